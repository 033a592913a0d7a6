"""Which attributes of elements, collections, models and types an untrusted template or query may read: those without effects.

Templates and queries call this before they read an attribute. Of elements, the features and operations of their class and
additions of a package's own code are allowed; of what the classes of pyecore and of this framework define, only the listed
names. Further rules of each language (paths, texts, functions) are in `robosmi.generate.templates` and
`robosmi.query.expression`.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any

from robosmi.model.elements.driver import Model, ModelElement, TypeHandle
from robosmi.model.elements.ecore import ECollection, EObject
from robosmi.model.elements.feature_values import Queried

OF_ELEMENTS = frozenset(
    ["eAllContents", "eClass", "eContainer", "eContainmentFeature", "eContents", "eIsSet", "eRoot", "eURIFragment",
     "eAllAttributes", "eAllOperations", "eAllReferences", "eAllStructuralFeatures", "eAllSuperTypes", "eAttributes",
     "eReferences", "findEOperation", "findEStructuralFeature", "getEAnnotation",
     "children", "line", "namespaceURI", "parentNode", "tagName", "text"]
)  # fmt: skip
"""Readable attributes of elements that are not features: EMF's names for elements and metamodels, then those of plain XML."""
OF_COLLECTIONS = frozenset(
    ["copy", "count", "difference", "index", "intersection", "isdisjoint", "issubset", "issuperset", "symmetric_difference",
     "union", "select", "reject"]
)  # fmt: skip
_NOT_OF_COLLECTIONS = frozenset(
    ["owner", "feature", "is_ref", "is_cont", "generic_type", "birth", "items", "map", "add_all", "remove_all", "remove_at"]
)
"""Internal attributes of pyecore's collections, and query operations that change a collection."""
OF_MODELS = frozenset(
    ["all", "all_contents", "all_of_kind", "all_of_type", "element", "find_type", "id_of", "literal", "name", "owns", "path",
     "roots", "type_names", "types"]
)  # fmt: skip
OF_TYPES = frozenset(["all", "all_instances", "all_of_kind", "all_of_type", "has", "name"])
_BASES = ("pyecore.", "robosmi.model.")
"""The modules whose classes elements inherit from, and whose members may also change and store elements."""


_MADE = frozenset({"dyn_inst", "listeners", "python_class"})
"""Members that pyecore adds to the classes that it makes."""


def of_models(obj: Any, attribute: str) -> bool | None:
    """Whether an attribute of a part of a model reads and changes nothing; None for what is no part of a model.

    Args:
        obj: an element, a collection that is a feature's value, a model, a type of a model, or anything.
        attribute: the attribute's name; with an underscore in front none is allowed.
    """
    if is_resource(obj) or isinstance(obj, ModuleType):
        return False
    if not isinstance(obj, (ECollection, EObject, ModelElement, TypeHandle, Model)):
        return None
    if attribute.startswith("_"):
        return False
    if isinstance(obj, ECollection):
        own = hasattr(obj.__class__, attribute) or attribute in _NOT_OF_COLLECTIONS
        return attribute in OF_COLLECTIONS or (isinstance(obj, Queried) and not own)  # what queries read
    if isinstance(obj, (EObject, ModelElement)):
        return attribute in OF_ELEMENTS or _is_own(obj, attribute)
    if isinstance(obj, TypeHandle):
        return attribute in OF_TYPES or not hasattr(TypeHandle, attribute)  # the name of a literal
    return attribute in OF_MODELS or not (hasattr(obj.__class__, attribute) or attribute in vars(obj))  # the name of a type


def is_resource(obj: Any) -> bool:
    """Whether an object is a pyecore resource; false before the module of resources is imported, which takes long."""
    module = sys.modules.get("pyecore.resources")
    return module is not None and isinstance(obj, (module.Resource, module.ResourceSet))


def _is_own(element: EObject | ModelElement, name: str) -> bool:
    """Whether a name belongs to the element's metamodel or its package's code, or is unknown, which is reported later."""
    if not isinstance(element, EObject):  # plain XML and tables have no metamodel, and features that no class defines
        return not hasattr(element.__class__, name) or name in element._features()
    kind = element.eClass
    if kind.findEStructuralFeature(name) is not None:
        return True
    # an operation counts by the class that defines it: Ecore's own, such as `getEClassifier`, return callables
    owners = [base for base in element.__class__.__mro__ if name in vars(base)]
    if not owners:
        return not hasattr(element, name)
    return name not in _MADE and not any(f"{base.__module__}.".startswith(_BASES) for base in owners)
