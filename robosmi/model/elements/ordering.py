"""Orders the nodes of graphs that may be deep or have cycles, without recursion.

Used for inheritance, inclusion and use, in metamodels, rules, modules and macros. The order of a chain's steps, whose graph is
also shown, is computed with networkx.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

T = TypeVar("T")


def post_order(
    starts: Iterable[T], following: Callable[[T], Sequence[T]], on_circle: Callable[[list[T]], object] | None = None
) -> Iterator[T]:
    """All reachable nodes without duplicates, each after its successors.

    Args:
        starts: where to begin, in order.
        following: the successors of a node, in order.
        on_circle: called with each cycle that is found, from a node to the same node; it may raise. The cycle is not followed.
    """
    done: set[T] = set()
    way: dict[T, None] = {}  # those that are begun, each led to by the one before
    for start in starts:
        pending = [(start, False)]
        while pending:
            one, ready = pending.pop()
            if ready:
                del way[one]
                done.add(one)
                yield one
            elif one in way:
                if on_circle is not None:
                    begun = list(way)
                    on_circle([*begun[begun.index(one) :], one])
            elif one not in done:
                way[one] = None
                pending.append((one, True))
                pending.extend((other, False) for other in reversed(following(one)))
