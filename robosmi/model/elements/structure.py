"""The containment tree of EMF elements: contents, roots, places, all in EMF's order, and without recursion.

EMF's order is pre-order: an element before its contents, features of supertypes before the class's own. pyecore's
`eAllContents` returns all children before it descends, and its `allInstances` mixes all models of the process, so neither is
used here. `emf` determines which elements make up a model.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from robosmi.errors import ModelError
from robosmi.model.elements.ecore import DynamicEObject, EClass, EObject
from robosmi.model.elements.features import all_features, is_computed
from robosmi.model.elements.pyecore_internals import container_of, key_of, own_resource_of, read


def feature_names(eclass: EClass) -> list[str]:
    """The names by which all features of an EClass are read from an element, those of supertypes first."""
    return [str(key_of(feature)) for feature in all_features(eclass)]


def contents(element: EObject) -> list[DynamicEObject]:
    """What an element contains directly."""
    found: list[DynamicEObject] = []
    cls = element.__class__
    names = cls.__dict__.get("_robosmi_containments")
    if names is None:
        names = _containments(element)
    if names:
        slots = element.__dict__
        for name, many in names:
            slot = slots.get(name)
            if slot is None:
                continue  # a slot that was never touched is empty
            value = read(slot)
            if many:
                found += value
            elif value is not None:
                found.append(value)
    return found


def _containments(element: EObject) -> list[tuple[str, bool]]:
    """The containment features of an element's class: name, and whether it holds many."""
    cls: Any = element.__class__
    features = [f for f in all_features(element.eClass) if f.is_reference and f.containment and not is_computed(f)]
    names = [(key_of(f), f.many) for f in features]
    if cls.__module__ != "pyecore.ecore":  # Ecore's own classes are everybody's
        cls._robosmi_containments = names
    return names


def refuse_circle(element: EObject, part: object) -> None:
    """Refuse a part that contains the element that is to contain it, or is that element.

    Raises:
        ModelError: it is so.
    """
    above: EObject | None = element
    while above is not None:
        if above is part:
            raise ModelError(
                f"{part!r} cannot be put into {'itself' if part is element else f'{element!r}, which it contains'}",
                fix="take that out of it first",
            )
        above = container_of(above)


def walk(root: EObject) -> Iterator[DynamicEObject]:
    """An element and everything it contains, in pre-order."""
    stack: list[Any] = [root]
    while stack:
        element = stack.pop()
        yield element
        if element.__class__.__dict__.get("_robosmi_containments") == []:
            continue  # most elements of a program cannot contain anything
        if held := contents(element):
            held.reverse()
            stack += held


def root_of(element: EObject) -> EObject:
    """The outermost container of an element, or the element itself."""
    while (container := element.eContainer()) is not None:
        element = container
    return element


def resource_of(element: EObject) -> Any:
    """The resource of an element's root container; a loop, since pyecore asks for it at every change, recursively.

    Raises:
        ModelError: the element contains itself.
    """
    steps, limit, seen = 0, 64, element  # a circle passes by one that was seen, sooner or later (Brent)
    while (container := container_of(element)) is not None:
        element = container.dyn_inst
        if element is seen:
            raise ModelError(f"{element!r} contains itself", fix="take it out of what it contains first")
        steps += 1
        if steps == limit:
            steps, limit, seen = 0, limit * 2, element
    return own_resource_of(element)


def place_in(collection: Any, element: EObject) -> int:
    """The position of an element in a many-valued feature, by identity; -1 if it is not there."""
    positions = getattr(collection, "map", None)
    guess = positions.get(element, -1) if positions is not None else -1
    if 0 <= guess < len(collection) and collection[guess] is element:
        return int(guess)
    return next((i for i, x in enumerate(collection) if x is element), -1)


def disconnect(made: Any) -> None:
    """Take an element that could not be made out of its container and out of all references."""
    for feature in all_features(made.eClass):
        slot = made.__dict__.get(key_of(feature)) if feature.is_reference and not is_computed(feature) else None
        if slot is not None and feature.many:
            read(slot).clear()
        elif slot is not None and read(slot) is not None:
            setattr(made, key_of(feature), None)
