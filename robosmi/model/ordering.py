"""Order in graphs whose ways may be long or lead in circles: what comes before what.

Nothing recurses, and nothing is known of models: inheritance, inclusion and use are walked here for metamodels, rules, modules
and macros alike. The order of a chain's steps, which is to be shown as a graph too, is networkx's.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TypeVar

T = TypeVar("T")


def post_order(
    starts: Iterable[T], following: Callable[[T], Sequence[T]], on_circle: Callable[[list[T]], object] | None = None
) -> Iterator[T]:
    """All that can be reached, each once, behind what it leads to.

    Args:
        starts: where to begin, in order.
        following: what one leads to, in the order in which it is to come.
        on_circle: is told of a way that comes back to where it began, from there to there, and may raise; such a way is not
            followed any further.
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
