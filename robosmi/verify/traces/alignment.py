"""Aligns the events of two runs: events of equal value in the same order correspond.

An event may be left without a counterpart if it is marginal: a servo width shown for few frames, which depend on when frames
begin, or a wheel that just reaches or misses a mark. Whether corresponding events agree in time and duration is judged by
`comparison`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

from msgspec import Struct
from msgspec.structs import replace

from robosmi.verify.traces.activity import HELD, LEVEL, PULSE, PULSES, READING, WAVE, ActivityEvent
from robosmi.verify.traces.driven_lines import lengths_alike, pulses_alike
from robosmi.verify.traces.servo_widths import tolerated_us

_HZ = 0.015
_NUMBERS = 0.01
_NUMBER = re.compile(r"(?<![\w.])-?\d{1,15}(?:\.\d{1,15})?(?![\w.])")
_DUTY = 0.02
_FASTEST_HZ = 5_000.0
"""Edges that a program makes itself at a higher rate are only counted, since the source's exact speed is not known."""
_FEW_FRAMES = 2
"""A servo width with at most this many frames may have one less, and so be invisible, when the frames begin at another time."""
_OWN_STEPS_US = 50.0
"""The most by which a width varies with the cost of the program's steps: twice as much is not known of the source's times."""
_MOST_STEPS = 200_000


def alike(one: ActivityEvent, other: ActivityEvent) -> bool:
    """Whether two events have the same value within the tolerances."""
    if one.pulses and other.pulses and (one.kind != other.kind or float(one.value[0]) > _FASTEST_HZ):
        return one.pulses == other.pulses
    if one.kind != other.kind:
        return _nearly_constant(one, other) or _nearly_constant(other, one)
    if one.kind == WAVE:
        (hz, duty), (other_hz, other_duty) = one.value, other.value
        loose = _looseness(one, other)
        near = abs(float(hz) - float(other_hz)) <= (_HZ + loose) * max(float(hz), float(other_hz))
        return near and abs(float(duty) - float(other_duty)) <= _DUTY
    if one.kind == PULSES:
        width = float(one.value[0])
        return abs(width - float(other.value[0])) <= tolerated_us(width) + _looseness(one, other) * width
    if one.kind == HELD:
        return one.value[0] == other.value[0] and lengths_alike(float(one.value[1]), float(other.value[1]))
    if one.kind == PULSE:
        return one.value[0] == other.value[0] and pulses_alike(float(one.value[1]), float(other.value[1]))
    if one.kind == READING:
        told = one if one.exact or one.off else other
        return _reads_alike(str(one.value[0]), str(other.value[0]), told)
    return one.value == other.value


def _nearly_constant(wave: ActivityEvent, level: ActivityEvent) -> bool:
    """Whether a timer's wave is within the tolerance of its duty of a constant level, as 99.6 % is of high."""
    if wave.kind != WAVE or wave.pulses or level.kind != LEVEL or isinstance(level.value[0], str):
        return False
    return abs(float(wave.value[1]) - float(level.value[0])) <= _DUTY


def _looseness(one: ActivityEvent, other: ActivityEvent) -> float:
    """The relative tolerance of a wave or width in addition to the usual one: that of the first event which has one."""
    return next((each.off[0] for each in (one, other) if each.off), 0.0)


def _reads_alike(one: str, other: str, told: ActivityEvent) -> bool:
    """Whether two lines are equal except for measured numbers, which may differ by one in the last digit, or by 1 %.

    If the range of a measured number is known, that range is the tolerance instead.

    Args:
        one, other: the lines.
        told: the event that has the tolerance of each number, whether it is exact, and its range.
    """
    if one == other:
        return True
    if _NUMBER.sub("0", one) != _NUMBER.sub("0", other):
        return False
    for place, (mine, theirs) in enumerate(zip(_NUMBER.findall(one), _NUMBER.findall(other), strict=True)):
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
    """Whether two numbers are printed with the same number of decimals, and, if one has leading zeros, of digits."""
    if float(mine) == float(theirs) != 0:
        return False
    if len(mine.partition(".")[2]) != len(theirs.partition(".")[2]):
        return False
    digits = [each.lstrip("-").partition(".")[0] for each in (mine, theirs)]
    filled = any(len(each) > 1 and each.startswith("0") for each in digits)
    return not filled or len(digits[0]) == len(digits[1])


