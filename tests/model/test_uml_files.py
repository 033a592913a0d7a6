"""What files of UML have that EMF's own do not: a number without bound, values of computed features, annotations of Ecore's."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError
from robosmi.model import Metamodel, Session, open_model
from robosmi.model.elements.datatypes import ECORE_URI
from tests.recording.written_models import FOLDER
from tests.running import run

UML = Path(__file__).parent / "uml"


@pytest.fixture
def file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A model whose data type has its text form in UML2's own code, which EMF's judge does not have."""
    monkeypatch.delenv(FOLDER, raising=False)
    return Path(shutil.copy(UML / "m.uml", tmp_path))


def test_a_number_without_bound_is_a_star(file: Path) -> None:
    before = file.read_text()
    model: Any = Session().open_model(file, metamodel=UML / "part.ecore")
    (bound,) = model.Bound.all
    assert bound.value == -1
    for value, text in ((7, "7"), (-1, "*")):
        bound.value = value
        model.save()
        assert file.read_text() == before.replace('value="*"', f'value="{text}"')
    model.roots[0].value = 2**40
    with pytest.raises(ModelError, match="is not between"):
        model.save()


def test_a_value_of_a_computed_feature_is_a_finding_and_stays_in_the_file(file: Path) -> None:
    before = file.read_text()
    model: Any = Session().open_model(file, metamodel=UML / "part.ecore")
    assert [finding.message for finding in model.findings][-1] == "Bound.nodes is computed, not stored"
    model.save()
    assert file.read_text() == before
    model.roots[0].name = "b"
    model.save()
    assert file.read_text() == before.replace('"a"', '"b"')
    with pytest.raises(ModelError, match="is computed"):
        open_model(file, metamodel=UML / "part.ecore", strict=True)


@pytest.mark.parametrize("ecore", ["ecore", ECORE_URI])
def test_ecore_is_a_further_metamodel(ecore: str, file: Path) -> None:
    before = file.read_text()
    model: Any = Session().open_model(file, metamodel=[UML / "part.ecore", ecore])
    assert [each.source for each in model.roots[0].eAnnotations] == ["s"]
    assert [finding.rule for finding in model.findings] == ["RS610", "RS610"]
    model.save()
    assert file.read_text() == before
    assert Metamodel.load(UML / "part.ecore", ecore).EAnnotation
    done = run("query", file, "Bound.all.first().value", "--metamodel", UML / "part.ecore", "--metamodel", ecore, "--json")
    assert done.result == {"value": -1}
