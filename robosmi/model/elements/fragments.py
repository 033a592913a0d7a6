"""Ids and fragments of EMF elements: `//@sections.0/@items.1` both ways, `//Book/title` in metamodels, xmi:id, id attributes.

As EMF's XMLResourceImpl has it: an id if there is one, else the way from the root. Files of references (`a.xmi#//`) are the
reader's and writer's.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Any
from urllib.parse import unquote

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements.by_name import feature_value
from robosmi.model.elements.ecore import EModelElement, ENamedElement, EObject
from robosmi.model.elements.features import all_features, is_of_ecore
from robosmi.model.elements.pyecore_internals import key_of, xmi_id_of
from robosmi.model.elements.structure import contents, place_in


def own_id(element: EObject) -> str | None:
    """The xmi:id of an element, or the value of the attribute that is its class's id, or None."""
    if identity := xmi_id_of(element):
        return str(identity)
    for name in _id_attributes(element):
        if (value := feature_value(element, name)) is not None:
            return str(value)
    return None


def _id_attributes(element: EObject) -> list[str]:
    cls: Any = element.__class__
    known: list[str] | None = cls.__dict__.get("_robosmi_ids")
    if known is None:
        known = [key_of(f) for f in all_features(element.eClass) if f.is_attribute and f.iD]
        if cls.__module__ != "pyecore.ecore":  # Ecore's own classes are everybody's
            cls._robosmi_ids = known
    return known


def fragment_of(element: Any, roots: Sequence[EObject]) -> str:
    """The id or fragment of an element, as EMF writes it.

    Args:
        element: any element.
        roots: the roots of its model, in order; with one root or none the fragment starts with `/`, else with `/0`, `/1` ...
    """
    if identity := own_id(element):
        return identity
    steps: list[str] = []
    while (container := element.eContainer()) is not None and (feature := element.eContainmentFeature()) is not None:
        name = element.name if isinstance(element, ENamedElement) and is_of_ecore(element.eClass) else None
        if name and _named(container, name) is element:
            steps.append(segment(name))
        elif feature.many:
            steps.append(f"@{feature.name}.{place_in(getattr(container, key_of(feature)), element)}")
        else:
            steps.append(f"@{feature.name}")
        element = container
    place = next((i for i, r in enumerate(roots) if r is element), 0) if len(roots) > 1 else 0
    return "/".join(["/" if len(roots) < 2 else f"/{place}", *reversed(steps)])


_ENCODED = re.compile(r"""[\x00-\x20"#%&',/:<>]""")


def segment(name: str) -> str:
    """A name as a step of a fragment, with the characters escaped that EMF's BasicEObjectImpl escapes."""
    return _ENCODED.sub(lambda match: f"%{ord(match.group()):02X}", name)


def _named(container: EObject, name: str) -> Any:
    """The first element of a metamodel with that name in a container, or None; EMF's fragments say names there."""
    return next((part for part in contents(container) if isinstance(part, ENamedElement) and part.name == name), None)


def resolve(fragment: str, roots: Sequence[EObject]) -> Any:
    """The element at a fragment such as `//@sections.0/@items.1` or `/1/@items.0`, or None where nothing is.

    Raises:
        ModelError: the fragment names a feature that is none, or is no fragment.
    """
    start, *steps = fragment[1:].split("/")
    if start and not start.isdecimal():
        raise ModelError(
            f"'{fragment}' is no fragment: '{start}' is no number of a root", fix="write it as //@feature.0/@feature"
        )
    position = int(start or 0)
    element = roots[position] if position < len(roots) else None
    for step in steps:
        if element is None:
            return None
        element = _step(element, step)
    return element


def _step(element: EObject, step: str) -> Any:
    """One step of a fragment, `@items.1`, `@parent`, or in a metamodel a name."""
    if step[:1] != "@" and isinstance(element, EModelElement):
        return _named(element, unquote(step))
    name, _, position = step[1:].rpartition(".") if step[-1:].isdecimal() and "." in step else (step[1:], "", "")
    known = {str(feature.name): key_of(feature) for feature in all_features(element.eClass)}
    if step[:1] != "@" or name not in known:
        raise ModelError(
            f"the step '{step}' of the fragment is no feature of {element.eClass.name}{did_you_mean(name, known)}",
            fix=f"use one of: {', '.join('@' + n for n in known)}",
        )
    value = feature_value(element, known[name])
    if not position:
        return value
    many = list(value) if isinstance(value, Iterable) and not isinstance(value, (str, bytes)) else []
    return many[int(position)] if int(position) < len(many) else None
