"""Two loads of one metamodel have different types: mixing them is an error that says how to use one load for both."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.errors import RuleError
from robosmi.model import Session
from robosmi.model.elements.driver import class_of
from robosmi.model.elements.feature_errors import FeatureValueError
from robosmi.model.emf import EmfModel
from robosmi.query import ModelView
from robosmi.transform import ETL
from robosmi.validate import EVL
from tests.library import EPSILON, LIBRARY, empty, library

GRAPH = EPSILON / "cases" / "models" / "graph.ecore"


def moved(one: Any, other: Any) -> None:
    """Append an element of the other load to a list."""
    one.Graph().nodes.append(other.Node(label="n"))


def extended(one: Any, other: Any) -> None:
    """Extend a list by an element of each load."""
    one.Graph().nodes.extend([one.Node(), other.Node(label="n")])


def assigned(one: Any, other: Any) -> None:
    """Set a reference to an element of the other load."""
    one.Edge().source = other.Node(label="n")


def made(one: Any, other: Any) -> None:
    """Create an element with a reference to one of the other load."""
    one.Edge(source=other.Node(label="n"))


def literal(one: Any, other: Any) -> None:
    """Set an attribute to an enumeration literal of the other load."""
    one.Node().shape = other.Shape.star


@pytest.mark.parametrize("mixed", [moved, extended, assigned, made, literal])
def test_an_element_of_another_load_is_refused_with_what_to_do(mixed: Any) -> None:
    with pytest.raises(FeatureValueError, match=r"is that of another load of the metamodel 'http://robosmi/test/graph'") as told:
        mixed(empty("graph", "A"), empty("graph", "B"))
    assert "Session" in str(told.value.fix)


def test_a_value_of_a_wrong_kind_is_told_in_plain_words_whichever_way_it_is_given() -> None:
    graph = empty("graph", "A")
    with pytest.raises(FeatureValueError, match=r"^Graph\.nodes does not take 'x': it takes Node, not str$"):
        graph.Graph().nodes.append("x")
    with pytest.raises(FeatureValueError, match=r"^Node\.label does not take 3: it takes EString, not int$"):
        graph.Node().label = 3
    with pytest.raises(FeatureValueError, match=r"it takes Node, not Edge$"):
        graph.Graph().nodes.append(graph.Edge())
    with pytest.raises(FeatureValueError, match=r"^Graph\.nodes does not take .*: it takes many values\n") as told:
        graph.Graph().nodes = graph.Node()
    assert told.value.fix == "use nodes.append(value), nodes.extend(values) or clear()"


@pytest.mark.parametrize("side", ["source", "target"])
def test_a_rule_about_a_class_of_another_load_is_refused(side: str) -> None:
    L, G = library("L"), empty("graph", "G")
    other_l, other_g = library("L2"), empty("graph", "G2")
    source = class_of((other_l if side == "source" else L).type_named("Book"))
    target = class_of((other_g if side == "target" else G).type_named("Node"))
    t = ETL(L, G)

    @t.rule(source, to=[target])
    def B(b: Any, n: Any) -> None:
        n.label = b.name

    name, model = ("Book", "L") if side == "source" else ("Node", "G")
    said = f"the rule B is about {name} of another load of the metamodel that the model {model} has"
    with pytest.raises(RuleError, match=said) as told:
        t.run()
    assert told.value.location is not None
    assert told.value.location.path.endswith("test_two_loads.py")


def test_models_of_one_session_are_no_strangers(tmp_path: Path) -> None:
    session = Session()
    first, second = (session.open_model(LIBRARY / "library.xmi", metamodel=LIBRARY / "library.ecore", name=n) for n in "AB")
    t = ETL(first, ModelView(EmfModel((), GRAPH, "G")))

    @t.rule(class_of(second.Book.kind), to=["Node"])
    def B(b: Any, n: Any) -> None:
        n.label = b.name

    assert len(t.run().links) == len([b for b in first.Book.all if b.__class__ is class_of(first.Book.kind)])


def test_a_model_is_made_of_the_path_of_its_metamodel() -> None:
    graph = ModelView(EmfModel((), str(GRAPH), "G"))
    assert graph.Node(label="n").label == "n"


@pytest.mark.parametrize("form", ["type of a model", "class"])
def test_a_context_of_another_load_is_refused(form: str) -> None:
    L, other = library("L"), library("L2")
    v = EVL(L)
    kind = other.Book if form == "type of a model" else class_of(other.type_named("Book"))

    @v.context(kind).constraint
    def Known(b: Any) -> bool:
        return False

    with pytest.raises(RuleError, match="the context Book is about another load of the metamodel that the model L has") as told:
        v.run()
    assert "Session" in str(told.value.fix)
    assert len(v.run(other).unsatisfied) > 0
