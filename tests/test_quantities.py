"""Counts in texts: the noun agrees with the number."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.base.quantities import quantity
from tests.running import run


@pytest.mark.parametrize(
    ("count", "words", "text"),
    [(0, ("pin",), "0 pins"), (1, ("pin",), "1 pin"), (2, ("pin",), "2 pins"), (2, ("class", "classes"), "2 classes"),
     (1, ("class", "classes"), "1 class")],
)  # fmt: skip
def test_the_noun_agrees_with_the_number(count: int, words: tuple[str, ...], text: str) -> None:
    assert quantity(count, *words) == text


def test_one_of_each_in_an_analysis(tmp_path: Path) -> None:
    program = tmp_path / "blink.c"
    program.write_text('#include "simpletools.h"\nint lamp = 3;\nint main() { high(lamp); }\n')
    lines = run("analyse", program).out.splitlines()
    assert "1 function, 1 global" in lines[0]
    assert any(line.endswith(" 1 call") for line in lines)
