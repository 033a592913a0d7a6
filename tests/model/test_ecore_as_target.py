"""Models that are metamodels: Ecore's classes are made, named, connected and deleted in any order, and EMF reads the file."""

from __future__ import annotations

import itertools
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pyecore import ecore

from robosmi.chain import Chain
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.feature_errors import UnknownFeatureError
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView
from robosmi.transform import ETL, Flock
from tests.emf_judge import ask, require_emf
from tests.library import library

GARDEN = Path(__file__).parent / "metamodels" / "garden.ecore"


def new() -> Any:
    return ModelView(EmfModel((), Metamodel.ecore(), "E"))


def accepted(*paths: Path) -> None:
    """Check metamodels by EMF's own validation."""
    require_emf()
    text, ok = ask(*paths)
    assert ok, text


def test_every_class_of_ecore_takes_its_features_as_any_other() -> None:
    E = new()
    for kind in ("EAnnotation", "EAttribute", "EClass", "EDataType", "EEnum", "EEnumLiteral", "EGenericType", "EOperation",
                 "EPackage", "EParameter", "EReference", "ETypeParameter"):  # fmt: skip
        named = kind not in ("EAnnotation", "EGenericType")
        made = E[kind](name="X") if named else E[kind]()
        assert not named or made.name == "X"
        assert E[kind].all_of_type == [made]
        with pytest.raises(UnknownFeatureError, match=rf"{kind} has no feature 'nme'"):
            E[kind](nme="X")
    abstract = E.EClass(name="Y", abstract=True, eSuperTypes=[E.EClass.all[0]])
    assert abstract.abstract
    assert abstract.eSuperTypes.index(E.EClass.all[0]) == 0


def _contain(p: Any, c: Any, b: Any, r: Any, k: Any, one: Any) -> None:
    p.eClassifiers.extend([c, b, k])
    c.eStructuralFeatures.append(r)
    k.eLiterals.append(one)


def _name(*made: Any) -> None:
    for element, name in zip(made, ("p", "Robot", "Part", "parts", "Kind", "arm"), strict=True):
        element.name = name


def _connect(p: Any, c: Any, b: Any, r: Any, k: Any, one: Any) -> None:
    c.eSuperTypes.append(b)
    r.eType, r.upperBound, r.containment = b, -1, True


@pytest.mark.parametrize("order", list(itertools.permutations([_contain, _name, _connect])))
def test_the_order_of_changes_is_free(order: tuple[Callable[..., None], ...], tmp_path: Path) -> None:
    """A transformation makes all targets first, and names them in whatever rule comes next."""
    E = new()
    parts = [E.EPackage(nsURI="http://example.org/p", nsPrefix="p"), E.EClass(), E.EClass(), E.EReference(), E.EEnum(),
             E.EEnumLiteral(value=1)]  # fmt: skip
    for step in order:
        step(*parts)
    E.save(tmp_path / "p.ecore")
    accepted(tmp_path / "p.ecore")
    made = Metamodel.load(tmp_path / "p.ecore")
    robot = made.Robot(parts=[made.Robot()])
    assert isinstance(robot, made.Part)
    assert made.Kind.arm.value == 1


def test_a_metamodel_that_is_a_model_changes_no_class_of_python() -> None:
    """Crossed supertypes would change the order of supertypes of all classes of the process."""
    E = new()
    before = vars(ecore.Metasubinstance).get("mro")
    a, b = E.EClass(name="A"), E.EClass(name="B")
    x, y = E.EClass(name="X", eSuperTypes=[a, b]), E.EClass(name="Y", eSuperTypes=[b, a])
    E.EClass(name="Z", eSuperTypes=[x, y])
    a.eSuperTypes.append(E.EClass(name="Top"))
    assert vars(ecore.Metasubinstance).get("mro") is before
    first = E.EClass(name="First")
    first.eOperations.append(E.EOperation(name="no python at all"))
    assert [o.name for o in first.eOperations] == ["no python at all"]


def test_a_metamodel_that_was_read_is_changed(tmp_path: Path) -> None:
    for name in ("garden.ecore", "common.ecore"):
        shutil.copy(GARDEN.parent / name, tmp_path / name)
    E = ModelView(EmfModel.load(tmp_path / "garden.ecore", name="E"))
    first = E.EClass.all.first()
    first.eStructuralFeatures.append(feature := E.EAttribute())
    feature.name, feature.eType = "colour", ecore.EString
    E.EClass.all.last().name = "Renamed"
    E.save()
    accepted(tmp_path / "common.ecore", tmp_path / "garden.ecore")
    read = Metamodel.load(tmp_path / "garden.ecore")
    assert getattr(read, first.name).eClass.findEStructuralFeature("colour") is not None
    assert read.find("Renamed") is not None


def test_rules_make_a_metamodel_of_a_model(tmp_path: Path) -> None:
    L, E = library(), new()
    t = ETL(L, E)

    @t.rule(L.Library, to=E.EPackage)
    def Package(s: Any, p: Any) -> None:
        p.name, p.nsURI, p.nsPrefix = "shelf", "http://example.org/shelf", "shelf"
        t.set(p, eClassifiers=L.Section.all)

    @t.rule(L.Section, to=E.EClass)
    def Class(s: Any, c: Any) -> None:
        t.set(c, eStructuralFeatures=s.items)
        c.name = s.name

    @t.rule(L.Item, to=E.EAttribute)
    def Attribute(i: Any, a: Any) -> None:
        a.name, a.eType = f"{i.name}_{i.year}", ecore.EString

    t.run()
    E.save(tmp_path / "shelf.ecore")
    accepted(tmp_path / "shelf.ecore")
    assert set(Metamodel.load(tmp_path / "shelf.ecore").names()) == {s.name for s in L.Section.all}


def test_a_metamodel_is_migrated(tmp_path: Path) -> None:
    old = ModelView(EmfModel.load(GARDEN, name="Old"))
    E = new()
    f = Flock(old, E)

    @f.migrate("EClass")
    def Suffixed(o: Any, m: Any) -> None:
        m.name = f"{o.name}2"

    f.run()
    assert [c.name for c in E.EClass.all] == [f"{c.name}2" for c in old.EClass.all]


def test_a_chain_makes_a_metamodel(tmp_path: Path) -> None:
    shutil.copy(GARDEN, tmp_path / "garden.ecore")
    shutil.copy(GARDEN.parent / "common.ecore", tmp_path / "common.ecore")

    def named(t: ETL, old: Any, made: Any) -> None:
        @t.rule(old.EPackage, to=made.EPackage)
        def Package(o: Any, p: Any) -> None:
            p.name, p.nsURI, p.nsPrefix = "made", "http://example.org/made", "made"
            t.set(p, eClassifiers=old.EClass.all)

        @t.rule(old.EClass, to=made.EClass)
        def Class(o: Any, c: Any) -> None:
            c.name = o.name

    c = Chain(tmp_path)
    c.load("old", "garden.ecore")
    c.transform(named, models="old", makes="made", metamodel="ecore", file="made.ecore")
    assert c.run()["named"].written == ["made.ecore"]
    accepted(tmp_path / "made.ecore")
    assert [r.state for r in c.run().steps] == ["up to date", "up to date"]
