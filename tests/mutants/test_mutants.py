"""The changes that make mutants, and how one gets into a run of the tests."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.mutants import reached
from tests.mutants.__main__ import (
    RECORDING,
    ROOT,
    Campaign,
    Mutant,
    Outcome,
    Recording,
    equivalent,
    in_stages,
    one_of_each_file,
    sample,
)
from tests.mutants.changes import Change, changes
from tests.recording.mutant import MUTANT

TEXT = b'''"""A module."""
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import this

LIMIT = 3  # \xc3\xa4


class Point(Base, frozen=True):
    """A point."""

    x: Literal[1] = 0


@cached(5)
def inside(value: int, text="\xc3\xa4") -> int:
    """Docstring."""
    if value < LIMIT and not text:
        log(value)
    return [each for each in text if each is value], f"{value == 1}"
'''
FOUND = [
    "7 3 -> (4)",
    "7 3 -> (2)",
    "13 0 -> (1)",
    "13 0 -> (-1)",
    "19 value < LIMIT and not text -> ((value < LIMIT) or (not text))",
    "19 value < LIMIT and not text -> (not (value < LIMIT and not text))",
    "19 value < LIMIT -> (value) <= (LIMIT)",
    "20 log(value) -> pass",
    '21 return [each for each in text if each is value], f"{value == 1}" -> return None',
    "21 each is value -> (each) is not (value)",
    "21 each is value -> (not (each is value))",
]


def test_what_runs_can_be_changed_and_nothing_else() -> None:
    assert sorted(f"{each.line} {each.shown(TEXT)}" for each in changes(TEXT)) == sorted(FOUND)


@pytest.mark.parametrize("change", changes(TEXT), ids=lambda change: change.shown(TEXT))
def test_a_changed_module_is_python_and_differs_in_one_place(change: Change) -> None:
    changed = change.applied(TEXT)
    compile(changed, "changed.py", "exec")
    assert changed != TEXT
    assert changed.startswith(TEXT[: change.start])
    assert changed.endswith(TEXT[change.end :])


def test_the_changes_of_the_product_are_python() -> None:
    for path in sorted((ROOT / "robosmi" / "quoting").glob("*.py")):
        text = path.read_bytes()
        for change in changes(text):
            compile(change.applied(text), path.name, "exec")


def test_a_sample_is_the_same_for_a_seed_and_takes_a_line_once() -> None:
    mutants = [Mutant("m.py", change, TEXT) for change in changes(TEXT)]
    chosen = sample(mutants, 4, 1)
    assert chosen == sample(mutants, 4, 1)
    assert len({each.change.line for each in chosen}) == 4
    assert len(sample(mutants, 99, 1)) == 5


def test_one_test_of_each_file_comes_first() -> None:
    assert one_of_each_file(["b.py::c", "a.py::b", "a.py::a", "a.py::b"]) == ["a.py::a", "b.py::c", "a.py::b"]


def test_the_tests_that_run_the_line_come_before_those_of_the_module() -> None:
    change = next(each for each in changes(TEXT) if each.line == 20)
    many = {f"a.py::{number:02}" for number in range(30)}
    first, rest, others = in_stages(Mutant("m.py", change, TEXT), {20: many, 21: {"b.py::x", "a.py::01"}})
    assert (len(first), len(rest), others) == (24, 6, ["b.py::x"])
    assert {*first, *rest} == many


def test_a_campaign_goes_on_where_it_has_ended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tests.mutants.__main__.OUT", tmp_path)
    monkeypatch.setattr("tests.mutants.__main__.in_stages", lambda *_: (["a"], ["b"], ["c"]))
    monkeypatch.setattr(Recording, "tests_of_lines", lambda *_: {})
    ran: list[str] = []

    def failing(_: Campaign, mutant: Mutant, tests: list[str]) -> str:
        ran.extend(tests)
        return "a test" if len(ran) == 3 else ""

    monkeypatch.setattr(Campaign, "_failing", failing)
    mutant, recording = Mutant("m.py", changes(TEXT)[0], TEXT), Recording(tmp_path, frozenset())
    assert Campaign("check", 0).judge(mutant, 1, recording) == Outcome(1, "")
    assert Campaign("check", 0).judge(mutant, 3, recording) == Campaign("check", 0).judge(mutant, 3, recording)
    assert Campaign("check", 0).outcomes == {mutant.name: Outcome(3, "a test")}
    assert ran == ["a", "b", "c"]
    assert Campaign("test", 0).outcomes == {}


def test_a_recording_has_the_tests_of_each_line_that_pass(tmp_path: Path) -> None:
    module = "robosmi/base/quantities.py"
    reached.start(tmp_path, [ROOT / module])
    around = {reached.RECORDED: str(tmp_path)}
    assert Campaign("all", 0).failures(["tests/test_quantities.py"], around, "-p", "tests.mutants.reached") == []
    tests = set().union(*Recording(tmp_path, frozenset()).tests_of_lines(module).values())
    assert tests
    assert {test.partition("::")[0] for test in tests} == {"tests/test_quantities.py"}
    assert not any(Recording(tmp_path, frozenset(tests)).tests_of_lines(module).values())


def test_a_mutant_is_what_a_run_and_all_that_it_starts_import(tmp_path: Path) -> None:
    module = ROOT / "robosmi" / "base" / "data_text.py"
    text = module.read_text(encoding="utf-8") + "\nMUTANT = True\n"
    (tmp_path / "mutant.json").write_text(json.dumps({"path": os.path.realpath(module), "text": text}))
    code = "import robosmi.base.data_text; print(getattr(robosmi.base.data_text, 'MUTANT', False))"
    again = f"import subprocess, sys; {code}; sys.stdout.flush(); subprocess.run([sys.executable, '-c', {code!r}], check=True)"
    around = os.environ | {MUTANT: str(tmp_path / "mutant.json"), "PYTHONPATH": str(RECORDING)}
    done = subprocess.run([sys.executable, "-c", again], env=around, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert done.stdout.split() == ["True", "True"]


def test_what_is_listed_as_equivalent_is_a_change_of_the_product_as_it_is() -> None:
    for module, line, change in equivalent():
        text = (ROOT / module).read_bytes()
        possible = {each.lasting for each in (Mutant(module, c, text) for c in changes(text))}
        assert (module, line, change) in possible
