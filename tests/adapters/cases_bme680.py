"""bme680.h: a sensor of air. Semantics of the library's sources (libbme680, Simple-Libraries 1cc167c10).

The truth is calculated here, in doubles, from the formulas that they write down.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

SAY = "void say(float number) { Serial.print(number, 3); Serial.print(' '); }"
FIRST, SECOND = 0x89, 0xE1
COEFFICIENTS = bytes.fromhex("00 1466 03 f3 998f 40 d7 58 00 c420 a0ff 20 1e 0000 c3f3 78f2 1e 78")  # from 0x89 on, 25 bytes
MORE = bytes.fromhex("3f af 2c 00 2d 14 78 9c 7665 51d4 e3 12 00 00")  # from 0xE1 on, 16 bytes
MEASURED = bytes.fromhex(
    "80 03 4e b0 40 7a 5c 80 50 a0 00 00 00 9b f5"
)  # from 0x1D on: flags, pressure, temperature, humidity, gas
HEAT = {0x00: 0x2B, 0x02: 0x16, 0x04: 0x33}


def content() -> list[int]:
    """The sensor's registers."""
    cells = bytearray(256)
    cells[FIRST : FIRST + 25] = COEFFICIENTS
    cells[SECOND : SECOND + 16] = MORE
    cells[0x1D : 0x1D + 15] = MEASURED
    for register, byte in HEAT.items():
        cells[register] = byte
    return list(cells)


def words(at: int, form: str = "<h") -> int:
    """A coefficient of two bytes from an address on."""
    number: int = struct.unpack_from(form, COEFFICIENTS + MORE, at)[0]
    return number


def truth() -> dict[str, float]:
    """The results of the library's formulas for the measured values; single bytes are unsigned there."""
    cal = COEFFICIENTS + MORE
    adc = MEASURED[5] << 12 | MEASURED[6] << 4 | MEASURED[7] >> 4
    t1, t2, t3 = words(33, "<H"), words(1), cal[3]
    fine = (adc / 16384 - t1 / 1024) * t2 + (adc / 131072 - t1 / 8192) ** 2 * t3 * 16
    celsius = fine / 5120
    adc = MEASURED[2] << 12 | MEASURED[3] << 4 | MEASURED[4] >> 4
    one = fine / 2 - 64000
    two = one * one * cal[16] / 131072 + one * words(13) * 2
    two = two / 4 + words(11) * 65536
    one = (cal[9] * one * one / 16384 + words(7) * one) / 524288
    one = (1 + one / 32768) * words(5, "<H")
    pressure = (1048576 - adc - two / 4096) * 6250 / one
    square, line = words(21) * pressure * pressure / 2147483648, pressure * words(19) / 32768
    pressure += (square + line + (pressure / 256) ** 3 * cal[23] / 131072 + cal[15] * 128) / 16
    adc = MEASURED[8] << 8 | MEASURED[9]
    h1, h2 = cal[27] << 4 | cal[26] & 15, cal[25] << 4 | cal[26] >> 4
    beyond = adc - (h1 * 16 + cal[28] / 2 * celsius)
    beyond *= h2 / 262144 * (1 + cal[29] / 16384 * celsius + cal[30] / 1048576 * celsius**2)
    humidity = beyond + (cal[31] / 16384 + cal[32] / 2097152 * celsius) * beyond**2
    first = [0, 0, 0, 0, 0, -1, 0, -0.8, 0, 0, -0.2, -0.5, 0, -1, 0, 0]
    second = [0, 0, 0, 0, 0.1, 0.7, 0, -0.8, -0.1, 0, 0, 0, 0, 0, 0, 0]
    scale, adc = MEASURED[14] & 15, MEASURED[13] << 2 | MEASURED[14] >> 6
    span = (1340 + 5 * (HEAT[0x04] >> 4)) * (1 + first[scale] / 100)
    gas = 1 / ((1 + second[scale] / 100) * 0.000000125 * (1 << scale) * ((adc - 512) / span + 1))
    slope = words(35) / 32768 * 0.0005 + 0.00235
    heat = (cal[37] / 16 + 49) * (1 + slope * 320) + cal[38] / 1024 * 25
    heater = int(3.4 * (heat * 4 / (4 + (HEAT[0x02] >> 4 & 3)) / (1 + HEAT[0x00] * 0.002) - 25))
    return {"celsius": celsius, "pressure": pressure, "humidity": humidity, "gas": gas, "heater": heater}


