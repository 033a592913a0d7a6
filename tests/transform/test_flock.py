"""The Flock mirror beyond the engine's cases: order of opposites, types of values, references to other models, bad input."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RuleError, UsageError
from robosmi.metamodels import ccode, trace
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.model.opening import open_model
from robosmi.query import ModelView
from robosmi.transform import Flock
from tests.library import EPSILON, library


def new(case: str) -> Any:
    return ModelView(EmfModel((), Metamodel.load(EPSILON / "cases" / "flock" / case / "new.ecore"), "New"))


def test_the_order_of_opposites_is_kept_when_asked_for() -> None:
    orders = []
    for keep in (False, True):
        target = new("copy")
        Flock(library("Old"), target, keep_order=keep).run()
        zap = next(c for c in target.Comic.all)
        orders.append([a.name for a in zap.authors])
        assert all(zap in a.books for a in zap.authors)
    assert orders == [["Ada", "Cy"], ["Cy", "Ada"]]


def test_an_equivalent_of_another_class_than_is_asked_for_is_refused() -> None:
    old, target = library("Old"), new("copy")
    migration = Flock(old, target)
    migration.run()
    author = old.Author.all[0]
    kind = type(migration.equivalent(author))
    assert migration.equivalent(author, kind) is migration.equivalent(author)
    with pytest.raises(RuleError, match="is no int"):
        migration.equivalent(author, int)


def metamodel(tmp_path: Path, version: int, features: str) -> Metamodel:
    head = '<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" '
    head += 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
    head += f'xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="p" nsURI="http://p/{version}" nsPrefix="p">'
    text = f'{head}<eClassifiers xsi:type="ecore:EClass" name="A">{features}</eClassifiers></ecore:EPackage>'
    (tmp_path / f"p{version}.ecore").write_text(text, encoding="utf-8")
    return Metamodel.load(tmp_path / f"p{version}.ecore")


def attribute(kind: str, more: str = "") -> str:
    href = f"http://www.eclipse.org/emf/2002/Ecore#//{kind}"
    return f'<eStructuralFeatures xsi:type="ecore:EAttribute" name="v" eType="ecore:EDataType {href}" {more}/>'


MANY = 'upperBound="-1" unique="false"'


@pytest.mark.parametrize(
    ("old", "value", "evolved", "expected"),
    [
        (attribute("EInt"), 3, attribute("EIntegerObject"), 3),
        (attribute("EInt"), 3, attribute("ELong"), 0),
        (attribute("EInt"), 3, attribute("EDouble"), 0.0),
        (attribute("EInt"), 3, attribute("EJavaObject"), 3),
        (attribute("EString"), "3", attribute("EInt"), 0),
        (attribute("EString"), "3", attribute("EString", MANY), ["3"]),
        (attribute("EString", MANY), ["3"], attribute("EString"), None),
        (attribute("EString", MANY), ["a", "b", "c"], attribute("EString", 'upperBound="2" unique="false"'), []),
        (attribute("EString", MANY), ["a", "b"], attribute("EString", 'upperBound="2" unique="false"'), ["a", "b"]),
        (attribute("EBoolean"), True, attribute("EInt"), 0),
        (attribute("EString"), "3", attribute("EString", 'changeable="false"'), None),
    ],
)  # fmt: skip
def test_values_are_copied_as_java_would_take_them(tmp_path: Path, old: str, value: Any, evolved: str, expected: Any) -> None:
    before = ModelView(EmfModel((), metamodel(tmp_path, 1, old), "Old"))
    after = ModelView(EmfModel((), metamodel(tmp_path, 2, evolved), "New"))
    before.A(v=value)
    Flock(before, after).run()
    (made,) = after.A.all
    assert (list(made.v) if isinstance(expected, list) else made.v) == expected


def test_references_to_other_models_stay_what_they_are(tmp_path: Path) -> None:
    head = 'xsi:type="ecore:EReference" name="links" upperBound="-1"'
    links = f'<eStructuralFeatures {head} eType="ecore:EClass http://www.eclipse.org/emf/2002/Ecore#//EObject"/>'
    before = ModelView(EmfModel((), metamodel(tmp_path, 1, links), "Old"))
    after = ModelView(EmfModel((), metamodel(tmp_path, 2, links), "New"))
    unit = ccode.SourceUnit(path="a.c")
    first = before.A(links=[unit])
    second = before.A(links=[first])
    f = Flock(before, after)
    f.delete("A", when=lambda o: o is first)
    f.run()
    (made,) = after.A.all
    assert f.equivalent(second) is made
    assert f.equivalent(unit, ccode.SourceUnit) is unit
    assert f.equivalent(first) is None
    assert list(made.links) == []
    assert f.equivalent([first, second, unit]) == [made, unit]


def test_ids_are_kept(tmp_path: Path) -> None:
    before = ModelView(EmfModel((), metamodel(tmp_path, 1, attribute("EInt")), "Old"))
    after = ModelView(EmfModel((), metamodel(tmp_path, 2, attribute("EInt")), "New"))
    before.A()._internal_id = "_x1"
    Flock(before, after).run()
    assert after.id_of(after.A.all[0]) == "_x1"


def test_types_are_given_as_handles_too() -> None:
    old, target = library("Old"), new("retype")
    f = Flock(old, target)
    f.retype(old.Book, target.Manual)
    f.retype("library::Section", "library::Shelf")
    f.run()
    assert len(target.Manual.all) == 5
    assert len(target.Shelf.all) == 4


@pytest.mark.parametrize(
    ("declare", "said"),
    [
        (lambda f: f.migrate("Bok"), "migrate Bok: the original metamodel has no type 'Bok' .did you mean 'Book'"),
        (lambda f: f.delete("Secton"), "delete Secton: .* no type 'Secton' .did you mean 'Section'"),
        (lambda f: f.retype("Bok", "Book"), "retype Bok to Book: .* no type 'Bok'"),
        (lambda f: f.migrate("Book", ignoring=["prise"]), "migrate Book: .* no feature 'prise' .* .did you mean 'price'"),
        (lambda f: f.delete_package("libary"), "delete package libary: .* no package 'libary' .did you mean 'library'"),
    ],
)
def test_a_rule_about_what_the_old_metamodel_does_not_have_is_refused(declare: Any, said: str) -> None:
    target = new("copy")
    f = Flock(library("Old"), target)
    declare(f)
    with pytest.raises(RuleError, match=said):
        f.run()
    assert list(target.all_contents()) == []


def test_a_lenient_migration_warns_of_what_the_old_metamodel_does_not_have() -> None:
    f = Flock(library("Old"), new("copy"), lenient=True)
    f.migrate("Bok")
    f.migrate("Book", ignoring=["pages"])
    f.delete("Section", strict=True, when=lambda o: False)
    f.delete_package("other::inner")
    f.run()
    assert f.warnings == [
        "Rule defined for migrating members of other::inner, but no package other::inner was found in the original metamodel.",
        "Rule defined for migrating instances of Bok, but no type Bok was found in the original metamodel.",
        "The pages property should be ignored, but there is no pages property defined for Book in the original metamodel.",
    ]


def test_a_type_that_the_new_metamodel_does_not_have_is_refused_before_anything_is_made() -> None:
    target = new("retype")
    f = Flock(library("Old"), target)
    f.retype("Comic", "Novl")
    with pytest.raises(RuleError, match=r"retype Comic to Novl: the new metamodel has no type 'Novl'.*did you mean 'Novel'"):
        f.run()
    assert list(target.all_contents()) == []
    abstract = Flock(library("Old"), target)
    abstract.retype("Comic", "Item")
    with pytest.raises(RuleError, match="no type 'Item' that can have elements"):
        abstract.run()


@pytest.mark.parametrize("what", ["rule", "guard of a rule", "guard of a mapping"])
def test_what_raises_is_named_with_element_line_and_cause(what: str) -> None:
    f = Flock(library("Old"), new("copy"))

    def raising(*_: Any) -> Any:
        return int("x")

    if what == "guard of a mapping":
        f.delete("Comic", when=raising)
    f.migrate("Comic", when=raising if what == "guard of a rule" else None)(raising if what == "rule" else lambda o, m: None)
    with pytest.raises(RuleError, match="invalid literal for int") as caught:
        f.run()
    text = str(caught.value)
    assert "test_flock.py:" in text
    assert "<Comic name='Zap'" in text
    assert ("delete Comic" if what == "guard of a mapping" else "migrate Comic") in text


def test_only_models_of_emf_are_migrated(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("a\n1\n", encoding="utf-8")
    with pytest.raises(UsageError, match="is no EMF model"):
        Flock(open_model(tmp_path / "a.csv"), new("copy"))


def test_roots_without_a_handle_are_taken() -> None:
    f = Flock(trace.Trace(texts=[trace.TextTrace(path="p")]), EmfModel((), [trace]))
    assert [x.path for x in f.run().all_of_kind("TextTrace")] == ["p"]
