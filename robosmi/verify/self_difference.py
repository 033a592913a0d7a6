"""Where runs of the source differ from each other on a channel, and what can still be compared there.

Before the first such place the source is as reliable as on any other channel. After it, lines of text are that all of its runs
print identically, as long as all runs print lines of the same shape (the text without its numbers) in the same order. Their
times are not compared, since these vary, too. Reliable channels are compared by `comparison`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from robosmi.data_text import Json
from robosmi.verify.activity import LINE, READING, ActivityEvent
from robosmi.verify.alignment import aligned, alike, shape_of


class SelfDifference(NamedTuple):
    """The first place where two runs of the source do something else on a channel.

    Attributes:
        at_ms: when, in milliseconds; the earlier one of what both do.
        nominal, varied: what the source does, and what it does with other costs or inputs; None where it does nothing more.
    """

    at_ms: float
    nominal: ActivityEvent | None
    varied: ActivityEvent | None

    def __str__(self) -> str:
        own, other = (f"{each} at {each.at_us / 1000:.1f} ms" if each else "nothing more" for each in (self.nominal, self.varied))
        return f"{own}, or {other}"

    def to_json(self) -> dict[str, Json]:
        """The contract's form."""
        return {"at_ms": round(self.at_ms, 3), "source": _said(self.nominal), "again": _said(self.varied)}


def _said(event: ActivityEvent | None) -> Json:
    return None if event is None else {"at_ms": round(event.at_us / 1000, 3), "what": str(event)}


def first_self_difference(source: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]]) -> SelfDifference | None:
    """The earliest place where a varied run has something else than the nominal one, or something more or less."""
    found = []
    for run in varied:
        both = aligned(source, run)
        own = source[both.own] if both.own < len(source) else None
        other = run[both.other] if both.other < len(run) else None
        times = [event.at_us / 1000 for event in (own, other) if event is not None]
        if times:
            found.append(SelfDifference(min(times), own, other))
    return min(found, key=lambda each: each.at_ms, default=None)


class WrongLine(NamedTuple):
    """A line that each run of the source prints, and what the target prints instead."""

    source: ActivityEvent
    target: ActivityEvent


def first_wrong_line(
    source: Sequence[ActivityEvent], target: Sequence[ActivityEvent], varied: Sequence[Sequence[ActivityEvent]]
) -> WrongLine | None:
    """The first line with other numbers than each run of the source prints there; None where nothing can be said.

    What is compared ends with the first line whose shape is not that of all runs of the source, and of the target. Lines of a
    shape that has other numbers in any run are not compared at all.
    """
    runs = [source, *varied]
    rows = []
    for row in zip(*[*runs, target], strict=False):
        if any(event.kind not in (LINE, READING) for event in row) or len({shape_of(event) for event in row}) > 1:
            break
        rows.append(row)
    wobbling = {shape_of(row[0]) for row in rows if any(not alike(row[0], again) for again in row[1:-1])}
    for row in rows:
        if shape_of(row[0]) not in wobbling and not alike(row[0], row[-1]):
            return WrongLine(row[0], row[-1])
    return None
