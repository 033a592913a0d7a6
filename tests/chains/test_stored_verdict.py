"""The verdict of `verify` in the report and on the page: as soon as it is there, and only for the sketch that it is about."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.transformations.chains.page import report_page
from robosmi.transformations.chains.stages.stored_verdict import FILE
from tests.running import run
from tests.tools import require_verification

PROGRAM = Path(__file__).parent.parent / "cli" / "cases" / "partly" / "course.c"
BOUND = ("--bind", "P5=D7", "--bind", "P9=none")
pytestmark = pytest.mark.processes


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A migrated program that was compared with its original."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("verdict")
    shutil.copy(PROGRAM, folder)
    assert run("migrate", folder / "course.c", "-o", folder / "out", *BOUND).code in (0, 1)
    outcome = run("verify", folder / "out", "--budget", "1")
    assert outcome.code == 0
    assert str(folder / "out" / "models" / "verification.svg") in outcome.out
    return folder


@pytest.fixture
def folder(made: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    shutil.copytree(made, tmp_path / "copy")
    return tmp_path / "copy"


def shown(out: Path) -> tuple[bool, bool]:
    """Whether the report and the page have the verdict."""
    return "`RS850`" in (out / "course" / "MIGRATION.md").read_text(), "RS850" in report_page(out, "n")


def test_a_verdict_is_in_the_report_and_on_the_page(folder: Path) -> None:
    out = folder / "out"
    assert shown(out) == (True, True)
    assert "verification.svg" in (out / "course" / "MIGRATION.md").read_text()
    assert run("migrate", folder / "course.c", "-o", out, *BOUND).code in (0, 1)  # the same sketch again
    assert shown(out) == (True, True)


@pytest.mark.parametrize("edit", ["course/course.ino", "course/more.h"])
def test_a_verdict_on_another_sketch_is_not_shown(folder: Path, edit: str) -> None:
    out = folder / "out"
    with (out / edit).open("a") as file:
        file.write("// mine\n")
    assert "RS850" not in report_page(out, "n")
    run("generate", out / "models" / "plan.xmi", "-o", out)
    assert shown(out) == (False, False)
    assert "// mine" in (out / edit).read_text()


def test_a_damaged_record_is_no_verdict(folder: Path) -> None:
    for text in ("", "{}", '{"schema": "robosmi-verdict/1", "sketch": {}, "rule": "RS850", "message": "", "fix": ""}'):
        (folder / "out" / "models" / FILE).write_text(text)
        assert "RS850" not in report_page(folder / "out", "n")


def test_undo_takes_back_the_choice_before_a_verdict(folder: Path) -> None:
    out = tmp = folder.parent / "again"
    before = run("migrate", folder / "course.c", "-o", tmp, "--bind", "P5=D7", "--bind", "P9=none")
    assert before.code in (0, 1)
    sketch = (out / "course" / "course.ino").read_text()
    assert run("choose", out, "P5=D8").code in (0, 1)
    assert (out / "course" / "course.ino").read_text() != sketch
    assert run("verify", out, "--budget", "1").code == 0
    assert shown(out)[0]
    assert run("undo", out).code == 0
    assert (out / "course" / "course.ino").read_text() == sketch
    assert shown(out) == (False, False)


def test_verify_writes_no_sketch(folder: Path) -> None:
    out = folder / "out"
    plan = out / "models" / "plan.xmi"
    assert plan.read_text().count('choice="D7"') == 1
    plan.write_text(plan.read_text().replace('choice="D7"', 'choice="none"', 1))  # a decision of which nothing is made yet
    sketch = (out / "course" / "course.ino").read_bytes()
    outcome = run("verify", out, "--budget", "1")
    assert (out / "course" / "course.ino").read_bytes() == sketch
    assert "MIGRATION.md does not have this verdict" in outcome.out
