"""Checks whether a value has the type that a function's annotation promises, for functions that replace a step.

Only the type itself and the members of tuples and unions are checked, not the contents of lists and mappings.
"""

from __future__ import annotations

import types
import typing
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from robosmi.functions import Function


def unlike(value: Any, function: Function) -> str:
    """The type that a function promises to return, in words, if a value does not have it; else an empty text.

    Args:
        value: what was made.
        function: the function whose return annotation says what is expected; one without an annotation expects anything.
    """
    try:
        expected = typing.get_type_hints(function).get("return", Any)
    except (NameError, TypeError, AttributeError):  # of a name that only type checkers import
        return ""
    return "" if _fits(value, expected) else named(expected)


def _fits(value: Any, expected: Any) -> bool:
    origin, members = typing.get_origin(expected), typing.get_args(expected)
    if origin in (typing.Union, types.UnionType):
        return any(_fits(value, member) for member in members)
    if origin is tuple and members and members[-1] is not Ellipsis:
        fits = isinstance(value, tuple) and len(value) == len(members)
        return fits and all(_fits(part, member) for part, member in zip(value, members, strict=True))
    kind = origin or expected
    if kind is None:
        return value is None
    return not isinstance(kind, type) or getattr(kind, "_is_protocol", False) or isinstance(value, kind)


def named(expected: Any) -> str:
    """A type as a person writes it: `list[PortBinding]`, `StoredDrawing or None`."""
    origin, members = typing.get_origin(expected), typing.get_args(expected)
    if origin in (typing.Union, types.UnionType):
        return " or ".join(named(member) for member in members)
    if expected is type(None) or expected is None:
        return "None"
    name = getattr(origin or expected, "__name__", str(expected))
    return f"{name}[{', '.join('...' if m is Ellipsis else named(m) for m in members)}]" if members else name


def described(value: Any) -> str:
    """A value described by its type: `None`, `a tuple of 2 (list, str)`, `an int`."""
    if value is None:
        return "None"
    name = type(value).__name__
    members = f" of {len(value)} ({', '.join(type(part).__name__ for part in value)})" if isinstance(value, tuple) else ""
    return f"{'an' if name[0].lower() in 'aeiou' else 'a'} {name}{members}"
