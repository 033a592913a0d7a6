"""A word misspelt in a file of data that somebody adds: the error tells the place, the cause and what to do."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from tests.running import run

CASES = tomllib.loads(Path(__file__).with_name("misspelt.toml").read_text(encoding="utf-8"))["case"]
PROGRAM = '#include "simpletools.h"\nint main() { while (1) { high(26); pause(500); } }\n'


@pytest.mark.parametrize("case", CASES, ids=lambda case: case["says"][0][:60])
def test_a_misspelt_word_is_told_with_place_cause_and_advice(
    case: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("wiring.csv").write_text("pin,part,title\nD9,Red LED,lamp\n")
    Path("blink.c").write_text(PROGRAM)
    file = Path(case["file"])
    file.parent.mkdir(parents=True)
    file.write_text(case["text"])
    for name, text in case.get("also", {}).items():
        Path(name).write_text(text)
    outcome = run(*case["command"])
    assert outcome.code == 3
    for words in case["says"]:
        assert words in outcome.err
