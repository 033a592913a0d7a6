"""Features of elements read by their names, whatever the technology of their model.

Which features an element has is told by `driver`; many values of EMF's are `feature_values`'s collections.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.model.driver import Held, Item, ModelElement, Node
from robosmi.typed import dynamic_attribute


def feature_value(element: Node, name: str) -> Held:
    """What a feature of an element holds, by its name."""
    value: Held = dynamic_attribute(element, name)
    return value


def feature_values(element: Node, name: str) -> Sequence[Item]:
    """What a feature of an element holds as several: nothing, the one value, or all of them."""
    value = feature_value(element, name)
    if value is None:
        return ()
    return value if isinstance(value, Sequence) and not isinstance(value, (str, bytes, ModelElement)) else (value,)
