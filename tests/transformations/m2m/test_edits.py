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
