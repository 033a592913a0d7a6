"""Describes the first events of two programs that do not correspond: late, early, missing, repeated, or different.

`comparison` finds that they differ and `alignment` which events correspond. The description has to be true for the whole runs:
an event that only comes late is not one that the other program lacks.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from msgspec import Struct

from robosmi.verify.activity import PULSES, ActivityEvent
from robosmi.verify.alignment import Alignment, alike

_MOST = 20_000
"""Limit on the events of a run that are searched."""


class ToldDifference(Struct, frozen=True):
    """A difference in words.

    Attributes:
        at_us: when it begins, in microseconds.
        message: what is different.
        source, target: the events that it is about, None for a side that has none.
    """

    at_us: float
    message: str
    source: ActivityEvent | None
    target: ActivityEvent | None


def told_difference(
    source: Sequence[ActivityEvent],
    target: Sequence[ActivityEvent],
    found: Alignment,
    in_time: Callable[[int, int], bool],
    allowed_ms: Callable[[int], float],
) -> ToldDifference:
    """Describe the first events without a counterpart.

    Args:
        source, target: the events of both programs, at least one of which has events without a counterpart.
        found: the alignment of these events.
        in_time: whether an event of the source and one of the target, given by their indices, are close enough in time.
        allowed_ms: the time tolerance of an event of the source, given by its index, in milliseconds.
    """
    sides = _Sides(source, target, found, in_time)
    mine = source[found.own] if found.own < len(source) else None
    theirs = target[found.other] if found.other < len(target) else None
    if mine is not None and theirs is not None:
        moved = alike(mine, theirs)
        lost, more = sides.met_elsewhere(found.other), sides.is_elsewhere(found.own)
        if lost and more and not moved:
            return ToldDifference(theirs.at_us, f"{theirs} before {mine}, not after it", mine, theirs)
        if lost and not more:
            return ToldDifference(mine.at_us, _missing(mine), mine, theirs)
        if more and not lost:
            return ToldDifference(theirs.at_us, sides.more(theirs), mine, theirs)
        if not moved:
            return ToldDifference(mine.at_us, f"{theirs} instead of {mine}", mine, theirs)
        return _moved(mine, theirs, allowed_ms(found.own))
    if mine is None:
        assert theirs is not None
        place = sides.nearest(theirs, source, sides.paired_source)
        return _moved(source[place], theirs, allowed_ms(place)) if place is not None else ToldDifference(
            theirs.at_us, sides.more(theirs), None, theirs
        )  # fmt: skip
    place = sides.nearest(mine, target, sides.paired_target)
    if place is not None:
        return _moved(mine, target[place], allowed_ms(found.own))
    return ToldDifference(mine.at_us, _missing(mine), mine, None)


def lasts_otherwise(event: ActivityEvent, source_ms: float, target_ms: float) -> str:
    """The message that something lasts too long or too short."""
    verb = "last" if event.kind == PULSES else "lasts"
    return f"{event} {verb} {target_ms:.2f} ms instead of {source_ms:.2f} ms"


class _Sides(Struct, frozen=True):
    """Both runs, and which of their events belong together."""

    source: Sequence[ActivityEvent]
    target: Sequence[ActivityEvent]
    found: Alignment
    in_time: Callable[[int, int], bool]

    @property
    def paired_source(self) -> set[int]:
        return {own for own, _ in self.found.pairs}

    @property
    def paired_target(self) -> set[int]:
        return {other for _, other in self.found.pairs}

    def met_elsewhere(self, other: int) -> bool:
        """Whether an event of the target matches a later event of the source in value and time."""
        return any(self._fit(own, other) for own in range(self.found.own + 1, min(len(self.source), self.found.own + _MOST)))

    def is_elsewhere(self, own: int) -> bool:
        """Whether an event of the source matches a later event of the target in value and time."""
        return any(
            self._fit(own, other) for other in range(self.found.other + 1, min(len(self.target), self.found.other + _MOST))
        )

    def _fit(self, own: int, other: int) -> bool:
        return self.in_time(own, other) and alike(self.source[own], self.target[other])

    def nearest(self, event: ActivityEvent, events: Sequence[ActivityEvent], paired: set[int]) -> int | None:
        """The index of the unpaired event with the same value that is nearest in time; None if there is none."""
        free = [number for number, each in enumerate(events[:_MOST]) if number not in paired and alike(each, event)]
        return min(free, key=lambda number: abs(events[number].at_us - event.at_us), default=None)

    def more(self, event: ActivityEvent) -> str:
        """The message that the target does something which the source does not do, at all or at that time."""
        if any(alike(each, event) for each in self.source[1:_MOST]):
            return f"{event} once more, which the source does not do then"
        return f"{event}, which the source does not do"


def _missing(event: ActivityEvent) -> str:
    return f"{event} {'are' if event.kind == PULSES else 'is'} missing"


def _moved(mine: ActivityEvent, theirs: ActivityEvent, allowed_ms: float) -> ToldDifference:
    dt = (theirs.at_us - mine.at_us) / 1000
    verb = "come" if mine.kind == PULSES else "comes"
    message = f"{mine} {verb} {abs(dt):.1f} ms too {'late' if dt > 0 else 'early'} (allowed are {allowed_ms:.1f} ms)"
    return ToldDifference(min(mine.at_us, theirs.at_us) if dt < 0 else mine.at_us, message, mine, theirs)
