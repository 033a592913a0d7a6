"""Ids of regions, derived from the model so that a person's text stays with its element."""

from __future__ import annotations

from robosmi.errors import ModelError
from robosmi.model.driver import DynamicNode, Item, is_element, name_of, type_of
from robosmi.model.ecore import EObject
from robosmi.model.fragments import own_id


def region_id(element: Item, *purpose: str) -> str:
    """An id for a region that belongs to an element.

    It is the element's own id (the attribute that is the class's id, else its `xmi:id`) where it has one, so that a renamed or
    moved element keeps its text. Else it is the names on the way to it, which stay while others are added or reordered, but not
    when it is renamed. A position is never part of it: the text would go to another element when one is inserted.

    Args:
        element: a model element.
        purpose: what the region is for, where an element has several.

    Returns:
        For example `City/Stories/Ants body`.

    Raises:
        ModelError: it is no element, or it has no id, and it or a container has no name.
    """
    if not is_element(element):
        raise ModelError(f"{element!r} is no element of a model", fix="give the element that the region belongs to")
    own = _own_id(element)
    return " ".join([own if own is not None else _names(element), *purpose])


def _own_id(element: DynamicNode) -> str | None:
    return (own_id(element) or None) if isinstance(element, EObject) else None


def _names(element: DynamicNode) -> str:
    found: list[str] = []
    step: DynamicNode | None = element
    while step is not None:
        name = getattr(step, "name", None)
        if not (name and isinstance(name, str)):
            raise ModelError(
                f"a {name_of(type_of(step))} has neither an id nor a name, so nothing in the model says which region is its own",
                fix="give it an id attribute or a name, or write the region's id in the template",
            )
        found.append(str(name))
        step = step.eContainer()
    return "/".join(reversed(found))
