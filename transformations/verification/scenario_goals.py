"""What a search for scenarios is after, beside the lines and branches of the source: what the program does one after the other.

A branch that was taken once, for the first time, says little: a robot that stops is to be seen stopping from each of its
motions, and going on after it. So each three things that follow one another on a channel are a goal, and values at the sides of a
border between two ways of the program. A button that is pressed again and again, and all keys and commands one after the other,
are one. What a device can show at the most and at the least is one, since numbers have their
longest texts there and some a sign; so is each text in which a number is negative, or beyond 16 bits.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Any

from robosmi.transformations.verification.original_side import Place, channel_events
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.typed import distinct, in_threes
from robosmi.verify.activity import BURST, HELD, LEVEL, LINE, PULSES, READING, WAVE, ActivityEvent
from robosmi.verify.original_run import OriginalRun

THEN, BESIDE, ENDS, SERIES, NEGATIVE, LARGE = "then", "beside", "ends", "series", "negative", "large"
VALUE = "value"
"""What places begin with that are no goals, but tell which way a program goes."""
GOALS = (THEN, BESIDE, ENDS, SERIES, NEGATIVE, LARGE)
"""What goals that are no places of the source begin with."""
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_LARGEST = 32767
_BEYOND = "99999"
"""What stands for a number beyond 16 bits."""
_MOST_ON_A_CHANNEL = 24
"""A program that prints or plays something else all the time is not to be followed for ever."""


def behaviour(run: OriginalRun, ports: Sequence[BoundPort]) -> frozenset[Place]:
    """Each two and three things that follow one another on a channel, and each text in which a number is negative.

    As ("then", channel, what, what, what), ("negative", channel, text) and ("large", channel, text).
    """
    found: set[Place] = set()
    for name, (events, *_) in channel_events(run.trace, ports, target=False).items():
        told = [_short(event) for event in events]
        then: list[Place] = [
            (THEN, name, *each) for each in (*pairwise(told), *in_threes(told, told[1:], told[2:], strict=False))
        ]
        found.update(distinct(then)[:_MOST_ON_A_CHANNEL])
        texts = [_NUMBER.sub(_signed_zero, str(event.value[0])) for event in events if event.kind in (LINE, READING)]
        negative: list[Place] = [(NEGATIVE, name, text) for text in texts if "-0" in text]
        found.update(distinct(negative)[:_MOST_ON_A_CHANNEL])
        texts = [_NUMBER.sub(_sized, str(event.value[0])) for event in events if event.kind in (LINE, READING)]
        large: list[Place] = [(LARGE, name, text) for text in texts if _BEYOND in text]
        found.update(distinct(large)[:_MOST_ON_A_CHANNEL])
    return frozenset(found)


def values_told(run: OriginalRun, ports: Sequence[BoundPort]) -> frozenset[Place]:
    """The levels of each channel, and its texts with 0 and 1 as the only numbers: what a comparison gives that is no branch.

    As ("value", channel, what). Other numbers stand for each other: a measured one differs with each value of an input.
    """
    return frozenset(
        (VALUE, name, _NUMBER.sub(_yes_or_no, f"{event.kind} {event.value[0]}"))
        for name, (events, *_) in channel_events(run.trace, ports, target=False).items()
        for event in events
        if event.kind in (LEVEL, HELD, LINE, READING)
    )


def _yes_or_no(number: re.Match[str]) -> str:
    return number[0] if number[0] in ("0", "1") else "2"


def shown(run: OriginalRun, ports: Sequence[BoundPort]) -> dict[str, list[str]]:
    """What a program does on each channel, without times: whether it heeds what an input shows."""
    return {
        name: [str(event) for event in events] for name, (events, *_) in channel_events(run.trace, ports, target=False).items()
    }


def _signed_zero(number: re.Match[str]) -> str:
    return "-0" if number[0].startswith("-") else "0"


def _sized(number: re.Match[str]) -> str:
    return _BEYOND if abs(float(number[0])) >= _LARGEST + 1 else "0"


def _short(event: ActivityEvent) -> str:
    """What an event says, so that measured numbers make no new goals."""
    value = event.value[0]
    if event.kind in (LINE, READING):
        return _NUMBER.sub("0", str(value))
    if event.kind == PULSES:
        return f"{event.kind} {round(float(value) / 10)}"
    if event.kind == WAVE:
        return f"{event.kind} {round(20 * math.log(max(1.0, float(value))))}"
    if event.kind == BURST:
        return event.kind
    return f"{event.kind} {value}" if event.kind in (LEVEL, HELD) else str(event)


def beside(border: float, facts: Mapping[str, Any], near: tuple[float, float] | None = None) -> tuple[float, float]:
    """Values at both sides of a border, as near to it as boards that measure differently allow.

    Args:
        border: where the source goes another way.
        facts: of the device that shows the values: `near_percent`, by how many per cent they are off; 100 is half and twice.
            `rounded_to`, to what programs round the values, and `off_least`, within which two boards measure the same value.
        near: by how many per cent and by how much more, where the port says it instead.
    """
    percent, more = near or (float(facts.get("near_percent", 10)), 0.0)
    factor = 1 + percent / 100
    sides = max(0.0, border / factor - more) if more else border / factor, border * factor + more
    step, off = float(facts.get("rounded_to", 0)), float(facts.get("off_least", 0))
    sure = off + border * float(facts.get("off_percent", 0)) / 100
    return (_clear(sides[0], border, step, off, sure), _clear(sides[1], border, step, off, sure)) if step else sides


def _clear(value: float, border: float, step: float, off: float, sure: float) -> float:
    """A value beside a border that two boards round alike: where it is too near to a multiple of the step, halfway to the next.

    Of the two such values it is the one nearer to the border that is further from it than two boards differ.

    Args:
        value: beside the border.
        border: where the source goes another way.
        step: programs round to its multiples.
        off: the distance from a multiple below which two boards may round differently.
        sure: the distance from the border beyond which both boards are on the same side of it.
    """
    whole = round(value / step) * step
    if abs(value - whole) >= off:
        return value
    above = 1 if value > border else -1
    halfway = [each for each in (whole - step / 2, whole + step / 2) if above * (each - border) >= sure]
    return min(halfway, key=lambda each: abs(each - border), default=value)
