"""lsm9ds1.h: a sensor of motion with nine axes. Semantics of the library's source (1cc167c10)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.adapters.bench import Uno, proves

CLOCK, DATA, MOTION, FIELD = "D6", "D5", "D7", "D8"
OPEN = "Serial.begin(115200); imu_init(6, 5, 7, 8);"
SAY = """
float said[32];
uint8_t count;
void say(float number) { said[count++] = number; }
void loop() { for (uint8_t n = 0; n < count; n++) { Serial.print(said[n]); Serial.print(' '); } count = 0; }
"""
"""Helpers that print numbers only at the end, so that exchanges take the same time whatever is read."""
KNOWN = {(FIELD, 0x0F): [0x3D], (MOTION, 0x0F): [0x68]}
"""The identification registers of the two halves of the sensor."""

Exchange = tuple[str, list[int], list[float]]
"""An exchange: the chip select, the bits at the rising edges of the clock, the times of its falling edges in ms."""


def m(*names: str) -> list[str]:
    """The `header/name` of these adapters."""
    return [f"lsm9ds1.h/imu_{name}" for name in names]


def exchanges(trace: PinTrace) -> list[Exchange]:
    """The exchanges on the wires, one for each time that a half was selected."""
    lines, found = {CLOCK: 0, DATA: 0, MOTION: 1, FIELD: 1}, list[Exchange]()
    for change in trace.changes:
        if change.pin not in lines:
            continue
        level = 1 if change.level in (1, "p") else 0
        if change.pin in (MOTION, FIELD) and lines[change.pin] and not level:
            found.append((change.pin, [], []))
        if change.pin == CLOCK and found and not lines[found[-1][0]] and level != lines[CLOCK]:
            if level:
                found[-1][1].append(lines[DATA])
            else:
                found[-1][2].append(change.at_us / 1000)
        lines[change.pin] = level
    return found


def number(bits: Sequence[int]) -> int:
    """Bits, highest first, as a number."""
    return int("".join(map(str, bits)), 2)


def answered(
    uno: Uno, program: str, names: Sequence[str], ms: float, registers: Mapping[tuple[str, int], Sequence[int]]
) -> tuple[PinTrace, list[tuple[str, int, int]]]:
    """Run a program with a sensor that answers with its registers, 0 for others: the trace, and what was written.

    The sensor's answers are levels at given times, so the program runs again until the answers fit its questions.
    """
    points: list[list[float]] = [[0, 0]]
    for _ in range(8):
        trace = uno.run(program, names, ms, [DeviceUse("levels", {"pin": DATA}, {"points": points})])
        wanted: list[list[float]] = [[0, 0]]
        for select, bits, falls in exchanges(trace):
            if len(bits) <= 8 or not bits[0]:
                continue
            told = registers.get((select, number(bits[2:8])), [])
            sent = [told[place // 8] >> (7 - place % 8) & 1 if place // 8 < len(told) else 0 for place in range(len(bits) - 8)]
            wanted += [[falls[7 + place] + 0.0001, bit] for place, bit in enumerate(sent)]
        changes = [each for place, each in enumerate(wanted) if not place or wanted[place - 1][1] != each[1]]
        if changes == points:
            break
        points = changes
    written = [(select, number(bits[:8]), number(bits[8:16])) for select, bits, _ in exchanges(trace) if bits and not bits[0]]
    return trace, written


@proves(*m("init", "setGyroScale", "setAccelScale", "setMagScale", "getGyroScale", "getAccelScale", "getMagScale"))
def a_sensor_of_nine_axes_is_set_up(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); say(imu_init(6, 5, 7, 8)); say(imu_getGyroScale()); say(imu_getAccelScale());
  say(imu_getMagScale()); imu_setGyroScale(2000); imu_setAccelScale(4); imu_setMagScale(16); say(imu_getGyroScale());
  say(imu_getAccelScale()); say(imu_getMagScale()); imu_setGyroScale(1); imu_setAccelScale(3); imu_setMagScale(5);
  say(imu_getGyroScale()); say(imu_getAccelScale()); say(imu_getMagScale()); }}
"""
    names = m("init", "setGyroScale", "setAccelScale", "setMagScale", "getGyroScale", "getAccelScale", "getMagScale")
    held = {(MOTION, 0x10): [0xD1], (MOTION, 0x20): [0xE7], (FIELD, 0x21): [0x9F]}
    trace, written = answered(uno, program, names, 60, {**KNOWN, **held})
    assert [int(float(each)) for each in trace.text.split()] == [0x683D, 500, 8, 12, 2000, 4, 16, 245, 2, 4]
    begun = [(MOTION, 0x22, 0x0C), (FIELD, 0x22, 0x84)]
    set_up = [(0x10, 0xC0), (0x11, 0), (0x12, 0), (0x1E, 0x38), (0x13, 0), (0x1F, 0x38), (0x20, 0xC0), (0x21, 0)]
    fields = [(FIELD, 0x21, 0), (FIELD, 0x23, 0x0C), (FIELD, 0x24, 0)]
    assert written[:13] == [*begun, *((MOTION, *each) for each in set_up), *fields]
    scales = [(MOTION, 0x10, 0xC9), (MOTION, 0x20, 0xFF), (FIELD, 0x21, 0xDF)]
    assert written[13:19] == [*scales, (MOTION, 0x10, 0xD9), (MOTION, 0x20, 0xF7), (FIELD, 0x21, 0xFF)]
    assert written[19:] == [(MOTION, 0x10, 0xC1), (MOTION, 0x20, 0xE7), (FIELD, 0x21, 0x9F)]
    nobody, written = answered(uno, program, names, 60, {})
    assert nobody.text.split()[0] == "0.00"
    assert written[:3] == [*begun, (MOTION, 0x10, 0x18)]


