"""How interrupts come upon each other on the stack, where the bytes that each takes are known.

What one takes is measured (adapter files) or read off machine code (`verification.machine_stack`).
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from robosmi.typed import sum_of


class HandlerBytes(NamedTuple):
    """What an interrupt's handler takes.

    Attributes:
        most: its bytes, with the address that it returns to.
        open: the same where it lets other interrupts in; below 0 where it does not.
    """

    most: int
    open: int


def upon_each_other(handlers: Iterable[HandlerBytes]) -> int:
    """Bytes that interrupts take at most: upon those that let others in, each as deep as it does, the deepest of all.

    Args:
        handlers: of different interrupts; none comes upon itself.
    """
    sizes = list(handlers)
    below = sum_of(each.open for each in sizes if each.open >= 0)
    return below + max((each.most - max(0, each.open) for each in sizes), default=0)
