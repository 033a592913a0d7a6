"""The deepest call chain through a program's own functions, in bytes of stack, given the stack that each function takes.

The callers tell what a function takes: `queries.resources.cooperation` for coroutines, `queries.resources.stack_depth` for what a
compiler keeps.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from robosmi.metamodels import ccode

FRAME = 14
"""Bytes of a call of one of the program's own functions: the address that it returns to and the registers that it keeps."""


class Taken(NamedTuple):
    """The stack that one function takes.

    Attributes:
        own: bytes of its own frame.
        callees: the program's own functions that it calls.
        others: bytes of the deepest of its calls of other functions.
    """

    own: int
    callees: Sequence[ccode.Function]
    others: int


def deepest_chain(function: ccode.Function, taken_by: Callable[[ccode.Function], Taken], call: int = 0) -> int:
    """Bytes of the deepest chain of calls from a function on; what calls itself, directly or through others, counts once.

    Args:
        function: where the chain begins.
        taken_by: gives the stack that a function takes.
        call: bytes of each call of one of the program's own functions.
    """
    known: dict[int, int] = {}
    parts: dict[int, Taken] = {}
    waiting = [function]
    while waiting:  # no recursion: functions may call the next for as long as they like
        at = waiting[-1]
        if id(at) not in parts:
            parts[id(at)] = taken_by(at)
            waiting += [callee for callee in parts[id(at)].callees if id(callee) not in parts]
            continue
        own, callees, others = parts[id(at)]
        known.setdefault(id(at), own + max([others, *(call + known.get(id(callee), 0) for callee in callees)]))
        waiting.pop()
    return known[id(function)]
