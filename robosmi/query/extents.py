"""Extents: which elements a model holds, in EMF's pre-order (an element before its contents, features in order).

pyecore's own `eAllContents` gives all children before it descends, and its `allInstances` mixes all models of the
process; neither is used. A root is any element, whose extent is the element itself and all it contains, or a model handle
(anything with `all_contents`). Extents are walked anew each time, so they are never out of date. Nothing recurses.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeVar, overload

from robosmi.query.collections import Q
from robosmi.query.types import matching

T = TypeVar("T")


def all_contents(root: Any) -> Iterator[Any]:
    """The root and everything it contains, in containment pre-order; of a model handle all its elements."""
    if hasattr(type(root), "all_contents"):
        yield from root.all_contents()
        return
    stack = [root]
    while stack:
        element = stack.pop()
        yield element
        stack.extend(reversed(contents(element)))


@overload
def all_of_kind(root: Any, kind: type[T]) -> Q[T]: ...
@overload
def all_of_kind(root: Any, kind: Any) -> Q[Any]: ...
def all_of_kind(root: Any, kind: Any) -> Q[Any]:
    """The elements in the extent that are instances of the class or a subclass (EOL `T.all`, `T.allOfKind`).

    Args:
        root: an element or a model handle.
        kind: a class, an EClass, or a type's name.
    """
    return Q._of(matching(all_contents(root), kind))


@overload
def all_of_type(root: Any, kind: type[T]) -> Q[T]: ...
@overload
def all_of_type(root: Any, kind: Any) -> Q[Any]: ...
def all_of_type(root: Any, kind: Any) -> Q[Any]:
    """The elements in the extent that are instances of exactly that class (EOL `T.allOfType`).

    Args:
        root: an element or a model handle.
        kind: a class, an EClass, or a type's name.
    """
    return Q._of(matching(all_contents(root), kind, exact=True))


def ancestor_of_kind(element: Any, kind: type[T]) -> T | None:
    """The nearest container of the element that is of that kind, or None; the element itself does not count."""
    container = element.eContainer()
    while container is not None and not isinstance(container, kind):
        container = container.eContainer()
    return container


def root_of(element: Any) -> Any:
    """The outermost container of the element, or the element itself."""
    while (container := element.eContainer()) is not None:
        element = container
    return element


_CONTAINMENTS: dict[Any, list[tuple[str, bool]]] = {}


def contents(element: Any) -> list[Any]:
    """What the element contains directly, features of supertypes first."""
    eclass = element.eClass
    features = _CONTAINMENTS.get(eclass)
    if features is None:
        features = _CONTAINMENTS[eclass] = [(f.name, f.many) for f in _ordered(eclass) if getattr(f, "containment", False)]
    slots = element.__dict__
    found: list[Any] = []
    for name, many in features:
        if name in slots:  # a slot that was never touched is empty
            if many:
                found.extend(slots[name])
            elif (value := slots[name]._get()) is not None:
                found.append(value)
    return found


def _ordered(eclass: Any) -> list[Any]:
    """Features in Ecore's order: those of supertypes first, each once."""
    result: list[Any] = []
    for base in eclass.eSuperTypes:
        result.extend(f for f in _ordered(base) if f not in result)
    return result + list(eclass.eStructuralFeatures)
