"""From where, and how exactly, the place is known at which a motion of a driven device, such as a wheel, ends.

A program drives a device for a time, so far from its last goal, or to a place. Which of these it does can differ from motion to
motion. If it is known for each of them (the model of the library tells it), each is compared as exactly as it can be; else all
motions of a program are taken to be as vague as those that are driven for a time.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import floor
from typing import NamedTuple

from robosmi.verify.bench import BY_A_WAY, FOR_A_TIME, TO_A_PLACE

FRAME_S = 0.021
"""Servo frames are 20 ms apart, 21 ms where a program makes them itself. A change of speed takes effect in one or the next."""
WAY = 0.01
"""Durations may differ by this part, as for other events, and so may the ways that are driven for a time."""
_BEYOND = 2.0
"""A goal that is nearer than `RestKind.recounts` in one run may be this much further away in another."""


class Driven(NamedTuple):
    """How a device was driven since its previous rest.

    Attributes:
        way: the length of the path on which it was driven for a time.
        changes: the sum of all absolute changes of speed on that path, in units per second.
        last: how it was driven last, one of `robosmi.verify.bench.AIMS`.
    """

    way: float
    changes: float
    last: str


class Rest(NamedTuple):
    """A time during which a device rests.

    Attributes:
        at_ms: when it begins, in milliseconds.
        place: the position, relative to the initial one.
        way: the length of the path since the previous rest, forwards and backwards.
        changes: the sum of all absolute changes of speed on that path, in units per second.
        barely: whether another run of the same program may not rest here.
        driven: how it was driven on that path, None if that is not known.
        beyond: how far it went on without being driven, as a servo does, and a motor does not.
    """

    at_ms: float
    place: float
    way: float
    changes: float
    barely: bool = False
    driven: Driven | None = None
    beyond: float = 0.0


class RestKind(NamedTuple):
    """How the places of one device are compared.

    Attributes:
        unit: the unit of its positions.
        within: the distance within which all correct runs rest if the program drives to a place; 0 if it never does.
        timed: whether the program drives the device for a time.
        recounts: how far the last goal has to be from where the device stands for the next goal to be counted from there, by
            whole units; 0 if it is always counted from the last one.
    """

    unit: str
    within: float
    timed: bool
    recounts: float = 0.0


class Expected(NamedTuple):
    """What is compared of a rest.

    Attributes:
        places: where each run rests, relative to where its motion is compared from, the target last.
        width: the distance within which all correct runs are.
        moved: whether the places are relative to an earlier rest.
        loose: whether runs of the source may differ by more than the width.
    """

    places: list[float]
    width: float
    moved: bool
    loose: bool


class Goals:
    """Follows the rests of several runs, and says what is expected of each.

    Args:
        kind: how places are compared.
        runs: the number of runs.
    """

    def __init__(self, kind: RestKind, runs: int) -> None:
        self._kind = kind
        self._left = [0.0] * runs
        """Where the runs rested last."""
        self._ended = [0.0] * runs
        """Where they last rested at a goal."""
        self._origin = [0.0] * runs
        """Where the motions began that led to that goal, by goals only."""
        self._vague = 0.0
        """How far that goal and the next one may differ by motions for a time between them."""

    def of(self, motion: Sequence[Rest], places: Sequence[float]) -> list[Expected]:
        """What is expected of the next rest; any of it suffices.

        Args:
            motion: the rests of the nominal run that were not compared since the last one that was, and this one.
            places: where each run rests, relative to its initial place.
        """
        kind = self._kind
        driven = [each.driven for each in motion if each.driven is not None]
        if len(driven) < len(motion) or not (kind.within or driven[-1].last == FOR_A_TIME):  # of a goal nothing is known then
            if not kind.timed:
                return [Expected([*places], kind.within, moved=False, loose=False)]
            width = 2 * kind.within + _width(sum(each.changes for each in motion), sum(each.way for each in motion))
            return [self._from_rest(places, width)]
        width = _width(sum(each.changes for each in driven), sum(each.way for each in driven))
        if driven[-1].last == TO_A_PLACE:
            self._origin, self._vague = [0.0] * len(places), 0.0
            return [self._at_goal(places, self._origin, kind.within, 0.0)]
        if driven[-1].last != BY_A_WAY:
            self._vague += width
            only_timed = all(each.way <= by.way for each, by in zip(motion, driven, strict=True))
            return [self._from_rest(places, width + (0 if kind.recounts and only_timed else 2 * kind.within))]
        self._vague += width
        if not kind.recounts or not self._vague:
            return [self._at_goal(places, self._origin, kind.within, self._vague)]
        left, ended, origin = self._left, self._ended, self._origin
        if width:
            return [self._at_goal(places, left, 2 * kind.within, width)]
        found = [self._at_goal(places, [float(floor(each)) for each in left], kind.within, 0.0)]
        if any(abs(stands - last) < kind.recounts + _BEYOND for stands, last in zip(left, ended, strict=True)):
            found.append(self._at_goal(places, origin, 2 * kind.within, 0.0))
        return found

    def _from_rest(self, places: Sequence[float], width: float) -> Expected:
        """A motion that is compared from the rest before it."""
        moved = [place - left for place, left in zip(places, self._left, strict=True)]
        self._left = [*places]
        return Expected(moved, width, moved=True, loose=True)

    def _at_goal(self, places: Sequence[float], origin: Sequence[float], within: float, vague: float) -> Expected:
        """A motion that ends at a goal, which is counted from `origin`."""
        moved = [place - begin for place, begin in zip(places, origin, strict=True)]
        if self._vague:
            self._origin, self._vague = [*places], 0.0
        self._left = self._ended = [*places]
        return Expected(moved, within + vague, moved=any(origin), loose=vague > 0)


def _width(changes: float, way: float) -> float:
    """By how much two runs may differ after motions for a time."""
    return FRAME_S * changes / 2 + WAY * way
