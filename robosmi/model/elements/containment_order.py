"""EMF's order where pyecore has none: what an element contains, and what a class has of its supertypes.

pyecore gives the references and attributes of a class as sets, whose order changes from run to run, and an element's contents in
the order of these. Elements of strict classes answer for themselves; templates and queries ask here for all others, which are the
elements of metamodels above all.
"""

from __future__ import annotations

from functools import partial

from robosmi.model.elements import structure
from robosmi.model.elements.ecore import EClass, EObject
from robosmi.model.elements.feature_values import Contents
from robosmi.model.elements.features import all_features, supertypes
from robosmi.model.elements.ordering import post_order

INHERITED = frozenset({"eAllAttributes", "eAllOperations", "eAllReferences", "eAllStructuralFeatures", "eAllSuperTypes"})
"""EMF's names for what a class has and inherits."""
ORDERED_FEATURES = INHERITED | {"eContents", "eAllContents"}
"""The names of EMF that are answered here."""


class EmfOperation(partial[Contents]):
    """An operation of EMF's of one element; it reads and changes nothing."""


def ordered_feature(element: EObject, name: str) -> Contents | EmfOperation | None:
    """What an element's attribute of that name means: its contents, or a function that gives them; None for others.

    Args:
        element: an element, or a class of a metamodel.
        name: one of `ORDERED_FEATURES`.
    """
    if name == "eContents":
        return contents(element)
    if name == "eAllContents":
        return EmfOperation(all_contents, element)
    return EmfOperation(inherited, element, name) if isinstance(element, EClass) and name in INHERITED else None


def contents(element: EObject) -> Contents:
    """What an element contains itself."""
    return Contents(structure.contents(element))


def all_contents(element: EObject) -> Contents:
    """All that an element contains, without itself, in pre-order."""
    walked = structure.walk(element)
    next(walked)
    return Contents(walked)


def inherited(eclass: EClass, name: str) -> Contents:
    """What a class has and inherits: that of supertypes first, each once."""
    if name == "eAllStructuralFeatures":
        return Contents(all_features(eclass))
    if name in ("eAllReferences", "eAllAttributes"):
        return Contents(f for f in all_features(eclass) if f.is_reference == (name == "eAllReferences"))
    classes = post_order([eclass], supertypes)
    if name == "eAllOperations":
        return Contents(operation for one in classes for operation in one.eOperations)
    return Contents(one for one in classes if one is not eclass)
