"""Which events of two runs belong together: those that say the same, in the same order.

A servo may show what it was told for too short a time in one run and not at all in another, as the frames fall, and a wheel that
turns round at a mark of its way may stay short of it: such an event needs no counterpart. Whether what belongs together comes in
time, and lasts as long, is `comparison`'s to judge.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from msgspec import Struct

from robosmi.typed import matches, paired
from robosmi.verify.activity import HELD, PULSE, PULSES, READING, WAVE, ActivityEvent
from robosmi.verify.driven_lines import lengths_alike, pulses_alike
from robosmi.verify.servo_widths import tolerated_us

_HZ = 0.015
_NUMBERS = 0.01
_NUMBER = re.compile(r"(?<![\w.])-?\d{1,15}(?:\.\d{1,15})?(?![\w.])")
_DUTY = 0.02
_FASTEST_HZ = 5_000.0
"""Edges that a program makes itself faster than this are only counted: nothing is claimed of how fast the source makes them."""
_FEW_FRAMES = 2
"""So few frames of a servo may be one less, which is not seen, where the other side's frames begin at another time."""
_MOST_STEPS = 200_000


def alike(one: ActivityEvent, other: ActivityEvent) -> bool:
    """Whether two events say the same, within what can be told apart."""
    if one.pulses and other.pulses and (one.kind != other.kind or float(one.value[0]) > _FASTEST_HZ):
        return one.pulses == other.pulses
    if one.kind != other.kind:
        return False
    if one.kind == WAVE:
        (hz, duty), (other_hz, other_duty) = one.value, other.value
        loose = one.off[0] if one.off else other.off[0] if other.off else 0.0
        near = abs(float(hz) - float(other_hz)) <= (_HZ + loose) * max(float(hz), float(other_hz))
        return near and abs(float(duty) - float(other_duty)) <= _DUTY
    if one.kind == PULSES:
        return abs(float(one.value[0]) - float(other.value[0])) <= tolerated_us(float(one.value[0]))
    if one.kind == HELD:
        return one.value[0] == other.value[0] and lengths_alike(float(one.value[1]), float(other.value[1]))
    if one.kind == PULSE:
        return one.value[0] == other.value[0] and pulses_alike(float(one.value[1]), float(other.value[1]))
    if one.kind == READING:
        told = one if one.exact or one.off else other
        return _reads_alike(str(one.value[0]), str(other.value[0]), told)
    return one.value == other.value


def _reads_alike(one: str, other: str, told: ActivityEvent) -> bool:
    """Whether two lines are the same, but for numbers that are off by one in their last digit, or by 1 %: measured values.

    Where it is known between which numbers a measured one lies, that counts instead.

    Args:
        one, other: the lines.
        told: the event that tells of each number by what part more it may be off, whether it is none that is measured, and
            between which numbers it lies.
    """
    if one == other:
        return True
    if _NUMBER.sub("0", one) != _NUMBER.sub("0", other):
        return False
    for place, (mine, theirs) in enumerate(paired(matches(_NUMBER, one), matches(_NUMBER, other))):
        if mine == theirs:
            continue
        if (place < len(told.exact) and told.exact[place]) or not _written_alike(mine, theirs):
            return False
        off = told.off[place] if place < len(told.off) else 0.0
        between = told.between[place] if place < len(told.between) else None
        if between is None:
            step = 10.0 ** -len(mine.partition(".")[2])
            by = max(1.001 * step, (_NUMBERS + off) * abs(float(mine)))
            between = float(mine) - by, float(mine) + by
        else:
            between = between[0] - off * abs(float(mine)), between[1] + off * abs(float(mine))
        if not between[0] <= float(theirs) <= between[1]:
            return False
    return True


def _written_alike(mine: str, theirs: str) -> bool:
    """Whether two numbers have as many decimals, and as many digits where one is filled up with zeros."""
    if float(mine) == float(theirs) != 0:
        return False
    if len(mine.partition(".")[2]) != len(theirs.partition(".")[2]):
        return False
    digits = [each.lstrip("-").partition(".")[0] for each in (mine, theirs)]
    filled = any(len(each) > 1 and each.startswith("0") for each in digits)
    return not filled or len(digits[0]) == len(digits[1])


