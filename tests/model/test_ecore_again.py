"""Metamodels that our own loader reads and our own writer writes again, whatever they hold: EMF's own bytes.

All metamodels that any test uses, those in Debian's EMF jars, and those that lie in the folder of shared facts. A file that EMF
itself cannot read is left out with the reason.
"""

from __future__ import annotations

import os
import zipfile
from pathlib import Path

import pytest
from pyecore import ecore

from robosmi.model.ecore.ecore_loader import load_metamodels
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.ecore import EPackage
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.emf_judge import JARS, ask, require_emf

ROOT = Path(__file__).parents[2]
CASES = Path(__file__).parent / "generator" / "cases"
NOT_EMF = {
    "ecore_by_place": "EMF knows Ecore by its namespace only",
    "two_files": "EMF knows Ecore by its namespace only",
    "several_refused": "we refuse it",
    "misspelt": "EMF refuses it",
    "missing": "EMF reports the neighbours that are not there",
    "bare": "EMF refuses a package without a namespace",
    "classifier_roots": "a model of Ecore and no metamodel: see test_classifier_roots",
    "odd_names": "EMF refuses a package without a namespace",
    **dict.fromkeys((path.name for path in CASES.glob("refused_*")), "we refuse it"),
}
ODD = {
    "diamonds": "an interface that is not abstract",
    "redefined": "features of the same name",
    "lambda": "names that are none in Java",
    "generics": "a wildcard in the place of a type",
    "defaults": "defaults that are no values",
    "no_default": "a default that is no value",
    "odd_names": "characters that are in no name",
    "no_types": "a package without a class",
    "bare": "no namespace",
    "empty_default": "a default that is no value",
    "same_names": "two elements of one name",
}
"""Files that are so on purpose, and what EMF's validation has against them."""
USED = [
    pytest.param(
        path, id=str(path.relative_to(ROOT)), marks=[pytest.mark.emf_objects(ODD[path.stem])] if path.stem in ODD else []
    )
    for folder in ("metamodels", "tests", "docs")
    for path in sorted((ROOT / folder).rglob("*.ecore"))
    if not {path.parent.name, path.stem} & NOT_EMF.keys()
]
PUBLIC = ["DateConversionDelegateAnnotation", "Ecore", "EcoreAnnotation", "ExtendedMetaData", "XMLNamespace", "XMLType"]


def check(path: Path, tmp_path: Path) -> None:
    """Compare what we write for a metamodel with what EMF writes."""
    require_emf()
    sources = [package.source for package in load_metamodels([path])]
    packages: dict[str, list[EPackage]] = {}
    for package, source in zip(Metamodel.load(path).epackages, sources, strict=True):
        packages.setdefault(os.path.relpath(source, path.parent), []).append(package)
    ours = to_xmi(packages, [path.name])[path.name]
    saved = tmp_path / "emf.ecore"
    text, ok = ask(path, "--resave", saved, "--no-validate")
    assert ok, text
    assert ours.decode() == saved.read_text(encoding="utf-8")


@pytest.mark.parametrize("path", USED)
def test_a_metamodel_of_the_tests_comes_out_as_emf_writes_it(path: Path, tmp_path: Path) -> None:
    check(path, tmp_path)


@pytest.mark.emf_objects("EMF's validation objects to some of its own metamodels")
@pytest.mark.parametrize("name", PUBLIC)
def test_a_metamodel_of_emf_itself_comes_out_as_emf_writes_it(name: str, tmp_path: Path) -> None:
    require_emf()
    path = tmp_path / f"{name}.ecore"
    for jar in JARS:
        with zipfile.ZipFile(jar) as archive:
            for entry in archive.namelist():
                if entry.rpartition("/")[2] == path.name:
                    path.write_bytes(archive.read(entry))
    assert path.is_file()
    check(path, tmp_path)


@pytest.mark.emf_objects("the folder is not ours")
def test_the_shared_metamodels_come_out_as_emf_writes_them(shared: Path, tmp_path: Path) -> None:
    broken = shared / "fault-cases"  # on purpose
    found = sorted(path for path in shared.rglob("*.ecore") if broken not in path.parents)
    assert len(found) > 10
    for path in found:
        check(path, tmp_path)


def test_what_models_do_not_need_is_there() -> None:
    package = Metamodel.load(CASES / "generics" / "generics.ecore").epackages[0]
    generic = [x for x in EmfModel(package, [ecore.eClass]).all_contents() if isinstance(x, ecore.EGenericType)]
    assert any(g.eTypeParameter is not None for g in generic)
    assert any(len(g.eTypeArguments) for g in generic)
    documented = Metamodel.load(CASES / "documentation" / "documented.ecore").epackages[0]
    annotations = [x for x in EmfModel(documented, [ecore.eClass]).all_contents() if isinstance(x, ecore.EAnnotation)]
    assert any(a.details.get("documentation") for a in annotations)


def test_everything_else_an_ecore_file_can_say(tmp_path: Path) -> None:
    path = Path(__file__).parent / "metamodels" / "everything.ecore"
    model = EmfModel.load(path)
    found = {x.name: x for x in model.all_of_kind("ENamedElement")}
    assert [k.name for k in found["parts"].eKeys] == ["code", "lot"]
    assert [k.name for k in found["fetch"].eExceptions] == ["Failure"]
    assert (found["fetch"].lowerBound, found["amount"].upperBound, found["amount"].unique) == (1, -1, False)
    assert [bound.eClassifier.name for bound in found["T"].eBounds] == ["Part"]
    assert [a.source for a in found["parts"].eAnnotations] == ["http://lab/note"]
    assert list(found["parts"].eAnnotations[0].references) == [found["code"]]
    assert found["parts"].eAnnotations[0].eAnnotations[0].details == {"why": "nested", "empty": None}
    model.save(tmp_path / path.name)  # that EMF writes the same is judged above
    assert (tmp_path / path.name).read_bytes() == path.read_bytes()


def test_an_ecore_file_is_a_model_whose_types_are_those_of_ecore() -> None:
    path = Path(__file__).parent / "metamodels" / "everything.ecore"
    model = EmfModel.load(path)
    assert [c.name for c in model.all_of_type("EClass")] == ["Part", "Store", "Shop"]
    assert [c.name for c in model.all_of_kind("EClassifier")] == ["Part", "Failure", "Names", "Store", "Shop", "Kind"]
    parts = model.element("//Store/parts")
    assert parts is not None
    assert (parts.name, model.id_of(parts), model.owns(parts)) == ("parts", "//Store/parts", True)
    assert model.element("//Store/nothing") is None
    again = EmfModel.load(path)
    assert not again.owns(parts)
    assert [x.name for x in EmfModel.load(CASES / "two_files" / "library.ecore").roots] == ["library"]  # not what it refers to


@pytest.mark.parametrize("element", ["//Store/parts", "//Store/fetch/amount", "//Kind/small", "//Shop/@eGenericSuperTypes.0"])
def test_a_fragment_in_a_metamodel_leads_back(element: str) -> None:
    model = EmfModel.load(Path(__file__).parent / "metamodels" / "everything.ecore")
    found = model.element(element)
    assert found is not None
    assert model.id_of(found) == element
