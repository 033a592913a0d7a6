"""Three-way merge: what one side did is taken, what both did differently is a conflict, and nothing gets lost."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

import pytest

import robosmi
from robosmi.errors import ModelError
from robosmi.model import Session
from robosmi.model.comparison.comparison import ModelComparison
from robosmi.model.comparison.merged_lists import merged_members, merged_order, replaced_twice
from robosmi.model.comparison.merging import ModelMerge
from robosmi.model.emf import EmfModel
from robosmi.model.xmi.xmi_writer import to_xmi
from tests.model.random_edits import shuffled

LIBRARY = Path(__file__).parents[1] / "epsilon" / "eol"
SPLIT = Path(__file__).parent / "split"
MERGED = Path(__file__).parent / "merged"
Edit = Callable[[Any], None]
FILES = {
    "library": (LIBRARY / "library.xmi", LIBRARY / "library.ecore"),
    "graph": (SPLIT / "ok.xmi", SPLIT / "g.ecore"),
    "team": (MERGED / "team.xmi", MERGED / "team.ecore"),
}


def models(which: str = "library", number: int = 3) -> list[Any]:
    """The same model several times."""
    s = Session()
    path, metamodel = FILES[which]
    return [s.open_model(path, metamodel=metamodel) for _ in range(number)]


def text(model: Any) -> bytes:
    return to_xmi({"m.xmi": model.roots})["m.xmi"]


def merged(one: Edit, other: Edit, take: Literal["a", "b"] | None = None, which: str = "library") -> ModelMerge:
    base, a, b = models(which)
    one(a)
    other(b)
    return ModelMerge(base, a, b, take)


def named(model: Any, name: str) -> Any:
    return next(each for each in model.all_contents() if each.name == name)


def sets(name: str, feature: str, value: Any) -> Edit:
    return lambda model: setattr(named(model, name), feature, value)


def moves(name: str, to: str, feature: str) -> Edit:
    return lambda model: getattr(named(model, to), feature).append(named(model, name))


def deletes(name: str) -> Edit:
    return lambda model: model.delete(named(model, name))


def adds(to: str, feature: str, kind: str, **values: Any) -> Edit:
    return lambda model: getattr(named(model, to), feature).append(model.create(kind, **values))


def nothing(model: Any) -> None:
    """Leave a model as it is."""


def reorders(model: Any) -> None:
    sections = model.Library.all[0].sections
    sections.append(sections.pop(0))


def changes_tags(*tags: str) -> Edit:
    def edit(model: Any) -> None:
        book = named(model, "Propellers")
        book.tags.clear()
        book.tags.extend(tags)

    return edit


def links(edge: str, feature: str, node: str) -> Edit:
    return lambda model: setattr(named(model, edge), feature, named(model, node))


def adopts(mentor: str, pupil: str) -> Edit:
    return lambda model: setattr(named(model, mentor), "pupil", named(model, pupil))


def leads(name: str) -> Edit:
    return lambda model: setattr(named(model, "t"), "leader", model.create("Person", name=name))


def scores(*numbers: int) -> Edit:
    def edit(model: Any) -> None:
        held = named(model, "cy").scores
        held.clear()
        held.extend(numbers)

    return edit


INDEPENDENT: list[tuple[str, Edit, Edit]] = [
    ("library", sets("Propellers", "year", 2020), sets("Propellers", "name", "Rotors")),
    ("library", moves("Propellers", "Arms", "items"), sets("Propellers", "name", "Rotors")),
    ("library", deletes("Servo"), sets("Boards", "year", 1)),
    ("library", adds("Arms", "items", "Journal", name="J"), adds("Tech", "sections", "Section", name="S")),
    ("library", moves("Boards", "Arms", "items"), deletes("Servo")),
    ("library", lambda model: named(model, "Propellers").tags.remove("spin"),
     lambda model: named(model, "Propellers").tags.append("new")),
    ("library", reorders, sets("Propellers", "price", 3.5)),
    ("team", adopts("ann", "bo"), adopts("bo", "cy")),
    ("team", leads("x"), adds("t", "guests", "Person", name="y")),
    ("team", scores(5, 5, 5), sets("cy", "name", "di")),
    ("graph", links("e", "target", "n1"), sets("n1", "weight", 7)),
    ("graph", links("e", "target", "n1"), adds("a", "nodes", "Node", name="n3")),
]  # fmt: skip


@pytest.mark.parametrize(("which", "one", "other"), INDEPENDENT)
def test_independent_edits_are_both_in_the_merged_model_whoever_made_them(which: str, one: Edit, other: Edit) -> None:
    (both,) = models(which, 1)
    one(both)
    other(both)
    for first, second in ((one, other), (other, one)):
        found = merged(first, second, which=which)
        assert found.conflicts == []
        assert ModelComparison(both, found.model).lines() == []


@pytest.mark.parametrize(("which", "one", "other"), INDEPENDENT)
def test_the_same_edit_on_both_sides_is_no_conflict(which: str, one: Edit, other: Edit) -> None:
    for edit in (one, other):
        (once,) = models(which, 1)
        edit(once)
        found = merged(edit, edit, which=which)
        assert found.conflicts == []
        assert ModelComparison(once, found.model).lines() == []


CONFLICTS: list[tuple[str, Edit, Edit, tuple[str, str, str | None]]] = [
    ("library", sets("Propellers", "year", 1), sets("Propellers", "year", 2), ("changed", "Book Propellers", "year")),
    ("library", deletes("Propellers"), sets("Propellers", "year", 2), ("removed", "Book Propellers", None)),
    ("library", deletes("Propellers"), moves("Propellers", "Arms", "items"), ("removed", "Book Propellers", None)),
    ("library", deletes("Tech"), adds("Tech", "items", "Journal", name="J"), ("removed", "Section Tech", None)),
    ("library", moves("Boards", "Arms", "items"), moves("Boards", "Robots", "items"), ("moved", "Book Boards", None)),
    ("library", changes_tags("a", "spin"), changes_tags("b", "spin"), ("changed", "Book Propellers", "tags")),
    ("library", adds("Arms", "items", "Journal", name="J", year=8), adds("Arms", "items", "Journal", name="J", year=9),
     ("changed", "Journal J", "year")),
    ("graph", links("e", "target", "n1"), deletes("n1"), ("removed", "Node n1", None)),
    ("graph", sets("e", "target", None), links("e", "target", "n1"), ("changed", "Edge e", "target")),
    ("team", adopts("ann", "bo"), adopts("cy", "bo"), ("changed", "Person bo", "mentor")),
    ("team", leads("x"), leads("y"), ("changed", "Team t", "leader")),
    ("team", adds("t", "guests", "Person", name="x"), adds("t", "guests", "Person", name="y"), ("changed", "Team t", "guests")),
    ("team", scores(5, 5, 1), scores(2, 5, 5), ("changed", "Person cy", "scores")),
    ("team", scores(5, 9), scores(7, 8), ("changed", "Person cy", "scores")),
]  # fmt: skip


@pytest.mark.parametrize(("which", "one", "other", "expected"), CONFLICTS)
def test_what_both_changed_is_a_conflict_and_the_side_that_wins_has_its_edit(
    which: str, one: Edit, other: Edit, expected: tuple[str, str, str | None]
) -> None:
    for first, second in ((one, other), (other, one)):
        found = merged(first, second, which=which)
        assert [(each.kind, each.name, each.feature) for each in found.conflicts] == [expected]
        (finding,) = found.findings
        assert (finding.rule, finding.element, finding.severity.name) == ("RS660", found.conflicts[0].element, "error")
        with pytest.raises(ModelError) as caught:
            assert found.model
        assert caught.value.fix
        for take, edit in (("a", first), ("b", second)):
            (wanted,) = models(which, 1)
            edit(wanted)
            won = merged(first, second, take, which)  # type: ignore[arg-type]
            assert [each.severity.name for each in won.findings] == ["info"]
            assert ModelComparison(wanted, won.model).lines() == []


def test_models_with_conflicts_stay_as_they_are() -> None:
    base, a, b = models()
    sets("Propellers", "year", 1)(a)
    sets("Propellers", "year", 2)(b)
    sets("Boards", "year", 3)(b)
    before = text(a), text(b)
    found = ModelMerge(base, a, b)
    assert len(found.conflicts) == 1
    assert (text(a), text(b)) == before
    (conflict,) = found.conflicts
    assert (conflict.base, conflict.a, conflict.b) == (2016, 1, 2)
    assert conflict.element == "//@sections.0/@sections.0/@items.0"


def test_elements_that_would_contain_each_other_are_a_conflict() -> None:
    found = merged(moves("Robots", "Stories", "sections"), moves("Stories", "Robots", "sections"))
    assert [each.kind for each in found.conflicts] == ["moved"]
    for take, inner in (("a", "Robots"), ("b", "Stories")):
        won = merged(moves("Robots", "Stories", "sections"), moves("Stories", "Robots", "sections"), take)  # type: ignore[arg-type]
        assert named(won.model, inner).eContainer() is named(won.model, "Stories" if inner == "Robots" else "Robots")


def test_ids_find_what_was_renamed_and_moved_and_are_those_of_the_merged_model(tmp_path: Path) -> None:
    source = FILES["graph"][0].read_text()
    source = source.replace('<groups name="a">', '<groups xmi:id="g" name="a">')
    source = source.replace('<nodes name="n1"', '<nodes xmi:id="x" name="n1"').replace(
        '<nodes name="n2"', '<nodes xmi:id="y" name="n2"'
    )
    texts = {
        "base": source,
        "a": source.replace('name="n1" weight="1"', 'name="other" weight="1"'),
        "b": source.replace('weight="1"', 'weight="8"').replace("</groups>", '<nodes xmi:id="z" name="n3"/></groups>'),
    }
    for name, each in texts.items():
        (tmp_path / f"{name}.xmi").write_text(each)
    found = robosmi.merge(*(tmp_path / f"{name}.xmi" for name in texts), metamodel=FILES["graph"][1])
    found.model.save(tmp_path / "m.xmi")
    wanted = texts["b"].replace('name="n1" weight="8"', 'name="other" weight="8"')
    (tmp_path / "wanted.xmi").write_text(wanted)
    assert robosmi.compare(tmp_path / "m.xmi", tmp_path / "wanted.xmi", metamodel=FILES["graph"][1]).lines() == []
    assert 'xmi:id="z"' in (tmp_path / "m.xmi").read_text()


def test_metamodels_are_merged_as_models(tmp_path: Path) -> None:
    source = FILES["graph"][1].read_text()
    more = '<eClassifiers xsi:type="ecore:EClass" name="Label" eSuperTypes="#//Named"/></ecore:EPackage>'
    texts = [
        source,
        source.replace('name="weight"', 'name="cost"'),
        source.replace('name="groups" upper', 'name="groups" lowerBound="1" upper').replace("</ecore:EPackage>", more),
    ]
    for name, each in zip("oab", texts, strict=True):
        (tmp_path / f"{name}.ecore").write_text(each)
    found = robosmi.merge(*(tmp_path / f"{name}.ecore" for name in "oab"))
    assert found.conflicts == []
    found.model.save(tmp_path / "m.ecore")
    (tmp_path / "w.ecore").write_text(texts[2].replace('name="weight"', 'name="cost"'))
    assert robosmi.compare(tmp_path / "m.ecore", tmp_path / "w.ecore").lines() == []


def test_references_into_other_files_lead_where_they_led(tmp_path: Path) -> None:
    (tmp_path / "n.xmi").write_bytes(FILES["graph"][0].read_bytes())
    lines = {"base": "0", "a": "0", "b": "1"}
    for name, node in lines.items():
        (tmp_path / f"{name}.xmi").write_text(
            '<g:Group xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" xmlns:g="http://example.org/g" name="w">'
            f'<edges name="x"><source href="n.xmi#//@groups.0/@nodes.{node}"/></edges></g:Group>'
        )
    found = robosmi.merge(*(tmp_path / f"{name}.xmi" for name in lines), metamodel=FILES["graph"][1])
    found.model.save(tmp_path / "m.xmi")
    assert robosmi.compare(tmp_path / "m.xmi", tmp_path / "b.xmi", metamodel=FILES["graph"][1]).equal


def test_copies_of_a_metamodel_are_refused() -> None:
    base, a, b = (EmfModel.load(*FILES["library"]) for _ in range(3))
    with pytest.raises(ModelError) as caught:
        ModelMerge(base, a, b)
    assert caught.value.fix


@pytest.mark.parametrize("seed", range(15))
@pytest.mark.parametrize("which", FILES)
def test_a_side_without_edits_changes_nothing(which: str, seed: int) -> None:
    def edit(model: Any) -> None:
        number = random.Random(seed)
        for _ in range(1 + seed % 4):
            shuffled(model, number)

    (wanted,) = models(which, 1)
    edit(wanted)
    for first, second in ((edit, nothing), (nothing, edit)):
        found = merged(first, second, which=which)
        assert (found.conflicts, text(found.model)) == ([], text(wanted))


@pytest.mark.parametrize("seed", range(15))
@pytest.mark.parametrize("which", FILES)
def test_sides_are_alike_and_the_winner_has_no_conflict_with_the_merged_model(which: str, seed: int) -> None:
    found = []
    for take, order in (("a", (0, 1)), ("b", (1, 0))):
        base, *sides = models(which)
        numbers = [random.Random(seed), random.Random(seed + 1000)]
        for model, number in zip(sides, numbers, strict=True):
            for _ in range(3):
                shuffled(model, number)
        found.append(ModelMerge(base, sides[order[0]], sides[order[1]], take))  # type: ignore[arg-type]
    assert {(each.kind, each.name, each.feature) for each in found[0].conflicts} == {
        (each.kind, each.name, each.feature) for each in found[1].conflicts
    }
    assert len(list(found[0].model.all_contents())) == len(list(found[1].model.all_contents()))
    for each in found:
        to_xmi({"m.xmi": each.model.roots})


@pytest.mark.parametrize(
    ("base", "a", "b", "expected"),
    [
        ("abc", "abc", "cab", "cab"),
        ("abc", "axbc", "abyc", "axbyc"),
        ("abc", "abcx", "abcy", "abcxy"),
        ("abc", "xbc", "abc", "xbc"),
        ("abc", "cba", "ac", "ca"),
        ("abc", "cba", "bac", None),
        ("", "xy", "z", "xyz"),
    ],
)
def test_lists_are_merged_item_by_item(base: str, a: str, b: str, expected: str | None) -> None:
    found = merged_order(base, a, b, merged_members(base, a, b))
    assert found == (None if expected is None else list(expected))


def test_an_item_that_both_replaced_is_noticed() -> None:
    assert replaced_twice("abc", "xbc", "ybc")
    assert not replaced_twice("abc", "xbc", "xbc")
    assert not replaced_twice("abc", "bc", "bcx")


def test_a_conflict_has_the_line_of_its_element_in_the_first_file(tmp_path: Path) -> None:
    """Counted by features and places: `nodes` and `edges` mixed, a comment, a tag of two lines, several tags on a line."""
    text = """<g:Graph xmlns:g="http://example.org/g" name="{0}">
<!-- --><groups name="a"/><groups name="b">
<edges name="e"/>
<nodes name="n" weight="{1}"/><nodes name="m"/><edges
name="f"/>
<nodes
name="o" weight="{1}"/></groups></g:Graph>
"""
    files = [tmp_path / f"{name}.xmi" for name in ("base", "a", "b")]
    for file, values in zip(files, (("r", 1), ("s", 2), ("t", 3)), strict=True):
        file.write_text(text.format(*values))
    found = robosmi.merge(*files, metamodel=SPLIT / "g.ecore")
    lines = [
        (each.feature, finding.location and finding.location.line)
        for each, finding in zip(found.conflicts, found.findings, strict=True)
    ]
    assert sorted(lines) == [("name", 1), ("weight", 4), ("weight", 6)]


def test_a_model_that_is_given_and_not_read_has_no_lines() -> None:
    found = merged(lambda m: setattr(m.Node.all[0], "weight", 5), lambda m: setattr(m.Node.all[0], "weight", 7), which="graph")
    assert [finding.location and finding.location.line for finding in found.findings] == [None]
