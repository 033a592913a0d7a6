"""The type of the decorators with which users declare rules: what they are given stays what it is.

For type checkers alone; import it under `TYPE_CHECKING`. What a decorator notes of a function is its own module's business.
"""

from __future__ import annotations

from typing import Protocol, TypeVar

from robosmi.functions import Function as AnyFunction

Function = TypeVar("Function", bound=AnyFunction)


class Decorator(Protocol):
    """A decorator that notes a function and gives back the very same."""

    def __call__(self, function: Function, /) -> Function:
        """The function that was given."""
