"""What a chosen library takes of the target: data, evidence in the plan, features of the platform model."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import PlatformDataError
from robosmi.metamodels import migration
from robosmi.recommend.device_ranker import DeviceRanker
from robosmi.recommend.history import History
from robosmi.recommend.index import LibraryIndex
from robosmi.recommend.library_record import write_index
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.libraries.library_ranking import device_knowledge, library_index
from robosmi.transformations.knowledge.libraries.library_takes import Takes, library_takes
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.m2m.choices.library_choice import LibraryModels, choose_libraries


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
    assert [str(takes) for takes in models.taken_by(servo)] == ["uses Timer1"]
    assert models.taken_by(None) == models.taken_by(dht) == []


def test_a_condition_is_told() -> None:
    assert str(Takes(("Timer2",), ("D3",), "it sends")) == "uses Timer2, D3 when it sends"


def test_a_damaged_entry_is_refused(tmp_path: Path) -> None:
    folder = tmp_path / ".robosmi/platform_repo/arduino/libraries"
    folder.mkdir(parents=True)
    (folder / "takes.toml").write_text('[[library]]\nnames = ["A"]\ntimer = ["Timer1"]\n')
    with pytest.raises(PlatformDataError, match="not a library with its resources"):
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


def line_follower(examples: Path) -> Any:
    """The circuit of the line follower."""
    return robosmi.load_hardware(examples / "line_follower" / "line_following_robot.fzz")


def decided(
    circuit: Any, index: LibraryIndex | None, history: History, target: str = "uno"
) -> dict[str, migration.LibraryChoice]:
    """The choices for all components by their titles, each taken where the ranking is at all sure."""
    models = LibraryModels(target_facts(target), load_board(target))
    if index is not None:
        models.__dict__["index"] = index
    found = library_index() if index is None else index
    ranker = DeviceRanker(found, device_knowledge("arduino", None), "avr")
    choices = choose_libraries(circuit, circuit.components, {}, ranker, models, history, 5, sure=0.01)
    return {choice.component.title: choice for choice in choices if choice.component is not None}


def test_what_was_chosen_for_another_platform_is_no_choice_for_this_one(examples: Path, tmp_path: Path) -> None:
    """Not even where it was chosen more often; a library of this platform that was chosen for the part is."""
    circuit, history = line_follower(examples), History(tmp_path / "history.sqlite")
    servo = next(c for c in circuit.components if c.title == "Basic Servo1")
    title = servo.partTitle or servo.title
    for _ in range(3):
        history.record(servo.partId, title, "abdrive", target="another board")
    assert decided(circuit, None, history)["Basic Servo1"].chosenBy is not migration.ChosenBy.history
    history.record(servo.partId, title, "ServoEasing", target="uno")
    choice = decided(circuit, None, history)["Basic Servo1"]
    assert (choice.choice, choice.chosenBy) == ("ServoEasing", migration.ChosenBy.history)


def test_what_does_not_work_on_the_architecture_is_not_chosen_because_it_was_before(examples: Path, tmp_path: Path) -> None:
    circuit, history = line_follower(examples), History(tmp_path / "history.sqlite")
    servo = next(c for c in circuit.components if c.title == "Basic Servo1")
    for _ in range(3):
        history.record(servo.partId, servo.partTitle or servo.title, "VarSpeedServo", target="uno")
    assert decided(circuit, None, history)["Basic Servo1"].choice == "VarSpeedServo"
    assert decided(circuit, None, history, "uno-r4-minima")["Basic Servo1"].chosenBy is not migration.ChosenBy.history


def test_without_any_library_nothing_is_chosen(examples: Path, tmp_path: Path) -> None:
    write_index(tmp_path / "empty.sqlite", [])
    circuit = line_follower(examples)
    choices = decided(circuit, LibraryIndex(tmp_path / "empty.sqlite"), History(tmp_path / "history.sqlite"))
    assert len(choices) == len(circuit.components)
    assert {choice.choice for choice in choices.values()} <= {"", "none"}
    assert all(choice.chosen is None and not choice.candidates for choice in choices.values())
