"""lcdParallel.h, spi_adc.h and lsm9ds1.h: chips on wires of their own. What the sources do."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import run, said
from tests.tools import require_tools

SAY = '#define SAY(value) print("%d ", value)\n'


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def test_a_display_gets_its_commands_and_characters_in_halves() -> None:
    found = run(
        '#include "simpletools.h"\n#include "lcdParallel.h"\nint main() {'
        "lcdParallel *lcd = lcdParallel_init(16, 2, 8, 4, 5, 6, 7, 8, 9);"
        'lcdParallel_print(lcd, "%c%d", 65, 7); lcdParallel_setCursor(lcd, 2, 1); lcdParallel_cursor(lcd); }',
        200, [],
    )  # fmt: skip
    lines, halves = dict.fromkeys(range(4, 10), 0), list[tuple[int, int]]()
    for change in found.trace.changes:
        pin, level = int(change.pin[1:]), int(change.level == 1)
        if pin == 5 and lines[5] and not level:
            halves.append((lines[4], sum(lines[6 + bit] << bit for bit in range(4))))
        lines[pin] = level
    assert [half for _, half in halves[:4]] == [3, 3, 3, 2]
    sent = [(high[0], high[1] << 4 | low[1]) for high, low in zip(halves[4::2], halves[5::2], strict=True)]
    assert sent == [(0, 0x28), (0, 0x0C), (0, 1), (0, 6), (1, 65), (1, 55), (0, 0xC2), (0, 0x0E)]


def test_a_converter_on_four_wires_is_read() -> None:
    high = DeviceUse("levels", {"pin": "P5"}, {"points": [[0, 1]]})
    told = said(
        "SAY((int)(MCP3202_getVolts(0, 4, 5, 6, 7, 4.096) * 1000 + 0.5)); SAY((int)(spi_adc(1, 4, 5, 6, 7, 8, 3) * 10));"
        "SAY((int)(MCP3002_getVolts(1, 4, 5, 6, 7, 1.024) * 1000 + 0.5));",
        50, [high], SAY, "spi_adc.h",
    )  # fmt: skip
    assert told == ["4095", "70", "1023"]


def test_a_sensor_of_nine_axes_is_read_and_calibrated() -> None:
    high = DeviceUse("levels", {"pin": "P5"}, {"points": [[0, 1]]})
    told = said(
        "int x, y, z; float t; SAY(imu_init(6, 5, 7, 8)); imu_setAccelScale(8); SAY(imu_getAccelScale()); "
        "imu_readTempCalculated(&t, 0); SAY((int)(t * 10000)); imu_calibrateAG(); imu_getAccelCalibration(&x, &y, &z);"
        "SAY(x); SAY(z); imu_readAccel(&x, &y, &z); SAY(x); SAY(z); SAY(imu_magAvailable());"
        "SAY(ee_getByte(63280)); SAY(ee_getByte(63294));",
        900, [high], SAY, "lsm9ds1.h",
    )  # fmt: skip
    assert told == ["0", "8", "249375", "-1", "-4097", "0", "4096", "1", str(ord("L")), str(ord("a"))]


def test_lower_bits_are_turned_round() -> None:
    told = said("SAY(__builtin_propeller_rev(0x73, 28)); SAY(__builtin_propeller_rev(1, 0) < 0);", 20, [], SAY, "propeller.h")
    assert told == ["12", "1"]
