"""Edits of a sketch and of the ports of its program meet: by look-up where a number has no one place, by words where it has."""

from __future__ import annotations

import re
from pathlib import Path

import robosmi

PROGRAMS = Path(__file__).parent / "programs"


def test_a_port_whose_value_has_no_one_place_is_looked_up(tmp_path: Path) -> None:
    source = PROGRAMS / "port_in_parts.c"
    robosmi.migrate([source], tmp_path / "out", bind={"LAMP": "D8"})
    sketch = tmp_path / "out" / source.stem
    text = (sketch / f"{source.stem}.ino").read_text()
    assert "#define LAMP 20L /* first half */ + 6" in text
    assert "toggle(port(LAMP))" in text
    table = re.search(r"port_pins\[32\] = \{([^}]*)\}", (sketch / "adapters.h").read_text())
    assert table is not None
    assert [pin.strip() for pin in table[1].split(",")] == ["255"] * 26 + ["8"] + ["255"] * 5


def test_a_renamed_constant_keeps_its_name_when_its_port_moves(tmp_path: Path) -> None:
    source = tmp_path / "lamp.c"
    source.write_text(
        '#include "simpletools.h"\nconst int lamp = 26;\nint main() { high(lamp); while (1) { toggle(lamp); pause(9); } }\n'
    )
    robosmi.migrate([source], tmp_path / "out", bind={"lamp": "D8"})
    sketch = tmp_path / "out" / "lamp" / "lamp.ino"
    text = sketch.read_text()
    assert "lamp = 8;" in text
    sketch.write_text(text.replace("lamp = 8;", "frontLamp = 8;").replace("(lamp)", "(frontLamp)"))
    made = robosmi.migrate([source], tmp_path / "out", bind={"lamp": "D12"})
    text = sketch.read_text()
    assert "frontLamp = 12;" in text
    assert "toggle(frontLamp)" in text
    assert "<<<<" not in text
    assert "RS511" not in [f.rule for f in made.findings]
    assert [f.message for f in made.findings if f.rule == "RS512" and "different words" in f.message]


def test_a_variable_of_a_structure_that_nobody_knows_keeps_its_type(tmp_path: Path) -> None:
    """A regression: the first mention of the structure hid where the declaration begins, and int came before the name."""
    source = tmp_path / "folder.c"
    lines = ["struct dirent *entry;", "struct other const *last = 0;", "static struct third *kept;"]
    source.write_text(f'#include "simpletools.h"\nint main() {{\n  {lines[0]}\n  {lines[1]}\n  {lines[2]}\n  pause(1);\n}}\n')
    robosmi.migrate([source], tmp_path / "out")
    text = (tmp_path / "out" / "folder" / "folder.ino").read_text()
    assert [line for line in lines if line not in text] == []


def test_a_constant_that_no_file_defines_is_not_extern_in_c(tmp_path: Path) -> None:
    source = tmp_path / "limit.c"
    source.write_text('#include "simpletools.h"\nextern const int limit;\nint main() { pause(limit); }\n')
    robosmi.migrate([source], tmp_path / "c", target="avr-c")
    assert "\nconst int32_t limit = {0};" in (tmp_path / "c" / "limit" / "limit.c").read_text()
    robosmi.migrate([source], tmp_path / "cxx", target="uno")
    assert "\nextern const int32_t limit = {0};" in (tmp_path / "cxx" / "limit" / "limit.ino").read_text()


def test_a_jump_over_a_value_that_cannot_be_assigned_is_said(tmp_path: Path) -> None:
    source = tmp_path / "jump.c"
    source.write_text(
        '#include "simpletools.h"\nvoid f(int n) {\n  if (n) goto out;\n  int one = 1;\n  int list[2] = { one, 2 };\n'
        "  pause(list[1]);\nout:\n  return;\n}\nint main() { f(1); }\n"
    )
    made = robosmi.migrate([source], tmp_path / "out")
    assert [f.location.line for f in made.findings if f.rule == "RS312" and f.location is not None] == [5]


def test_a_list_whose_members_are_in_order_is_no_gap(tmp_path: Path) -> None:
    program = tmp_path / "lists.c"
    program.write_text(
        "typedef struct { int pin, low, high; } Joint;\n"
        "typedef struct { Joint joint; int k; } Two;\n"
        "Joint one = { .pin = 1, .low = 2, .high = 3 };\n"
        "Joint two = { .pin = 1, .high = 3, .low = 2 };\n"
        "Two three = { .joint = { .pin = 1, .low = 2 }, .k = 3 };\n"
        "Two four = { .joint = { .low = 1, .pin = 2 }, .k = 3 };\n"
        "struct { int a, b; } five = { .a = 1, .b = 2 };\n"
        "int six[8] = { [sizeof(int)] = 1 };\n"
        "int main() { return six[0] + one.pin + two.pin + three.k + four.k + five.a; }\n"
    )
    found = robosmi.plan_migration([program]).plan.findings
    assert {f.line for f in found if f.rule == "RS312"} == {8}
