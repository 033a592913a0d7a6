"""Comparison of two models: what is the same although it moved or was renamed, and that no difference is missed or made up."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import ModelError
from robosmi.model import Session
from robosmi.model.comparison.comparison import ModelComparison, compare
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.model.kitchen import FOLDER as XMI, kitchen
from tests.model.random_edits import shuffled

LIBRARY = Path(__file__).parents[1] / "epsilon" / "eol"
SPLIT = Path(__file__).parent / "split"


def two(path: Path = LIBRARY / "library.xmi", metamodel: Path = LIBRARY / "library.ecore") -> tuple[Any, Any]:
    """The same model twice."""
    s = Session()
    return s.open_model(path, metamodel=metamodel), s.open_model(path, metamodel=metamodel)


def told(found: ModelComparison) -> list[tuple[str, str, str | None]]:
    return [(change.kind, change.name, change.feature) for change in found.changes]


def book(model: Any, name: str) -> Any:
    return next(each for each in model.Item.all if each.name == name)


def section(model: Any, name: str) -> Any:
    return next(each for each in model.Section.all if each.name == name)


def rename(b: Any) -> None:
    book(b, "Propellers").name = "Rotors"


def change_values(b: Any) -> None:
    book(b, "Propellers").year = 2020
    book(b, "Propellers").price = 13.5
    book(b, "Propellers").tags.append("new")


def turn_reference(b: Any) -> None:
    book(b, "Boards").authors.pop()


def move_away(b: Any) -> None:
    section(b, "Arms").items.append(book(b, "Propellers"))


def move_and_change(b: Any) -> None:
    move_away(b)
    book(b, "Propellers").year = 1999


def remove_one(b: Any) -> None:
    b.delete(book(b, "Servo"))


def add_with_contents(b: Any) -> None:
    b.Library.all[0].sections.append(b.create("Section", name="New", items=[b.create("Journal", name="J")]))


def reorder(b: Any) -> None:
    sections = b.Library.all[0].sections
    first = sections[0]
    sections.remove(first)
    sections.append(first)


CASES: list[tuple[Callable[[Any], None], list[tuple[str, str, str | None]]]] = [
    (rename, [("changed", "Book Propellers", "name")]),
    (change_values, [("changed", "Book Propellers", feature) for feature in ("year", "price", "tags")]),
    (turn_reference, [("changed", "Book Boards", "authors")]),
    (move_away, [("moved", "Book Propellers", "items")]),
    (move_and_change, [("moved", "Book Propellers", "items"), ("changed", "Book Propellers", "year")]),
    (remove_one, [("removed", "Journal Servo", "items"), ("changed", "Member Mia", "borrowed")]),
    (add_with_contents, [("added", "Section New", "sections"), ("added", "Journal J", "items")]),
    (reorder, [("moved", "Section Tech", "sections")]),
]


@pytest.mark.parametrize(("edit", "expected"), CASES, ids=lambda case: getattr(case, "__name__", ""))
def test_an_edit_is_what_is_different(edit: Callable[[Any], None], expected: list[tuple[str, str, str | None]]) -> None:
    a, b = two()
    assert ModelComparison(a, b).equal
    edit(b)
    assert told(ModelComparison(a, b)) == expected
    kinds = {"added": "removed", "removed": "added"}
    back = ModelComparison(b, a)
    assert sorted(change.kind for change in back.changes) == sorted(kinds.get(kind, kind) for kind, *_ in expected)


def test_records_say_where_and_what() -> None:
    a, b = two()
    change_values(b)
    move_away(b)
    moved, year, price, tags = (change.to_json() for change in ModelComparison(a, b).changes)
    assert moved == {
        "kind": "moved", "element": "//@sections.0/@sections.0/@items.0", "type": "Book", "feature": "items",
        "before": "//@sections.0/@sections.0 items[0]", "after": "//@sections.0/@sections.0/@sections.0 items[0]",
        "name": "Book Propellers",
    }  # fmt: skip
    assert (year["before"], year["after"], price["before"], price["after"]) == (2016, 2020, 12.5, 13.5)
    assert (tags["before"], tags["after"]) == (["cogs", "spin"], ["cogs", "spin", "new"])


def test_the_side_of_an_opposite_that_follows_is_no_change_of_its_own() -> None:
    a, b = two(SPLIT / "ok.xmi", SPLIT / "g.ecore")
    b.Edge.all[0].target = b.Node.all[0]
    assert told(ModelComparison(a, b)) == [("changed", "Edge e", "target")]
    for model in (a, b):
        model.Edge.all[0].target = model.Node.all[0]
        model.Group.all[0].edges.append(model.create("Edge", name="f", source=model.Node.all[0]))
    edges = b.Node.all[0].out
    edges.append(edges.pop(0))
    assert told(ModelComparison(a, b)) == [("changed", "Node n1", "out")]


def test_an_id_counts_before_name_and_contents(tmp_path: Path) -> None:
    nodes = '<groups xmi:id="g"><nodes xmi:id="{}" name="n"/><nodes xmi:id="{}" name="m"/></groups>'
    text = (SPLIT / "ok.xmi").read_text()
    start, end = text.index("<groups"), text.index("</g:Graph>")
    for name, ids in (("a.xmi", ("x", "y")), ("b.xmi", ("y", "x"))):
        (tmp_path / name).write_text(text[:start] + nodes.format(*ids) + text[end:])
    found = compare(tmp_path / "a.xmi", tmp_path / "b.xmi", SPLIT / "g.ecore")
    assert [(c.kind, c.element, c.before, c.after) for c in found.changes if c.kind == "changed"] == [
        ("changed", "x", "n", "m"),
        ("changed", "y", "m", "n"),
    ]
    (tmp_path / "b.xmi").write_text((tmp_path / "b.xmi").read_text().replace('"x"', '"z"'))
    found = compare(tmp_path / "a.xmi", tmp_path / "b.xmi", SPLIT / "g.ecore")
    assert {(c.kind, c.element) for c in found.changes} >= {("removed", "x"), ("added", "z")}


def test_metamodels_are_compared_as_models(tmp_path: Path) -> None:
    text = (SPLIT / "g.ecore").read_text()
    (tmp_path / "g.ecore").write_text(
        text.replace('name="weight"', 'name="cost"').replace('name="groups" upper', 'name="groups" lowerBound="1" upper')
    )
    found = robosmi.compare(SPLIT / "g.ecore", tmp_path / "g.ecore")
    assert [(c.element, c.feature, c.before, c.after) for c in found.changes] == [
        ("//Graph/groups", "lowerBound", 0, 1),
        ("//Node/weight", "name", "weight", "cost"),
    ]


def test_two_copies_of_a_metamodel_are_the_same_metamodel() -> None:
    a, b = (EmfModel.load(LIBRARY / "library.xmi", LIBRARY / "library.ecore") for _ in "ab")
    assert type(a.roots[0]) is not type(b.roots[0])
    assert compare(a, b).equal


def test_forms_of_files_make_no_difference(tmp_path: Path) -> None:
    EmfModel.load(LIBRARY / "library.xmi", LIBRARY / "library.ecore").save(tmp_path / "l.json")
    assert robosmi.compare(LIBRARY / "library.xmi", tmp_path / "l.json", metamodel=LIBRARY / "library.ecore").equal


def test_references_into_other_files_are_compared_by_where_they_lead(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        s = Session()
        (tmp_path / name / "n.xmi").write_bytes((SPLIT / "ok.xmi").read_bytes())
        nodes: Any = s.open_model(tmp_path / name / "n.xmi", metamodel=SPLIT / "g.ecore")
        edges = EmfModel((), s.metamodel(SPLIT / "g.ecore"), path=tmp_path / name / "e.xmi")
        edges.create("Edge", name="far", source=nodes.Node.all[0])
        edges.save()
    places = tmp_path / "one" / "e.xmi", tmp_path / "two" / "e.xmi"
    assert compare(*places, SPLIT / "g.ecore").equal
    places[1].write_text(places[1].read_text().replace("@nodes.0", "@nodes.1"))
    (change,) = compare(*places, SPLIT / "g.ecore").changes
    assert (change.before, change.after) == ("n.xmi#//@groups.0/@nodes.0", "n.xmi#//@groups.0/@nodes.1")


def test_what_cannot_be_compared_is_refused() -> None:
    with pytest.raises(ModelError, match="different metamodels") as caught:
        compare(LIBRARY / "library.xmi", SPLIT / "ok.xmi", Metamodel.load(LIBRARY / "library.ecore", SPLIT / "g.ecore"))
    assert caught.value.location is not None
    assert caught.value.fix
    rows = Path(__file__).parent / "drivers" / "cases" / "rows"
    with pytest.raises(ModelError, match="no metamodel"):
        compare(rows, rows)


def test_of_many_alike_only_those_differ_that_were_edited() -> None:
    mm = Metamodel.load(SPLIT / "g.ecore")
    a, b = (EmfModel(mm.Graph(groups=[mm.Group(nodes=[mm.Node(weight=n % 7) for n in range(3000)])])) for _ in "ab")
    nodes = b.roots[0].groups[0].nodes
    nodes[1500].weight = 99
    nodes.insert(700, mm.Node(weight=4))
    assert [(c.kind, c.feature) for c in ModelComparison(a, b).changes] == [("changed", "weight"), ("added", "nodes")]


# --- no difference is missed, and none is made up


@pytest.mark.emf_writes_otherwise("EMF forgets a nil, and gives up where one side of an opposite is given")
def test_files_of_every_kind_of_value_are_equal_to_themselves_alone() -> None:
    models = [EmfModel.load(path, kitchen()) for path in sorted((XMI / "good").glob("*.xmi"))]
    texts = [to_xmi({"m.xmi": model.roots})["m.xmi"] for model in models]
    equal = [(i, j) for i, a in enumerate(models) for j, b in enumerate(models) if ModelComparison(a, b).equal]
    assert equal == [(i, j) for i, one in enumerate(texts) for j, other in enumerate(texts) if one == other]
    assert len(equal) > len(models)


@pytest.mark.parametrize("seed", range(40))
@pytest.mark.parametrize("which", ["library", "graph"])
def test_models_are_equal_if_and_only_if_their_files_are(which: str, seed: int) -> None:
    paths = (LIBRARY / "library.xmi", LIBRARY / "library.ecore") if which == "library" else (SPLIT / "ok.xmi", SPLIT / "g.ecore")
    number = random.Random(seed)
    a, b = two(*paths)
    for _ in range(number.randrange(4)):
        shuffled(b, number)
    texts = [to_xmi({"m.xmi": model.roots})["m.xmi"] for model in (a, b)]
    found, back = ModelComparison(a, b), ModelComparison(b, a)
    assert found.equal == back.equal == (texts[0] == texts[1])
    assert len(found.lines()) <= len(found.changes)


def test_one_unread_file_is_the_same_from_two_folders(tmp_path: Path) -> None:
    text = (SPLIT / "w.xmi").read_text()
    hrefs = {"a/w.xmi": "../lib/gone.xmi", "b/c/w.xmi": "../../lib/gone.xmi", "b/d.xmi": "gone.xmi", "e/d.xmi": "gone.xmi"}
    hrefs["f.xmi"] = (tmp_path / "lib" / "gone.xmi").as_uri()
    for name, href in hrefs.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text.replace("ok.xmi", href))

    def changes(one: str, other: str) -> list[tuple[str, Any, Any]]:
        found = compare(tmp_path / one, tmp_path / other, SPLIT / "g.ecore").changes
        return [(change.kind, change.before, change.after) for change in found]

    assert [changes("a/w.xmi", other) for other in ("b/c/w.xmi", "f.xmi")] == [[], []]
    assert changes("b/d.xmi", "e/d.xmi") == [], "the same text, as in a copy of the folder"
    fragment = "#//@groups.0/@nodes.1"
    assert changes("a/w.xmi", "b/d.xmi") == [("changed", f"../lib/gone.xmi{fragment}", f"gone.xmi{fragment}")]
    merged = robosmi.merge(*(tmp_path / name for name in ("a/w.xmi", "b/c/w.xmi", "b/d.xmi")), metamodel=SPLIT / "g.ecore")
    assert merged.conflicts == []
