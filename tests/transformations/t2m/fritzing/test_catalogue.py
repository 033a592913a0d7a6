"""The catalogue of parts and the boards: what is in it is sound, lazily read, and a user's own data goes first."""

from __future__ import annotations

import json
import re
import shutil
from collections import Counter
from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.cli.main import main
from robosmi.errors import PlatformDataError
from robosmi.transformations.knowledge import drawn_boards as boards
from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import Phrases, conducts_by_bus_only, connector_kind, name_direction, names
from robosmi.transformations.knowledge.part_roles import classify, classify_drawn
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from robosmi.transformations.t2m.fritzing import read_circuit
from robosmi.transformations.t2m.fritzing.part_file import generated_part
from tests.transformations.t2m.fritzing.support import FIXTURES, SHARED


def test_every_entry_can_be_read_and_says_why_it_has_its_role() -> None:
    catalogue = Catalogue()
    ids = [part_id for part_id, path in catalogue.ids() if path.suffix == ".sqlite"]
    assert len(ids) == len(set(ids)) > 2200
    roles = Counter[str]()
    for part_id in ids:
        part = catalogue.find(part_id)
        assert part is not None
        assert part.evidence
        assert part.connectors.keys() >= {member for members in part.buses.values() for member in members}
        roles[part.role] += 1
    assert roles["Unknown"] < 0.03 * len(ids)  # general chips and mystery parts: what they are is told by the drawing
    assert all(roles[role] > 50 for role in ("Board", "Input", "Output", "Both", "Passive", "Power", "Decoration"))


def test_every_entry_that_is_written_by_hand_can_be_read_and_has_a_role() -> None:
    """Its own, or that of the rules."""
    catalogue = Catalogue()
    found = [classify(part) for part_id, path in catalogue.ids() if path.suffix == ".toml" and (part := catalogue.find(part_id))]
    assert len(found) > 70
    assert [part.id for part in found if part.role == "Unknown" or not part.evidence] == []
    for part in found:
        assert part.connectors.keys() >= {member for members in part.buses.values() for member in members}


def test_the_roles_in_the_catalogue_are_those_of_the_rules_as_they_are_now() -> None:
    """Whoever changes a rule imports the parts again (parts/README.md)."""
    catalogue = Catalogue()
    changed = []
    for part_id in (part_id for part_id, path in catalogue.ids() if path.suffix == ".sqlite"):
        part = catalogue.find(part_id)
        assert part is not None
        now = classify(replace(part, role="Unknown", driver=False, evidence=""))
        if (now.role, now.driver) != (part.role, part.driver):
            changed.append(f"{part.title}: {part.role} -> {now.role}")
    assert changed == []


def test_of_a_description_there_are_only_counts_of_words() -> None:
    catalogue = Catalogue()
    words = catalogue.words("HIH-4030_Breakout-v10")
    assert words["humidity"] >= 1
    assert all(re.fullmatch(r"[^\W_]{2,30}", word) and count > 0 for word, count in words.items())
    assert list(words) == sorted(words)
    assert catalogue.words("no such part") == {}


@pytest.mark.parametrize(
    ("part_id", "role", "driver"),
    [
        ("3234DBDC80leg", "Output", False),
        ("Humidity_and_Temperature_Sensor_RHT03_6", "Input", False),
        ("2d505f861194750183f944ba86c13b44_28", "Input", False),
        ("1a7828b6466fac9fd042221e931124c4", "Output", True),
        ("NPN-to92-ebc", "Output", True),
        ("Level-Converter-v11", "Both", True),
        ("1000AFDF10011leg", "Power", False),
        ("arduino_Uno_Rev3(fix)", "Board", False),
        ("ResistorModuleID", "Passive", False),
        ("LogoTextModuleID", "Decoration", False),
    ],
)
def test_roles_of_well_known_parts(part_id: str, role: str, driver: bool) -> None:
    part = Catalogue().find(part_id)
    assert part is not None
    assert (part.role, part.driver) == (role, driver)


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
    found = classify(part)
    assert (found.role, found.driver) == (role, driver)
    assert bool(found.evidence) == (role != "Unknown" and part.role == "Unknown")


def test_names_of_connectors() -> None:
    known = names()
    assert [connector_kind(n, known) for n in (" VCC ", "Gnd", "+", "-", "pulse", "")] == [
        "supply",
        "ground",
        "supply",
        "ground",
        "signal",
        "unknown",
    ]


def test_what_conducts_by_bus_only() -> None:
    known = names()
    assert [conducts_by_bus_only(f, known) for f in ("Breadboard", "Pin Header", "Screw Terminal", "Resistor", "")] == [
        True,
        True,
        True,
        False,
        False,
    ]


def test_generated_parts() -> None:
    known = names()
    header, strip = generated_part("generic_female_pin_header_8_100mil", known), generated_part("20.14Stripboard2ModuleID", known)
    assert header is not None
    assert strip is not None
    assert (len(header.connectors), header.family, strip.family) == (8, "Pin Header", "Stripboard")
    assert generated_part("generic_ic_dip_x", known) is None