READINGS = m(
    "readGyro", "readAccel", "readMag", "readTemp", "readGyroCalculated", "readAccelCalculated", "readMagCalculated",
    "readTempCalculated", "gyroAvailable", "accelAvailable", "magAvailable", "tempAvailable",
)  # fmt: skip


@proves(*READINGS)
def nine_axes_and_the_temperature_are_read(uno: Uno) -> None:
    program = f"""{SAY}
int32_t x, y, z;
float a, b, c;
void setup() {{ {OPEN} imu_readGyro(&x, &y, &z); say(x); say(y); say(z); imu_readAccel(&x, &y, &z); say(x); say(y); say(z);
  imu_readMag(&x, &y, &z); say(x); say(y); say(z); imu_readTemp(&x); say(x);
  imu_readGyroCalculated(&a, &b, &c); say(a); say(b); say(c);
  imu_readAccelCalculated(&a, &b, &c); say(a); say(b); say(c); imu_readMagCalculated(&a, &b, &c); say(a); say(b); say(c);
  imu_readTempCalculated(&a, 0); say(a); imu_readTempCalculated(&a, 1); say(a); imu_readTempCalculated(&a, 2); say(a);
  say(imu_gyroAvailable()); say(imu_accelAvailable()); say(imu_magAvailable()); say(imu_tempAvailable()); }}
"""
    readings = {
        (MOTION, 0x18): [0x00, 0x40, 0xFF, 0xFF, 0x01, 0x80], (MOTION, 0x28): [0x00, 0x10, 0x00, 0xF0, 0x02, 0x00],
        (FIELD, 0x28): [0xFB, 0x08, 0x05, 0xF7, 0x07, 0x00], (MOTION, 0x15): [0xF0, 0xFF],
        (MOTION, 0x27): [0x02], (FIELD, 0x27): [0x08],
    }  # fmt: skip
    trace, _ = answered(uno, program, [*m("init"), *READINGS], 80, {**KNOWN, **readings})
    told = [float(each) for each in trace.text.split()]
    assert told[:10] == [16384, -1, -32767, 4096, -4096, 2, 2299, -2299, 7, -16]
    assert told[10:13] == [pytest.approx(250, abs=0.01), pytest.approx(-0.02, abs=0.01), pytest.approx(-499.98, abs=0.01)]
    assert told[13:16] == [1, -1, 0]
    assert told[16:19] == [pytest.approx(1, abs=0.01), pytest.approx(-1, abs=0.01), 0]
    assert told[19:22] == [24, pytest.approx(75.2), pytest.approx(297.15, abs=0.01)]
    assert told[22:] == [1, 0, 1, 0]
    others, _ = answered(
        uno, program, [*m("init"), *READINGS], 80, {**KNOWN, **readings, (MOTION, 0x27): [5], (FIELD, 0x27): [7]}
    )
    assert [float(each) for each in others.text.split()][22:] == [0, 1, 0, 1]
    several = [number(bits[:8]) for select, bits, _ in exchanges(trace) if len(bits) > 16 and select == FIELD]
    assert several == [0xE8, 0xE8]  # the magnetometer is told that more bytes follow


