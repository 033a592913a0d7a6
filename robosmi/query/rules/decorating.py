"""The type of decorators that register the decorated function and return it unchanged.

For type checkers only; import it under `TYPE_CHECKING`.
"""

from __future__ import annotations

from typing import Protocol, TypeVar

from robosmi.base.functions import Function as AnyFunction

Function = TypeVar("Function", bound=AnyFunction)


class Decorator(Protocol):
    """A decorator that registers a function and returns it unchanged."""

    def __call__(self, function: Function, /) -> Function:
        """The function that was given."""
