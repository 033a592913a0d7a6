"""Edits of a plan's text that cannot be made are refused, with what to do."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.errors import ModelError

PROGRAMS = Path(__file__).parent / "programs"


def test_a_port_whose_value_has_no_one_place_is_not_rewritten(tmp_path: Path) -> None:
    source = PROGRAMS / "port_in_parts.c"
    with pytest.raises(ModelError, match=r"LAMP.*cannot be given another pin"):
        robosmi.migrate([source], tmp_path / "out", bind={"LAMP": "D8"})
    assert not (tmp_path / "out").exists()
    robosmi.migrate([source], tmp_path / "out")
    assert "#define LAMP 20L /* first half */ + 6" in (tmp_path / "out" / source.stem / f"{source.stem}.ino").read_text()
