"""sirc.h: remote controls. Semantics of the library's source (libsirc, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

ALL = [f"sirc.h/sirc_{name}" for name in ("button", "device", "code", "setTimeout")]


@proves(*ALL)
def keys_of_a_remote_control_are_read(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
void setup() { Serial.begin(115200); say(sirc_button(10)); delay(100); say(sirc_button(10)); delay(100); say(sirc_device(10));
  delay(100); say(sirc_code(10, 12)); sirc_setTimeout(300); delay(100); uint32_t begun = millis(); say(sirc_button(10));
  say((millis() - begun) / 10); }
void loop() {}
"""
    points = [[10, [4, 1]], [200, [9, 1]], [400, [21, 1]], [600, [106, 11]]]
    trace = uno.run(program, ALL, 1500, [DeviceUse("sony_remote", {"signal": "D10"}, {"points": points})])
    told = [int(each) for each in trace.text.split()]
    assert told[:5] == [5, 0, 1, 106 | 11 << 7, -1]
    assert told[5] in (30, 31, 32)  # looked at after each pulse, which is waited for 20 ms
