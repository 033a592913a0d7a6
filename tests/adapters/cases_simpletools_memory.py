"""simpletools.h and simplei2c.h: EEPROM, two-wire bus. Semantics of the library's sources (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

NAMES = ("putByte", "getByte", "putInt", "getInt", "putStr", "getStr", "putFloat32", "getFloat32")
OLDER = ("put_byte", "get_byte", "put_int", "get_int", "put_str", "get_str", "put_float32")


def s(*names: str) -> list[str]:
    """The `header/name` of these functions of simpletools.h."""
    return [f"simpletools.h/{name}" for name in names]


def i(*names: str) -> list[str]:
    """The `header/name` of these functions of simplei2c.h."""
    return [f"simplei2c.h/{name}" for name in names]


@proves(*s(*(f"ee_{name}" for name in (*NAMES, *OLDER))))
def what_is_put_into_the_memory_is_there(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200);
  ee_putInt(-123456, 32768); Serial.print(ee_getInt(32768)); Serial.print(' ');
  for (int32_t at = 0; at < 4; at++) { Serial.print(ee_getByte(32768 + at), HEX); Serial.print(' '); }
  ee_putByte(200, 33); ee_putByte(7, 34); Serial.print(ee_getByte(33) + ee_getByte(34)); Serial.print(' ');
  ee_putFloat32(-1.25, 40); Serial.print(ee_getFloat32(40)); Serial.print(' '); Serial.print((uint32_t)ee_getInt(40), HEX);
  char text[6] = "?????"; ee_putStr("Hello", 6, 50); Serial.print(' '); Serial.print(ee_getStr(text, 5, 51));
  Serial.println(ee_getByte(50));
  ee_put_int(70000, 60); ee_put_byte(9, 64); ee_put_str("ab", 3, 65); ee_put_float32(2.5, 70);
  Serial.print(ee_get_int(60)); Serial.print(ee_get_byte(64)); Serial.print(ee_get_str(text, 3, 65));
  Serial.print(ee_getFloat32(70));
} void loop() {}
"""
    trace = uno.run(program, s(*(f"ee_{name}" for name in (*NAMES, *OLDER))), 300)
    bits = " ".join(f"{byte:X}" for byte in (-123456).to_bytes(4, "little", signed=True))
    assert trace.text.split("\r\n") == [f"-123456 {bits} 207 -1.25 BFA00000 ello72", "700009ab2.50"]


@proves(*s("i2c_newbus", "i2c_out", "i2c_in", "i2c_busy"))
def devices_on_the_bus_are_written_and_read(uno: Uno) -> None:
    program = """
uint8_t data[6], more[40];
void show(int32_t count) { Serial.print(count); for (int at = 0; at < 4; at++) { Serial.print(' '); Serial.print(data[at]);
  } Serial.print("\\r\\n"); }
void setup() { Serial.begin(115200);
  i2c *bus = i2c_newbus(SCL, SDA, 0), *none = i2c_newbus(4, 5, 0);
  const uint8_t out[] = {1, 2, 3};
  Serial.println(i2c_out(bus, 0x50, 0x0102, 2, out, 3)); Serial.println(i2c_busy(bus, 0x50));
  while (i2c_busy(bus, 0x50)) yield();
  show(i2c_in(bus, 0x50, 0x0101, 2, data, 4)); show(i2c_in(bus, 0x50, 0x0001, -2, data, 2));
  show(i2c_in(bus, 0x50, 0x0102, 2, data, -3));
  show(i2c_in(bus, 0x68, 4, 1, data, 4)); i2c_out(bus, 0x68, 9, 1, out, -2); show(i2c_in(bus, 0x68, 9, 1, data, 2));
  show(i2c_in(bus, 0x68, 20, 1, more, 40)); Serial.println(more[39]);
  Serial.println(i2c_out(bus, 0x33, 1, 1, out, 1)); show(i2c_in(none, 0x50, 1, 2, data, 4)); Serial.println(i2c_busy(none, 0x50));
} void loop() {}
"""
    devices = [
        DeviceUse("eeprom", {}, {"address": 0x50, "content": [0] * 0x101 + [9]}),
        DeviceUse("registers", {}, {"address": 0x68, "content": list(range(10, 110))}),
    ]
    trace = uno.run(program, [*s("i2c_newbus", "i2c_out", "i2c_in", "i2c_busy"), *i("i2c")], 100, devices)
    assert trace.text.split("\r\n")[:-1] == [
        "6", "1", "7 9 1 2 3", "5 0 9 2 3", "6 3 2 1 3", "6 14 15 16 17", "4 2 1 16 17", "42 2 1 16 17", "69", "0",
        "0 2 1 16 17", "1",
    ]  # fmt: skip


@proves(*i("i2c_open", "i2c_start", "i2c_stop", "i2c_writeByte", "i2c_readByte", "i2c_writeData", "i2c_readData", "i2c_poll"))
def the_bus_goes_byte_by_byte(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200);
  i2c bus; Serial.print(i2c_open(&bus, SCL, SDA, 0) == &bus);
  const uint8_t out[] = {3, 77, 78};
  i2c_start(&bus); Serial.print(i2c_writeByte(&bus, 0xD0)); Serial.print(i2c_writeData(&bus, out, 3)); i2c_stop(&bus);
  i2c_start(&bus); i2c_writeByte(&bus, 0xD0); i2c_writeByte(&bus, 3); i2c_start(&bus); Serial.print(i2c_writeByte(&bus, 0xD1));
  Serial.print(' '); Serial.print(i2c_readByte(&bus, 0)); Serial.print(' '); Serial.print(i2c_readByte(&bus, 1)); i2c_stop(&bus);
  uint8_t in[3] = {0, 0, 0};
  i2c_start(&bus); i2c_writeByte(&bus, 0xD0); i2c_writeByte(&bus, 2); i2c_start(&bus); i2c_writeByte(&bus, 0xD1);
  Serial.print(' '); Serial.print(i2c_readData(&bus, in, 3)); i2c_stop(&bus);
  Serial.print(in[0]); Serial.print(in[1]); Serial.print(in[2]);
  Serial.print(' '); Serial.print(i2c_poll(&bus, 0xD0)); Serial.print(i2c_poll(&bus, 0xD2)); i2c_stop(&bus);
  i2c_start(&bus); i2c_writeByte(&bus, 0xA0); i2c_writeData(&bus, out, 3); i2c_stop(&bus); Serial.print(i2c_poll(&bus, 0xA0));
  i2c_open(&bus, 3, 4, 1); Serial.print(i2c_writeByte(&bus, 0xD0)); Serial.print(i2c_readByte(&bus, 0));
} void loop() {}
"""
    names = i("i2c_open", "i2c_start", "i2c_stop", "i2c_writeByte", "i2c_readByte", "i2c_writeData", "i2c_readData", "i2c_poll")
    device = DeviceUse("registers", {}, {"address": 0x68, "content": [50, 51, 52]})
    memory = DeviceUse("eeprom", {}, {"address": 0x50})
    trace = uno.run(program, names, 50, [device, memory])
    assert trace.text == "1" + "03" + "0 77 78" + " 2527778" + " 01" + "1" + "10"  # an EEPROM is busy from the stop on
    assert [event.value for event in trace.device_events] == [[3, 77], [4, 78], [3 << 8 | 77, 78]]
