"""Lines and branches of the source that no scenario has reached, as the user reads them: ranges of lines by file."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from pathlib import Path

SHOWN = 12
"""Limit on the ranges shown, unless all are requested."""


def line_ranges(missed: Collection[tuple[str, int]], known: Iterable[tuple[str, int]]) -> list[str]:
    """Lines as `file:3` and `file:5-9`, by file and line.

    Args:
        missed: file and line of each.
        known: all lines with code: what stands between two missed lines and has none parts no range.
    """
    found: list[list[tuple[str, int]]] = []
    last_missed = False
    for place in sorted(set(known)):
        if place in missed:
            if last_missed and found[-1][-1][0] == place[0]:
                found[-1].append(place)
            else:
                found.append([place])
        last_missed = place in missed
    return [_range(places) for places in found]


def _range(places: Sequence[tuple[str, int]]) -> str:
    (file, first), (_, last) = places[0], places[-1]
    return f"{Path(file).name}:{first}" + (f"-{last}" if last > first else "")


def format_ranges(places: Sequence[str], whole: bool = False) -> str:
    """Places in one line, each file named once, as `a.c:3, 5-9; b.c:2`.

    Args:
        places: as `file:line` or `file:first-last`; several of one place are listed once.
        whole: whether to tell all of them, however many there are.
    """
    listed = list(dict.fromkeys(places))
    shown = listed if whole or len(listed) <= SHOWN + 1 else listed[:SHOWN]
    by_file: dict[str, list[str]] = {}
    for place in shown:
        file, _, lines = place.rpartition(":")
        by_file.setdefault(file, []).append(lines)
    text = "; ".join(f"{file}:{', '.join(lines)}" for file, lines in by_file.items())
    return text if len(shown) == len(listed) else f"{text} and {len(listed) - len(shown)} more (verify -v shows all)"
