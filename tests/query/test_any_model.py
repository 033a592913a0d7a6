"""The page on models of any technology: its examples run as they stand, two technologies in one query among them."""

from __future__ import annotations

import doctest
import re
import shutil
import zipfile
from pathlib import Path
from typing import Any

import pytest

from robosmi.model.elements.driver import Model
from robosmi.model.opening import drivers, endings, open_model
from tests.running import run

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "how-to" / "query-any-model.md"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files that the page names."""
    example = ROOT / "docs" / "examples" / "line_follower"
    with zipfile.ZipFile(next(example.glob("*.fzz"))) as archive:
        inner = next(name for name in archive.namelist() if name.endswith(".fz"))
        (tmp_path / "robot.fz").write_bytes(archive.read(inner))
    shutil.copy(example / "line_follower.c", tmp_path / "robot.c")
    shutil.copy(PAGE.with_name("stock.csv"), tmp_path)
    for name in ("shelf.ecore", "shelf.xmi"):
        shutil.copy(ROOT / "tests" / "model" / "drivers" / "cases" / "emf" / name, tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_examples_of_the_page_run(folder: Path) -> None:
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) > 5
    names: dict[str, object] = {}
    exec(compile(blocks[0], str(PAGE), "exec"), names)
    parser, runner = doctest.DocTestParser(), doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    attempted = 0
    for number, block in enumerate(blocks[1:], 1):
        case = parser.get_doctest(block, names, f"block {number}", str(PAGE), 0)
        assert case.examples
        said: list[str] = []
        result = runner.run(case, out=said.append, clear_globs=False)
        assert result.failed == 0, "".join(said)
        names = case.globs
        attempted += result.attempted
    assert attempted > 12
    assert (folder / "hall.xmi").is_file()


def test_the_commands_of_the_page_run(folder: Path) -> None:
    lines = re.findall(r"^    robosmi (query .*)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(lines) == 3
    values = []
    for line in lines:
        words = [a or b for a, b in re.findall(r"'([^']*)'|(\S+)", line)]
        if "model.xmi" in words:
            words = [
                {"model.xmi": "shelf.xmi", "library.ecore": "shelf.ecore"}.get(w, w).replace("year > 2000", "pages > 100")
                for w in words
            ]
        outcome = run(*words, *([] if "--json" in words else ["--json"]))
        assert outcome.code == 0, outcome.err
        values.append(outcome.result["value"])
    assert "Basic Servo1" in values[0]
    assert values[1:] == [["Gears"], []]


def test_the_page_names_every_driver_and_ending() -> None:
    table = PAGE.read_text(encoding="utf-8").partition("## From Python")[0]
    assert set(drivers()) == set(re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE))
    assert set(endings()) == set(re.findall(r"`(\.\w+)`", table))


def test_what_the_ending_does_not_say_the_content_does(folder: Path) -> None:
    for name, driver in (("shelf.xmi", "EmfModel"), ("robot.fz", "XmlModel")):
        target = folder / f"{name}.unknown"
        shutil.copy(folder / name, target)
        options: dict[str, Any] = {"metamodel": folder / "shelf.ecore"} if driver == "EmfModel" else {}
        assert type(open_model(target, **options)).__name__ == driver


def test_a_driver_of_ones_own_is_found_through_the_registry(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from robosmi.plugins import registry

    entries = registry().entries["driver"]
    monkeypatch.setitem(entries, ".lines", f"{__name__}:open_lines")
    monkeypatch.setitem(entries, "lines", f"{__name__}:open_lines")
    monkeypatch.setattr("robosmi.model.opening.load", lambda target: open_lines)
    (folder / "x.lines").write_text("a\n")
    assert open_model(folder / "x.lines").name == "lines of x.lines"
    assert open_model(folder / "robot.fz", driver="lines").name == "lines of robot.fz"


def open_lines(path: Path, name: str | None = None) -> Model:
    """A driver of a test's own."""
    from robosmi.model.plain_xml import XmlModel

    return XmlModel.parse(b"<lines/>", f"lines of {path.name}")
