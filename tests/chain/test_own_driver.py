"""A chain loads a file by a driver of its own, a function or a class beside it: `driver = "FILE.py:NAME"`."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from robosmi.chain import read_chain
from robosmi.errors import RuleError, SourceError

FOLDER = Path(__file__).parent / "notes"


@pytest.fixture
def notes(tmp_path: Path) -> Path:
    """A copy of the chain's folder."""
    return Path(shutil.copytree(FOLDER, tmp_path / "notes", ignore=shutil.ignore_patterns("__pycache__")))


def replace(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


@pytest.mark.parametrize("driver", ["read", "Notes"])
def test_a_text_becomes_a_model_and_a_change_of_the_driver_reads_it_again(driver: str, notes: Path) -> None:
    replace(notes / "chain.toml", "drivers.py:read", f"drivers.py:{driver}")
    read_chain(notes / "chain.toml").run()
    assert (notes / "out" / "all.txt").read_text() == "buy wheels\ncharge\n"
    assert [r.state for r in read_chain(notes / "chain.toml").run().steps] == ["up to date"] * 2
    replace(notes / "drivers.py", ".strip()", ".strip().upper()")
    read_chain(notes / "chain.toml").run()
    assert (notes / "out" / "all.txt").read_text() == "BUY WHEELS\nCHARGE\n"


@pytest.mark.parametrize(("driver", "error", "said"), [
    ("drivers.py:raed", SourceError, r"drivers.py has no function 'raed' (did you mean 'read'?)"),
    ("driver.py:read", SourceError, "there is no file"),
    ("drivers.py:gives_nothing", RuleError, "the driver of the step 'load notes' gives None, which is no Model"),
    ("drivers.py:takes_one", RuleError, "the function of the step 'load notes' does not fit: too many positional arguments"),
    ("drivers.py:raises", RuleError, "the driver of the step 'load notes' fails: ValueError: not a number"),
    ("drivers.py:Unfinished", RuleError, "fails: TypeError: Can't instantiate abstract class"),
])  # fmt: skip
def test_a_driver_that_cannot_be_used_is_told_with_its_place(
    driver: str, error: type[RuleError | SourceError], said: str, notes: Path
) -> None:
    replace(notes / "chain.toml", "drivers.py:read", driver)
    with pytest.raises(error, match=re.escape(said)) as told:
        read_chain(notes / "chain.toml").run()
    assert told.value.location is not None or driver.endswith("Unfinished")
    assert told.value.fix


LOUD = """

def loud(v: EVL, notes: Any) -> None:
    \"""Notes are loud.\"""
    shout = Fix("shout", lambda n: object.__setattr__(n, "text", n.text.upper()))
    v.context(notes.Note).constraint(name="Loud", fixes=[shout])(lambda n: n.text.isupper())
"""


def test_a_fix_of_a_model_that_can_only_be_read_is_not_performed(notes: Path) -> None:
    """It was told as done, and nothing was written."""
    replace(
        notes / "drivers.py",
        "from robosmi.generate import Gen\n",
        "from robosmi.generate import Gen\nfrom robosmi.validate import EVL, Fix\n",
    )
    with (notes / "drivers.py").open("a") as file:
        file.write(LOUD)
    replace(
        notes / "chain.toml",
        "[[step]]\ngenerate",
        '[[step]]\nvalidate = "drivers.py:loud"\nmodels = "notes"\n\n[[step]]\ngenerate',
    )
    for _ in range(2):
        step = read_chain(notes / "chain.toml").run(fix="first").steps[1]
        assert (step.state, step.fixed, step.saved) == ("failed", [], [])
        assert {finding.rule for finding in step.findings} == {"RS532", "Loud"}
        assert "can only be read" in next(f.message for f in step.findings if f.rule == "RS532")
    assert (notes / "notes.txt").read_text() == (FOLDER / "notes.txt").read_text()
