"""The board files against the core's own files, and against each other."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError, UsageError
from robosmi.verify.boards import Board, find_board, load_board, load_boards
from tests.tools import KNOWN_PLACES, require_tools

BOARDS = {board.name: board for board in load_boards("arduino")}
ABILITIES = {"digital", "pwm", "analog_in", "interrupt", "uart", "i2c", "spi"}


def labels(board: Board, ability: str) -> set[str]:
    """The pins of a board with an ability."""
    return {pin.label for pin in board.pins if ability in pin.abilities}


@pytest.mark.parametrize("board", BOARDS.values(), ids=BOARDS)
def test_a_board_file_holds_together(board: Board) -> None:
    assert board.path.stem == board.name
    assert len({pin.number for pin in board.pins}) == len(board.pins)
    names = [name for pin in board.pins for name in (pin.label, *pin.aliases)]
    assert len(names) == len(set(names))
    for pin in board.pins:
        assert set(pin.abilities) <= ABILITIES
        assert bool(pin.timer) == ("pwm" in pin.abilities) == bool(pin.channel)
        assert (pin.interrupt is not None) == ("interrupt" in pin.abilities)
    assert board.led in labels(board, "digital")
    ids = [(drawn.tool, module) for drawn in board.drawn_as for module in drawn.modules]
    assert ids
    assert len(ids) == len(set(ids))


@pytest.mark.parametrize("board", BOARDS.values(), ids=BOARDS)
def test_a_board_file_says_what_the_core_says(board: Board) -> None:
    """PWM, interrupts and memory as in the core's variants/*/pins_arduino.h and boards.txt."""
    require_tools("arduino-core-avr")
    root = KNOWN_PLACES["arduino-core-avr"].parents[2]
    listed = (root / "boards.txt").read_text()
    for key, value in (("upload.maximum_size", board.flash_bytes), ("upload.maximum_data_size", board.ram_bytes)):
        _, _, name, *options = board.fqbn.split(":")
        chip = board.mcu.removesuffix("p")
        option = options[0].removeprefix("cpu=") if options else rf"(?:16MHz)?{chip}"
        found = re.findall(rf"^{name}\.(?:menu\.cpu\.{option}\.)?{re.escape(key)}=(\d+)", listed, re.MULTILINE)
        assert str(value) in found
    assert f"build.board={board.define}\n" in listed
    header = (root / "variants" / board.variant / "pins_arduino.h").read_text()
    while other := re.search(r'#include "\.\./(\w+)/pins_arduino\.h"', header):  # a variant that only adds to another
        header = (root / "variants" / other[1] / "pins_arduino.h").read_text()
    rows = re.findall(r"NOT_ON_TIMER|TIMER(\d)([ABCD])", _timers(header))
    by_number = {pin.number: pin for pin in board.pins}
    for number, (timer, channel) in enumerate(rows):
        if number in by_number:
            pin = by_number[number]
            assert (pin.timer.removeprefix("Timer"), pin.channel) == (timer, channel), pin.label


def _timers(header: str) -> str:
    table = header[header.index("digital_pin_to_timer_PGM[]") :]
    table = table[: table.index("};")]
    return re.sub(r"#if defined\(__AVR_ATmega8__\).*?#else(.*?)#endif", r"\1", table, flags=re.DOTALL)


def test_the_uno_as_everybody_knows_it() -> None:
    uno = BOARDS["uno"]
    assert labels(uno, "pwm") == {"D3", "D5", "D6", "D9", "D10", "D11"}
    assert labels(uno, "analog_in") == {f"A{n}" for n in range(6)}
    assert labels(uno, "interrupt") == {"D2", "D3"}
    assert {pin.label for pin in uno.pins if pin.reserved} == {"D0", "D1"}
    drawn = next(d for d in uno.drawn_as if "arduino_Uno_Rev3(fix)" in d.modules)
    assert drawn.connectors["connector61"] == "D0"
    assert drawn.connectors["connector59"] == "A4"


def test_all_pins_are_drawn_on_the_common_part_of_each_board() -> None:
    for board in BOARDS.values():
        wanted = {pin.label for pin in board.pins if pin.reserved not in ("on the ICSP header only", "not brought out")}
        assert wanted <= set(board.drawn_as[0].connectors.values())


@pytest.mark.parametrize("name", ["nano", "arduino:avr:nano", "arduino:avr:nano:cpu=atmega328old"])
def test_a_board_is_found_by_each_of_its_names(name: str) -> None:
    assert find_board(name, list(BOARDS.values())).name == "nano"


def test_a_board_with_another_chip_is_not_taken_for_it() -> None:
    with pytest.raises(UsageError, match="no board is called"):
        find_board("arduino:avr:nano:cpu=atmega168", list(BOARDS.values()))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("ram_bytes = 2048", "ram_byte = 2048", r"'ram_bytes' is missing \(did you mean 'ram_byte'\?\)"),
        ("ram_bytes = 2048", 'ram_bytes = "2 K"', "'ram_bytes' must be a whole number"),
        ('label = "D4"', 'label = "D5"', "'pins' has D5 twice"),
        ('D0 = ["connector61"]', 'D99 = ["connector61"]', r"'drawn_as\[0\].connectors.D99' is no pin of this board"),
        ("pins = [", "pins = [[", "cannot be read"),
    ],
)
def test_a_damaged_board_file_names_file_and_key(tmp_path: Path, old: str, new: str, message: str) -> None:
    text = BOARDS["uno"].path.read_text()
    assert old in text
    path = tmp_path / "uno.toml"
    path.write_text(text.replace(old, new, 1))
    with pytest.raises(PlatformDataError, match=message) as caught:
        load_board(path)
    assert str(caught.value).startswith(str(path))
