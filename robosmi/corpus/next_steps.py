"""What to do next with a corpus: which missing bodies of functions would free most programs, and what stops programs.

A greedy cover: the next function is that which brings most programs nearest to lacking none. Each program that calls it counts as
one divided by the number of functions that it still lacks, so that the last function that a program lacks counts most. Equal
functions are ordered by their calls.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable

from msgspec import Struct

_ONE = 10**12
"""What a program counts for its last function; whole numbers, so that the order in which they are added does not matter."""
Function = tuple[str, str | None]
"""Name, and the header that declares it, or None."""


class Missing(Struct, frozen=True):
    """A function without a body, as the cover chooses it.

    Attributes:
        function: its name.
        header: the header that declares it; None if nothing known does, so that a fact is missing, too.
        calls: its call sites in all programs.
        programs: programs that call it.
        frees: programs that lack nothing more once it and all before it have a body.
        freed: these of all chosen so far.
    """

    function: str
    header: str | None
    calls: int
    programs: int
    frees: int
    freed: int


def greedy_cover(lacks: Iterable[tuple[str, str, str | None, int]], most: int) -> list[Missing]:
    """The functions to write next, best first.

    Args:
        lacks: program, function, header and number of calls, for each function that lacks a body.
        most: number of functions that are chosen.
    """
    left: dict[str, set[Function]] = defaultdict(set)
    users: dict[Function, set[str]] = defaultdict(set)
    calls: Counter[Function] = Counter()
    for program, name, header, count in lacks:
        function = (name, header)
        left[program].add(function)
        users[function].add(program)
        calls[function] += count
    scores = {function: sum(_ONE // len(left[program]) for program in who) for function, who in users.items()}
    chosen: list[Missing] = []
    freed = 0
    while scores and len(chosen) < most:
        best = max(scores, key=lambda each: (scores[each], calls[each], each[0], each[1] or ""))
        del scores[best]
        frees = 0
        for program in users[best]:
            before = len(left[program])
            left[program].discard(best)
            frees += before == 1
            for other in left[program]:
                scores[other] += _ONE // (before - 1) - _ONE // before
        freed += frees
        chosen.append(Missing(*best, calls[best], len(users[best]), frees, freed))
    return chosen


_QUOTED = re.compile(r"'[^']*'|\"[^\"]*\"")
_PLACE = re.compile(r"^(?:/|[A-Za-z]:\\)[^:\n]*(?::\d+)*: ")
_NUMBER = re.compile(r"\d+(?:\.\d+)?")


def kind_of_message(message: str) -> str:
    """A message without what differs from program to program: its place, names in quotes, numbers."""
    return _NUMBER.sub("N", _QUOTED.sub("'...'", _PLACE.sub("", message)))


class Cluster(Struct):
    """Programs that are stopped by the same.

    Attributes:
        state, step: where they ended.
        kind: their messages without what differs.
        programs: their number.
        examples: the first few of them.
    """

    state: str
    step: str
    kind: str
    programs: int = 0
    examples: list[str] = []


def clusters(stopped: Iterable[tuple[str, str, str | None, str | None]]) -> list[Cluster]:
    """What stops programs, the most frequent first.

    Args:
        stopped: id, state, step and message of each program that is not done.
    """
    found: dict[tuple[str, str, str], Cluster] = {}
    for program, state, step, message in stopped:
        kind = kind_of_message(message or "")
        cluster = found.setdefault((state, step or "", kind), Cluster(state, step or "", kind, examples=[]))
        cluster.programs += 1
        if len(cluster.examples) < 5:
            cluster.examples.append(program)
    return sorted(found.values(), key=lambda cluster: (-cluster.programs, cluster.kind))
