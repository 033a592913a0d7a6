"""soundimpact.h, colormath.h, stacktest.h, and i2c.h and eeprom.h of propgcc: what the sources do."""

from __future__ import annotations

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.host_model.bench import run, said
from tests.tools import require_tools

SAY = '#define SAY(value) print("%d ", value)\n'


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def test_sounds_are_counted_by_a_cog() -> None:
    levels = [[at + part, 1 - 2 * part] for at in (10, 25, 30, 60) for part in (0, 0.5)]
    sensor = DeviceUse("levels", {"pin": "P4"}, {"points": [[0, 0], *([at, int(level == 1)] for at, level in levels)]})
    told = said(
        "int *p = soundImpact_run(4); pause(40); SAY(soundImpact_getCount()); pause(40); SAY(soundImpact_getCount()); "
        "soundImpact_end(p); SAY(soundImpact_getCount());",
        200, [sensor], SAY, "soundimpact.h",
    )  # fmt: skip
    assert told == ["3", "1", "0"]


def test_colours_lose_their_lowest_bits() -> None:
    told = said("SAY(remapColor888to565(0xFF0000)); SAY(remapColor888to565(0x345678));", 20, [], SAY, "colormath.h")
    assert told == [str(0xF800), str(0x34 >> 3 << 11 | 0x56 >> 2 << 5 | 0x78 >> 3)]


def test_how_much_stack_a_cog_of_the_original_uses_is_not_known() -> None:
    found = run(
        '#include "stacktest.h"\nvoid idle(void *p) { for (;;) pause(1); }\n'
        "int main() { int *cog = cog_runStackTest(idle, 50); pause(5); cog_endStackTest(cog); }",
        50, [],
    )  # fmt: skip
    assert (found.status, found.cause) == ("unmodelled", "the stack of a cog")


def test_a_memory_of_propgcc_keeps_bytes() -> None:
    memory = DeviceUse("eeprom", {}, {"address": 0x51, "content": [0] * 0x200})
    told = said(
        "EEPROM_COGDRIVER d; EEPROM_SIMPLE s; uint8_t out[3] = {7, 8, 9}, in[2]; SAY(eepromOpen(&d, 28, 29, 500000, 0xA2) == 0);"
        "EEPROM *m = eepromOpen(&d, 28, 29, 400000, 0xA2); SAY(eepromWrite(m, 0x102, out, 3)); SAY(eepromRead(m, 0x103, in, 2));"
        "SAY(in[0]); SAY(in[1]); SAY(eepromClose(m)); SAY(eepromClose(m)); m = simple_eepromOpen(&s, 28, 29, 0xA6);"
        "SAY(eepromRead(m, 0, in, 1));",
        200, [memory], SAY, "eeprom.h",
    )  # fmt: skip
    assert told == ["1", "0", "0", "8", "9", "0", "-1", "-1"]