def b(*names: str) -> list[str]:
    """The `header/name` of these functions of bme680.h."""
    return [f"bme680.h/bme680_{name}" for name in names]


READINGS = b("readSensor", "temperature", "pressure", "altitude", "humidity", "gasResistance")
UNITS = [f"bme680.h/{name}" for name in ("CELSIUS", "FAHRENHEIT", "KELVIN", "PASCALS", "MMHG", "INHG", "PSI", "METERS", "FEET")]
SETTINGS = [f"bme680.h/BME680_{name}" for name in (
    "SETTING_AMB_TEMP", "SETTING_HEATER_TEMP", "SETTING_HEATER_DURATION", "SETTING_FILTER_SIZE", "SETTING_TEMP_SAMPLES",
    "SETTING_PRESSURE_SAMPLES", "SETTING_HUMIDITY_SAMPLES", "OS_NONE", "OS_1X", "OS_16X", "FILTER_SIZE_127",
)]  # fmt: skip
SPI = DeviceUse(
    "serial_registers",
    {"select": "D5", "clock": "D6", "data_in": "D7", "data_out": "D8"},
    {"content": content(), "step": True, "page": 0x73},
)


def written(trace_events: Sequence[object]) -> list[tuple[int, ...]]:
    """The writes of registers, as numbers."""
    return [tuple(event.value) for event in trace_events if event.what == "written"]  # type: ignore[attr-defined]


@proves(*b("openSPI", "write", "read", "begin", "loadSettings", "close"), *READINGS)
def air_is_measured_over_four_wires(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); bme680 *air = bme680_openSPI(6, 7, 8, 5); say(bme680_readSensor(air));
  say(bme680_temperature(air, CELSIUS)); say(bme680_temperature(air, FAHRENHEIT)); say(bme680_temperature(air, KELVIN));
  say(bme680_pressure(air, PASCALS)); say(bme680_pressure(air, MMHG)); say(bme680_pressure(air, INHG));
  say(bme680_pressure(air, PSI) * 1000); say(bme680_altitude(air, METERS)); say(bme680_altitude(air, FEET));
  say(bme680_humidity(air)); say(bme680_gasResistance(air)); uint8_t byte = 0;
  bme680_read(air, 0x1d, &byte, 1); bme680_write(air, 0x1d, "\\0", 1); say(byte); say(bme680_readSensor(air));
  say(bme680_humidity(air)); air->temp_oversample = 1; bme680_loadSettings(air); bme680_close(air); say(millis());
  void *place = malloc(sizeof(bme680_t)); say(place == (void *)air); bme680_begin(air); say(air->temp_oversample); }}
