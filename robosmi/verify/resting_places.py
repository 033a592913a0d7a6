"""Where what a program drives comes to rest between two motions: whether that is at the same places on the target.

A robot that turns by 69 degrees and not by 90 makes the same motions at nearly the same times. So the places at which its wheels
rest are compared. All right runs of a program that is told how far it went come to rest within a small width, which is known; so
a right target does so within that width of each run of the source. Where a program drives for a time, each motion is compared by
itself, and the width is what it goes in a frame of its pulses at each change of its speed, too, and a part of the way.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from robosmi.typed import paired, sum_of
from robosmi.verify.activity import LINE, ActivityEvent
from robosmi.verify.alignment import aligned
from robosmi.verify.comparison import DIFFERENT, NOT_EXERCISED, SAME, ChannelComparison, FirstDifference

_FRAME_S = 0.021
"""Frames of servos are 20 ms apart, 21 ms where a program makes them itself."""
_WAY = 0.01
"""How long something lasts may be off by so much."""


class Rest(NamedTuple):
    """That a device comes to rest.

    Attributes:
        at_ms: since when, in milliseconds.
        place: where, from where it was put down.
        way: how far it went since the rest before, back and forth.
        changes: the sum of all changes of its speed on that way, in its unit a second.
        barely: whether another run of the same program may do without it.
    """

    at_ms: float
    place: float
    way: float
    changes: float
    barely: bool = False


class RestKind(NamedTuple):
    """What is known of places at which a device rests.

    Attributes:
        unit: of its places.
        within: the width within which right runs rest that are told how far the device went; 0 where they never are.
        timed: whether the program drives it for a time.
    """

    unit: str
    within: float
    timed: bool


def compare_rests(channel: str, runs: Sequence[Sequence[Rest]], target: Sequence[Rest], kind: RestKind) -> ChannelComparison:
    """Compare the places at which a device rests, as far as the target and all runs of the source rest equally often.

    Args:
        channel: what to call it.
        runs: those of the source, the first one being that which is told.
        target: the target's.
        kind: what is known of such places.
    """
    nominal, *varied = runs
    others = [*varied, target]
    found = [dict(aligned(_events(nominal), _events(each)).pairs) for each in others]
    left = [0.0] * (len(others) + 1)
    first = compared = 0
    for number, rest in enumerate(nominal):
        if any(number not in pairs for pairs in found):
            if rest.barely:
                continue
            break
        row = [rest, *(each[pairs[number]] for each, pairs in paired(others, found))]
        if any(each.barely for each in row):
            continue
        *own, theirs = [each.place - start for each, start in paired(row, left)]
        width = kind.within
        if kind.timed:
            motion = nominal[first : number + 1]
            width = 2 * kind.within  # it may begin and end anywhere within that
            width += _FRAME_S * sum_of(each.changes for each in motion) / 2 + _WAY * sum_of(each.way for each in motion)
            left = [each.place for each in row]
        least, most = min(*own, max(own) - width), max(*own, min(own) + width)
        if not least <= theirs <= most:
            difference = _told(channel, (row[0], row[-1]), (own[0], theirs), (least, most), kind)
            return ChannelComparison(channel, DIFFERENT, difference, compared)
        first, compared = number + 1, compared + 1
    return ChannelComparison(channel, SAME if compared else NOT_EXERCISED, events=compared)


def _events(rests: Sequence[Rest]) -> list[ActivityEvent]:
    """Rests as events that all say the same: which of two runs belong together is told by their order."""
    return [ActivityEvent(1000 * rest.at_ms, LINE, ("rests",), barely=rest.barely) for rest in rests]


def _told(
    channel: str, rests: tuple[Rest, Rest], places: tuple[float, float], ends: tuple[float, float], kind: RestKind
) -> FirstDifference:
    """What is different, in words."""
    does = f"turns by {{:.1f}} {kind.unit} until it rests" if kind.timed else f"rests {{:.1f}} {kind.unit} from where it began"
    source, target = (ActivityEvent(1000 * rest.at_ms, LINE, (does.format(place),)) for rest, place in paired(rests, places))
    message = f"{target.value[0]}, instead of {places[0]:.1f} (between {ends[0]:.1f} and {ends[1]:.1f} are the same)"
    return FirstDifference(rests[0].at_ms, channel, message, source, target)
