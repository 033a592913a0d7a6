"""The times in which a pin is high, and which of them make a wave though interrupts delay some of its edges.

What they tell of what a program does, beside servos' frames and levels, is `activity`'s. Times are microseconds.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from statistics import median
from typing import NamedTuple

from robosmi.typed import sum_of
from robosmi.verify.simulation import PinTrace

FEWEST = 4
"""So many pulses at least are a wave or a burst; fewer are levels."""
_AHEAD = 8
_NOTE = 0.04
"""Two notes are further apart than this: a semitone is 5.9 %."""
_STEADY = 1.3
"""Periods of a wave are within this factor of one another, nearly all of them."""
_PITCH = 0.015
_RARE = 10
"""Odd pulses within a wave are the wave's where those before and behind are so many times as many."""
_FAST_US = 200.0
"""Periods of a wave that interrupts stretch by a large part."""
_FAST_AHEAD = 20
_STRETCHED = 2.2


class Pulse(NamedTuple):
    """A time in which a pin is high, or in which a timer makes a wave there (`hz` above 0)."""

    begin: float
    end: float
    hz: float = 0.0
    duty: float = 0.0


def pulses_of(trace: PinTrace, pin: str) -> list[Pulse]:
    """The high times and waves of a pin, by time; a high time within a wave is the wave's."""
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
        high.append(Pulse(up, trace.simulated_us))
    outside = [p for p in high if not any(w.begin <= p.begin < w.end for w in waves)] if waves else high
    return sorted([*(p for p in waves if p.end > p.begin), *outside], key=lambda pulse: pulse.begin)


def same_wave(one: Pulse, other: Pulse) -> bool:
    """Whether two waves of a timer are one that goes on: within 1 % of the frequency and 0.02 of the share that is high."""
    return abs(one.hz - other.hz) <= 0.01 * other.hz and abs(one.duty - other.duty) <= 0.02


def wave_parts(pulses: Sequence[Pulse]) -> list[tuple[bool, list[Pulse]]]:
    """Pulses that follow each other closely, cut into those that make a wave (True) and those that do not, by time."""
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
    return _absorbed(parts)


def _absorbed(parts: list[tuple[bool, list[Pulse]]]) -> list[tuple[bool, list[Pulse]]]:
    """Parts in which a few odd pulses at the begin or the end of a wave, or within it, are the wave's.

    A few stretched ones may look steady by chance. Within a wave they are few beside all of its pulses around them: a carrier in
    bursts is cut at several places, so that the piece next to them may be a burst only.
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
    """Parts of which the last ones are the wave's before them, where interrupts stretched it; the first ones, if turned round."""
    wave = next((n for n in reversed(range(len(parts))) if _is_sure(*parts[n])), len(parts))
    rest = [pulse for _, pulses in parts[wave + 1 :] for pulse in pulses]
    if not rest or not _is_stretched(sorted(rest, key=lambda pulse: pulse.begin), parts[wave][1]):
        return parts
    return [*parts[:wave], (True, sorted([*parts[wave][1], *rest], key=lambda pulse: pulse.begin))]


def _is_sure(steady: bool, part: Sequence[Pulse]) -> bool:
    """Whether a part is a wave by itself, and not by chance: of a fast one interrupts may stretch many pulses in a row."""
    return steady and len(part) >= _AHEAD and (len(part) >= _FAST_AHEAD or _usual(part) > _FAST_US)


def _are_rare(odd: int, before: Sequence[Pulse], rest: Sequence[tuple[bool, list[Pulse]]]) -> bool:
    """Whether so many odd pulses are few beside those of the wave before them and those with which it goes on after them.

    Args:
        odd: how many they are.
        before: the wave's pulses before them.
        rest: the parts after them, the first of which goes on with the wave.
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
    """Whether pulses at the begin or the end of a fast wave are its own, though interrupts have stretched them.

    They are few, and but for pauses between bursts none of their periods is much more than twice as long as the wave's.
    """
    periods = sorted(after.begin - before.begin for before, after in pairwise(odd))
    usual = _usual(wave)
    regular = all(period < _STRETCHED * usual for period in periods[: len(periods) * _RARE // (_RARE + 1)])
    return usual <= _FAST_US and regular and len(odd) * _RARE < len(wave)


def _usual(wave: Sequence[Pulse]) -> float:
    """The usual period of a wave, in microseconds."""
    return median(after.begin - before.begin for before, after in pairwise(wave))


def _same_pitch(one: Sequence[Pulse], other: Sequence[Pulse]) -> bool:
    """Whether two waves have the same frequency, within 1.5 %."""
    usual = _usual(one)
    return abs(usual - _usual(other)) <= _PITCH * usual


def _steady_until(periods: list[float], first: int) -> int:
    """The number of the last pulse of a wave that begins with a pulse: most of its periods are about the same.

    Single ones may be odd: an interrupt stretches one, a pause between two bursts of a carrier is one long one.
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
            if sum_of(_near(period, usual) for period in ahead) * 2 < len(ahead):
                return number
        number += 1
    return number


def _one_pitch_until(periods: list[float], first: int, last: int) -> int:
    """The number of the last pulse of the first note of a wave: where even periods become clearly other even ones at once."""
    for number in range(first + _AHEAD, last - _AHEAD):
        if abs(periods[number + 1] - periods[number - 1]) <= _NOTE * periods[number - 1]:
            continue
        before, after = periods[number - _AHEAD : number], periods[number + 1 : number + 1 + _AHEAD]
        if _is_even(before) and _is_even(after):
            return number
    return last


def _is_even(periods: Sequence[float]) -> bool:
    return max(periods) - min(periods) <= 2 * _PITCH * min(periods)


def _near(period: float, usual: float) -> bool:
    return usual / _STEADY <= period <= usual * _STEADY
