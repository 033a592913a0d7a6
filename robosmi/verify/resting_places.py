"""Comparing the places at which driven devices, such as wheels, rest between two motions.

A robot that turns by 69 degrees instead of 90 makes the same motions at nearly the same times, so the places at which its wheels
rest are compared. If the program drives to a place by what its encoders report, all correct runs rest within a known distance
of each other, so a correct target rests within that distance of each run of the source. If the program drives for a time, each
motion is compared separately, and the distance that the device covers in one servo frame at each change of speed, and a
percentage of the path, are allowed as well.
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
_LEAST_MARGIN = 0.2
"""The part of the allowed distance that the target may differ beyond runs of the source that differ by all of it."""
_LATE_MS = 500.0
"""A rest that begins later or earlier than in all runs of the source by more than this and `_WAY` is another rest."""
_WAY = 0.01
"""Durations may differ by this part, as for other events."""


class Rest(NamedTuple):
    """A time during which a device rests.

    Attributes:
        at_ms: when it begins, in milliseconds.
        place: the position, relative to the initial one.
        way: the length of the path since the previous rest, forwards and backwards.
        changes: the sum of all absolute changes of speed on that path, in units per second.
        barely: whether another run of the same program may not rest here.
    """

    at_ms: float
    place: float
    way: float
    changes: float
    barely: bool = False


class RestKind(NamedTuple):
    """How the places of one device are compared.

    Attributes:
        unit: the unit of its positions.
        within: the distance within which all correct runs rest if the program drives to a place; 0 if it never does.
        timed: whether the program drives the device for a time, so that each motion is compared separately.
    """

    unit: str
    within: float
    timed: bool


def compare_rests(channel: str, runs: Sequence[Sequence[Rest]], target: Sequence[Rest], kind: RestKind) -> ChannelComparison:
    """Compare the places at which a device rests, up to the first rest that not all runs have.

    Args:
        channel: the name of the channel.
        runs: the rests in each run of the source, the nominal run first.
        target: the rests of the migrated program.
        kind: how they are compared.
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
            width = 2 * kind.within  # the motion may begin and end anywhere within it
            width += _FRAME_S * sum_of(each.changes for each in motion) / 2 + _WAY * sum_of(each.way for each in motion)
            left = [each.place for each in row]
        spread = max(own) - min(own)
        if (spread > 2 * width and not kind.timed) or not _in_time(row):
            break  # these are not the same rests
        margin = max(width - spread, _LEAST_MARGIN * width)
        least, most = min(own) - margin, max(own) + margin
        if not least <= theirs <= most:
            difference = _told(channel, (row[0], row[-1]), (own[0], theirs), (least, most), kind)
            return ChannelComparison(channel, DIFFERENT, difference, compared)
        first, compared = number + 1, compared + 1
    return ChannelComparison(channel, SAME if compared else NOT_EXERCISED, events=compared)


def _in_time(row: Sequence[Rest]) -> bool:
    """Whether the target, which is the last one, begins to rest at about the same time as the runs of the source."""
    *own, theirs = [rest.at_ms for rest in row]
    late_ms = _LATE_MS + _WAY * max(own)
    return min(own) - late_ms <= theirs <= max(own) + late_ms


def _events(rests: Sequence[Rest]) -> list[ActivityEvent]:
    """Rests as equal events, so that the rests of two runs are matched by their order."""
    return [ActivityEvent(1000 * rest.at_ms, LINE, ("rests",), barely=rest.barely) for rest in rests]


def _told(
    channel: str, rests: tuple[Rest, Rest], places: tuple[float, float], ends: tuple[float, float], kind: RestKind
) -> FirstDifference:
    """The difference, with a message that states both places and the tolerance."""
    does = f"turns by {{:.1f}} {kind.unit} until it rests" if kind.timed else f"rests {{:.1f}} {kind.unit} from where it began"
    source, target = (ActivityEvent(1000 * rest.at_ms, LINE, (does.format(place),)) for rest, place in paired(rests, places))
    message = f"{target.value[0]}, instead of {places[0]:.1f} (between {ends[0]:.1f} and {ends[1]:.1f} are the same)"
    return FirstDifference(rests[0].at_ms, channel, message, source, target)
