"""Cycles of includes in a program without an include guard that would end them.

The reader breaks such cycles (`headers`); a compiler gives up. Includes under a condition may end and are not judged.
"""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.headers import guarded

CIRCLE = "RS114"
_OPENS = ("if", "ifdef", "ifndef")


def circles(units: Sequence[ccode.SourceUnit], contexts: Sequence[UnitContext]) -> None:
    """Add a finding RS114 for each file that includes itself, directly or not, at the first include of the cycle.

    Args:
        units: the files of the program.
        contexts: the context that each was built with, in the same order; they collect the findings.
    """
    again = {
        os.path.realpath(str(unit.path)): (unit, contexts[number])
        for number, unit in enumerate(units)
        if unit.includes and not guarded(contexts[number].source.parsed)
    }
    ways = {
        place: {_meant(include, place, context.include_dirs): include for include in reversed(_always(unit))}
        for place, (unit, context) in again.items()
    }
    behind = {place: _reached(place, ways) for place in ways}
    for place, (_, context) in again.items():
        if place in behind[place]:
            together = [other for other in behind[place] if place in behind.get(other, ())]
            first = min((include for end, include in ways[place].items() if end in together), key=_start)
            _tell(context, first, sorted(os.path.basename(each) for each in together))


def _reached(place: str, ways: Mapping[str, Mapping[str, ccode.Include]]) -> set[str]:
    """The files that a file includes, directly or not."""
    found: set[str] = set()
    pending = [place]
    while pending:
        new = ways.get(pending.pop(), {}).keys() - found
        found |= new
        pending.extend(new)
    return found


def _start(element: ccode.Include | ccode.PreprocessorConditional) -> int:
    return int(element.startOffset)


def _always(unit: ccode.SourceUnit) -> list[ccode.Include]:
    """The includes of a file that are under no conditional directive."""
    turns = [(_start(each), (each.directive in _OPENS) - (each.directive == "endif")) for each in unit.conditionals]
    return [each for each in unit.includes if not sum(turn for place, turn in turns if place < _start(each))]


def _meant(include: ccode.Include, place: str, folders: Sequence[str]) -> str:
    """The path of the included file, found as a compiler does if the reader has cut the include; empty if there is none."""
    beside = [] if include.system else [os.path.dirname(place)]
    places = (os.path.join(folder, str(include.header)) for folder in (*beside, *folders))
    known = include.resolvedPath or next((each for each in places if os.path.isfile(each)), None)
    return os.path.realpath(str(known)) if known else ""


def _tell(context: UnitContext, include: ccode.Include, together: Sequence[str]) -> None:
    what = (
        "the file includes itself"
        if len(together) == 1
        else f"the include of {include.header} comes back to this file ({', '.join(together)})"
    )
    message = f"{what}, and nothing keeps it from being read again without end: no compiler takes that"
    fix = "put `#pragma once` at the top of the headers, or take the include out"
    context.find(CIRCLE, Severity.error, message, _start(include), int(include.endOffset), fix)
