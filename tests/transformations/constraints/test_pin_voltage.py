"""RS258: what parts give a pin must not be more than it bears."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.chains.hardware import hardware
from tests.running import run

FOLDER = Path(__file__).parent
DIRECT = FOLDER / "drawings" / "RS258_fails" / "diagram.json"


@pytest.mark.parametrize(
    ("drawing", "part", "pin"),
    [
        ("drawings/RS258_fails", "ranger", "GP2"), ("pin_voltage/button_at_5_v", "button", "GP5"),
        ("pin_voltage/at_board_voltage", "", ""),
        ("drawings/RS258_holds", "", ""),
    ],
)  # fmt: skip
def test_a_part_at_5_v_needs_a_divider_before_a_pin_for_less(drawing: str, part: str, pin: str) -> None:
    outcome = run("check", FOLDER / drawing / "diagram.json", "--json")
    found = [finding for finding in outcome.document["findings"] if finding["rule"] == "RS258"]
    assert [finding["evidence"]["pin"] for finding in found] == ([pin] if pin else [])
    assert all(part in finding["message"] for finding in found)
    assert outcome.code == (1 if pin else 0)


@pytest.mark.parametrize(
    ("table", "pin"),
    [
        ("ranger", "GP3"), ("ranger_with_divider", ""), ("unnamed_wire", "GP26"), ("sensor_for_3_v", ""), ("driven_parts", ""),
        ("tolerant_pin", ""), ("tolerant_pin_as_digital", ""), ("tolerant_pin_that_measures", "A0"),
    ],
)  # fmt: skip
def test_a_table_without_voltages_has_what_is_known_of_its_parts(table: str, pin: str) -> None:
    found = [f for f in hardware(FOLDER / "pin_voltage" / f"{table}.csv").findings if f.rule == "RS258"]
    assert [finding.evidence["pin"] for finding in found] == ([pin] if pin else [])
    assert all("'through'" in (finding.fix or "") and "needs a supply of 4.5 V" in finding.message for finding in found)


def test_pins_of_5_v_boards_are_not_asked(tmp_path: Path) -> None:
    text = DIRECT.read_text()
    for old, new in (("wokwi-pi-pico", "wokwi-arduino-uno"), ("VBUS", "5V"), ("GND.8", "GND.1"), (":GP", ":")):
        text = text.replace(old, new)
    (tmp_path / "diagram.json").write_text(text)
    assert "RS258" not in run("check", tmp_path / "diagram.json", "--json").rules()


def test_a_migration_writes_the_sketch_all_the_same_and_exits_with_1(tmp_path: Path) -> None:
    program = tmp_path / "ping.c"
    program.write_text('#include "simpletools.h"\nint main() { while (1) { high(3); pause(1); low(3); pause(100); } }\n')
    outcome = run("migrate", program, "--hardware", DIRECT, "--target", "pico", "-o", tmp_path / "out", "--json")
    assert outcome.code == 1
    assert "RS258" in outcome.rules()
    assert (tmp_path / "out" / "ping" / "ping.ino").is_file()


def test_upload_refuses_what_may_damage_the_board_until_a_person_accepts_it(tmp_path: Path) -> None:
    program = tmp_path / "ping.c"
    program.write_text('#include "simpletools.h"\nint main() { while (1) { high(3); pause(1); low(3); pause(100); } }\n')
    assert run("migrate", program, "--hardware", DIRECT, "--target", "pico", "-o", tmp_path / "out").code == 1
    refused = run("upload", tmp_path / "out", "--port", "/dev/none")
    assert refused.code == 3
    assert "RS258" in refused.err
    assert "[[accept]]" in refused.err
    text = '[[accept]]\nrule = "RS258"\nelement = "*"\nreason = "its echo has a divider that is not drawn"\n'
    (tmp_path / "robosmi.toml").write_text(text)
    assert "not compiled yet" in run("upload", tmp_path / "out", "--port", "/dev/none").err


def test_what_harms_no_board_is_not_asked_about(tmp_path: Path) -> None:
    program = tmp_path / "blink.c"
    program.write_text('#include "simpletools.h"\nint main() { high(3); }\n')
    assert run("migrate", program, "--target", "pico", "-o", tmp_path / "out").code == 0
    assert "not compiled yet" in run("upload", tmp_path / "out", "--port", "/dev/none").err
