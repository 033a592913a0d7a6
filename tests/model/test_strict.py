"""Elements refuse what their metamodel does not know, say what was meant, and stay pyecore's own EObjects."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from pyecore.ecore import EObject

from robosmi.errors import ModelError
from robosmi.metamodels import ccode, hardware
from robosmi.model.elements.strict import FeatureValueError, UnknownFeatureError


def assign(name: str, value: Any) -> Callable[[], None]:
    """Assign a feature of a function."""
    return lambda: setattr(ccode.Function(name="f"), name, value)


def make(**features: Any) -> Callable[[], Any]:
    """Make a function with these features."""
    return lambda: ccode.Function(**features)


@pytest.mark.parametrize(
    ("attempt", "said"),
    [
        (make(nmae="f"), "Function has no feature 'nmae' (did you mean 'name'?)"),
        (assign("sigature", "f()"), "Function has no feature 'sigature' (did you mean 'signature'?)"),
        (lambda: ccode.Function().sigature, "Function has no feature 'sigature' (did you mean 'signature'?)"),  # type: ignore[attr-defined]
        (lambda: hardware.Net().conectors, "Net has no feature 'conectors' (did you mean 'connectors'?)"),  # type: ignore[attr-defined]
    ],
)
def test_a_misspelt_feature_fails_and_names_the_nearest(attempt: Callable[[], Any], said: str) -> None:
    with pytest.raises(UnknownFeatureError) as caught:
        attempt()
    assert caught.value.message == said
    assert isinstance(caught.value, AttributeError)
    assert caught.value.fix
    assert "name" in caught.value.fix or "circuit" in caught.value.fix


@pytest.mark.parametrize("attempt", [make(storage="staticStorage"), assign("storage", "staticStorage")])
def test_a_text_is_no_literal_and_the_literals_are_named(attempt: Callable[[], Any]) -> None:
    with pytest.raises(FeatureValueError, match="takes a literal of Storage, not the text") as caught:
        attempt()
    assert "Storage.staticStorage" in (caught.value.fix or "")


@pytest.mark.parametrize(
    "attempt",
    [
        make(line="3"),
        assign("line", "3"),
        make(line=3.5),
        make(name=3),
        assign("name", b"f"),
        make(definition="yes"),
        make(storage=hardware.Role.Board),
        make(body=hardware.Net()),
        assign("body", hardware.Net()),
        make(body="{}"),
        lambda: ccode.Macro(parameters="abc"),
        lambda: ccode.Macro(parameters=["a", 3]),  # type: ignore[list-item]
    ],
)
def test_a_value_of_another_type_fails(attempt: Callable[[], Any]) -> None:
    with pytest.raises(FeatureValueError) as caught:
        attempt()
    assert isinstance(caught.value, ModelError)
    assert isinstance(caught.value, TypeError)


@pytest.mark.parametrize(
    "attempt",
    [
        lambda: ccode.SourceUnit(declarations=[hardware.Net()]),  # type: ignore[list-item]
        lambda: ccode.SourceUnit().declarations.append(hardware.Net()),  # type: ignore[arg-type]
        lambda: ccode.SourceUnit(declarations=["f"]),  # type: ignore[list-item]
    ],
)
def test_an_element_of_another_class_does_not_enter_a_collection(attempt: Callable[[], Any]) -> None:
    with pytest.raises(TypeError):
        attempt()


def test_an_abstract_class_has_no_elements() -> None:
    with pytest.raises(TypeError, match="abstract"):
        ccode.Declaration(name="x")


def test_elements_are_pyecore_objects() -> None:
    function = ccode.Function(name="f", line=3)
    assert isinstance(function, EObject)
    assert isinstance(function, ccode.Located)
    assert function.eClass.name == "Function"
    assert function.eGet("line") == 3
    assert function.eIsSet("line")
    assert not function.eIsSet("column")
    function.eSet("column", 4)
    assert function.column == 4


def test_a_wrong_value_leaves_the_old_one() -> None:
    function = ccode.Function(name="f", line=3)
    with pytest.raises(FeatureValueError):
        function.line = "4"  # type: ignore[assignment]
    assert function.line == 3


def test_features_that_were_not_given_have_their_defaults() -> None:
    function = ccode.Function()
    assert (function.name, function.line, function.body) == ("", 0, None)
    assert function.storage is ccode.Storage.unspecified
    assert list(function.parameters) == []
    assert ccode.SourceUnit().path is None  # required: there is nothing to fall back on


def test_an_element_says_what_it_is() -> None:
    assert repr(ccode.Function(name="f", line=3)) == "<Function name='f' line=3>"
