"""Types of the attributes of XML itself (`xml:lang`, `xml:space`), which metamodels made of XML Schemas refer to."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from tests.emf_judge import judge, look

FOLDER = Path(__file__).parent / "xml_namespace"


def test_values_are_texts() -> None:
    model: Any = EmfModel.load(FOLDER / "texts.xmi", FOLDER / "texts.ecore")
    (text,) = model.Text.all
    assert (text.lang, text.space) == ("en", "preserve")


@pytest.mark.parametrize(
    "place", ["http://www.w3.org/XML/1998/namespace", "platform:/plugin/org.eclipse.emf.ecore/model/XMLNamespace.ecore"]
)
def test_the_types_are_found_by_namespace_and_place(place: str, tmp_path: Path) -> None:
    path = tmp_path / "texts.ecore"
    path.write_text((FOLDER / "texts.ecore").read_text().replace("http://www.w3.org/XML/1998/namespace", place))
    texts: Any = Metamodel.load(path).epackages[0]
    lang = texts.eClassifiers[0].eStructuralFeatures[0]
    assert (lang.eType.name, lang.eType.ePackage.nsURI) == ("LangType", "http://www.w3.org/XML/1998/namespace")


def test_emf_takes_what_is_written(tmp_path: Path) -> None:
    shutil.copy(FOLDER / "texts.ecore", tmp_path / "before.ecore")
    EmfModel.load(tmp_path / "before.ecore").save(tmp_path / "texts.ecore")
    assert b"namespace#//LangType" in (tmp_path / "texts.ecore").read_bytes()
    assert look([], tmp_path / "texts.ecore").ok
    model: Any = EmfModel.load(FOLDER / "texts.xmi", tmp_path / "texts.ecore")
    model.Text.all[0].lang = "de"
    model.save(tmp_path / "texts.xmi")
    judge([tmp_path / "texts.ecore"], tmp_path / "texts.xmi")
