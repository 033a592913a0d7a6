"""Three-way merge of texts by lines: what the user changed and what the generator changed since the same base.

The algorithm is diff3's: lines that both sides left alone are where they meet; between such lines, a side that did not change
gives way, and both having changed is a conflict unless they changed alike. `by_words` does the same with the words of such lines.
Matching lines are found by patience diff (lines that stand once in both texts are anchors), and a line that stands more often
matches only below the same head: else a body would go to another function that looks like its own when functions change places.
Python's `difflib` does the rest. (The `merge3` package merges so, too, but its licence, GPL, does not fit; `three-merge` merges
characters and marks no conflicts.)
Source: S. Khanna, K. Kunal, B. C. Pierce, A Formal Investigation of Diff3, FSTTCS 2007.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence, Set
from difflib import SequenceMatcher
from typing import TypeVar

from msgspec import Struct

T = TypeVar("T")
Span = tuple[int, int]
Blocks = Callable[[Sequence[str], Sequence[str]], list[tuple[int, int, int]]]
_WORDS = re.compile(r"\s*(?:\w+|[^\w\s])|\s+\Z")
"""A word or sign with the blanks before it, so that two changes separated only by blanks are adjacent."""
_MOST_WORDS = 2000
_ALIKE = 0.5
"""Least share of the words that both sides must keep; with fewer, the matches are coincidental."""


class Chunk(Struct, frozen=True):
    """A stretch of the three texts.

    Attributes:
        kind: `same` (nobody changed it), `ours`, `theirs` (that side changed it), `both` (alike), `conflict`.
        base: from line, to line (exclusive) of the base.
        ours: the same for the person's text.
        theirs: the same for the generator's.
    """

    kind: str
    base: Span
    ours: Span
    theirs: Span


def stretch(lines: Sequence[T], span: Span) -> Sequence[T]:
    """The lines of a span, its end exclusive."""
    return lines[span[0] : span[1]]


def chunks(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str], blocks: Blocks | None = None) -> list[Chunk]:
    """The stretches of three texts, in order, without gaps.

    Args:
        base: lines of the text that both started from.
        ours: lines of the person's.
        theirs: lines of the generator's.
        blocks: finds what two texts have in common, as lines match unless it is given.
    """
    found: list[Chunk] = []
    at = [0, 0, 0]
    for start, length, in_ours, in_theirs in _meeting(base, ours, theirs, blocks or _blocks):
        found += _between(base, ours, theirs, at, [start, in_ours, in_theirs])
        if length:
            spans = [(p, p + length) for p in (start, in_ours, in_theirs)]
            found.append(Chunk("same", *spans))
        at = [start + length, in_ours + length, in_theirs + length]
    return found


def by_words(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]) -> list[str] | None:
    """Lines merged by words and signs, each with its own, where both sides changed the same lines and different words of them.

    Args:
        base: lines of the text that both started from.
        ours: lines of the person's.
        theirs: lines of the generator's.

    Returns:
        The merged lines; None where a line came or went, where changes touch, where a side has hardly a word of a line left, or
        where each side changed a line that the other did not (a body under another head may be another's).
    """
    if not len(base) == len(ours) == len(theirs):
        return None
    mine = {i for i, line in enumerate(ours) if line != base[i]}
    made = {i for i, line in enumerate(theirs) if line != base[i]}
    if not (mine <= made or made <= mine):
        return None
    merged = [_line_by_words(*three) for three in zip(base, ours, theirs, strict=True)]
    lines = [line for line in merged if line is not None]
    return lines if len(lines) == len(merged) else None


def _line_by_words(base: str, ours: str, theirs: str) -> str | None:
    before, mine, made = (_WORDS.findall(text) for text in (base, ours, theirs))
    if max(len(before), len(mine), len(made)) > _MOST_WORDS:
        return None
    if any(SequenceMatcher(None, before, side, autojunk=False).ratio() < _ALIKE for side in (mine, made)):
        return None
    merged: list[str] = []
    for chunk in chunks(before, mine, made, _in_common):
        if chunk.kind == "conflict":
            return None
        merged += stretch(made, chunk.theirs) if chunk.kind == "theirs" else stretch(mine, chunk.ours)
    return "".join(merged)


def _in_common(base: Sequence[str], other: Sequence[str]) -> list[tuple[int, int, int]]:
    """Matching runs of words, as (index in the base, index in the other, length)."""
    found = SequenceMatcher(None, base, other, autojunk=False).get_matching_blocks()
    return [(block.a, block.b, block.size) for block in found if block.size]


def _meeting(
    base: Sequence[str], ours: Sequence[str], theirs: Sequence[str], blocks: Blocks
) -> Iterator[tuple[int, int, int, int]]:
    """Runs of lines that neither side changed: (index in the base, length, index in ours, in theirs); last an empty one."""
    left = blocks(base, ours)
    right = blocks(base, theirs)
    i = j = 0
    while i < len(left) and j < len(right):
        (a, x, n), (b, y, m) = left[i], right[j]
        start, stop = max(a, b), min(a + n, b + m)
        if start < stop:
            yield start, stop - start, x + start - a, y + start - b
        if a + n < b + m:
            i += 1
        else:
            j += 1
    yield len(base), 0, len(ours), len(theirs)


def _blocks(base: Sequence[str], other: Sequence[str]) -> list[tuple[int, int, int]]:
    """Matching runs of lines, as (index in the base, index in the other, length)."""
    unique = _unique(base, other)
    above, in_other = _heads(base, set(unique)), _heads(other, set(unique.values()))
    found: list[tuple[int, int, int]] = []
    for i, j, length in sorted(_runs(base, other)):
        for k in range(length):
            head = above[i + k]
            if i + k not in unique and (None if head is None else unique[head]) != in_other[j + k]:
                continue
            if found and (found[-1][0] + found[-1][2], found[-1][1] + found[-1][2]) == (i + k, j + k):
                found[-1] = (found[-1][0], found[-1][1], found[-1][2] + 1)
            else:
                found.append((i + k, j + k, 1))
    return found


def _unique(base: Sequence[str], other: Sequence[str]) -> dict[int, int]:
    """Lines that occur once in each of two texts: index in the base -> index in the other, in the base's order."""
    counts, others = Counter(base), Counter(other)
    places = {line: place for place, line in enumerate(other)}
    return {i: places[line] for i, line in enumerate(base) if counts[line] == 1 == others[line]}


def _heads(lines: Sequence[str], unique: Set[int]) -> list[int | None]:
    """For each line its head: the last of the unique lines before it with less indentation (at the left margin: without any).

    A line such as `return;` occurs in many functions; its head identifies the function.
    """
    found: list[int | None] = []
    indents: list[int] = []
    heads: list[int] = []
    for place, line in enumerate(lines):
        indent = len(line) - len(line.lstrip()) if line.strip() else 0
        outer = bisect_left(indents, max(indent, 1))
        found.append(heads[outer - 1] if outer else None)
        if place in unique:
            outer = bisect_left(indents, indent)
            indents[outer:], heads[outer:] = [indent], [place]
    return found


def _runs(base: Sequence[str], other: Sequence[str]) -> Iterator[tuple[int, int, int]]:
    """Matching runs of lines by patience diff, in no particular order.

    Lines that occur once in both texts are anchors, recursively between anchors. From each anchor lines are matched downwards,
    then upwards; what is left without anchors is matched by `difflib`.
    """
    work = [(0, len(base), 0, len(other))]
    while work:
        a, stop_a, b, stop_b = work.pop()
        length = _equal(base, other, range(a, stop_a), range(b, stop_b))
        if length:
            yield a, b, length
        a, b = a + length, b + length
        unique = _unique(base[a:stop_a], other[b:stop_b])
        anchors = [(a + i, b + unique[i]) for i in _rising(unique)]
        if anchors:
            starts, stops = [(a, b), *anchors], [*anchors, (stop_a, stop_b)]
            work += [(i, end_i, j, end_j) for (i, j), (end_i, end_j) in zip(starts, stops, strict=True)]
            continue
        length = _equal(base, other, range(stop_a - 1, a - 1, -1), range(stop_b - 1, b - 1, -1))
        stop_a, stop_b = stop_a - length, stop_b - length
        if length:
            yield stop_a, stop_b, length
        middle = SequenceMatcher(None, base[a:stop_a], other[b:stop_b], autojunk=False)
        yield from ((a + block.a, b + block.b, block.size) for block in middle.get_matching_blocks() if block.size)


def _equal(base: Sequence[str], other: Sequence[str], places: range, in_other: range) -> int:
    """The number of consecutive equal lines."""
    most = min(len(places), len(in_other))
    return next((n for n in range(most) if base[places[n]] != other[in_other[n]]), most)


def _rising(places: Mapping[int, int]) -> list[int]:
    """The longest increasing subsequence: the most keys whose values are in increasing order (patience sorting)."""
    tops: list[int] = []  # the smallest value that ends a choice of each length
    keys: list[int] = []
    before: dict[int, int | None] = {}
    for key, value in places.items():
        length = bisect_left(tops, value)
        tops[length : length + 1], keys[length : length + 1] = [value], [key]
        before[key] = keys[length - 1] if length else None
    found: list[int] = []
    last = keys[-1] if keys else None
    while last is not None:
        found.append(last)
        last = before[last]
    return found[::-1]


def _between(
    base: Sequence[str], ours: Sequence[str], theirs: Sequence[str], start: list[int], stop: list[int]
) -> Iterator[Chunk]:
    """The chunk between two runs of lines that neither side changed: a change, a conflict, or nothing."""
    spans = [(a, b) for a, b in zip(start, stop, strict=True)]
    was, mine, other = stretch(base, spans[0]), stretch(ours, spans[1]), stretch(theirs, spans[2])
    if not was and not mine and not other:
        return
    if mine == other:
        yield Chunk("both", *spans)
    elif mine == was:
        yield Chunk("theirs", *spans)
    elif other == was:
        yield Chunk("ours", *spans)
    else:
        yield Chunk("conflict", *spans)


def line_map(old: Sequence[str], new: Sequence[str]) -> dict[int, int]:
    """Map the line numbers of one text to those of another, for lines that are in both."""
    return {a + k: b + k for a, b, n in _blocks(old, new) for k in range(n)}