def numbers_of(event: ActivityEvent) -> list[str]:
    """The numbers in an event's text."""
    return _NUMBER.findall(str(event.value[0]))


def shape_of(event: ActivityEvent) -> str:
    """An event's text with every number replaced by 0."""
    return _NUMBER.sub("0", str(event.value[0]))


def parts_off(one: ActivityEvent, other: ActivityEvent) -> tuple[float, ...]:
    """The relative differences of a wave's frequency, or of each number of a reading, between two corresponding events."""
    if one.kind == other.kind == WAVE:
        return (_part(float(one.value[0]), float(other.value[0])),)
    if one.kind == other.kind == READING:
        mine, theirs = numbers_of(one), numbers_of(other)
        return tuple(_part(float(mine[at]), float(theirs[at])) for at in range(min(len(mine), len(theirs))))
    return ()


def with_vague_widths(source: Sequence[ActivityEvent], scaled: Sequence[Sequence[ActivityEvent]]) -> list[ActivityEvent]:
    """The events, where a servo width that the program makes by its own steps has a tolerance of twice its variation with them.

    Such a width contains the cost of some steps. So it is greater in a run whose steps cost more, smaller in one whose steps cost
    less, and differs by little. All other widths keep their tolerance.

    Args:
        source: the events of the nominal run.
        scaled: those of a run in which all steps cost more, and of one in which they cost less, if there is one.
    """
    kinds = [event.kind for event in source]
    if not scaled or any([event.kind for event in run] != kinds for run in scaled):
        return list(source)
    vague = []
    for at, event in enumerate(source):
        if event.kind == PULSES:
            width = float(event.value[0])
            more = [sign * (float(run[at].value[0]) - width) for sign, run in zip((1, -1)[: len(scaled)], scaled, strict=True)]
            if min(more) > 0 and tolerated_us(width) < max(more) <= _OWN_STEPS_US:
                event = replace(event, off=(2 * max(more) / width,))
        vague.append(event)
    return vague


def larger(one: tuple[float, ...], other: tuple[float, ...]) -> tuple[float, ...]:
    """The elementwise maximum of two tuples, which may differ in length."""
    longer, shorter = (one, other) if len(one) >= len(other) else (other, one)
    return tuple(max(part, shorter[at]) if at < len(shorter) else part for at, part in enumerate(longer))


def _part(one: float, other: float) -> float:
    return abs(one - other) / max(abs(one), abs(other)) if one != other else 0.0


class Alignment(Struct, frozen=True):
    """Which events of two runs correspond.

    Attributes:
        pairs: indices of corresponding events, without those that only repeat the value from before a marginal event.
        own, other: indices of the first events without a counterpart; the lengths of the runs if all have one.
    """

    pairs: list[tuple[int, int]]
    own: int
    other: int


def aligned(
    own: Sequence[ActivityEvent], other: Sequence[ActivityEvent], fitting: Callable[[int, int], bool] | None = None
) -> Alignment:
    """Find which events of two runs correspond, as a longest common prefix in which marginal events may be skipped.

    Args:
        own, other: the events of the runs.
        fitting: whether two events of equal value, given by their indices, may correspond; all may if None.
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
    """A linked list of pairs: the last pair, and those before it."""

    pair: tuple[int, int]
    before: _Way | None
    length: int


def _pairs(way: _Way | None) -> list[tuple[int, int]]:
    found = []
    while way is not None:
        found.append(way.pair)
        way = way.before
    return found[::-1]


def is_brief(event: ActivityEvent) -> bool:
    """Whether an event is a servo width that is shown for so few frames that another run may not show it."""
    return event.kind == PULSES and 0 < event.frames <= _FEW_FRAMES


def _needless(events: Sequence[ActivityEvent], number: int, last: int) -> bool:
    """Whether an event may lack a counterpart: it is marginal, very short, or repeats the value from before such an event."""
    event = events[number]
    if event.barely or is_brief(event):
        return True
    before = number if event.kind == PULSES else number - 1  # what is between two widths that are the same may not be seen
    return before > last >= 0 and alike(event, events[last])
