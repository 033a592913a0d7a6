"""Groups the times in which a pin is high into waves, though interrupts delay some of their edges.

`activity` interprets the rest: servo frames and levels. Times are microseconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from statistics import median
from typing import NamedTuple

from robosmi.verify.simulation import PinTrace

FEWEST = 4
"""Minimum number of pulses of a wave or burst; fewer are plain levels."""
_AHEAD = 8
NOTE = 0.04
"""Least relative difference of the periods of two notes; a semitone is 5.9 %."""
_STEADY = 1.3
"""Nearly all periods of a wave are within this factor of the usual one."""
_PITCH = 0.015
_RARE = 10
"""Odd pulses within a wave are counted to it if the regular pulses around them are more than this many times as many."""
_FAST_US = 200.0
"""Waves with a period up to this are fast: a single interrupt stretches it by a large part."""
_FAST_AHEAD = 20
_STRETCHED = 2.2
TONE_DUTY, _MOST = (0.4, 0.6), 0.75
"""So long is a tone high, in most of its periods."""
SERVO_PERIOD_US, SERVO_WIDTH_US = (12_000.0, 30_000.0), (300.0, 3_000.0)
"""Between these are the periods of servo frames, and the widths of their pulses."""
_APART, _DELAYED_US = 3, 100.0
"""A pulse stands apart from a tone after so many of its periods, and is longer than its pulses if it is longer than they become
by an interrupt."""


class Pulse(NamedTuple):
    """A time in which a pin is high, or in which a timer makes a wave there (`hz` above 0).

    It is `barely` there if it is the cut-off last pulse of a tone, which another run of the same program may lack.
    """

    begin: float
    end: float
    hz: float = 0.0
    duty: float = 0.0
    barely: bool = False


def pulses_of(trace: PinTrace, pin: str) -> list[Pulse]:
    """The high times and timer waves of a pin in order of time; high times within a wave are not listed separately.

    A tone of a timer with so few periods that its edges would be no wave is listed as its high times; so are frames of a servo.
    """
    waves: list[Pulse] = []
    begun: tuple[float, float, float] | None = None
    for wave in trace.waves:
        if wave.pin != pin:
            continue
        if begun is not None:
            waves.append(Pulse(begun[0], wave.at_us, begun[1], begun[2]))
        begun = (wave.at_us, wave.hz, wave.duty) if wave.hz > 0 and wave.duty > 0 else None
    if begun is not None:
        waves.append(Pulse(begun[0], trace.simulated_us, begun[1], begun[2]))
    high: list[Pulse] = []
    up: float | None = None
    for at_us, level in trace.levels(pin):
        if level == 1 and up is None:
            up = at_us
        elif level != 1 and up is not None:
            high.append(Pulse(up, at_us))
            up = None
    if up is not None:
        high.append(Pulse(up, trace.known_us))  # a program that ended leaves it high
    outside = [p for p in high if not any(w.begin <= p.begin < w.end for w in waves)] if waves else high
    made = [pulse for number in range(len(waves)) for pulse in _high_times(waves, number) if pulse.end > pulse.begin]
    return sorted([*made, *outside], key=lambda pulse: pulse.begin)


def few_periods(trace: PinTrace, pin: str) -> list[Pulse]:
    """The high times of a timer's tones at a pin that have fewer periods than a wave needs, in order of time."""
    edges = {at_us for at_us, level in trace.levels(pin) if level == 1}
    return [pulse for pulse in pulses_of(trace, pin) if pulse.hz == 0 and pulse.begin not in edges]


def _high_times(waves: Sequence[Pulse], number: int) -> list[Pulse]:
    """A timer's wave as its high times if they are frames of a servo, or a tone of a few periods that is no part of a wave that
    changes; else the wave.

    A timer begins a tone with the half of a period that is low.
    """
    wave = waves[number]
    period = 1e6 / wave.hz
    if _is_servo(wave):
        return _servo_frames(waves, number)
    beside = (*waves[max(0, number - 1) : number], *waves[number + 1 : number + 2])
    joined = any(other.begin - wave.end < period and wave.begin - other.end < period for other in beside)
    if joined or wave.duty != 0.5 or wave.end - wave.begin >= FEWEST * period:
        return [wave]
    ups = [wave.begin + (turn + 0.5) * period for turn in range(FEWEST)]
    return [Pulse(up, min(up + period / 2, wave.end), barely=up + period / 2 > wave.end) for up in ups if up < wave.end]


def _is_servo(wave: Pulse) -> bool:
    period = 1e6 / wave.hz
    return SERVO_PERIOD_US[0] <= period <= SERVO_PERIOD_US[1] and SERVO_WIDTH_US[0] <= period * wave.duty <= SERVO_WIDTH_US[1]


