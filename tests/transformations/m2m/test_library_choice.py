"""What a chosen library takes of the target: data, evidence in the plan, features of the platform model."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.library_takes import Takes, library_takes
from robosmi.transformations.m2m.library_choice import LibraryModels
from robosmi.transformations.m2m.library_ranking import library_index
from robosmi.transformations.t2m.target_platform import target_facts


def test_shipped_entries_name_libraries_timers_and_pins_that_exist() -> None:
    known, board = set(library_index().names()), load_board("uno")
    timers = {pin.timer for pin in board.pins if pin.timer}
    labels = {pin.label for pin in board.pins}
    taken = library_takes("arduino", board)
    assert set(taken) <= known
    assert {timer for takes in taken.values() for timer in takes.timers} <= timers
    assert {pin for takes in taken.values() for pin in takes.pins} <= labels


def test_a_library_element_has_what_it_takes_and_what_it_depends_on() -> None:
    models = LibraryModels(target_facts("uno"), load_board("uno"))
    servo, dht = models.get("Servo"), models.get("DHT sensor library")
    assert (list(servo.timers), list(servo.pins)) == (["Timer1"], [])
    assert list(dht.depends) == ["Adafruit Unified Sensor"]
    assert "Adafruit Unified Sensor" in models.elements
    assert [str(takes) for takes in models.taken_by(servo)] == ["takes Timer1"]
    assert models.taken_by(None) == models.taken_by(dht) == []


def test_a_condition_is_told() -> None:
    assert str(Takes(("Timer2",), ("D3",), "it sends")) == "takes Timer2, D3 when it sends"


def test_a_damaged_entry_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / ".robosmi/platform_repo/arduino/libraries"
    folder.mkdir(parents=True)
    (folder / "takes.toml").write_text('[[library]]\nnames = ["A"]\ntimer = ["Timer1"]\n')
    with pytest.raises(PlatformDataError, match="no library with what it takes"):
        library_takes("arduino", load_board("uno"), tmp_path)
    assert set(library_takes("nowhere", load_board("uno"))) == {"Servo"}


@pytest.mark.parametrize(
    ("board", "spi", "i2c", "servo", "ir"),
    [
        ("uno", ("D11", "D12", "D13"), ("A4", "A5"), ("Timer1",), ("Timer2",)),
        ("mega", ("D51", "D50", "D52"), ("D20", "D21"), ("Timer5",), ("Timer2",)),
        ("leonardo", ("D16", "D14", "D15"), ("D2", "D3"), ("Timer1",), None),
    ],
)
def test_what_a_library_takes_follows_from_the_microcontroller(
    board: str, spi: tuple[str, ...], i2c: tuple[str, ...], servo: tuple[str, ...], ir: tuple[str, ...] | None
) -> None:
    taken = library_takes("arduino", load_board(board))
    assert taken["SPI"].pins == spi
    assert taken["Wire"].pins == i2c
    assert taken["Servo"].timers == servo
    assert (taken["IRremote"].timers if "IRremote" in taken else None) == ir
    assert taken["Ethernet"].pins == ("D10", *spi)
