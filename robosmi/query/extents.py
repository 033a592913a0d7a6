"""Extents: which elements a model or an element holds, in containment pre-order (an element before its contents).

A root is any element, whose extent is the element itself and all it contains, or a model of any technology (a
`robosmi.model.driver.Model`), which may keep its extents; those of an element are walked anew each time. Neither is ever out of
date, and nothing recurses.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeVar, overload

from robosmi.model.elements.driver import DynamicNode, Kind, Model, Node, contents_of, walk
from robosmi.query.collections import Q
from robosmi.query.types import matching, resolve

if TYPE_CHECKING:
    from robosmi.model.elements.driver import TypeHandle
    from robosmi.model.elements.ecore import EClassifier
    from robosmi.model.elements.strict import Element

T = TypeVar("T")


@overload
def all_contents(root: Element) -> Iterator[Element]: ...
@overload
def all_contents(root: DynamicNode | Model) -> Iterator[DynamicNode]: ...
def all_contents(root: Node | Model) -> Iterator[Node]:
    """The root and everything it contains, in containment pre-order; of a model all its elements."""
    return root.all_contents() if isinstance(root, Model) else walk(root)


@overload
def all_of_kind(root: Node | Model, kind: type[T]) -> Q[T]: ...
@overload
def all_of_kind(root: Node | Model, kind: str | EClassifier | TypeHandle) -> Q[DynamicNode]: ...
def all_of_kind(root: Node | Model, kind: Kind) -> Q[Any]:
    """The elements in the extent that are instances of the class or a subclass (EOL `T.all`, `T.allOfKind`).

    Args:
        root: an element or a model.
        kind: a class, an EClass, or a type's name.
    """
    return _extent(root, kind, False)


@overload
def all_of_type(root: Node | Model, kind: type[T]) -> Q[T]: ...
@overload
def all_of_type(root: Node | Model, kind: str | EClassifier | TypeHandle) -> Q[DynamicNode]: ...
def all_of_type(root: Node | Model, kind: Kind) -> Q[Any]:
    """The elements in the extent that are instances of exactly that class (EOL `T.allOfType`).

    Args:
        root: an element or a model.
        kind: a class, an EClass, or a type's name.
    """
    return _extent(root, kind, True)


def _extent(root: Node | Model, kind: Kind, exact: bool) -> Q[Any]:
    if isinstance(root, Model) and isinstance(requested := kind if isinstance(kind, str) else resolve(kind), (str, type)):
        return Q._of(list(root.all_of_type(requested) if exact else root.all_of_kind(requested)))
    return Q._of(matching(root.all_contents() if isinstance(root, Model) else walk(root), kind, exact=exact))


def ancestor_of_kind(element: Node, kind: type[T]) -> T | None:
    """The nearest container of the element that is of that kind, or None; the element itself does not count."""
    container = element.eContainer()
    while container is not None and not isinstance(container, kind):
        container = container.eContainer()
    return container


def contents(element: Node) -> Sequence[DynamicNode]:
    """What the element contains directly, features of supertypes first."""
    return contents_of(element)