def _servo_frames(waves: Sequence[Pulse], number: int) -> list[Pulse]:
    """The frames of a servo that a timer makes; another width counts from the next frame on, since the timer runs on."""
    wave, first = waves[number], number
    period = 1e6 / wave.hz
    while first and waves[first - 1].end >= waves[first].begin and abs(waves[first - 1].hz - wave.hz) <= 0.01 * wave.hz:
        first -= 1
    origin = waves[first].begin
    last = number + 1 == len(waves) or waves[number + 1].begin > wave.end
    turns = range(math.ceil((wave.begin - origin) / period), math.ceil((wave.end - origin) / period))
    ends = [(origin + turn * period, origin + (turn + wave.duty) * period) for turn in turns]
    return [Pulse(up, min(down, wave.end) if last else down, barely=last and down > wave.end) for up, down in ends]


def same_wave(one: Pulse, other: Pulse) -> bool:
    """Whether a timer's wave continues another: within 1 % of the frequency and 0.02 of the duty cycle."""
    return abs(one.hz - other.hz) <= 0.01 * other.hz and abs(one.duty - other.duty) <= 0.02


def wave_parts(pulses: Sequence[Pulse]) -> list[tuple[bool, list[Pulse]]]:
    """Divide pulses with short pauses into parts that are a wave (True) and parts that are not, in order of time."""
    periods = [after.begin - before.begin for before, after in pairwise(pulses)]
    parts: list[tuple[bool, list[Pulse]]] = []
    first = 0
    while first < len(pulses):
        last = _one_pitch_until(periods, first, _steady_until(periods, first))
        steady = last - first + 1 >= FEWEST
        part = list(pulses[first : last + 1] if steady else pulses[first : first + 1])
        if not steady and parts and not parts[-1][0]:
            parts[-1][1].extend(part)
        else:
            parts.append((steady, part))
        first += len(part)
    return [piece for steady, part in _absorbed(parts) for piece in (_apart(part) if steady else [(False, part)])]


def _apart(wave: list[Pulse]) -> list[tuple[bool, list[Pulse]]]:
    """Divide a tone from the program's own pulses beside it, which interrupts cannot have made of pulses of the tone.

    These stand apart from the tone and are of another length. Fast waves are not divided, since they are sent in bursts.
    """
    period, high = _usual(wave), median(pulse.end - pulse.begin for pulse in wave)
    of_tone = sum(TONE_DUTY[0] <= (pulse.end - pulse.begin) / period <= TONE_DUTY[1] for pulse in wave)
    if not _is_sure(True, wave) or period <= _FAST_US or of_tone < _MOST * len(wave):
        return [(True, wave)]  # PWM, whose last width is no pulse of its own
    last = len(wave) - 1
    pieces: list[tuple[bool, list[Pulse]]] = []
    for number, pulse in enumerate(wave):
        length = pulse.end - pulse.begin
        far = [
            number == 0 or pulse.begin - wave[number - 1].end > _APART * period,
            number == last or wave[number + 1].begin - pulse.end > _APART * period,
        ]
        own = (any(far) and length > _STEADY * high + _DELAYED_US) or (all(far) and length < high / _STEADY - _DELAYED_US)
        if pieces and pieces[-1][0] is not own:
            pieces[-1][1].append(pulse)
        else:
            pieces.append((not own, [pulse]))
    return [(steady and len(part) >= FEWEST, part) for steady, part in pieces]


def _absorbed(parts: list[tuple[bool, list[Pulse]]]) -> list[tuple[bool, list[Pulse]]]:
    """Join parts of a few odd pulses at either end of a wave, or within it, with the wave.

    A few stretched pulses may look regular by chance. Within a wave they are compared with all of its pulses around them: a
    carrier sent in bursts is divided at several places, so the part next to them may be one burst only.
    """
    kept: list[tuple[bool, list[Pulse]]] = []
    for number, (steady, part) in enumerate(parts):
        wave = next((n for n in reversed(range(len(kept))) if _is_sure(*kept[n])), len(kept))
        if between := kept[wave + 1 :]:
            odd = [pulse for _, pulses in between for pulse in pulses]
            before = kept[wave][1]
            if steady and _same_pitch(before, part) and _are_rare(len(odd), before, parts[number:]):
                kept[wave:] = [(True, before + odd)]  # interrupts stretch some in a row
        few = kept and not kept[-1][0] and len(kept[-1][1]) < FEWEST
        goes_on = kept and kept[-1][0] and (_same_pitch(kept[-1][1], part) if steady else len(part) < FEWEST)
        if goes_on or (steady and few):
            kept[-1] = (True, kept[-1][1] + part)
        else:
            kept.append((steady, part))
    return _joined_end(_joined_end(kept)[::-1])[::-1]


