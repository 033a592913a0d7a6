"""How long a program drives a line that it shares with a device before it releases it.

A sensor that has to be charged, or is started by a long pulse, answers only if the line is driven long enough; a simulated
sensor may be more tolerant than a real one, so the durations are compared, too. The device's answers are compared elsewhere.
"""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import inf
from statistics import median

from msgspec.structs import replace

from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import HELD, LEVEL, PULSE, ActivityEvent
from robosmi.verify.traces.pulses import TONE_DUTY, few_periods
from robosmi.verify.traces.servo_widths import EQUAL_US

DRIVEN_LOW, LET_GO = "driven low", "let go"
_SHORTEST_US = 100.0
"""Shorter durations are ignored: the source's times are not known below this."""
_AGREE = 3  # the middle one of them is their median
"""If a line is driven often, a new length counts once this many in a row have it, since interrupts stretch single ones."""
_OFTEN_US = 200_000.0
_LEAST_PAUSE_US, _PAUSES, _CLEAR = 500_000.0, 5, 1.5
"""A line is no longer driven after a pause of at least the first, and the second times the usual pause.

The end is marginal if the pause is less than the third times this limit.
"""
_TONE_STEADY = 1.3
"""The duty cycle of a tone, and the factor within which its periods are equal to the neighbouring ones."""
_TONE_PULSES = 3
"""The least number of pulses of a tone."""
NO_MORE = -1_000.0
"""The length, in an event, that means that the line is no longer driven."""


