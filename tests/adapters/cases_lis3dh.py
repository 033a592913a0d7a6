"""lis3dh.h: an accelerometer. Semantics of the library's sources (liblis3dh, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

SAY = "void say(int32_t number) { Serial.print(number); Serial.print(' '); }"


def words(*values: int) -> list[int]:
    """16-bit values as bytes, lowest byte first."""
    return [byte for value in values for byte in (value & 0xFF, value >> 8 & 0xFF)]


CONTENT = [0] * 0x40
CONTENT[0x0F], CONTENT[0x27] = 0x33, 0x08
CONTENT[0x08:0x0E] = words(700 << 4, -1016 << 4, 40 << 4)
CONTENT[0x28:0x2E] = words(500 << 4, -250 << 4, 866 << 4)


def sensor(sdo: str) -> DeviceUse:
    """The sensor at an Uno."""
    return DeviceUse("serial_registers", {"select": "D5", "clock": "D6", "data_in": "D7", "data_out": sdo}, {"content": CONTENT})


def m(*names: str) -> list[str]:
    """The `header/name` of these functions of lis3dh.h."""
    return [f"lis3dh.h/lis3dh_{name}" for name in names]


THREE_WIRES = m(
    "init", "accel", "getAccel", "accel_mg", "getAccel_mg", "setRange", "getRange", "setResolution", "getResolution", "tilt",
    "tiltConfig", "getWhoAmI", "readByte", "writeByte", "shutdown",
)  # fmt: skip
FOUR_WIRES = m(
    "init4wire", "adc", "getADC", "adc_mV", "getADC_mV", "adcCal_mV", "tempRaw", "temp_C", "temp_F", "tempCal_C", "tempCal_F",
    "setADCmode", "setBDUmode", "setSPImode", "getSPImode",
)  # fmt: skip


@proves(*THREE_WIRES)
def accelerations_are_read_over_three_wires(uno: Uno) -> None:
    program = f"""{SAY}
int x, y, z, motion;
void setup() {{ Serial.begin(115200); lis3dh *device = lis3dh_init(6, 7, 5); say(lis3dh_getWhoAmI(device));
  say(lis3dh_getRange(device)); say(lis3dh_getResolution(device)); say(lis3dh_accel(device, &x, &y, &z)); say(x); say(y); say(z);
  say(lis3dh_getAccel_mg(device, 2)); say(lis3dh_tilt(device, &x, &y, &z, &motion)); say(x); say(y); say(z); say(motion);
  lis3dh_setRange(device, 16); lis3dh_setResolution(device, 10); say(lis3dh_getRange(device)); say(lis3dh_getResolution(device));
  say(lis3dh_accel_mg(device, &x, &y, &z)); say(x); say(y); say(z); say(lis3dh_getAccel(device, 3));
  lis3dh_setResolution(device, 8); say(lis3dh_getAccel_mg(device, 1)); lis3dh_setResolution(device, 12);
  lis3dh_setRange(device, 2); say(lis3dh_tiltConfig(device, 101)); say(lis3dh_tiltConfig(device, 50));
  lis3dh_writeByte(device, 0x28, 0); lis3dh_writeByte(device, 0x29, 0); say(lis3dh_readByte(device, 0x2C));
  lis3dh_tilt(device, &x, &y, &z, &motion); say(x); lis3dh_shutdown(device); lis3dh_writeByte(device, 0x27, 0);
  say(lis3dh_accel(device, &x, &y, &z)); }}
void loop() {{}}
"""
    trace = uno.run(program, [*THREE_WIRES, "lis3dh.h/lis3dh"], 400, [sensor("D7")])
    told = [int(each) for each in trace.text.split()]
    assert told[:8] == [0x33, 2, 12, 1, 500, -250, 866, -250]
    assert told[8:13] == [1, 29, -14, 32, 30]
    assert told[13:21] == [16, 10, 1, 125 * 48, -63 * 48, 216 * 48, 216, 31 * 192]
    assert told[21:] == [0, 1, (866 << 4) & 0xFF, 15, 0]
    assert [event.value for event in trace.device_events][-2:] == [[0x20, 0], [0x27, 0]]


@proves(*FOUR_WIRES)
def voltages_and_temperatures_are_read_over_four_wires(uno: Uno) -> None:
    program = f"""{SAY}
int a, b, c;
void setup() {{ Serial.begin(115200); lis3dh_t *device = lis3dh_init4wire(6, 7, 8, 5); lis3dh_adc(device, &a, &b, &c);
  say(a); say(b); say(c); say(lis3dh_getADC(device, 2)); lis3dh_adc_mV(device, &a, &b, &c); say(a); say(b); say(c);
  say(lis3dh_getADC_mV(device, 1)); lis3dh_adcCal_mV(device, 0, 3300, 100, 3200); say(lis3dh_getADC_mV(device, 1));
  say(lis3dh_tempRaw(device)); lis3dh_tempCal_C(device, 21); say(lis3dh_temp_C(device)); say(lis3dh_temp_F(device));
  lis3dh_tempCal_F(device, 86); say(lis3dh_temp_C(device));
  lis3dh_setADCmode(device, 0, 1); say(lis3dh_readByte(device, 0x1F)); say(lis3dh_getSPImode(device));
  lis3dh_setSPImode(device, 3); say(lis3dh_getSPImode(device)); say(lis3dh_readByte(device, 0x23)); lis3dh_setBDUmode(device, 1);
  say(lis3dh_readByte(device, 0x23)); }}
void loop() {{}}
"""
    told = [int(each) for each in uno.run(program, [*FOUR_WIRES, *m("readByte")], 1600, [sensor("D8")]).text.split()]
    calibrated = 1000 * 3300 // 3100
    first = (700 - 1400) * 7800 // -3432
    assert told[:8] == [700, -1016, 40, -1016, first, 900 + 800 * 3048 // 4064, 900 + 800 * 1992 // 4064, first]
    assert told[8] == pytest.approx((first * calibrated - calibrated * 100) / 1000, abs=1)
    assert told[9:13] == [12, 21, 69, 31]  # tempCal_F rounds up too often, as there
    assert told[13:] == [0x40, 4, 3, 0x89, 0x09]
