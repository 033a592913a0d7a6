"""The judge of all written models itself: runs of pytest on small test files, with EMF, without it, and with marks."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from tests.emf_judge import require_emf

ROOT = Path(__file__).parents[1]
HEAD = """
import subprocess, sys
import pytest
from tests.model.kitchen import classes, kitchen, saved

Root = classes(kitchen())["Root"]
"""
GOOD = """
def test_good(tmp_path):
    saved(Root(name="r"), tmp_path / "good.xmi")
"""
BAD = """
def test_bad(tmp_path):
    saved(Root(), tmp_path / "bad.xmi")
"""
OTHERWISE = """
def test_other(tmp_path):
    item = classes(kitchen())["Item"](name="i")
    item.strD = None
    saved(Root(name="r", items=[item]), tmp_path / "other.xmi")
"""
IN_A_PROGRAM = """
CODE = '''
import sys
from pathlib import Path
from tests.model.kitchen import classes, kitchen, saved
saved(classes(kitchen())["Root"](), Path(sys.argv[1]))
'''

def test_program(tmp_path):
    subprocess.run([sys.executable, "-c", CODE, str(tmp_path / "bad.xmi")], check=True)
"""
NOTHING = """
def test_nothing():
    assert Root(name="r").name == "r"
"""


def pytest_run(folder: Path, *tests: str, path: str | None = None, processes: int = 0) -> tuple[int, str]:
    """The exit code of a run of tests, shared out among so many processes, and what it printed."""
    (folder / "conftest.py").write_text("from tests.conftest import pytest_addoption, pytest_configure\n", encoding="utf-8")
    (folder / "test_small.py").write_text(HEAD + "".join(tests), encoding="utf-8")
    (folder / "pytest.ini").write_text("[pytest]\naddopts = -ra --strict-markers -p no:cacheprovider\n", encoding="utf-8")
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "PATH": path or os.environ["PATH"]}
    environment.pop("CI", None)
    command = [sys.executable, "-m", "pytest", "-q", *([f"-n{processes}"] if processes else []), "."]
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


def marked(test: str, mark: str) -> str:
    return f'\n@pytest.mark.{mark}("why"){test}'


def test_a_model_that_emf_takes_is_one_more_test_that_passes(tmp_path: Path) -> None:
    require_emf()
    code, out = pytest_run(tmp_path, GOOD)
    assert code == 0
    assert "2 passed" in out
    assert "1 sets of written models judged by EMF" in out


@pytest.mark.parametrize(("bad", "test"), [(BAD, "test_bad"), (IN_A_PROGRAM, "test_program")])
def test_a_model_that_emf_refuses_fails_the_run_and_names_the_test(bad: str, test: str, tmp_path: Path) -> None:
    require_emf()
    code, out = pytest_run(tmp_path, GOOD, bad)
    assert code == 1
    assert "1 failed, 2 passed" in out
    assert "bad.xmi" in out
    assert f"  written by test_small.py::{test}\n" in out
    assert "MODEL-ERROR: The required feature 'name' of" in out
    assert "test_good" not in out
    shutil.rmtree(out.partition("bad.xmi (")[2].partition("/models-")[0])


def test_a_model_that_emf_writes_otherwise_fails_with_the_line(tmp_path: Path) -> None:
    require_emf()
    code, out = pytest_run(tmp_path, OTHERWISE)
    assert code == 1
    assert "EMF writes line 2 differently" in out
    shutil.rmtree(out.partition("other.xmi (")[2].partition("/models-")[0])


def test_marks_say_that_emf_sees_it_otherwise_on_purpose(tmp_path: Path) -> None:
    require_emf()
    assert pytest_run(tmp_path, marked(OTHERWISE, "emf_writes_otherwise"), marked(BAD, "emf_objects"))[0] == 0


def test_models_of_several_processes_are_judged_once_with_their_marks(tmp_path: Path) -> None:
    require_emf()
    code, out = pytest_run(
        tmp_path, GOOD, marked(OTHERWISE, "emf_writes_otherwise"), marked(BAD, "emf_writes_otherwise"), processes=2
    )
    assert code == 1
    assert "1 failed, 3 passed" in out
    assert "3 sets of written models judged by EMF" in out
    shutil.rmtree(out.partition("bad.xmi (")[2].partition("/models-")[0])


def test_the_mark_for_other_bytes_does_not_excuse_an_objection(tmp_path: Path) -> None:
    require_emf()
    code, out = pytest_run(tmp_path, marked(BAD, "emf_writes_otherwise"))
    assert code == 1
    shutil.rmtree(out.partition("bad.xmi (")[2].partition("/models-")[0])


def test_a_mark_does_not_excuse_another_test_that_writes_the_same(tmp_path: Path) -> None:
    require_emf()
    code, out = pytest_run(tmp_path, marked(BAD, "emf_objects"), BAD.replace("test_bad", "test_again"))
    assert code == 1
    assert "written by test_small.py::test_again" in out
    shutil.rmtree(out.partition("bad.xmi (")[2].partition("/models-")[0])


def test_without_java_it_is_skipped_with_the_reason(tmp_path: Path) -> None:
    code, out = pytest_run(tmp_path, BAD, path="/nowhere")
    assert code == 0
    assert "1 passed, 1 skipped" in out
    assert "not installed: java, javac" in out


def test_a_run_that_writes_no_model_asks_nobody(tmp_path: Path) -> None:
    code, out = pytest_run(tmp_path, NOTHING)
    assert code == 0
    assert "1 passed" in out
    assert "EMF" not in out
