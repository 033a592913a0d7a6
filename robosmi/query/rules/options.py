"""Options of declarations, as `@g.rule(template=...)`: a misspelt one is refused with the nearest that there is."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable
from functools import wraps
from typing import ParamSpec, TypeVar

from robosmi.diagnostics import Location
from robosmi.errors import UsageError, did_you_mean

P = ParamSpec("P")
T = TypeVar("T")


def check_options(what: str, given: Iterable[str], known: Iterable[str], place: Location | None = None) -> None:
    """Refuse an option that there is not.

    Args:
        what: whose options they are, "a constraint".
        given: the names that were given.
        known: the names that there are.
        place: where it is declared, or None.

    Raises:
        UsageError: one is unknown.
    """
    names = list(known)
    for name in given:
        if name not in names:
            raise UsageError(
                f"{what} has no option '{name}'{did_you_mean(name, names)}", location=place, fix=f"use one of: {', '.join(names)}"
            )


def with_options(what: str) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """A decorator of functions that take options by name: what is none of them is a `UsageError`, not Python's own TypeError.

    Args:
        what: whose options they are, "a rule of Gen".
    """

    def decorate(function: Callable[P, T]) -> Callable[P, T]:
        parameters = inspect.signature(function).parameters.values()
        names = [p.name for p in parameters if p.kind is inspect.Parameter.KEYWORD_ONLY]
        others = {p.name for p in parameters if p.kind is inspect.Parameter.POSITIONAL_OR_KEYWORD}

        @wraps(function)
        def checked(*arguments: P.args, **options: P.kwargs) -> T:
            check_options(what, (name for name in options if name not in others), names)
            return function(*arguments, **options)

        return checked

    return decorate
