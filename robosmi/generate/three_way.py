"""Three-way merge of texts by lines: what a person changed and what the generator changed since the same base.

The algorithm is diff3's: lines that both sides left alone are where they meet; between such lines, a side that did not change
gives way, and both having changed is a conflict unless they changed alike. Matching lines are found by Python's `difflib`.
(The `merge3` package does the same but its licence, GPL, does not fit; `three-merge` merges characters and marks no conflicts.)
Source: S. Khanna, K. Kunal, B. C. Pierce, A Formal Investigation of Diff3, FSTTCS 2007.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from difflib import SequenceMatcher

Span = tuple[int, int]


@dataclass(frozen=True)
class Chunk:
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


def chunks(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]) -> list[Chunk]:
    """The stretches of three texts, in order, without gaps.

    Args:
        base: lines of the text that both started from.
        ours: lines of the person's.
        theirs: lines of the generator's.
    """
    found: list[Chunk] = []
    at = [0, 0, 0]
    for start, length, in_ours, in_theirs in _meeting(base, ours, theirs):
        found += _between(base, ours, theirs, at, [start, in_ours, in_theirs])
        if length:
            spans = [(p, p + length) for p in (start, in_ours, in_theirs)]
            found.append(Chunk("same", *spans))
        at = [start + length, in_ours + length, in_theirs + length]
    return found


def _meeting(base: Sequence[str], ours: Sequence[str], theirs: Sequence[str]) -> Iterator[tuple[int, int, int, int]]:
    """Runs of lines that both sides kept: place in the base, length, place in ours, in theirs; an empty one at the end."""
    left = _blocks(base, ours)
    right = _blocks(base, theirs)
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
    """Matching runs: place in the base, place in the other, length."""
    head = 0
    while head < min(len(base), len(other)) and base[head] == other[head]:
        head += 1
    tail = 0
    while tail < min(len(base), len(other)) - head and base[-1 - tail] == other[-1 - tail]:
        tail += 1
    middle = SequenceMatcher(None, base[head : len(base) - tail], other[head : len(other) - tail], autojunk=False)
    found = [(0, 0, head)] if head else []
    found += [(block.a + head, block.b + head, block.size) for block in middle.get_matching_blocks() if block.size]
    return [*found, (len(base) - tail, len(other) - tail, tail)] if tail else found


def _between(
    base: Sequence[str], ours: Sequence[str], theirs: Sequence[str], start: list[int], stop: list[int]
) -> Iterator[Chunk]:
    """What lies between two runs that both kept."""
    spans = [(a, b) for a, b in zip(start, stop, strict=True)]
    was, mine, other = base[slice(*spans[0])], ours[slice(*spans[1])], theirs[slice(*spans[2])]
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
    """Where lines of one text stand in another: index -> index, for those that are in both."""
    return {a + k: b + k for a, b, n in _blocks(old, new) for k in range(n)}
