"""Generated packages on disk: whole or not at all, nothing of a person's is lost, any of them may be imported first."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.cli.main import main
from robosmi.errors import StoppedError
from robosmi.generate.packages import generate_packages

ROOT = Path(__file__).parents[3]
CASES = Path(__file__).parent / "cases"
CIRCLES = CASES / "circles" / "root.ecore"


def tree(folder: Path) -> dict[str, bytes]:
    """The files of a folder."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


@pytest.mark.parametrize("name", ["root/__init__.py", "root/left/__init__.py"])
@pytest.mark.parametrize("foreign", [True, False])
def test_an_edited_or_foreign_file_stops_the_run_and_stays(name: str, foreign: bool, tmp_path: Path) -> None:
    path = tmp_path / name
    if foreign:
        path.parent.mkdir(parents=True)
    else:
        generate_packages([str(CIRCLES)], str(tmp_path))
    path.write_text("# a person's\n")
    before = tree(tmp_path)
    with pytest.raises(StoppedError, match="was not made by robosmi" if foreign else "was changed since the last run"):
        generate_packages([CIRCLES], tmp_path)
    assert tree(tmp_path) == before


def test_other_line_ends_are_no_edit_and_the_file_is_made_anew_with_its_own(tmp_path: Path) -> None:
    generate_packages([CIRCLES], tmp_path)
    before = tree(tmp_path)
    path = tmp_path / "root" / "__init__.py"
    path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    made = generate_packages([CIRCLES], tmp_path)
    assert tree(tmp_path) == before
    assert [(f.rule, f.location.path) for f in made.findings if f.location and f.rule == "RS523"] == [("RS523", str(path))]


def test_files_of_a_person_beside_generated_ones_stay(tmp_path: Path) -> None:
    generate_packages([CIRCLES], tmp_path)
    for name in ("notes.txt", "root/mixins.py", "root/left/extra.py", "other/__init__.py"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text('"""Mine."""\n')
    before = tree(tmp_path)
    assert generate_packages([CIRCLES], tmp_path).written == []
    assert tree(tmp_path) == before


def test_a_package_that_is_gone_from_the_metamodel_is_removed(tmp_path: Path) -> None:
    metamodel = tmp_path / "root.ecore"
    metamodel.write_text(CIRCLES.read_text())
    shutil.copy(CIRCLES.with_name("apart.ecore"), tmp_path)
    generate_packages([metamodel], tmp_path / "made")
    start, end = '  <eSubpackages name="empty"', "</ecore:EPackage>"
    text = CIRCLES.read_text()
    metamodel.write_text(text[: text.index(start)] + end)
    made = generate_packages([metamodel], tmp_path / "made")
    assert made.removed == [tmp_path / "made" / "root" / "empty" / "__init__.py"]
    assert not made.removed[0].exists()


def test_two_metamodels_in_one_folder_leave_each_other_alone(tmp_path: Path) -> None:
    generate_packages([CIRCLES], tmp_path)
    before = tree(tmp_path)
    generate_packages([CASES / "shadows" / "shadows.ecore"], tmp_path)
    assert {name: data for name, data in tree(tmp_path).items() if name in before} == before


@pytest.mark.parametrize("first", ["root", "root.left", "root.right", "root.right.Inner_", "root.empty"])
def test_any_package_of_a_circle_may_be_imported_first(first: str, tmp_path: Path) -> None:
    generate_packages([CIRCLES], tmp_path / "made")
    code = f"import made.{first}; from made.root import Top; from made.root.left import Leaf; print(Top(first=Leaf()).first)"
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}{os.pathsep}{tmp_path}"}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False, env=environment
    )
    assert (done.returncode, done.stdout) == (0, "<Leaf>\n"), done.stderr


@pytest.mark.parametrize("first", ["library", "people", "base"])
def test_any_package_of_several_files_may_be_imported_first(first: str, tmp_path: Path) -> None:
    generate_packages([CASES / "two_files" / "library.ecore"], tmp_path / "made")
    code = (
        f"import made.{first}; from made.people import Person; from made.library import Book; print(Book(owner=Person()).owner)"
    )
    environment = {**os.environ, "PYTHONPATH": f"{ROOT}{os.pathsep}{tmp_path}"}
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", code], capture_output=True, text=True, check=False, env=environment
    )
    assert (done.returncode, done.stdout) == (0, "<Person>\n"), done.stderr


def test_the_order_of_the_files_given_changes_nothing(tmp_path: Path) -> None:
    paths = sorted((CASES / "two_files").glob("*.ecore"))
    generate_packages(paths, tmp_path / "one")
    generate_packages(paths[::-1], tmp_path / "two")
    assert tree(tmp_path / "one") == tree(tmp_path / "two")


def test_the_command_says_what_it_made_and_what_is_not_as_the_metamodel_says(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["metamodels", "generate", str(CASES / "defaults" / "defaults.ecore"), "-o", str(tmp_path / "py"), "--json"]
    assert main(words) == 0
    document = json.loads(capsys.readouterr().out)
    package = str(tmp_path / "py" / "defaults" / "__init__.py")
    assert document["artifacts"] == [{"path": package, "kind": "python"}]
    assert document["result"]["written"] == [package]
    assert document["result"]["sources"][package].endswith("defaults.ecore")
    assert document["result"]["classes"] == 1
    assert {f["rule"] for f in document["findings"]} == {"RS603"}
    assert main([words[0], "--fail-on", "warning", *words[1:]]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["result"]["written"] == []
    assert document["result"]["skipped"] == [{"path": package, "why": "unchanged"}]


def test_the_command_refuses_with_place_cause_and_what_to_do(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["metamodels", "generate", str(CASES / "refused_types" / "types.ecore"), "-o", str(tmp_path / "py"), "--json"]
    assert main(words) == 3
    document = json.loads(capsys.readouterr().out)
    assert document["ok"] is False
    (finding,) = document["findings"]
    assert finding["rule"] == "RS907"
    assert finding["location"]["line"] == 8
    assert finding["fix"]
    assert "has no type" in finding["message"]
    assert not (tmp_path / "py").exists()


def test_a_package_with_the_name_of_a_module_of_python_is_said(tmp_path: Path) -> None:
    source = (CASES / "shadows" / "shadows.ecore").read_text().replace('name="shadows"', 'name="ast"')
    (tmp_path / "ast.ecore").write_text(source)
    made = generate_packages([tmp_path / "ast.ecore"], tmp_path / "py")
    (finding,) = [f for f in made.findings if f.rule == "RS606"]
    assert "py.ast" in (finding.fix or "")