def level_durations(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """For how long a line is driven at a time: an event wherever this length changes.

    Args:
        trace: what was seen.
        pin: label of the pin.
    """
    held = [(level, _held(trace, pin, level, _SHORTEST_US)) for level in (0, 1)]
    found = [event for level, each in held for event in _lengths(HELD, level, each, lengths_alike, trace.known_us)]
    return sorted(found, key=lambda event: event.at_us)


def pulse_lengths(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """How long the pulses at a pin are that a single function call makes: an event wherever this length changes.

    Pulses of a tone at the same pin are left out, since some boards make a tone with a timer and others edge by edge.

    Args:
        trace: what was seen.
        pin: label of the pin.
    """
    of_timers = [(pulse.begin, pulse.end - pulse.begin) for pulse in few_periods(trace, pin)]
    low = _without_tones(_held(trace, pin, 0, 0.0))
    high = _without_tones(sorted([*_held(trace, pin, 1, 0.0), *of_timers]), _TONE_STEADY)
    lengths = [(length, level) for level, held in ((0, low), (1, high)) for _, length in held]
    lengths += [(trace.known_us - at_us, level) for at_us, level in trace.levels(pin)[-1:] if level in (0, 1)]
    level, held = (0, low) if max(lengths, default=(0.0, 0))[1] else (1, high)
    return _lengths(PULSE, level, held, pulses_alike, trace.known_us)


def _lengths(
    kind: str, level: int, held: list[tuple[float, float]], are_alike: Callable[[float, float], bool], until_us: float
) -> list[ActivityEvent]:
    found: list[ActivityEvent] = []
    lately: list[tuple[float, float]] = []
    at_first = len([begin for begin, _ in held if begin - held[0][0] < _OFTEN_US])
    pause_us = _long_pause(held)
    known: float | None = None  # the last one that was found to be alike: most are the same
    for number, (begin, length) in enumerate(held):
        del lately[: max(0, len(lately) + 1 - _AGREE)]
        while lately and begin - lately[0][0] >= _OFTEN_US:
            del lately[0]
        lately.append((begin, length))
        often = len(lately) == _AGREE or (at_first >= _AGREE and begin - held[0][0] < _OFTEN_US)
        if not often or len(lately) >= _AGREE:
            told = sorted([each[1] for each in lately])[1] if len(lately) == _AGREE else median(each[1] for each in lately)
            if told != known and (not found or not are_alike(float(found[-1].value[1]), told)):
                found.append(ActivityEvent(lately[0][0], kind, (level, told)))
            known = told
        rests_us = (held[number + 1][0] if number + 1 < len(held) else until_us) - begin - length
        if found and rests_us > pause_us:
            near = rests_us < _CLEAR * pause_us
            found.append(ActivityEvent(begin + length, kind, (level, NO_MORE), barely=near))
            lately, known = [], None
    return found


def _without_tones(held: list[tuple[float, float]], longest: float = inf) -> list[tuple[float, float]]:
    """Pulses without those of tones, including pulses that are cut off at the begin or the end of a tone.

    Args:
        held: begin and length of each pulse in microseconds, by time.
        longest: the length of the longest pulse that may be a cut-off one, as a multiple of the tone's half period.
    """
    periods = [after[0] - before[0] for before, after in pairwise(held)]
    tone = [False] * len(periods)
    for at, period in enumerate(periods):
        near = [periods[other] for other in (at - 1, at + 1) if 0 <= other < len(periods)]
        steady = any(period / _TONE_STEADY <= each <= period * _TONE_STEADY for each in near)
        tone[at] = steady and TONE_DUTY[0] <= held[at][1] / period <= TONE_DUTY[1]
    whole = [sum(tone[at : at + _TONE_PULSES]) == _TONE_PULSES for at in range(len(tone))]
    sure = [any(whole[max(0, at - _TONE_PULSES + 1) : at + 1]) for at in range(len(tone))]

    def of_tone(at: int) -> bool:
        beside = range(max(0, at - 2), min(len(sure), at + 3))
        return any(
            sure[other]
            and abs(held[other][0] - held[at][0]) <= 2 * periods[other]
            and held[at][1] <= longest * periods[other] / 2 + 2 * EQUAL_US
            for other in beside
        )

    return [pulse for at, pulse in enumerate(held) if not of_tone(at)]


def _long_pause(held: list[tuple[float, float]]) -> float:
    """The pause after which a line counts as no longer driven, in microseconds: much longer than the usual pause."""
    pauses = sorted(held[at + 1][0] - held[at][0] - held[at][1] for at in range(len(held) - 1))
    return max(_LEAST_PAUSE_US, _PAUSES * pauses[len(pauses) // 2]) if pauses else inf


def let_go_levels(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """The times when a line is driven low and released, up to where the program drives it high; others may pull it up.

    The analysis is causal, so a longer trace has the same first events. If the line is first released so near the end of the
    run that another run may do so later, all of its events are marginal.

    Args:
        trace: the trace of the run.
        pin: label of the pin.

    Returns:
        The events, beginning with the initial state. It is the only event if the line is never released, as with an output that
        rests, or a pin on which a timer makes a wave.
    """
    changes = trace.levels(pin)
    waves = [wave.at_us for wave in trace.waves if wave.pin == pin and wave.hz > 0]
    high_us = min([*waves, *(at_us for at_us, level in changes if level == 1)], default=inf)
    driven = next((number for number, (_, level) in enumerate(changes) if level == 0), len(changes))
    found = [ActivityEvent(0.0, LEVEL, (LET_GO,))]
    ends = [at_us for at_us, _ in changes[driven + 1 :]]
    lasting = zip(changes[driven:], [*ends, inf], strict=False)  # some cores make a pin an input for a moment in pinMode
    if not any(level != 0 and at_us < high_us and end_us - at_us >= _SHORTEST_US for (at_us, level), end_us in lasting):
        return found
    for number, (at_us, level) in enumerate(changes[driven:]):
        if at_us >= high_us:
            break
        lasts_us = ends[number] - at_us if number < len(ends) else _OFTEN_US
        value = DRIVEN_LOW if level == 0 else LET_GO
        if lasts_us >= _SHORTEST_US and found[-1].value != (value,):
            found.append(ActivityEvent(at_us, LEVEL, (value,)))
    first_us = next((event.at_us for event in found[1:] if event.value == (LET_GO,)), inf)
    near = trace.simulated_us - _LEAST_PAUSE_US < first_us < inf
    return [found[0], *(replace(event, barely=True) for event in found[1:])] if near else found


def lengths_alike(one_us: float, other_us: float) -> bool:
    """Whether two lengths are the same, within 100 us and 5 %."""
    return abs(one_us - other_us) <= _SHORTEST_US + 0.05 * max(one_us, other_us)


def pulses_alike(one_us: float, other_us: float) -> bool:
    """Whether two pulses are equally long, within 1 % and the delay of both edges by interrupts."""
    return abs(one_us - other_us) <= 2 * EQUAL_US + 0.01 * max(one_us, other_us)


def _held(trace: PinTrace, pin: str, wanted: int, shortest_us: float) -> list[tuple[float, float]]:
    found: list[tuple[float, float]] = []
    begun: float | None = None
    for at_us, level in trace.levels(pin):
        if level == wanted and begun is None:
            begun = at_us
        elif level != wanted and begun is not None:
            if at_us - begun >= shortest_us:
                found.append((begun, at_us - begun))
            begun = None
    return found
