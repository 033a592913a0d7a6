"""`Metamodel.load`: any .ecore as strict dynamic classes; several files, odd names, orders of supertypes that Python refuses."""

from __future__ import annotations

from pathlib import Path

import pytest
from pyecore.ecore import EClass, EPackage
from pyecore.resources import URI, ResourceSet

from robosmi import resources
from robosmi.errors import ModelError, SourceError, UsageError
from robosmi.metamodels import hardware
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.strict import Element
from robosmi.model.emf import EmfModel
from robosmi.model.plantuml import to_plantuml

CASES = Path(__file__).parent / "metamodels"
SHELF = Path(__file__).parent / "drivers" / "cases" / "emf" / "shelf.ecore"
OWN = sorted(resources.built_in("metamodels").glob("*.ecore"))


def test_dynamic_classes_are_strict() -> None:
    mm = Metamodel.load(SHELF)
    book = mm.Book(name="Gears", pages=3)
    assert isinstance(book, Element)
    assert book.genre is mm.Genre.fiction  # type: ignore[attr-defined]
    for attempt, said in (
        (lambda: mm.Book(nmae="x"), "did you mean 'name'"),
        (lambda: setattr(book, "page", 3), "did you mean 'pages'"),
        (lambda: book.titel, "Book has no feature 'titel'"),  # type: ignore[attr-defined]
        (lambda: setattr(book, "pages", "many"), "does not take 'many'"),
        (lambda: setattr(book, "genre", "fiction"), "takes a literal of Genre"),
        (lambda: mm.Named(), "is abstract"),
        (lambda: mm.Boook, "did you mean 'Book'"),
        (lambda: mm.literal("Genre#poetry"), "there is no type 'Genre#poetry'"),
    ):
        with pytest.raises(ModelError, match=said):
            attempt()


def test_two_loads_of_one_file_never_mix() -> None:
    first, second = Metamodel.load(SHELF), Metamodel.load(SHELF)
    assert first.Book is not second.Book
    assert not isinstance(first.Book(), second.Book)
    with pytest.raises(TypeError):
        first.Shelf(books=[second.Book()])


@pytest.mark.parametrize("path", OWN, ids=lambda path: path.stem)
def test_pyecore_reads_the_same_from_our_own_metamodels(path: Path) -> None:
    ours = Metamodel.load(path).epackages[0]
    theirs = ResourceSet().get_resource(URI(str(path))).contents[0]

    def said(package: EPackage) -> list[object]:
        found: list[object] = [package.name, package.nsURI, package.nsPrefix]
        for c in package.eClassifiers:
            if isinstance(c, EClass):
                features = [
                    (
                        f.name, f.eType.name, f.lowerBound, f.upperBound, f.ordered, f.unique, f.derived, f.transient,
                        f.is_reference and f.containment, f.is_reference and f.eOpposite and f.eOpposite.name,
                        f.is_attribute and str(f.get_default_value()),
                    )
                    for f in c.eStructuralFeatures
                ]  # fmt: skip
                found.append((c.name, c.abstract, [s.name for s in c.eSuperTypes], features))
            else:
                found.append((c.name, [(x.name, x.value) for x in c.eLiterals]))
        return found

    assert said(ours) == said(theirs)


def test_several_files_and_sub_packages_are_one_metamodel() -> None:
    mm = Metamodel.load(CASES / "garden.ecore")
    assert mm.find("garden::tools::Spade") is mm.find("Spade")
    assert [p.name for p in mm.epackages] == ["garden", "common"]
    assert getattr(mm.get("http://example.org/garden/tools"), "name", "") == "tools"
    bed = mm.Bed(name="b", tools=[mm.Spade(name="s")])
    assert bed.tools[0].bed is bed
    model = EmfModel(bed, mm)
    assert [x.name for x in model["common::Named"].all] == ["b", "s"]
    assert model["garden::tools::Spade"].all == list(bed.tools)


def test_supertypes_in_an_order_that_python_refuses_are_taken() -> None:
    mm = Metamodel.load(CASES / "orders.ecore")
    both = mm.Both(left="l", right="r", top="t")
    assert (both.left, both.right, both.top) == ("l", "r", "t")
    assert isinstance(both, mm.LeftRight)
    assert isinstance(both, mm.RightLeft)
    model = EmfModel([both, mm.Left()], mm)
    assert [type(x).__name__ for x in model.Left.all] == ["Both", "Left"]
    assert mm.Again(top="x").top == "x"  # a supertype and its own supertype