void loop() {{}}
"""
    used = [*b("openSPI", "write", "read", "begin", "loadSettings", "close"), *READINGS, *UNITS, "bme680.h/bme680"]
    trace = uno.run(program, used, 1500, [SPI])
    told = [float(each) for each in trace.text.split()]
    right = truth()
    assert told[0] == 0
    assert told[1] == pytest.approx(right["celsius"], abs=0.01)
    assert 10 < told[1] < 40
    assert told[2] == pytest.approx(right["celsius"] * 1.8 + 32, abs=0.02)
    assert told[3] == pytest.approx(right["celsius"] + 273.15, abs=0.01)
    assert told[4] == pytest.approx(right["pressure"], rel=1e-4)
    assert told[5] == pytest.approx(right["pressure"] * 0.0075006156, rel=1e-4)
    assert told[6] == pytest.approx(right["pressure"] * 0.00029529983, rel=1e-4)
    assert told[7] == pytest.approx(right["pressure"] * 0.145037738, rel=1e-4)
    metres = 44330 * (1 - (right["pressure"] / 101325) ** 0.1903)
    assert told[8] == pytest.approx(metres, abs=2)
    assert told[9] == pytest.approx(metres * 3.28084, abs=6)
    assert told[10] == pytest.approx(right["humidity"], abs=0.02)
    assert 0 < told[10] < 100
    assert told[11] == pytest.approx(right["gas"], rel=1e-3)
    assert told[12] == 0x80
    assert told[13:15] == [255, 0]
    waited = 10 + 183 + 10 + 183 + 10 + 183 + 10 * 10 + 10
    assert waited < told[15] < waited + 110  # the bits take their time, too
    assert told[16:] == [1, 4]
    stored = written(trace.device_events)
    assert stored[:6] == [(0x73, 0), (0x60 + 128, 0), (0x73, 0x10), (0x5A, right["heater"]), (0x5B, 0x64), (0x5C, 64 + 37)]
    assert stored[6:14] == [
        (0x74, 0x8C), (0x75, 0x08), (0x76, 0x74), (0x77, 4 << 5 | 3 << 2), (0x78, 0x72), (0x79, 2), (0x7A, 0x71), (0x7B, 0x10),
    ]  # fmt: skip
    assert stored[14:16] == [(0x74, 0x8D), (0x74, 0x8C)]
    assert (0x77, 1 << 5 | 3 << 2) in stored[16:]


@proves(*b("openI2C", "configure", "heaterEnable", "heaterDisable"))
def air_is_measured_on_the_two_wire_bus(uno: Uno) -> None:
    program = f"""{SAY}
i2c bus;
void setup() {{ Serial.begin(115200); bme680_t *air = bme680_openI2C(i2c_newbus(SCL, SDA, 0), 0x77); say(bme680_readSensor(air));
  say(bme680_temperature(air, CELSIUS)); uint32_t begun = millis(); bme680_heaterDisable(air); say(millis() - begun);
  uint8_t byte = 0; bme680_read(air, 0x70, &byte, 1); say(byte); begun = millis(); bme680_heaterEnable(air);
  say(millis() - begun); bme680_read(air, 0x70, &byte, 1); say(byte);
  bme680_configure(air, BME680_SETTING_HUMIDITY_SAMPLES, BME680_OS_16X);
  bme680_configure(air, BME680_SETTING_TEMP_SAMPLES, BME680_OS_16X);
  bme680_configure(air, BME680_SETTING_PRESSURE_SAMPLES, BME680_OS_NONE); say(air->sensor_reading_period);
  bme680_configure(air, BME680_SETTING_FILTER_SIZE, BME680_FILTER_SIZE_127);
  bme680_configure(air, BME680_SETTING_HEATER_DURATION, 60); bme680_configure(air, BME680_SETTING_HEATER_TEMP, 500);
  bme680_configure(air, BME680_SETTING_AMB_TEMP, 0); say(air->heater_temp); say(air->amb_temp); say(air->pres_oversample); }}
void loop() {{}}
"""
    sensor = DeviceUse("registers", {}, {"address": 0x77, "content": content()})
    used = [*b("openI2C", "configure", "heaterEnable", "heaterDisable", "readSensor", "temperature", "read"), *UNITS, *SETTINGS]
    trace = uno.run(program, [*used, "simpletools.h/i2c_newbus"], 1500, [sensor])
    told = [float(each) for each in trace.text.split()]
    assert told[0] == 0
    assert told[1] == pytest.approx(truth()["celsius"], abs=0.01)
    assert told[2] == pytest.approx(251, abs=3)
    assert told[3] == 0x08
    assert told[4] == pytest.approx(251, abs=3)
    assert told[5:] == [0, 30769, 400, 0, 0]  # without samples the Propeller shifts by 31
    stored = written(trace.device_events)
    assert stored[0] == (0xE0, 0)
    last = {each[0]: each[1] for each in stored}
    assert (last[0x75], last[0x77], last[0x79], last[0x5C]) == (7 << 2, 5 << 5, 5, 60)
