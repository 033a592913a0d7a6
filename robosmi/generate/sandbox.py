"""What a template may read and call: Jinja's sandbox, restricted to reading where parts of models are concerned.

`robosmi.model.reachable` lists the readable attributes of elements, collections, models and types, for queries as well. The
environment of `templates` calls this module for every access, so results are cached by class and name. Values that a Python
program passes to its templates are not restricted.
"""

from __future__ import annotations

from functools import partial, partialmethod
from pathlib import Path, PurePath
from types import CodeType, FrameType, FunctionType, MethodType, ModuleType, TracebackType
from typing import Any

from jinja2.sandbox import is_internal_attribute

from robosmi.errors import RuleError
from robosmi.model.driver import TypeHandle
from robosmi.model.reachable import of_models

_OF_PATHS = frozenset(name for name in dir(PurePath) if not name.startswith("_"))
_CLOSED = (ModuleType, CodeType, FrameType, TracebackType, partial, partialmethod)
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
    if attribute.startswith("_") or isinstance(obj, _CLOSED) or is_internal_attribute(obj, attribute):
        return False
    part = of_models(obj, attribute)
    if part is not None:
        return part
    return attribute in _OF_PATHS if isinstance(obj, Path) else True


def refused(obj: Any, attribute: str) -> RuleError:
    """The error for an attribute that is not allowed."""
    return RuleError(
        f"a template may not use '{attribute}' of a {type(obj).__name__}",
        fix="compute it in the rule, and give it to the template",
    )


def may_call(function: Any) -> bool:
    """Whether a template may call an object: not a type of a model, which would make an element, nor what is marked unsafe."""
    if function.__class__ is TypeHandle:
        return False
    if function.__class__ in _WATCHED:
        return not any(getattr(function, mark, False) is True for mark in ("unsafe_callable", "alters_data"))
    return True
