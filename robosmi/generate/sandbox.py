"""What a template may look at and call: Jinja's sandbox, and of elements, collections and models what is listed here.

An element has the features and operations of its class, and what a package's own code adds to it; of what the classes of pyecore
and of this framework define, only what reads is there. The environment of `templates` asks here; its speed matters, so the
answer is remembered by class and name. What a Python program gives to its templates beside these is its own affair.
"""

from __future__ import annotations

import sys
from functools import partial, partialmethod
from pathlib import Path, PurePath
from types import CodeType, FrameType, FunctionType, MethodType, ModuleType, TracebackType
from typing import Any

from jinja2.sandbox import is_internal_attribute
from pyecore.ecore import EObject
from pyecore.valuecontainer import ECollection

from robosmi.errors import RuleError
from robosmi.model.driver import Model, ModelElement, TypeHandle

_OF_ELEMENTS = frozenset(
    ["eAllContents", "eClass", "eContainer", "eContainmentFeature", "eContents", "eIsSet", "eRoot", "eURIFragment",
     "eAllAttributes", "eAllOperations", "eAllReferences", "eAllStructuralFeatures", "eAllSuperTypes", "eAttributes",
     "eReferences", "findEOperation", "findEStructuralFeature", "getEAnnotation",
     "children", "line", "namespaceURI", "parentNode", "tagName", "text"]
)  # fmt: skip
"""What is not a feature of an element and reads: EMF's names of elements and of metamodels, then those of plain XML."""
_OF_COLLECTIONS = frozenset(
    [
        "copy",
        "count",
        "difference",
        "index",
        "intersection",
        "isdisjoint",
        "issubset",
        "issuperset",
        "symmetric_difference",
        "union",
    ]
)
_OF_MODELS = frozenset(
    ["all_contents", "all_of_kind", "all_of_type", "element", "find_type", "id_of", "name", "owns", "path", "roots", "types"]
)
_OF_TYPES = frozenset(["all", "all_of_type", "has", "name"])
_OF_PATHS = frozenset(name for name in dir(PurePath) if not name.startswith("_"))
_CLOSED = (ModuleType, CodeType, FrameType, TracebackType, partial, partialmethod)
_BASES = ("pyecore.", "robosmi.model.")
"""The modules whose classes elements inherit from. What they define changes and stores elements, too."""
_WATCHED = (FunctionType, MethodType)
_ALLOWED: dict[tuple[type, str], bool] = {}


def allowed(obj: Any, attribute: str) -> bool:
    """Whether a template may ask an object for an attribute."""
    key = (obj.__class__, attribute)
    known = _ALLOWED.get(key)
    if known is None:
        known = _ALLOWED[key] = _judged(obj, attribute)
    return known


def _judged(obj: Any, attribute: str) -> bool:
    if attribute.startswith("_") or isinstance(obj, _CLOSED) or _is_resource(obj) or is_internal_attribute(obj, attribute):
        return False
    if isinstance(obj, ECollection):
        return attribute in _OF_COLLECTIONS
    if isinstance(obj, (EObject, ModelElement)):
        return attribute in _OF_ELEMENTS or _is_own(obj, attribute)
    if isinstance(obj, TypeHandle):
        return attribute in _OF_TYPES or not hasattr(TypeHandle, attribute)  # the name of a literal
    if isinstance(obj, Model):
        return attribute in _OF_MODELS or not (hasattr(type(obj), attribute) or attribute in vars(obj))  # the name of a type
    if isinstance(obj, Path):
        return attribute in _OF_PATHS
    return True


def _is_resource(obj: Any) -> bool:
    """Whether an object is one of pyecore's resources: there are none before their module is imported, which takes long."""
    module = sys.modules.get("pyecore.resources")
    return module is not None and isinstance(obj, (module.Resource, module.ResourceSet))


def _is_own(element: EObject | ModelElement, name: str) -> bool:
    """Whether a name is the element's own: of its metamodel or of its package's code, or, so that this is told, of nobody."""
    if not isinstance(element, EObject):  # plain XML and tables have no metamodel, and features that no class defines
        return not hasattr(type(element), name)
    kind = element.eClass
    if kind.findEStructuralFeature(name) is not None or kind.findEOperation(name) is not None:
        return True
    owner = next((base for base in type(element).__mro__ if name in vars(base)), None)
    return not hasattr(element, name) if owner is None else not f"{owner.__module__}.".startswith(_BASES)


def refused(obj: Any, attribute: str) -> RuleError:
    """The error for an attribute that is not allowed."""
    return RuleError(
        f"a template may not use '{attribute}' of a {type(obj).__name__}",
        fix="compute it in the rule, and give it to the template",
    )


def may_call(function: Any) -> bool:
    """Whether a template may call an object: all but types of a model, which would make an element, and what is marked unsafe."""
    if function.__class__ is TypeHandle:
        return False
    if function.__class__ in _WATCHED:
        return not (getattr(function, "unsafe_callable", False) or getattr(function, "alters_data", False))
    return True