def _joined_end(parts: list[tuple[bool, list[Pulse]]]) -> list[tuple[bool, list[Pulse]]]:
    """Join the parts after a wave with it if they are its own pulses, stretched by interrupts."""
    wave = next((n for n in reversed(range(len(parts))) if _is_sure(*parts[n])), len(parts))
    rest = [pulse for _, pulses in parts[wave + 1 :] for pulse in pulses]
    if not rest or not _is_stretched(sorted(rest, key=lambda pulse: pulse.begin), parts[wave][1]):
        return parts
    return [*parts[:wave], (True, sorted([*parts[wave][1], *rest], key=lambda pulse: pulse.begin))]


def _is_sure(steady: bool, part: Sequence[Pulse]) -> bool:
    """Whether a part is long enough to be a wave and not regular by chance; interrupts may stretch many pulses of a fast one."""
    return steady and len(part) >= _AHEAD and (len(part) >= _FAST_AHEAD or _usual(part) > _FAST_US)


def _are_rare(odd: int, before: Sequence[Pulse], rest: Sequence[tuple[bool, list[Pulse]]]) -> bool:
    """Whether odd pulses are few compared with the wave before them and its continuation after them.

    Args:
        odd: the number of odd pulses.
        before: the wave's pulses before them.
        rest: the parts after them, the first of which continues the wave.
    """
    regular = 0
    for steady, part in rest:
        if not _is_sure(steady, part):
            odd += len(part)
        elif _same_pitch(before, part):
            regular += len(part)
        else:
            break
        if regular and odd * _RARE < len(before) + regular:
            return True
    return False


def _is_stretched(odd: Sequence[Pulse], wave: Sequence[Pulse]) -> bool:
    """Whether pulses at either end of a fast wave belong to it, though interrupts have stretched them.

    They must be few, and, except for pauses between bursts, their periods must not exceed 2.2 times the wave's.
    """
    periods = sorted(after.begin - before.begin for before, after in pairwise(odd))
    usual = _usual(wave)
    regular = all(period < _STRETCHED * usual for period in periods[: len(periods) * _RARE // (_RARE + 1)])
    return usual <= _FAST_US and regular and len(odd) * _RARE < len(wave)


def _usual(wave: Sequence[Pulse]) -> float:
    """The median period of a wave, in microseconds."""
    return median(after.begin - before.begin for before, after in pairwise(wave))


def _same_pitch(one: Sequence[Pulse], other: Sequence[Pulse]) -> bool:
    """Whether two waves have the same frequency, within 1.5 %."""
    usual = _usual(one)
    return abs(usual - _usual(other)) <= _PITCH * usual


def _steady_until(periods: list[float], first: int) -> int:
    """The index of the last pulse of a wave that begins at a pulse: most of its periods are about the same.

    Single periods may be odd: an interrupt stretches one, and a pause between two bursts of a carrier is a long one.
    """
    if first >= len(periods):
        return first
    usual = median(periods[first : first + 5])
    if not _near(periods[first], usual):
        return first
    number = first
    while number < len(periods):
        if _near(periods[number], usual):
            usual = 0.9 * usual + 0.1 * periods[number]
        else:
            ahead = periods[number + 1 : number + 1 + _AHEAD]
            if sum(_near(period, usual) for period in ahead) * 2 < len(ahead):
                return number
        number += 1
    return number


def _one_pitch_until(periods: list[float], first: int, last: int) -> int:
    """The index of the last pulse of a wave's first note, which ends where uniform periods change clearly to other ones."""
    for number in range(first + _AHEAD, last - _AHEAD):
        if abs(periods[number + 1] - periods[number - 1]) <= _PITCH * periods[number - 1]:
            continue
        before, after = periods[number - _AHEAD : number], periods[number + 1 : number + 1 + _AHEAD]
        if _is_even(before) and _is_even(after) and abs(median(after) - median(before)) > NOTE * median(before):
            return number
    return last


def _is_even(periods: Sequence[float]) -> bool:
    """Whether periods are the same, except for one edge that an interrupt delays: one period longer, the other one shorter."""
    usual = sorted(periods)[1:-1]
    return usual[-1] - usual[0] <= 2 * _PITCH * usual[0]


def _near(period: float, usual: float) -> bool:
    return usual / _STEADY <= period <= usual * _STEADY
