"""What a template may look at and call: Jinja's sandbox, and of model elements what reads and not what changes or stores.

The environment of `templates` asks here; its speed matters, so what is allowed is remembered by class and name.
"""

from __future__ import annotations

import sys
from pathlib import Path, PurePath
from types import CodeType, FrameType, FunctionType, MethodType, ModuleType, TracebackType
from typing import Any

from jinja2.sandbox import is_internal_attribute
from pyecore.ecore import EObject
from pyecore.valuecontainer import ECollection

from robosmi.errors import RuleError
from robosmi.model.driver import Model, ModelElement, TypeHandle

READING = frozenset(
    ["eAllContents", "eClass", "eContainer", "eContainmentFeature", "eContents", "eIsSet", "eRoot", "eURIFragment"]
)
"""What is not a feature of an element and still allowed."""
_OF_ELEMENTS = frozenset(name for name in dir(EObject) if name not in READING) | {
    "eFactoryInstance", "getEClassifier", "instanceClass", "notifyChanged", "python_class",
}  # fmt: skip
_CHANGING = frozenset(
    ["add", "append", "clear", "create", "discard", "difference_update", "extend", "insert", "intersection_update", "pop",
     "remove", "remove_or_unset", "reverse", "sort", "symmetric_difference_update", "update"]
)  # fmt: skip
_OF_MODELS = frozenset(
    ["all_contents", "all_of_kind", "all_of_type", "element", "find_type", "id_of", "name", "owns", "path", "types"]
)
_CLOSED = (ModuleType, CodeType, FrameType, TracebackType)
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
        return attribute not in _CHANGING
    if isinstance(obj, (EObject, ModelElement)):
        return attribute not in _OF_ELEMENTS
    if isinstance(obj, Model):
        return attribute in _OF_MODELS or attribute not in dir(obj)  # what is not there is the name of a type
    if isinstance(obj, Path):
        return hasattr(PurePath, attribute)
    return True


def _is_resource(obj: Any) -> bool:
    """Whether an object is one of pyecore's resources: there are none before their module is imported, which takes long."""
    module = sys.modules.get("pyecore.resources")
    return module is not None and isinstance(obj, (module.Resource, module.ResourceSet))


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
