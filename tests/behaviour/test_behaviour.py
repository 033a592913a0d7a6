"""Whole programs behave as on the source: what their sketches print on a simulator is what the same text prints on 32 bits.

A program is a file, or a folder with several, in `programs`: widths, plain char, structures, control, main and its loop, names.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.behaviour.running import ENOUGH, sketch, sources, truth
from tests.tiers import sample
from tests.tools import require_engine, require_tools

PROGRAMS = sorted(path for path in (Path(__file__).parent / "programs").iterdir() if path.is_dir() or path.suffix == ".c")


@pytest.mark.parametrize("program", sample(PROGRAMS, 8), ids=lambda path: path.stem)
def test_the_sketch_says_what_the_program_says(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr", "gcc-32-bits")
    require_engine("simavr")
    wanted, ended = truth(sources(program), tmp_path)
    found = sketch(sources(program), tmp_path, 3)
    if ended:
        assert found == wanted
    else:
        assert wanted.startswith(found)
        assert len(found) > min(ENOUGH, len(wanted) - 1)