BIASES = m(
    "setGyroCalibration", "setAccelCalibration", "setMagCalibration", "getGyroCalibration", "getAccelCalibration",
    "getMagCalibration", "init",
)  # fmt: skip


@proves(*BIASES)
def biases_are_taken_off_and_kept(uno: Uno) -> None:
    program = f"""{SAY}
int32_t x, y, z;
void read() {{ imu_readGyro(&x, &y, &z); say(x); imu_readAccel(&x, &y, &z); say(x); say(z); }}
void setup() {{ {OPEN} imu_setAccelCalibration(-5, 6, 300); read(); imu_setGyroCalibration(7, -8, 9); read();
  imu_setMagCalibration(-2, 0x123, 1); imu_getAccelCalibration(&x, &y, &z); say(x); say(y); say(z);
  imu_getGyroCalibration(&x, &y, &z); say(x); say(y); say(z); imu_getMagCalibration(&x, &y, &z); say(x); say(y); say(z);
  imu_setAccelCalibration(-5, 6, 300); imu_state = ImuState(); imu_init(6, 5, 7, 8); read();
  imu_getMagCalibration(&x, &y, &z); say(x); say(y); say(z); }}
"""
    names = [*BIASES, *m("readGyro", "readAccel"), "lsm9ds1.h/imu_state"]
    trace, written = answered(uno, program, names, 600, KNOWN)
    told = [int(float(each)) for each in trace.text.split()]
    assert told[:3] == [0, 5, -300]
    assert told[3:6] == [-7, 0, 0]  # the calibration of one takes that of the other back, as there
    assert told[6:15] == [-5, 6, 300, 7, -8, 9, -2, 0x123, 1]
    assert told[15:] == [-7, 0, 0, -2, 0x123, 1]  # read from the memory
    offsets = [(address, value) for select, address, value in written if select == FIELD and 5 <= address <= 10]
    assert offsets == 2 * [(5, 0xFE), (6, 0xFF), (7, 0x23), (8, 1), (9, 1), (10, 0)]


@proves(*m("calibrateAG"))
def the_mean_of_stored_readings_is_a_bias(uno: Uno) -> None:
    program = f"""{SAY}
int32_t x, y, z;
void setup() {{ {OPEN} imu_setAccelScale(8); imu_calibrateAG(); imu_getGyroCalibration(&x, &y, &z); say(x); say(y); say(z);
  imu_getAccelCalibration(&x, &y, &z); say(x); say(y); say(z); }}
"""
    names = m("init", "setAccelScale", "calibrateAG", "getGyroCalibration", "getAccelCalibration")
    ones = [DeviceUse("levels", {"pin": DATA}, {"points": [[0, 1]]})]
    trace = uno.run(program, names, 700, ones)
    assert [int(float(each)) for each in trace.text.split()] == [-1, -1, -1, -1, -1, -4097]
    seen = [(select, number(bits[:8]), bits[8:]) for select, bits, _ in exchanges(trace)]
    assert sum(select == MOTION and address == 0x98 for select, address, _ in seen) == 63  # what it says that it stored
    settings = [number(bits) for _, address, bits in seen if address == 0x2E]
    assert settings == [0x3F, 0]


