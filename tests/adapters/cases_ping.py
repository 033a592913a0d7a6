"""ping.h: the ranger with one pin. Semantics of the library's source (libping, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves


@proves("ping.h/ping", "ping.h/ping_cm", "ping.h/ping_inches")
def rangers_are_read_in_microseconds_centimetres_and_inches(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); }
void loop() { Serial.print(ping_cm(7)); Serial.print(' '); Serial.print(ping(7)); Serial.print(' ');
Serial.println(ping_inches(7)); delay(30); }
"""
    points = [[0, 10.4], [100, 254.2], [300, None]]
    trace = uno.run(
        program,
        ["ping.h/ping", "ping.h/ping_cm", "ping.h/ping_inches"],
        1900,
        [DeviceUse("ranger", {"signal": "D7"}, {"points": points})],
    )
    read = [tuple(map(int, line.split())) for line in trace.text.splitlines() if len(line.split()) == 3]
    near, far = read[0], next(line for line in read if line[0] > 200)
    assert near[0] == 10
    assert abs(near[1] - 10.4 * 58) <= 8
    assert near[2] == 4
    assert far[0] == 254
    assert far[2] == 99
    assert read[-1] == (0, 0, 0)
