"""Random changes of models, for properties of what compares and merges them."""

from __future__ import annotations

import random
from typing import Any


def shuffled(model: Any, number: random.Random) -> None:
    """Change a kitchen or library model in one random way."""
    elements = [element for element in model.all_contents() if element.eContainer() is not None]
    if not elements:
        return
    element = number.choice(elements)
    feature = number.choice([f for f in element.eClass.eAllStructuralFeatures() if not f.derived and not f.transient])
    action = number.randrange(4)
    if action == 0:
        model.delete(element)
    elif action == 1 and feature.is_attribute and not feature.many and feature.eType.name == "EString":
        setattr(element, feature.name, number.choice(["a", "b", None, "new"]))
    elif action == 2 and feature.many and len(getattr(element, feature.name)) > 1:
        values = getattr(element, feature.name)
        values.append(values.pop(0))
    elif action == 3:
        holder = element.eContainer()
        held = getattr(holder, element.eContainmentFeature().name)
        others = [x for x in elements if type(x) is type(holder) and x is not element]
        inside = {id(x) for x in element.eAllContents()}
        others = [x for x in others if id(x) not in inside and x is not holder]
        if others and element.eContainmentFeature().many and len(held):
            getattr(number.choice(others), element.eContainmentFeature().name).append(element)