@proves(*m("calibrateMag"))
def the_middle_of_1200_readings_is_a_bias(uno: Uno) -> None:
    program = f"""{SAY}
int32_t x, y, z;
void setup() {{ {OPEN} imu_calibrateMag(); imu_getMagCalibration(&x, &y, &z); say(x); say(y); say(z); }}
"""
    names = m("init", "calibrateMag", "getMagCalibration")
    levels = [DeviceUse("levels", {"pin": DATA}, {"points": [[0, 1], [500, 0], [520, 1]]})]
    trace = uno.run(program, names, 4200, levels)
    assert len(trace.text.split()) == 3
    seen = [(select, number(bits[:8])) for select, bits, _ in exchanges(trace)]
    assert seen.count((FIELD, 0xE8)) == 1200
    assert [address for _, address in seen if 5 <= address <= 10] == [5, 6, 7, 8, 9, 10]


INTERRUPTS = m(
    "setAccelInterrupt", "setGyroInterrupt", "setMagInterrupt", "clearAccelInterrupt", "clearGyroInterrupt", "clearMagInterrupt",
    "SPIwriteByte", "SPIreadBytes",
)  # fmt: skip


@proves(*INTERRUPTS)
def interrupts_of_the_sensor_are_set_and_cleared(uno: Uno) -> None:
    program = f"""{SAY}
uint8_t bytes[2];
void setup() {{ {OPEN} imu_setAccelInterrupt(1, -1.5, 20, 1, 1); imu_setGyroInterrupt(3, -90, 0, 0, 0);
  imu_setMagInterrupt(2, -2, 1); imu_clearAccelInterrupt(); imu_clearGyroInterrupt(); imu_clearMagInterrupt();
  imu_SPIwriteByte(8, 0x45, 0x77); imu_SPIreadBytes(7, 0x18, bytes, 2); say(bytes[0]); say(bytes[1]); }}
"""
    of_motion = {0x1E: [0x3A], 0x06: [0x01], 0x30: [0x80], 0x0C: [0xC0], 0x18: [1, 2]}
    held = {(MOTION, address): values for address, values in of_motion.items()}
    trace, written = answered(uno, program, [*m("init"), *INTERRUPTS], 100, {**KNOWN, **held})
    after = written[16:]
    accel, gyro, field = after[:5], after[5:15], after[15:18]
    assert accel == [(MOTION, 0x1E, 0x38), (MOTION, 8, 48), (MOTION, 6, 0x89), (MOTION, 0x0A, 0x94), (MOTION, 0x0C, 0xC0)]
    threshold = -5898 & 0x7FFF
    both = [(0x31 + half + 2 * axis, (threshold >> 8, threshold & 0xFF)[half]) for axis in range(3) for half in range(2)]
    assert gyro == [(MOTION, *each) for each in [(0x1E, 0x38), *both, (0x30, 0x15), (0x37, 0), (0x0C, 0xC0)]]
    assert field == [(FIELD, 0x32, 4597 & 0xFF), (FIELD, 0x33, 4597 >> 8), (FIELD, 0x30, 0x27)]
    rest = [(MOTION, address, 0) for address in (7, 8, 9, 6, 0x0A)] + [(MOTION, 0x0C, 0x80)]
    rest += [(MOTION, address, 0) for address in (0x31, 0x32, 0x33, 0x34, 0x35, 0x36, 0x30, 0x37)] + [(MOTION, 0x0C, 0x40)]
    rest += [(FIELD, address, 0) for address in (0x32, 0x33, 0x30, 0x30)] + [(FIELD, 5, 0x77)]
    assert after[18:] == rest
    assert [int(float(each)) for each in trace.text.split()] == [1, 2]
