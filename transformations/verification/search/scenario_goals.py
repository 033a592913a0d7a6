"""The goals of a search for scenarios besides lines and branches of the source: sequences of events, and extreme values.

Reaching a branch once shows little: a robot that stops should be seen stopping from each of its motions, and going on after it.
So each two or three events that follow one another on a channel are a goal. Further goals are values at both sides of a border
between two ways of the program, a button that is pressed again and again, all keys and commands in sequence, and the least and
the greatest values of a device, since numbers have their longest texts there and some a sign; so is each text in which a number
is negative, or beyond 16 bits.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from robosmi.transformations.verification.original_side import ChannelEvents, Place
from robosmi.verify.traces.activity import BURST, HELD, LEVEL, LINE, PULSES, READING, WAVE, ActivityEvent

THEN, BESIDE, ENDS, SERIES, NEGATIVE, LARGE = "then", "beside", "ends", "series", "negative", "large"
UNDISTURBED = "undisturbed"
VALUE = "value"
"""First item of places that are no goals, but show which way a program takes."""
GOALS = (THEN, BESIDE, ENDS, SERIES, NEGATIVE, LARGE, UNDISTURBED)
"""First items of goals that are no places of the source."""
_NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
_LARGEST = 32767
_BEYOND = "99999"
"""Replaces a number beyond 16 bits in a text."""
_MOST_ON_A_CHANNEL = 24
"""Most goals of a kind on one channel: a program that always prints something new would keep the search busy forever."""


def behaviour(seen: ChannelEvents) -> frozenset[Place]:
    """Each two or three successive events of a channel, and each text in which a number is negative or beyond 16 bits.

    As ("then", channel, event, event, event), ("negative", channel, text) and ("large", channel, text).

    Args:
        seen: the events of each channel in a run.
    """
    found: set[Place] = set()
    for name, (events, *_) in seen.items():
        told = [_short(event) for event in events]
        then: list[Place] = [(THEN, name, *each) for each in (*pairwise(told), *zip(told, told[1:], told[2:], strict=False))]
        found.update(list(dict.fromkeys(then))[:_MOST_ON_A_CHANNEL])
        texts = [_NUMBER.sub(_signed_zero, str(event.value[0])) for event in events if event.kind in (LINE, READING)]
        negative: list[Place] = [(NEGATIVE, name, text) for text in texts if "-0" in text]
        found.update(list(dict.fromkeys(negative))[:_MOST_ON_A_CHANNEL])
        texts = [_NUMBER.sub(_sized, str(event.value[0])) for event in events if event.kind in (LINE, READING)]
        large: list[Place] = [(LARGE, name, text) for text in texts if _BEYOND in text]
        found.update(list(dict.fromkeys(large))[:_MOST_ON_A_CHANNEL])
    return frozenset(found)


def shown_values(seen: ChannelEvents) -> frozenset[Place]:
    """The levels of each channel, and its texts in which all numbers other than 0 and 1 are alike.

    As ("value", channel, text). They show the result of a comparison that is no branch; other numbers are made alike because a
    measured one differs with each value of an input.

    Args:
        seen: the events of each channel in a run.
    """
    return frozenset(
        (VALUE, name, _NUMBER.sub(_yes_or_no, f"{event.kind} {event.value[0]}"))
        for name, (events, *_) in seen.items()
        for event in events
        if event.kind in (LEVEL, HELD, LINE, READING)
    )


def final_values(seen: ChannelEvents) -> dict[str, str]:
    """What each channel does at the end, with measured numbers made alike: the state that an input has left the program in."""
    return {name: _short(events[-1]) if events else "" for name, (events, *_) in seen.items()}


def _yes_or_no(number: re.Match[str]) -> str:
    return number[0] if number[0] in ("0", "1") else "2"


def shown(seen: ChannelEvents) -> dict[str, list[str]]:
    """What a program does on each channel, without times: this shows whether it reacts to an input."""
    return {name: [str(event) for event in events] for name, (events, *_) in seen.items()}


def _signed_zero(number: re.Match[str]) -> str:
    return "-0" if number[0].startswith("-") else "0"


def _sized(number: re.Match[str]) -> str:
    return _BEYOND if abs(float(number[0])) >= _LARGEST + 1 else "0"


def _short(event: ActivityEvent) -> str:
    """Text of an event in which measured numbers are made alike, so that they make no new goals."""
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


def near_threshold(border: float, facts: Mapping[str, Any], near: tuple[float, float] | None = None) -> tuple[float, float]:
    """Values at both sides of a border, as near to it as boards that measure differently allow.

    Args:
        border: the value at which the source takes another way.
        facts: facts of the device that shows the values: `near_percent`, by how many per cent they differ from the border (100:
            half and twice); `rounded_to`, to what programs round them; `off_least`, within which two boards measure the same
            value.
        near: per cent and an addition instead, if the port has them.
    """
    percent, more = near or (float(facts.get("near_percent", 10)), 0.0)
    factor = 1 + percent / 100
    sides = max(0.0, border / factor - more) if more else border / factor, border * factor + more
    step, off = float(facts.get("rounded_to", 0)), float(facts.get("off_least", 0))
    sure = off + border * float(facts.get("off_percent", 0)) / 100
    return (_clear(sides[0], border, step, off, sure), _clear(sides[1], border, step, off, sure)) if step else sides


def _clear(value: float, border: float, step: float, off: float, sure: float) -> float:
    """A value beside a border that two boards round alike: if a multiple of the step is too near, halfway to the next.

    ... %value the value beside the border. %border the value at which the source takes another way. %step the step to whose
    multiples programs round.
    """
    whole = round(value / step) * step
    if abs(value - whole) >= off:
        return value
    above = 1 if value > border else -1
    halfway = [each for each in (whole - step / 2, whole + step / 2) if above * (each - border) >= sure]
    return min(halfway, key=lambda each: abs(each - border), default=value)
