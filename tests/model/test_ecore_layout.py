"""An .ecore file that is saved keeps its layout, comments and encoding; an edit changes its own lines."""

from __future__ import annotations

import difflib
import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.model.emf import EmfModel

SPLIT = Path(__file__).parent / "split"
COMMENT = "  <!-- the whole\n       graph -->\n"


@pytest.fixture
def commented(tmp_path: Path) -> Path:
    """A metamodel with comments, whose lines are longer than EMF writes them."""
    text = (SPLIT / "g.ecore").read_text()
    place = text.index('  <eClassifiers xsi:type="ecore:EClass" name="Graph"')
    text = (text[:place] + COMMENT + text[place:]).replace("<ecore:EPackage", "<!-- licence -->\n<ecore:EPackage")
    (tmp_path / "g.ecore").write_text(text)
    return tmp_path / "g.ecore"


def test_a_file_that_was_not_edited_keeps_its_bytes(commented: Path) -> None:
    before = commented.read_bytes()
    EmfModel.load(commented).save()
    assert commented.read_bytes() == before
    assert list(commented.parent.iterdir()) == [commented]


def test_an_edit_changes_the_lines_of_what_it_concerns(commented: Path) -> None:
    before = commented.read_text().splitlines()
    model: Any = EmfModel.load(commented)
    next(one for one in model.EClass.all if one.name == "Graph").name = "Net"
    next(one for one in model.EAttribute.all if one.name == "weight").lowerBound = 1
    model.save()
    after = commented.read_text().splitlines()
    changed = [line for line in difflib.ndiff(before, after) if line[0] in "+-"]
    assert [line[0] for line in changed] == ["-", "+", "-", "+"]
    again: Any = EmfModel.load(commented)
    assert "Net" in [one.name for one in again.EClass.all]
    assert list(commented.parent.iterdir()) == [commented]


def test_comments_come_along_to_another_place(commented: Path) -> None:
    target = commented.with_name("copy.ecore")
    EmfModel.load(commented).save(target)
    assert target.read_bytes() == commented.read_bytes()


def test_a_file_that_has_changed_meanwhile_is_written_as_emf_does(commented: Path) -> None:
    model = EmfModel.load(commented)
    shutil.copy(SPLIT / "g.ecore", commented)
    model.save()
    assert COMMENT not in commented.read_text()
