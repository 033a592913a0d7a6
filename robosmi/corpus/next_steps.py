"""What to do next with a corpus: which missing bodies of functions would free most programs, and what stops programs.

A greedy cover by sets: the next functions are all those that one more program lacks, namely the set that frees most programs for
each function in it. Of equal sets the smaller comes first, then the one with more call sites.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence

from msgspec import Struct

Function = tuple[str, str | None]
"""Name, and the header that declares it, or None."""


class Missing(Struct, frozen=True):
    """A function without a body, as the cover chooses it.

    Attributes:
        function: its name.
        header: the header that declares it; None if nothing known does, so that a fact is missing, too.
        calls: its call sites in all programs.
        programs: number of programs that call it.
        frees: the programs that lack nothing more once it and all before it have a body.
        freed: the number of these for all chosen so far.
    """

    function: str
    header: str | None
    calls: int
    programs: int
    frees: Sequence[str]
    freed: int


def greedy_cover(lacks: Iterable[tuple[str, str, str | None, int]], most: int) -> list[Missing]:
    """The functions to write next, best first.

    Args:
        lacks: program, function, header and number of calls, for each function that lacks a body.
        most: number of functions that are chosen.
    """
    lacked: dict[str, set[Function]] = defaultdict(set)
    users: Counter[Function] = Counter()
    calls: Counter[Function] = Counter()
    for program, name, header, count in lacks:
        function = (name, header)
        users[function] += function not in lacked[program]
        lacked[program].add(function)
        calls[function] += count
    left: dict[frozenset[Function], list[str]] = defaultdict(list)
    for program, functions in lacked.items():
        left[frozenset(functions)].append(program)
    chosen: list[Missing] = []
    freed = 0
    while left and len(chosen) < most:
        best = _best(left, calls)
        for function in sorted(best, key=lambda each: (-calls[each], each[0], each[1] or "")):
            remaining: dict[frozenset[Function], list[str]] = defaultdict(list)
            for lacking, names in left.items():
                remaining[lacking - {function}] += names
            frees = sorted(remaining.pop(frozenset(), ()))
            left = remaining
            freed += len(frees)
            chosen.append(Missing(*function, calls[function], users[function], frees, freed))
    return chosen[:most]


def _best(left: dict[frozenset[Function], list[str]], calls: Counter[Function]) -> frozenset[Function]:
    """The set of functions that frees most programs for each of its functions.

    Args:
        left: functions -> the programs that lack just these.
        calls: call sites of each function.
    """
    shared = Counter(function for functions in left for function in functions)
    with_rarest: dict[Function, list[frozenset[Function]]] = defaultdict(list)
    for functions in left:  # a set lies within another only if its rarest function does
        with_rarest[min(functions, key=lambda each: (shared[each], each[0], each[1] or ""))].append(functions)

    def worth(functions: frozenset[Function]) -> tuple[float, int, int, list[tuple[str, str]]]:
        within = (inner for function in functions for inner in with_rarest.get(function, ()) if inner <= functions)
        frees = sum(len(left[inner]) for inner in within)
        names = sorted((name, header or "") for name, header in functions)
        return -frees / len(functions), len(functions), -sum(calls[each] for each in functions), names

    return min(left, key=worth)


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
