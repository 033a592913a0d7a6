"""Arduino sketches as a source: which files belong to one, what their names mean, where they stand."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from robosmi.resources import built_in
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.t2m.platform_headers import read_headers
from tests.running import run

SKETCH = Path(__file__).parent / "sketches" / "two_tabs"


def units(*words: str | Path) -> dict[str, dict[str, Any]]:
    outcome = run("analyse", *words, "--json")
    assert outcome.code == 0, outcome.err
    assert not [finding for finding in outcome.document["findings"] if finding["severity"] == "error"]
    return {Path(unit["path"]).name: unit for unit in outcome.result["units"]}


@pytest.mark.parametrize("given", [SKETCH / "two_tabs.ino", SKETCH / "a_lamp.ino", SKETCH])
def test_a_sketch_is_all_tabs_of_its_folder_and_its_sources(given: Path) -> None:
    assert list(units(given)) == ["two_tabs.ino", "a_lamp.ino", "z_report.pde", "Wheel.cpp", "Wheel.h"]


def test_functions_of_later_tabs_are_known_with_their_types() -> None:
    found = units(SKETCH / "two_tabs.ino")
    assert [unit["unknown_calls"] for unit in found.values()] == [[]] * 5
    assert all(unit["coverage"]["calls_in_text"] == unit["coverage"]["calls_in_model"] for unit in found.values())
    assert found["two_tabs.ino"]["prototypes"] == []
    assert [call["name"] for call in found["two_tabs.ino"]["user_calls"]] == ["blink", "name", "report", "turn", "turns"]
    assert [call["lines"] for call in found["a_lamp.ino"]["user_calls"]] == [[7]]


def test_a_sketch_has_no_main() -> None:
    assert [unit["main"] for unit in units(SKETCH / "two_tabs.ino").values()] == [None] * 5


def test_calls_of_objects_have_header_and_signature_of_the_overload() -> None:
    calls = {call["name"]: call for call in units(SKETCH / "two_tabs.ino")["two_tabs.ino"]["platform_calls"]}
    assert (calls["print"]["header"], calls["print"]["lines"]) == ("Print.h", [12])
    assert calls["print"]["signature"] == "size_t print(int value, int base = 10)"
    assert calls["begin"]["header"] == "HardwareSerial.h"
    assert "length" in calls


def test_pins_of_calls_are_known() -> None:
    [use] = units(SKETCH / "two_tabs.ino")["a_lamp.ino"]["pin_uses"]
    assert (use["pin"], use["function"], use["direction"], use["line"]) == (7, "digitalWrite", "out", 6)


def test_places_in_a_library_of_the_sketch_s_own_are_told_by_its_folder_alone() -> None:
    sketch = SKETCH.parent / "own_library" / "own_library.ino"
    result = run("analyse", sketch, "--target", "pico", "--json").result
    assert result["bundled_libraries"] == [str(sketch.parent / "src" / "Lamp")]
    assert [(Path(place["path"]).name, place["line"], place["kind"]) for place in result["portability"]] == [
        ("own_library.ino", 4, "pin_13"), ("own_library.ino", 5, "port_register"), ("own_library.ino", 5, "avr_libc_call"),
    ]  # fmt: skip


def test_the_board_decides_what_is_compiled(tmp_path: Path) -> None:
    sketch = tmp_path / "s" / "s.ino"
    sketch.parent.mkdir()
    sketch.write_text("#if defined(__AVR_ATmega2560__) && defined(ARDUINO_AVR_MEGA2560)\nvoid big() {}\n#endif\nvoid loop() {}\n")
    assert [f["name"] for f in units(sketch, "--from", "mega")["s.ino"]["functions"]] == ["big", "loop"]
    assert [f["name"] for f in units(sketch)["s.ino"]["functions"]] == ["loop"]


def test_a_board_of_a_platform_without_boards_is_wrong_usage(tmp_path: Path) -> None:
    program = tmp_path / "robot.c"
    program.write_text("int main() { return 0; }\n")
    assert run("analyse", program, "--from", "uno", "--json").code == 2


def test_a_sketch_can_be_read_for_another_platform() -> None:
    assert list(units(SKETCH / "a_lamp.ino", "--source-platform", "generic")) == ["a_lamp.ino"]


def test_the_facts_are_what_the_headers_declare() -> None:
    """api.json has what `platform import` finds in the headers that the parser is given; registers come from registers.json."""
    folder = built_in("platform_repo") / "arduino"
    found = read_headers(folder / "include", ApiIndex.load("arduino")).headers
    stored = json.loads((folder / "api.json").read_text())["headers"]
    assert set(stored) == set(found) - {"stdint.h", "stddef.h", "limits.h"}
    for header, content in stored.items():
        assert {k: v for k, v in content.items() if k not in ("source", "registers")} == {
            k: v for k, v in found[header].items() if k not in ("source", "registers")
        }
