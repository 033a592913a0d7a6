"""New elements take their values by the names of features; anything else is told with what to write, not by a bare TypeError."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pyecore.ecore import EAttribute, EClass, EPackage, EString

from robosmi.errors import ModelError
from robosmi.metamodels import ccode
from robosmi.model.ecore.metamodel import Metamodel
from robosmi.model.elements.feature_errors import FeatureValueError
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView, create

GRAPH = Metamodel.load(Path(__file__).parents[1] / "epsilon" / "cases" / "models" / "graph.ecore")


def graph() -> Any:
    return ModelView(EmfModel((), GRAPH, "G"))


in_no_model: Any = create


def made_in_pyecore() -> Any:
    """A class that was made in pyecore, whose own classes drop such values without a word, and which a model has made strict."""
    kind = EClass("Kind")
    kind.eStructuralFeatures.append(EAttribute("name", EString))
    package = EPackage("own", "http://example.org/own", "own")
    package.eClassifiers.append(kind)
    EmfModel((), [package])
    return kind


@pytest.mark.parametrize(
    ("make", "fix"),
    [
        (lambda: graph().Node("x"), "write Node(label='x'); its features: incoming, label, outgoing"),
        (lambda: graph().create("Node", "x"), "write Node(label='x'); its features: incoming, label, outgoing"),
        (lambda: graph().create(graph().Node, "x"), "write Node(label='x'); its features: incoming, label, outgoing"),
        (lambda: graph().model.create("Node", "x"), "write Node(label='x'); its features: incoming, label, outgoing"),
        (lambda: in_no_model(GRAPH.Node, "x"), "write Node(label='x'); its features: incoming, label, outgoing"),
        (lambda: GRAPH.Node("x"), "write Node(label='x'); its features: incoming, label, outgoing"),
        (lambda: ccode.ExpressionStatement("x"), "write ExpressionStatement(FEATURE='x'); its features: "),  # type: ignore[call-arg, arg-type]
        (lambda: ccode.Function("f", line=3), "write Function(name='f'); its features: "),  # type: ignore[call-arg, arg-type]
        (lambda: made_in_pyecore()("x"), "write Kind(name='x'); its features: name"),
        (lambda: ModelView(EmfModel((), Metamodel.ecore())).EClass("X"), "write EClass(name='X'); its features: abstract, "),
    ],
)
def test_a_value_without_the_name_of_its_feature_is_told_with_the_likely_one(make: Callable[[], Any], fix: str) -> None:
    with pytest.raises(FeatureValueError, match="takes values by the names of its features") as told:
        make()
    assert str(told.value.fix).startswith(fix)


@pytest.mark.parametrize("values", [("star",), ()])
def test_an_enumeration_is_told_to_make_no_elements(values: tuple[str, ...]) -> None:
    with pytest.raises(ModelError, match="Shape is an enumeration") as told:
        graph().Shape(*values)
    with pytest.raises(ModelError, match="Shape is an enumeration"):
        graph().create(graph().Shape, *values)
    assert told.value.fix == "use one of its literals: Shape.box, Shape.round, Shape.star"


@pytest.mark.parametrize("roots", [GRAPH, "x.xmi", Path("x.xmi"), [GRAPH], [GRAPH.Node], 3, None])
def test_a_model_of_anything_but_elements_is_told_what_it_takes(roots: Any) -> None:
    with pytest.raises(ModelError, match="a model is made of root elements, not of") as told:
        EmfModel(roots, GRAPH)
    assert "EmfModel.load(path, metamodel)" in str(told.value.fix)
    assert "EmfModel((), metamodel)" in str(told.value.fix)