def test_names_that_python_and_pyecore_need_are_taken() -> None:
    mm = Metamodel.load(CASES / "names.ecore")
    odd = getattr(mm, "class")(**{"from": "a"})
    assert odd.from_ == "a"
    assert getattr(odd, "from") == "a"
    odd.delete_ = "d"
    odd.name = "n"
    model = EmfModel(odd, mm)
    assert id(model.element("/")) == id(odd)
    assert odd.kind is mm.Kind.eLiterals[0]
    assert [literal.name for literal in mm.Kind.eLiterals] == ["name", "eLiterals", "if"]
    assert mm.literal("Kind#name").value == 0
    model.delete(odd)
    assert model.roots == []


def test_data_types_keep_their_defaults() -> None:
    mm = Metamodel.load(CASES / "names.ecore")
    odd = getattr(mm, "class")()
    assert (odd.count, odd.big, odd.thing, odd.flag, odd.ratio) == (7, None, None, True, 0.5)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("", "not well-formed"),
        ("<a/>", "no EPackage"),
        ("<!DOCTYPE a [<!ENTITY b 'c'>]><a/>", "DOCTYPE"),
        ('<eClassifiers xsi:type="ecore:EClass" name="A" eSuperTypes="#//A"/>', "its own supertype"),
        ('<eClassifiers xsi:type="ecore:EClass" name="A" eSuperTypes="#//B"/>', "'#//B' leads to nothing"),
    ],
)
def test_a_damaged_metamodel_is_refused_with_its_place(content: str, said: str, tmp_path: Path) -> None:
    file = tmp_path / "bad.ecore"
    if content.startswith("<eC"):
        content = (
            '<ecore:EPackage xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" '
            f'xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" name="p" nsURI="u" nsPrefix="p">{content}</ecore:EPackage>'
        )
    file.write_text(content)
    with pytest.raises((ModelError, SourceError), match=said) as caught:
        Metamodel.load(file)
    assert caught.value.location is not None
    assert caught.value.fix


def test_a_metamodel_can_be_shown() -> None:
    mm = Metamodel.load(SHELF)
    assert repr(mm) == "<Metamodel shelf: 7 types>"
    assert "shelf::Book" in mm._repr_html_()
    diagram = to_plantuml(mm)
    assert 'abstract class "shelf.Named" {' in diagram
    assert '"shelf.Shelf" *--> "0..*" "shelf.Book" : books' in diagram
    assert '"shelf.Book" <|-- "shelf.Comic"' in diagram
    assert 'enum "shelf.Genre" {' in diagram
    assert diagram.startswith("@startuml\n")
    assert diagram.endswith("@enduml\n")


def test_an_object_diagram_shows_containment_once_and_says_what_it_leaves_out() -> None:
    model = EmfModel.load(SHELF.with_suffix(".xmi"), SHELF)
    diagram = to_plantuml(model)
    assert diagram.count("o1 *-- o4") == 1
    assert "o1 --> o6 : newest" in diagram
    assert "o4 --> o1" not in diagram
    assert "6 more elements are not shown" in to_plantuml(model, limit=2)


def test_a_default_is_any_text_that_emf_takes() -> None:
    data = Metamodel.load(Path(__file__).parent / "generator" / "cases" / "data_types" / "data.ecore")
    assert data.Account().real == 1.5  # "1.5f" in the file


def test_a_metamodel_of_what_is_no_list_of_packages_is_told_what_to_write() -> None:
    with pytest.raises(UsageError, match=r"do: write: Metamodel\(\[PACKAGE\]\)"):
        Metamodel(hardware)  # type: ignore[arg-type]
    with pytest.raises(UsageError, match=r"do: read the file: Metamodel\.load\(PATH\)"):
        Metamodel("shelf.ecore")  # type: ignore[arg-type]


def test_files_and_packages_are_one_metamodel() -> None:
    shelf, garden = Metamodel.load(SHELF), Metamodel.load(CASES / "garden.ecore")
    assert sorted(Metamodel.of([*shelf.packages, CASES / "garden.ecore"]).names()) == sorted([*shelf.names(), *garden.names()])
    assert Metamodel.of([str(SHELF)]).names() == shelf.names()