def numbers_of(event: ActivityEvent) -> list[str]:
    """The numbers in a text."""
    return matches(_NUMBER, str(event.value[0]))


def shape_of(event: ActivityEvent) -> str:
    """A text without its numbers."""
    return _NUMBER.sub("0", str(event.value[0]))


def parts_off(one: ActivityEvent, other: ActivityEvent) -> tuple[float, ...]:
    """By what part of itself a wave's frequency, or each number of a reading, is off in an event that says the same."""
    if one.kind == other.kind == WAVE:
        return (_part(float(one.value[0]), float(other.value[0])),)
    if one.kind == other.kind == READING:
        mine, theirs = numbers_of(one), numbers_of(other)
        return tuple(_part(float(mine[at]), float(theirs[at])) for at in range(min(len(mine), len(theirs))))
    return ()


def larger(one: tuple[float, ...], other: tuple[float, ...]) -> tuple[float, ...]:
    """The larger of each two parts; what only one has is that one's."""
    longer, shorter = (one, other) if len(one) >= len(other) else (other, one)
    return tuple(max(part, shorter[at]) if at < len(shorter) else part for at, part in enumerate(longer))


def _part(one: float, other: float) -> float:
    return abs(one - other) / max(abs(one), abs(other)) if one != other else 0.0


class Alignment(Struct, frozen=True):
    """Which events of two runs correspond.

    Attributes:
        pairs: numbers of the events of both runs, without those that repeat what was said before something too short.
        own, other: the numbers of the first events that have no counterpart; the lengths of the runs where all have.
    """

    pairs: list[tuple[int, int]]
    own: int
    other: int


def aligned(
    own: Sequence[ActivityEvent], other: Sequence[ActivityEvent], fitting: Callable[[int, int], bool] | None = None
) -> Alignment:
    """Find which events of two runs correspond: the longest common sequence.

    Args:
        own, other: the events.
        fitting: whether two events that say the same may belong together, by their numbers; all may if None.
    """
    best = ((-1, 0), 0, 0, None)  # type: tuple[tuple[int, int], int, int, _Way | None]
    waiting: list[tuple[int, int, _Way | None]] = [(0, 0, None)]
    seen: set[tuple[int, int, int, int]] = set()
    while waiting and len(seen) < _MOST_STEPS:
        first, second, way = waiting.pop()
        last = (way.pair[0], way.pair[1]) if way is not None else (-1, -1)
        if (first, second, *last) in seen:
            continue
        seen.add((first, second, *last))
        reached = (first + second, way.length if way is not None else 0)
        if reached > best[0]:
            best = (reached, first, second, way)
        if first == len(own) and second == len(other):
            break
        if second < len(other) and _needless(other, second, last[1]):
            waiting.append((first, second + 1, way))
        if first < len(own) and _needless(own, first, last[0]):
            waiting.append((first + 1, second, way))
        both = first < len(own) and second < len(other)
        if both and alike(own[first], other[second]) and (fitting is None or fitting(first, second)):
            waiting.append((first + 1, second + 1, _Way((first, second), way, (way.length if way is not None else 0) + 1)))
    return Alignment(_pairs(best[3]), best[1], best[2])


class _Way(Struct, frozen=True):
    """A pair and those before it."""

    pair: tuple[int, int]
    before: _Way | None
    length: int


def _pairs(way: _Way | None) -> list[tuple[int, int]]:
    found = []
    while way is not None:
        found.append(way.pair)
        way = way.before
    return found[::-1]


def _needless(events: Sequence[ActivityEvent], number: int, last: int) -> bool:
    """Whether an event needs no counterpart: it only just happens, is too short, or says what was said before such a one."""
    event = events[number]
    if event.barely or (event.kind == PULSES and 0 < event.frames <= _FEW_FRAMES):
        return True
    before = number if event.kind == PULSES else number - 1  # what is between two widths that are the same may not be seen
    return before > last >= 0 and alike(event, events[last])
