"""i2c.h and eeprom.h: the two-wire bus and memories on it. Semantics of propgcc b280e7a77 (lib/sys/propeller)."""

from __future__ import annotations

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

BUS = [
    f"i2c.h/{name}" for name in ("i2cOpen", "simple_i2cOpen", "i2cClose", "i2cWrite", "i2cWriteMore", "i2cRead", "i2cReadMore")
]


@proves(*BUS)
def registers_are_written_and_read_in_parts(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
I2C_COGDRIVER driver; I2C_SIMPLE simple; uint8_t data[4];
void setup() { Serial.begin(115200); say(i2cOpen(&driver, SCL, SDA, 500000) == 0); I2C *bus = i2cOpen(&driver, SCL, SDA, 400000);
  say(TWBR); const uint8_t out[] = {3, 77, 78}; say(i2cWrite(bus, 0xD0, out, 1, 0)); say(i2cWriteMore(bus, out + 1, 2, 1));
  say(i2cWrite(bus, 0xD0, out, 1, 0)); say(i2cRead(bus, 0xD0, data, 2, 1)); say(data[0]); say(data[1]);
  say(i2cRead(bus, 0xD0, data, 1, 1)); say(data[0]); say(i2cRead(bus, 0x40, data, 1, 1)); say(i2cWrite(bus, 0x40, out, 1, 1));
  say(i2cClose(bus)); say(i2cWrite(bus, 0xD0, out, 1, 1)); bus = simple_i2cOpen(&simple, SCL, SDA); say(TWBR);
  i2cWrite(bus, 0xD0, out, 1, 0); i2c_start(&bus->bus); i2c_writeByte(&bus->bus, 0xD1); say(i2cReadMore(bus, data, 3, 1));
  say(data[0]); say(data[2]); bus = i2cOpen(&driver, 4, 5, 100000); say(i2cRead(bus, 0xD0, data, 1, 1));
  bus = simple_i2cOpen(&simple, 4, 5); say(i2cWrite(bus, 0xD0, out, 1, 1)); }
void loop() {}
"""
    device = DeviceUse("registers", {}, {"address": 0x68, "content": [50, 51, 52, 53, 54, 55]})
    uses = [
        *BUS,
        *(f"i2c.h/{name}" for name in ("I2C_COGDRIVER", "I2C_SIMPLE")),
        "simplei2c.h/i2c_start",
        "simplei2c.h/i2c_writeByte",
    ]
    told = [int(each) for each in uno.run(program, uses, 60, [device]).text.split()]
    assert told[:8] == [1, 12, 0, 0, 0, 0, 77, 78]
    assert told[8:14] == [0, 55, -1, -1, 0, -1]
    assert told[14:] == [72, 0, 77, 55, -1, -1]


MEMORY = [
    f"eeprom.h/{name}" for name in ("eepromOpen", "simple_eepromOpen", "eepromInit", "eepromRead", "eepromWrite", "eepromClose")
]


@proves(*MEMORY)
def a_memory_on_the_bus_keeps_bytes(uno: Uno) -> None:
    program = """
void say(int32_t number) { Serial.print(number); Serial.print(' '); }
EEPROM_COGDRIVER driver; EEPROM_SIMPLE simple; EEPROM other; uint8_t data[4];
void setup() { Serial.begin(115200); say(eepromOpen(&driver, SCL, SDA, 500000, 0xA0) == 0);
  EEPROM *memory = eepromOpen(&driver, SCL, SDA, 400000, 0xA0); const uint8_t out[] = {7, 8, 9};
  say(eepromWrite(memory, 0x102, out, 3)); say(eepromRead(memory, 0x103, data, 2)); say(data[0]); say(data[1]);
  eepromInit(&other, memory->dev, 0xA4); say(eepromRead(&other, 0, data, 1)); say(eepromWrite(&other, 0, out, 1));
  say(eepromClose(memory)); say(eepromClose(memory)); memory = simple_eepromOpen(&simple, SCL, SDA, 0xA0);
  say(eepromRead(memory, 0x102, data, 1)); say(data[0]); say(other.address); }
void loop() {}
"""
    device = DeviceUse("eeprom", {}, {"address": 0x50, "content": [0] * 0x200})
    told = [int(each) for each in uno.run(program, [*MEMORY, "eeprom.h/EEPROM_SIMPLE"], 80, [device]).text.split()]
    assert told == [1, 0, 0, 8, 9, -1, -1, 0, -1, 0, 7, 0xA4]
