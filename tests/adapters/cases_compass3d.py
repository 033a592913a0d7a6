"""compass3d.h: a compass. Semantics of the library's source (libcompass3d, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

BOTH = ["compass3d.h/compass_init", "compass3d.h/compass_read"]


@proves(*BOTH)
def three_axes_are_read_in_the_order_of_the_compass(uno: Uno) -> None:
    program = """
int x, y, z;
void setup() { Serial.begin(115200); i2c *bus = i2c_newbus(SCL, SDA, 0); compass_init(bus); compass_read(bus, &x, &y, &z);
  Serial.print(x); Serial.print(' '); Serial.print(y); Serial.print(' '); Serial.print(z); }
void loop() {}
"""
    content = [0x70, 0xA0, 1, 0x01, 0x02, 0xFF, 0x38, 0x00, 0x64]
    compass = DeviceUse("registers", {}, {"address": 0x1E, "content": content})
    trace = uno.run(program, [*BOTH, "simpletools.h/i2c_newbus"], 30, [compass])
    assert trace.text == "258 100 -200"
    assert [event.value for event in trace.device_events] == [[2, 0]]
