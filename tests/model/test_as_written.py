"""What a file has, and a save keeps: empty texts, prefixes and literals, xsi:schemaLocation, references into other files.

That the metamodels come out as EMF writes them is judged in `test_ecore_again`.
"""

from __future__ import annotations

import copy
import pickle
import shutil
from pathlib import Path

import pytest

from robosmi.errors import ModelError
from robosmi.model import EmfModel, Metamodel, load_model
from robosmi.model.ecore.ecore_lint import lint
from robosmi.model.ecore.ecore_loader import load_metamodels
from robosmi.model.session import Session
from tests.emf_judge import look

CASES = Path(__file__).parent / "as_written"
EMPTY = CASES / "empty_default.ecore"
pytestmark = pytest.mark.emf_objects("empty defaults are no values, and the judge finds metamodels by namespace, not by location")
MISSPELT = Path(__file__).parent / "misspelt" / "elements.ecore"


@pytest.mark.parametrize("name", ["odd_names", "no_types", "bare", "empty_default"])
def test_a_metamodel_keeps_its_bytes(name: str, tmp_path: Path) -> None:
    EmfModel.load(CASES / f"{name}.ecore").save(tmp_path / "out.ecore")
    assert (tmp_path / "out.ecore").read_bytes() == (CASES / f"{name}.ecore").read_bytes()


def test_an_empty_literal_is_a_literal(tmp_path: Path) -> None:
    model = EmfModel.load(CASES / "none.xmi", EMPTY)
    assert model.roots[0].k.name == "None"
    model.save(tmp_path / "none.xmi")
    assert (tmp_path / "none.xmi").read_bytes() == (CASES / "none.xmi").read_bytes()
    assert look([EMPTY], CASES / "none.xmi", "--no-validate").saved == (CASES / "none.xmi").read_bytes()


def test_the_name_of_a_literal_that_has_another_text_is_refused() -> None:
    with pytest.raises(ModelError, match="'None' is no literal of K") as caught:
        EmfModel.load(CASES / "by_name.xmi", EMPTY, strict=True)
    assert caught.value.location is not None
    assert caught.value.location.line == 2
    read = EmfModel.load(CASES / "by_name.xmi", EMPTY)
    assert [(f.rule, f.location and f.location.line) for f in read.findings] == [("RS610", 2)]


def test_an_empty_default_is_that_of_the_type() -> None:
    root = EmfModel.load(CASES / "none.xmi", EMPTY).roots[0]
    assert (root.i, root.f, root.b, root.d, root.p.name) == (0, 0.0, False, None, "first")


def test_schema_location_and_references_into_other_files_are_kept(tmp_path: Path) -> None:
    for name in ("empty_default.ecore", "none.xmi", "located.xmi"):
        shutil.copy(CASES / name, tmp_path)
    EmfModel.load(tmp_path / "located.xmi").save(tmp_path / "again.xmi")
    assert (tmp_path / "again.xmi").read_bytes() == (CASES / "located.xmi").read_bytes()
    (tmp_path / "deep").mkdir()
    EmfModel.load(tmp_path / "located.xmi").save(tmp_path / "deep" / "again.xmi")
    text = (tmp_path / "deep" / "again.xmi").read_text(encoding="utf-8")
    assert 'xsi:schemaLocation="http://lab/empty_default ../empty_default.ecore"' in text
    assert 'href="../none.xmi#/"' in text
    assert EmfModel.load(tmp_path / "deep" / "again.xmi").roots[0].other.k.name == "None"


def test_a_session_saves_references_between_its_models(tmp_path: Path) -> None:
    for name in ("empty_default.ecore", "none.xmi", "located.xmi"):
        shutil.copy(CASES / name, tmp_path)
    session = Session()
    first = session.open_model(tmp_path / "none.xmi", metamodel=tmp_path / "empty_default.ecore")
    second = session.open_model(tmp_path / "located.xmi", metamodel=tmp_path / "empty_default.ecore")
    assert isinstance(first, EmfModel)
    assert isinstance(second, EmfModel)
    second.save()
    first.roots[0].other = second.roots[0]
    first.save()
    assert 'href="located.xmi#/"' in (tmp_path / "none.xmi").read_text(encoding="utf-8")
    assert 'href="none.xmi#/"' in (tmp_path / "located.xmi").read_text(encoding="utf-8")


def test_misspelt_elements_and_classes_are_named_with_their_lines() -> None:
    found = lint(MISSPELT, load_metamodels([MISSPELT]))
    lines = [f.location.line for f in found if f.location is not None and f.rule == "RS607"]
    assert lines == [3, 4, 4, 6, 7, 8, 10]


def test_an_element_is_not_copied_by_python() -> None:
    root = Metamodel.load(EMPTY).R()
    for attempt in (copy.copy, copy.deepcopy, pickle.dumps):
        with pytest.raises(ModelError, match="cannot be copied") as caught:
            attempt(root)
        assert load_model.__name__ in (caught.value.fix or "")