def test_a_general_chip_is_told_by_what_the_drawing_says_of_it() -> None:
    chip = generated_part("generic_ic_dip_16_300mil", names())
    assert chip is not None
    assert classify(chip).role == "Unknown"
    assert classify_drawn(chip, "IC1", {}).role == "Unknown"
    register = classify_drawn(chip, "IC1", {"chip label": "74HC595"})
    assert (register.role, register.driver) == ("Output", True)
    assert classify_drawn(chip, "L293D", {}).evidence.startswith("'l293d', labelled 'L293D'")
    named = {f"connector{i}": PartConnector(f"connector{i}", name) for i, name in enumerate(("SH_CP", "ST_CP", "DS", "Q0"))}
    assert classify_drawn(replace(chip, connectors=named), "IC1", {}).driver


def test_directions_of_a_chip_s_connectors() -> None:
    known = names()
    assert [name_direction(n, known) for n in ("SDA", "Trig", "Echo", "OUT", "CLK")] == ["bus", "write", "read", None, None]
    assert [name_direction(n, known, chip=True) for n in ("OUT", "CLK", "A1")] == ["read", "write", None]


def test_phrases() -> None:
    phrases = Phrases([("hc sr04", 1), ("servo*", 2), ("led", 3)])
    assert sorted(phrases.found("HC-SR04 with servos and LEDs")) == [
        (1, "hc sr04"),
        (2, "servos"),
        (2, "servos and"),
        (2, "servos and leds"),
    ]
    assert "knowledge" not in phrases
    assert "RED_LED" in phrases
    assert "x" * 1_000_000 + "servo" not in phrases  # long texts are not searched to their end


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
        ('[[part]]\nids = ["a"]\n[part.buses]\nx = ["y"]\n', "bus 'x' has a connector that the part does not have", 1),
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


def test_parts_that_are_boards() -> None:
    drawn = boards.drawn_board("arduino_Uno_Rev3(fix)", "fritzing")
    assert drawn is not None
    assert (drawn.name, drawn.pins["connector52"], drawn.pins["connector59"]) == ("uno", "D9", "A4")
    assert boards.drawn_board("ResistorModuleID", "fritzing") is None


