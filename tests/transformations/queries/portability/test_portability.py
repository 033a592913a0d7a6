"""Places that may behave differently on another board: each kind in its line, and none elsewhere."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from robosmi.transformations.knowledge.platforms.portability_facts import portability_facts
from tests.running import run

HERE = Path(__file__).parent
KINDS = HERE / "kinds" / "kinds.ino"


def places(sketch: Path, target: str, source: str = "uno") -> list[dict[str, Any]]:
    outcome = run("analyse", sketch, "--from", source, "--target", target, "--json")
    assert outcome.code == 0, outcome.err
    found: list[dict[str, Any]] = outcome.result["portability"]
    return found


def labelled(sketch: Path) -> set[tuple[int, str]]:
    """Line and kind, as the comments of a sketch say."""
    kinds = portability_facts("arduino")
    assert kinds is not None
    lines = enumerate(sketch.read_text().splitlines(), 1)
    return {(number, word) for number, line in lines for word in line.partition("//")[2].split() if word in kinds.kinds}


def test_every_kind_is_found_in_its_line_and_nowhere_else() -> None:
    found = {(place["line"], place["kind"]) for place in places(KINDS, "pico") if place["path"].endswith("kinds.ino")}
    assert found == labelled(KINDS)


def test_the_fixture_has_every_kind() -> None:
    kinds = portability_facts("arduino")
    assert kinds is not None
    assert {kind for _, kind in labelled(KINDS)} == {name for name, kind in kinds.kinds.items() if kind.when == "analyse"}


def test_a_place_says_what_stands_there_and_what_is_done_about_it() -> None:
    place = next(place for place in places(KINDS, "pico") if place["kind"] == "timer_register")
    assert set(place) == {"kind", "path", "line", "what", "cure"}
    assert re.search(r"\bTCCR1B\b", place["what"])
    assert place["cure"] in ("none", "task")


def test_a_nano_differs_in_nothing_from_an_uno() -> None:
    assert places(KINDS, "nano") == []


def test_a_mega_has_the_chips_registers_but_other_pins_at_its_ports() -> None:
    counted = Counter(place["kind"] for place in places(KINDS, "mega"))
    assert counted["port_register"] == 1
    assert counted["analog_pin_as_14_to_19"] == 1
    kept = ("timer_register", "isr_vector", "analog_pin_above_A3", "progmem", "eeprom", "sizeof_int", "pin_13", "servo")
    assert not any(counted[kind] for kind in kept)


def test_a_mega_has_another_order_of_interrupts_than_a_leonardo() -> None:
    assert "attach_interrupt_number" in {place["kind"] for place in places(KINDS, "leonardo", "mega")}
    assert "attach_interrupt_number" not in {place["kind"] for place in places(KINDS, "mega", "uno")}


def test_a_pin_that_the_source_board_lacks_asks_for_the_board(tmp_path: Path) -> None:
    sketch = tmp_path / "pads" / "pads.ino"
    sketch.parent.mkdir()
    sketch.write_text("void setup() {}\nvoid loop() { analogRead(A8); }\n")
    said = [place["what"] for place in places(sketch, "pico") if place["kind"] == "analog_pin_above_A3"]
    assert "neither has Arduino Uno: give the board of this sketch with --from" in said[0]
    assert "--from" not in str(places(sketch, "pico", "mega"))


def test_on_a_mega_14_is_no_analogue_pin() -> None:
    assert "analog_pin_as_14_to_19" not in {place["kind"] for place in places(KINDS, "pico", "mega")}


def test_names_of_the_programs_own_are_no_places() -> None:
    assert places(HERE / "own_names" / "own_names.ino", "pico") == []


def test_the_text_lists_kinds_and_places() -> None:
    outcome = run("analyse", KINDS, "--from", "uno", "--target", "pico")
    assert "timer_register: 2" in outcome.out
    assert re.search(r"kinds\.ino:\d+: .*TCCR5B", outcome.out)


def test_a_board_that_nobody_said_is_told() -> None:
    outcome = run("analyse", KINDS, "--target", "pico", "--json")
    assert outcome.result["board"] == "uno"
    assert "RS115" in {finding["rule"] for finding in outcome.document["findings"]}
    assert "RS115" not in {finding["rule"] for finding in run("analyse", KINDS, "--from", "uno", "--json").document["findings"]}


@pytest.mark.parametrize("words", [("--from", "unu"), ("--target", "picu")])
def test_an_unknown_board_is_wrong_usage(words: tuple[str, str]) -> None:
    assert run("analyse", KINDS, *words, "--json").code == 2


def test_programs_of_other_platforms_have_no_such_list(tmp_path: Path) -> None:
    program = tmp_path / "robot.c"
    program.write_text("int main() { return 0; }\n")
    assert run("analyse", program, "--target", "pico", "--json").code == 2


def test_the_project_file_names_the_board(tmp_path: Path) -> None:
    sketch = tmp_path / "blink" / "blink.ino"
    sketch.parent.mkdir()
    sketch.write_text("void setup() { pinMode(15, OUTPUT); }\nvoid loop() {}\n")
    assert [place["kind"] for place in places(sketch, "pico")] == ["analog_pin_as_14_to_19"]
    (sketch.parent / "robosmi.toml").write_text("[migrate]\nfrom = 'mega'\n")
    outcome = run("analyse", sketch, "--target", "pico", "--json")
    assert (outcome.result["board"], outcome.result["portability"]) == ("mega", [])


def test_each_register_of_an_uno_says_what_it_is_for() -> None:
    facts = portability_facts("arduino")
    assert facts is not None
    assert not [name for name in sorted(facts.microcontrollers["atmega328p"].registers) if not facts.meaning(name)]
    assert "timer 1" in facts.meaning("OCR1BH")
    assert facts.meaning("TWCR") != facts.meaning("TWBR")
    assert facts.meaning("NONE") == ""
