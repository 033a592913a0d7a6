"""The errors of queries: a name that does not exist, a value that is not there, an operand of the wrong kind.

All are `ModelError`s (exit code 3), with the nearest known name where there is one. What a lambda raises by itself is
not caught here. Errors of elements' own features come from `robosmi.model.elements.feature_errors`, those of types from
`robosmi.model.driver`.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robosmi.errors import ModelError, did_you_mean
from robosmi.model.elements.driver import UnknownTypeError, unknown_type
from robosmi.model.elements.ecore import EObject
from robosmi.query.values import collection_kind

__all__ = [
    "OperandError",
    "UndefinedError",
    "UnknownOperationError",
    "UnknownPropertyError",
    "UnknownTypeError",
    "describe",
    "unknown_operation",
    "unknown_property",
    "unknown_type",
]


class UnknownPropertyError(ModelError, AttributeError):
    """A property that the target does not have."""


class UnknownOperationError(ModelError, AttributeError):
    """An operation that the target does not have."""


class UndefinedError(ModelError):
    """A property of nothing: the target is None (EOL: "Called feature ... on undefined object")."""


class OperandError(ModelError, TypeError):
    """A value of a kind that the operation or operator does not take."""


def unknown_property(target: str, name: str, known: Iterable[str]) -> UnknownPropertyError:
    """The error for a property that is not there, with the nearest that is."""
    names = sorted(set(known))
    fix = f"use one of: {', '.join(names)}" if names else None
    return UnknownPropertyError(f"{target} has no property '{name}'{did_you_mean(name, names)}", fix=fix)


def unknown_operation(target: str, name: str, known: Iterable[str]) -> UnknownOperationError:
    """The error for an operation that is not there, with the nearest that is."""
    return UnknownOperationError(
        f"{target} has no operation '{name}'{did_you_mean(name, sorted(set(known)))}",
        fix="see docs/reference/eol.md for the operations, or register one with @operation",
    )


def describe(target: Any) -> str:
    """What a target is, for messages: `a Book`, `a Sequence`."""
    kind = collection_kind(target)
    if kind is None:
        kind = target.eClass.name if isinstance(target, EObject) else type(target).__name__
    return f"{'an' if kind[0] in 'AEIOU' else 'a'} {kind}"