@pytest.mark.parametrize(
    ("written", "label"),
    [
        *[(text, "D9") for text in ("D9 PWM", "~9", "9", "IO9", "D9")],
        *[(text, "A4") for text in ("A4/SDA", "AD4/SDA", "A4", "ANALOG_4", "Analog 4")],
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
    assert [boards.normalised_label(n, numbered=False) for n in ("GPIO17", "VIN", "D4")] == ["GPIO17", "", "D4"]


@pytest.mark.skipif(not SHARED.is_dir(), reason="the facts about boards are not there")
def test_pins_of_all_boards_are_those_of_the_shared_facts() -> None:
    """176 of the 179. Two others have a display and a sound chip on lines that their labels give a second name; the part of the
    third calls A0 to A5 D14 to D19, which its maker and our board do not."""
    facts = json.loads((SHARED / "boards.json").read_text())
    known = names()
    different = []
    for module, fact in facts.items():
        about = f"{fact['family']} / {fact['title']} / {module}"
        drawn = boards.drawn_board(module, "fritzing")
        arduino = about in known.numbered_labels and about not in known.not_numbered_labels
        found: dict[str, set[str]] = {}
        for connector, name in fact["connectors"].items():
            label = drawn.pins.get(connector, "") if drawn else boards.normalised_label(name or "", arduino)
            found.setdefault(label, set()).add(connector)
        wanted = {label: set(connectors) for label, connectors in fact["signal_pins"].items()}
        if any(found.get(label) != connectors for label, connectors in wanted.items()):
            different.append(fact["title"])
    assert sorted(different) == [
        "Arduino Esplora (Rev4)", "Arduino NANO RP2040 CONNECT with headers", "Bare Conductive Touch Board"
    ]  # fmt: skip


def library(folder: Path) -> Path:
    parts = folder / "parts"
    parts.mkdir()
    for name in ("my_board", "my_button", "my_driver", "my_motor"):
        shutil.copy(FIXTURES / f"{name}.fzp", parts)
    (parts / "torn.fzp").write_text("<module moduleId='torn'><connectors>")
    (parts / "other.fzp").write_text("<svg/>")
    return parts


def test_import_of_a_folder_of_parts(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    parts = library(tmp_path)
    target = tmp_path / ".robosmi" / "platform_repo" / "parts" / "mine.sqlite"
    assert main(["parts", "import", str(parts), str(parts), "-o", str(target), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["result"]["added"] == 4
    assert document["result"]["repeated"] == 4
    assert [Path(s["path"]).name for s in document["result"]["skipped"]] == ["other.fzp", "torn.fzp"] * 2
    assert document["artifacts"] == [{"path": str(target), "kind": "parts"}]
    catalogue = Catalogue(tmp_path)
    bridge = catalogue.find(next(i for i, path in catalogue.ids() if path == target and "driver" in i.lower()))
    assert bridge is not None
    assert (bridge.role, bridge.driver, bridge.source) == ("Output", True, "parts/my_driver.fzp")
    first = target.read_bytes()
    assert main(["parts", "import", str(parts), "-o", str(target)]) == 0
    assert target.read_bytes() == first
    assert str(tmp_path) not in first.decode("latin-1")


def test_an_imported_part_serves_drawings_of_its_project(tmp_path: Path) -> None:
    target = tmp_path / ".robosmi" / "platform_repo" / "parts" / "mine.sqlite"
    assert main(["parts", "import", str(library(tmp_path)), "-o", str(target)]) == 0
    circuit, findings = read_circuit(FIXTURES / "embedded.fz", project=tmp_path)
    assert findings == []
    assert [c.role.name for c in circuit.components] == ["Board", "Output", "Input", "Output", "Output"]


@pytest.mark.parametrize("damage", [b"", b"no database", b"SQLite format 3\x00" + b"\x00" * 200])
def test_a_damaged_file_of_parts_is_told(damage: bytes, tmp_path: Path) -> None:
    target = tmp_path / ".robosmi" / "platform_repo" / "parts" / "mine.sqlite"
    target.parent.mkdir(parents=True)
    target.write_bytes(damage)
    with pytest.raises(PlatformDataError, match="the file of parts cannot be used") as caught:
        Catalogue(tmp_path).find("a")
    assert caught.value.location is not None
    assert caught.value.location.path == str(target)


def test_import_of_a_folder_without_parts(tmp_path: Path) -> None:
    assert main(["parts", "import", str(tmp_path), "-o", str(tmp_path / "a.sqlite")]) == 3
    assert main(["parts", "import", str(tmp_path / "none"), "-o", str(tmp_path / "a.sqlite")]) == 3
    assert not (tmp_path / "a.sqlite").exists()


@pytest.mark.parametrize(
    ("entry", "told"),
    [('role = "Sensor"\nwhy = "x"', "an entry has the role 'Sensor'"), ('role = "Input"', "an entry for 'Input' has no reason")],
)
def test_damaged_rules_for_roles_are_told(entry: str, told: str, tmp_path: Path) -> None:
    folder = tmp_path / ".robosmi" / "platform_repo" / "parts"
    folder.mkdir(parents=True)
    (folder / "roles.toml").write_text(f"[[rule]]\n{entry}\n")
    with pytest.raises(PlatformDataError, match=told):
        classify(Part("x", "Thing"), tmp_path)


def own_rules(folder: Path, text: str) -> Path:
    """A project with a `roles.toml` of its own."""
    place = folder / ".robosmi" / "platform_repo" / "parts"
    place.mkdir(parents=True)
    (place / "roles.toml").write_text(text)
    return folder


def test_own_rules_for_roles_go_before_the_built_in_ones_and_leave_them(tmp_path: Path) -> None:
    project = own_rules(tmp_path, '[[rule]]\nrole = "Input"\nwhy = "ours"\nwords = ["gizmo"]\n')
    servo, gizmo = Part("s", "Basic Servo"), Part("g", "Red LED", description="with a gizmo")
    assert classify(servo, project).role == classify(servo).role == "Output"
    assert (classify(gizmo).role, classify(gizmo, project).role) == ("Output", "Input")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[[rule]]\nrole = "Input"\nwhy = "x"\nword = ["a"]', "'word' is not a key \\(did you mean 'words'\\?\\)"),
        ('[[rules]]\nrole = "Input"\nwhy = "x"', "unknown table 'rules' \\(did you mean 'rule'\\?\\)"),
        ('[rule]\nrole = "Input"', "'rule' is not a list of tables"),
        ('[[rule]]\nrole = "Input"\nwhy = "x"\nfamilies.fritzin = ["a"]', "families.fritzin.*did you mean 'fritzing'"),
        ('[[rule]]\nrole = "Input"\nwhy = "x"\ndriver = "yes"', "'driver' has the value 'yes'"),
        ('[[rule]]\nrole = "Input"\nwhy = "x"\nwords = "a"', "'words' has the value 'a'"),
        ('[[rule]]\nrole = "Input"\nwhy = "x"\nnamed = ["suply"]', "did you mean 'supply'"),
    ],
)
def test_what_means_nothing_in_rules_for_roles_is_refused(text: str, said: str, tmp_path: Path) -> None:
    project = own_rules(tmp_path, text)
    with pytest.raises(PlatformDataError, match=said) as caught:
        classify(Part("x", "Thing"), project)
    assert caught.value.location is not None
    assert caught.value.fix
