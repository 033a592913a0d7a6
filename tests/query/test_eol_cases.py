"""Our queries against answers of the real engine: every file of `eol/`, through the interpreter of `tests/eol_cases.py`.

`cases-dev.json` holds answers that the engine gave; the other files hold measured facts and those of the engine's
sources, each with its place (`source`). A case that differs is named with its expected answer.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.eol_cases import check, main, same

FOLDER = Path(__file__).parents[1] / "epsilon" / "eol"
FILES = sorted(path.name for path in FOLDER.glob("*.json"))


@pytest.mark.parametrize("name", FILES)
def test_we_answer_as_the_engine_does(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    agreeing, differing = check(FOLDER / name)
    capsys.readouterr()  # the cases of print
    assert [(case["id"], case["expected"], answer) for case, answer in differing] == []
    assert agreeing == len(json.loads((FOLDER / name).read_text())["cases"]) > 0


def test_every_case_says_where_its_answer_is_from() -> None:
    for name in set(FILES) - {"cases-dev.json"}:
        cases = json.loads((FOLDER / name).read_text())["cases"]
        assert all(case["source"] for case in cases)
        assert len({case["id"] for case in cases}) == len(cases)


def test_a_wrong_answer_is_told_apart(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data = json.loads((FOLDER / "boolean.json").read_text())
    for file in ("library.ecore", "library.xmi"):
        (tmp_path / file).write_bytes((FOLDER / file).read_bytes())
    data["cases"] = [
        {"id": "wrong", "expression": ["xor", True, True], "expected": True},
        {"id": "odd", "expression": ["xor", True, True], "expected": True, "quirk": "said so"},
    ]
    (tmp_path / "cases.json").write_text(json.dumps(data))
    assert main([str(tmp_path / "cases.json")]) == 1
    assert "0 agree, 2 differ (1 quirk)" in capsys.readouterr().out
    data["cases"] = data["cases"][1:]
    (tmp_path / "cases.json").write_text(json.dumps(data))
    assert main([str(tmp_path / "cases.json")]) == 0


def test_the_judge_tells_kinds_and_types_apart() -> None:
    assert same([1, 2], {"Sequence": [1, 2]})
    assert not same([2, 1], {"Sequence": [1, 2]})
    assert same({2, 1}, {"Set": [1, 2]})
    assert not same({1, 2}, {"Sequence": [1, 2]})
    assert not same(1, True)
    assert not same(1, {"Real": 1.0})
    assert not same(1.0, 1)
