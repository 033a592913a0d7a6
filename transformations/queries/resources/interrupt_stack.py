"""How much stack nested interrupt handlers take together, given the bytes that each takes.

A handler's bytes are measured (adapter files) or read off machine code (`verification.stack.machine_stack`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple


class HandlerBytes(NamedTuple):
    """The stack that an interrupt handler takes.

    Attributes:
        most: bytes at its deepest point, return address included.
        open: bytes at its deepest point with interrupts enabled, where another handler may interrupt it; negative if it never
            enables them.
    """

    most: int
    open: int


def upon_each_other(handlers: Iterable[HandlerBytes]) -> int:
    """Upper bound of the stack in bytes that nested interrupt handlers take together.

    Every handler that enables interrupts may be suspended at its `open` depth, each once; on top of them comes the handler that
    needs the most beyond its own.

    Args:
        handlers: of different interrupts; no handler interrupts itself.
    """
    sizes = list(handlers)
    below = sum(each.open for each in sizes if each.open >= 0)
    return below + max((each.most - max(0, each.open) for each in sizes), default=0)
