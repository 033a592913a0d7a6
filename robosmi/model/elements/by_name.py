"""Reads features of elements by name, independently of the model's technology.

`driver` lists the features of an element; many-valued features of EMF elements are collections of `feature_values`.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.model.elements.driver import Item, ItemOrItems, ModelElement, Node


def feature_value(element: Node, name: str) -> ItemOrItems:
    """The value of an element's feature, given by name."""
    value: ItemOrItems = getattr(element, name)
    return value


def feature_values(element: Node, name: str) -> Sequence[Item]:
    """The values of an element's feature as a list: none, the single value, or all of them."""
    value = feature_value(element, name)
    if value is None:
        return ()
    return value if isinstance(value, Sequence) and not isinstance(value, (str, bytes, ModelElement)) else (value,)
