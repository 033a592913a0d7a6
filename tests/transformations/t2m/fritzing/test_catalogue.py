"""The catalogue of parts and the boards: what is in it is sound, lazily read, and a user's own data goes first."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from robosmi.errors import PlatformDataError, UsageError
from robosmi.resources import built_in
from robosmi.transformations.t2m import boards
from robosmi.transformations.t2m.parts_catalogue import (
    Catalogue,
    Part,
    classify,
    conducts_by_bus_only,
    connector_kind,
    generated_part,
    rules,
)

PARTS = built_in("platform_repo") / "parts"


def test_every_entry_parses_and_has_a_role_with_a_reason() -> None:
    catalogue = Catalogue()
    ids = [part_id for part_id, _ in catalogue.ids()]
    assert len(ids) == len(set(ids))
    for part_id in ids:
        part = catalogue.find(part_id)
        assert part is not None
        assert part.role != "Unknown"
        assert part.title
        assert part.evidence.removeprefix("catalogue of parts: ")
        assert part.connectors


def test_entry_by_entry_gives_what_the_whole_file_gives() -> None:
    whole = [
        i
        for path in sorted(PARTS.glob("*.toml"))
        if path.name != "families.toml"
        for t in tomllib.loads(path.read_text())["part"]
        for i in t["ids"]
    ]
    assert sorted(whole) == sorted(part_id for part_id, _ in Catalogue().ids())


@pytest.mark.parametrize(
    ("part_id", "holes", "buses"),
    [
        ("13f88e58b86d08d73d112f0fb05e6968", 400, 64),
        ("HalfBreadboardModuleID", 420, 68),
        ("HalfMinusBreadboardModuleID", 270, 48),
        ("MiniBreadboardModuleID", 170, 34),
        ("TinyBreadboardModuleID", 200, 40),
        ("BreadboardModuleID", 840, 136),
        ("Breadboard-RSR03MB102-ModuleID", 830, 130),
    ],
)
def test_breadboards_have_the_holes_and_rows_of_the_real_part(part_id: str, holes: int, buses: int) -> None:
    part = Catalogue().find(part_id)
    assert part is not None
    assert (len(part.connectors), len(part.buses)) == (holes, buses)


def test_rows_and_rails_of_the_half_breadboard() -> None:
    part = Catalogue().find("13f88e58b86d08d73d112f0fb05e6968")
    assert part is not None
    assert part.buses["bus7-f"] == ("pin7F", "pin7G", "pin7H", "pin7I", "pin7J")
    assert part.buses["bus-W"][:6] == ("pin3W", "pin4W", "pin5W", "pin6W", "pin7W", "pin9W")


@pytest.mark.parametrize(
    ("part", "role", "driver"),
    [
        (Part("x", "220 Ohm Resistor", "Resistor"), "Passive", False),
        (Part("x", "Photocell (LDR)", "Photo-Resistor"), "Input", False),
        (Part("x", "DHT11 basic temperature-humidity sensor", "Pin Header"), "Input", False),
        (Part("x", "Motor Driver 1A Dual TB6612FNG", "Motor Driver"), "Output", True),
        (Part("x", "DC Motor", "DC Motor"), "Output", False),
        (Part("TwoLayerRectanglePCBModuleID"), "Decoration", False),
        (Part("x", "Arduino Shield PCB", "Plain Vanilla PCB"), "Decoration", False),
        (Part("GroundModuleID"), "Power", False),
        (Part("x", "Lilypad LED", "microcontroller board (lilypad)"), "Output", False),
        (Part("x", "Thing", "Things"), "Unknown", False),
        (Part("x", "Relay", role="Decoration"), "Decoration", False),
    ],
)
def test_rules_for_parts_without_an_entry(part: Part, role: str, driver: bool) -> None:
    found = classify(part, rules())
    assert (found.role, found.driver) == (role, driver)
    assert bool(found.evidence) == (role != "Unknown" and part.role == "Unknown")


def test_names_of_connectors() -> None:
    known = rules()
    assert [connector_kind(n, known) for n in (" VCC ", "Gnd", "+", "-", "pulse", "")] == [
        "supply",
        "ground",
        "supply",
        "ground",
        "signal",
        "unknown",
    ]


def test_what_conducts_by_bus_only() -> None:
    known = rules()
    assert [conducts_by_bus_only(f, known) for f in ("Breadboard", "Pin Header", "Screw Terminal", "Resistor", "")] == [
        True,
        True,
        True,
        False,
        False,
    ]


def test_generated_parts() -> None:
    known = rules()
    header, strip = generated_part("generic_female_pin_header_8_100mil", known), generated_part("20.14Stripboard2ModuleID", known)
    assert header is not None
    assert strip is not None
    assert (len(header.connectors), header.family, strip.family) == (8, "Pin Header", "Stripboard")
    assert generated_part("generic_ic_dip_x", known) is None


def user_parts(folder: Path, text: str) -> Path:
    target = folder / ".robosmi" / "platform_repo" / "parts"
    target.mkdir(parents=True)
    (target / "mine.toml").write_text(text)
    return target / "mine.toml"


def test_a_user_s_entry_goes_before_the_built_in_one(tmp_path: Path) -> None:
    user_parts(tmp_path, '[[part]]\nids = ["ResistorModuleID"]\ntitle = "Mine"\nrole = "Input"\n')
    part = Catalogue(tmp_path).find("ResistorModuleID")
    assert part is not None
    assert (part.title, part.role) == ("Mine", "Input")


@pytest.mark.parametrize(
    ("text", "cause", "line"),
    [
        ('[[part]]\nids = ["a"]\nrole = "Sensor"\n', "unknown role 'Sensor'", 1),
        ('# a\n[[part]]\nids = ["a"\n', "not valid TOML", None),
        ('[[part]]\nids = ["b"]\n[[part]]\nids = ["a"]\nconnectors = [{ id = "c", kind = "hot" }]\n', "unknown kind 'hot'", 3),
        ('[[part]]\nids = ["a"]\nconnectors = [{ name = "c" }]\n', "is damaged", 1),
        ('[[part]]\nids = ["a"]\nsize = 3\n', "it has 0 connectors, not 3", 1),
        ('[[part]]\nids = ["a"]\n[part.buses]\nx = ["y"]\n', "bus 'x' has a connector that the part has not", 1),
        ('[[part]]\ntitle = "a"\nx = "a"\n', "a part has no ids", 1),
    ],
)
def test_damaged_entries_name_file_and_line(text: str, cause: str, line: int | None, tmp_path: Path) -> None:
    path = user_parts(tmp_path, text)
    with pytest.raises(PlatformDataError) as caught:
        Catalogue(tmp_path).find("a")
    assert cause in caught.value.message
    assert caught.value.location is not None
    assert caught.value.location.path == str(path)
    if line is not None:
        assert caught.value.location.line == line


def test_boards_have_their_pins_in_order() -> None:
    uno = boards.load_board("uno")
    assert [pin.label for pin in uno.pins] == [f"D{i}" for i in range(14)] + [f"A{i}" for i in range(6)]
    assert [pin.literal for pin in uno.pins][-7:] == ["13", "A0", "A1", "A2", "A3", "A4", "A5"]
    assert "pwm" in uno.pins[9].abilities
    assert (uno.fqbn, uno.flashBytes, uno.volts) == ("arduino:avr:uno", 32256, 5.0)


@pytest.mark.parametrize("name", boards.board_names())
def test_every_board_loads(name: str) -> None:
    board = boards.load_board(name)
    assert len({pin.label for pin in board.pins}) == len(board.pins) > 10


def test_an_unknown_board() -> None:
    with pytest.raises(UsageError, match=r"no board is called 'unno' \(did you mean 'uno'\?\)"):
        boards.load_board("unno")


def test_parts_that_are_boards() -> None:
    drawn = boards.drawn_board("arduino_Uno_Rev3(fix)", "fritzing")
    assert drawn is not None
    assert (drawn.name, drawn.pins["connector52"], drawn.pins["connector59"]) == ("uno", "D9", "A4")
    assert boards.drawn_board("ResistorModuleID", "fritzing") is None


@pytest.mark.parametrize(
    ("written", "label"),
    [
        *[(text, "D9") for text in ("D9 PWM", "~9", "9", "IO9", "D9")],
        *[(text, "A4") for text in ("A4/SDA", "AD4/SDA", "A4")],
        *[(text, "D0") for text in ("D0/RX", "D0RX", "RX-I", "D0 RX0")],
        *[("D10 PWM/SS", "D10"), ("TX-O", "D1"), ("D4/A6", "D4"), ("Pin 13", "D13"), ("D16 PWM/TX2", "D16")],
        *[
            (text, "")
            for text in ("5V", "+5V", "3V3", "3.3V", "VIN", "GND", "G", "AREF", "RESET", "RST", "ioref", "IO_REF", "IO REF")
        ],
        *[(text, "") for text in ("N/C", "n.c.", "ICSP MISO", "ICSP2 SCK", "")],
    ],
)
def test_labels_of_arduino_boards(written: str, label: str) -> None:
    assert boards.normalised_label(written) == label


def test_labels_of_other_boards_are_taken_as_they_are() -> None:
    assert [boards.normalised_label(n, arduino=False) for n in ("GPIO17", "VIN", "D4")] == ["GPIO17", "", "D4"]
