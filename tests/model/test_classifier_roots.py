"""An .ecore file whose root is a classifier is a model of Ecore, as in EMF, and no metamodel."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from robosmi.errors import ModelError, SourceError
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from tests.running import run

FOLDER = Path(__file__).parent / "classifier_roots"


@pytest.mark.parametrize(("name", "classes"), [("m1", ["C11"]), ("m2", ["C21"]), ("m3", ["C31"])])
def test_a_class_alone_is_read(name: str, classes: list[str]) -> None:
    done = run("query", FOLDER / f"{name}.ecore", "EClass.all.name", "--json")
    assert done.result == {"value": classes}


def test_its_supertypes_are_those_of_the_other_files() -> None:
    (root,) = EmfModel.load(FOLDER / "m1.ecore").roots
    assert [one.name for one in root.eSuperTypes] == ["C21"]
    assert [one.name for one in root.eSuperTypes[0].eSuperTypes] == ["C31"]
    assert root.eContainer() is None


def test_one_without_references_is_saved(tmp_path: Path) -> None:
    path = Path(shutil.copy(FOLDER / "m3.ecore", tmp_path))
    model = EmfModel.load(path)
    model.roots[0].abstract = True
    model.save()
    (root,) = EmfModel.load(path).roots
    assert (root.name, root.abstract) == ("C31", True)


def test_a_reference_to_a_class_without_a_package_is_not_written(tmp_path: Path) -> None:
    for file in FOLDER.glob("*.ecore"):
        shutil.copy(file, tmp_path)
    with pytest.raises(ModelError) as caught:
        EmfModel.load(tmp_path / "m1.ecore").save()
    assert caught.value.fix
    assert (tmp_path / "m1.ecore").read_bytes() == (FOLDER / "m1.ecore").read_bytes()


def test_it_is_no_metamodel() -> None:
    with pytest.raises(SourceError) as caught:
        Metamodel.load(FOLDER / "m3.ecore")
    assert caught.value.location is not None
    assert caught.value.location.line == 2
    assert caught.value.fix
