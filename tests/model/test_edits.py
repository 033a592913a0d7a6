"""Edits that look right take effect or are refused: loops over what they change, containers given to constructors."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import ModelError
from robosmi.model import EmfModel, Metamodel, Session
from robosmi.model.ecore.ecore_lint import lint
from robosmi.model.ecore.ecore_loader import load_metamodels

SPLIT = Path(__file__).parent / "split"


@pytest.fixture
def graph() -> EmfModel:
    """A graph with a group of two nodes and an edge."""
    return EmfModel.load(SPLIT / "ok.xmi", SPLIT / "g.ecore")


def test_a_loop_over_values_may_change_them(graph: EmfModel) -> None:
    group = graph.Group.all[0]
    for node in group.nodes:
        group.nodes.remove(node)
    assert (list(group.nodes), graph.Node.all) == ([], [])


def test_a_container_given_to_a_constructor_contains_the_element(graph: EmfModel) -> None:
    group = graph.Group.all[0]
    before = list(graph.all_contents())
    made = graph.Node(name="z", group=group)
    assert (made.eContainer(), group.nodes[-1], graph.Node.all[-1]) == (group, made, made)
    assert graph.roots == [before[0]]
    assert len(list(graph.all_contents())) == len(before) + 1


@pytest.mark.parametrize("wrong", [{"nmae": "z"}, {"weight": "heavy"}, {"out": [3]}, {"out": None, "into": "x"}])
def test_a_constructor_that_fails_leaves_nothing_behind(graph: EmfModel, wrong: dict[str, Any]) -> None:
    group, edge = graph.Group.all[0], graph.Edge.all[0]
    before = list(graph.all_contents()), edge.source
    with pytest.raises(ModelError):
        graph.Node(name="z", group=group, **wrong)
    with pytest.raises(ModelError):
        graph.Node(**{"out": [edge], "group": group, **wrong, "weight": "heavy"})
    assert list(graph.all_contents()) == before[0]
    assert edge.source in (before[1], None)


def test_two_metamodels_with_one_namespace_are_refused_in_one_call(tmp_path: Path) -> None:
    second = tmp_path / "g2.ecore"
    second.write_text((SPLIT / "g.ecore").read_text().replace('"weight"', '"cost"'))
    with pytest.raises(ModelError, match="has the namespace") as refused:
        Metamodel.load(SPLIT / "g.ecore", second)
    assert str(refused.value.location) == f"{second}:2"
    assert Metamodel.load(SPLIT / "g.ecore", SPLIT / "g.ecore").names() == Metamodel.load(second).names()
    s = Session()
    with pytest.raises(ModelError, match="has the namespace"):
        s.metamodel(SPLIT / "g.ecore", second)
    assert s.metamodel(SPLIT / "g.ecore").Node is not s.metamodel(second).Node


def test_an_opposite_of_one_side_is_a_finding(tmp_path: Path) -> None:
    one = tmp_path / "one.ecore"
    one.write_text((SPLIT / "g.ecore").read_text().replace(' eOpposite="#//Edge/source"', ""))
    assert [finding.rule for finding in lint(one, load_metamodels([one]))] == ["RS607"]


def test_elements_of_one_name_are_findings_once() -> None:
    path = Path(__file__).parent / "several" / "same_names.ecore"
    found = Metamodel.load(path).findings
    assert [(each.location.line, each.element) for each in found if each.location is not None] == [
        (6, "n.A.x"),
        (8, "n.B"),
        (9, "n.C.x"),
    ]
    assert {each.rule for each in found} == {"RS607"}
