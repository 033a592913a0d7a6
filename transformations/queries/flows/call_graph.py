"""Who calls a function and what it calls, directly and through others, also across files; calls of unknown targets are named.

They read `Call.callee` and its opposite `Function.calls` and nothing else, so that they run on a stored model and on demand.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from robosmi.metamodels import ccode
from robosmi.query import Q, all_of_kind, ancestor_of_kind


def callees(function: ccode.Function) -> Q[ccode.Function]:
    """The functions that a function calls, each once, in the order of their first call; also those it does not define."""
    called = all_of_kind(function.body, ccode.Call) if function.body is not None else []
    return Q(c.callee for c in called if c.callee is not None).distinct()


def callers(function: ccode.Function) -> Q[ccode.Function]:
    """The functions of the program that call a function, each once, in the order of their calls."""
    return Q(f for c in function.calls if (f := ancestor_of_kind(c, ccode.Function)) is not None).distinct()


def all_callees(function: ccode.Function) -> Q[ccode.Function]:
    """The functions that a function reaches through calls, nearest first; the function itself if it is among them."""
    found: Q[Any] = Q([function]).closure(lambda f: list(callees(f)))
    return found


def all_callers(function: ccode.Function) -> Q[ccode.Function]:
    """The functions of the program from which calls lead to a function, nearest first."""
    found: Q[Any] = Q([function]).closure(lambda f: list(callers(f)))
    return found


def computed_calls(elements: Iterable[ccode.Call]) -> Q[ccode.Call]:
    """The calls whose target the text does not name: through pointers, members of records and results of other calls."""
    return Q(elements).select(lambda c: c.callee is None)
