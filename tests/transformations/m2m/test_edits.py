"""A port whose number has no one place in the text is bound all the same: its calls look it up."""

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
