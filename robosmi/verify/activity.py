"""What a program does at a pin as a person or a device sees it: levels that stay, waves, pulses of servos, bursts.

A trace is edges and waves of timers; two programs that do the same on two machines never have the same edges. `activity` turns
the edges of one pin into few events, in the same way for every machine, and `console_lines` what was printed. Comparing them is
`comparison`'s. Times are microseconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from statistics import median

from msgspec import Struct

from robosmi.typed import paired, replaced, sum_of
from robosmi.verify.pulses import FEWEST, Pulse, pulses_of, same_wave, wave_parts
from robosmi.verify.servo_widths import servo_widths
from robosmi.verify.simulation import ConsoleByte, PinTrace

LEVEL, PULSES, WAVE, BURST, LINE, READING = "level", "pulses", "wave", "burst", "line", "reading"
HELD, PULSE = "held", "pulse"
"""The kinds of events with what they say.

In this order: (0 or 1,), (width in us,), (Hz, duty), (number of pulses,), (text,), (text,), (0 or 1, us) twice, less than 0 us
where that is over. A reading is a line of a program that measures; held is how long a line that is shared with a device is
driven, a pulse how long those are that one function makes in one go. A level that is a text is how a line is driven that the
program lets go (see `driven_lines`).
"""


class Sight(Struct, frozen=True):
    """How short an event may be to count as one of its own.

    Attributes:
        pause_us: pulses that follow each other within this time are one activity: a shorter pause in a tone is not seen.
        frames: so many frames of a servo at least have to have a width for it to be seen.
    """

    pause_us: float = 60_000.0
    frames: int = 2


SIGHTS = (Sight(), Sight(90_000.0), Sight(40_000.0))
"""Several, since a pause, or what a servo shows, may last a little less than any limit on one side and more on the other."""

_SERVO_PERIOD_US = (12_000.0, 30_000.0)
_SERVO_WIDTH_US = (300.0, 3_000.0)
_SILENCE_US = 200_000.0
_CLEAR = 1.2
"""A pause is clearly longer or shorter than another when it is so many times as long, or less than that part of it."""


class ActivityEvent(Struct, frozen=True):
    """From `at_us` on something is so.

    Attributes:
        at_us: when it begins.
        kind: one of the kinds above.
        value: what it is, as the kind says.
        pulses: of how many edges up a wave or burst is made, where it is made of edges and not by a timer; else 0.
        frames: how many frames of a servo have the width, without a pause.
        unclear: whether a pause about as long as the one that ends an activity is near, so that it may be seen otherwise.
        barely: whether it only just happens, so that another run of the same program may do without it.
        vague_us: by how much its begin may be put otherwise, since what was before passes into it slowly.
        off: by what part of itself a wave's frequency, or each number of a reading, may be off beyond what counts as the same
            anyway, since it is off in other runs of the program.
        exact: whether each number of a reading is the same whatever is measured, so that it may not be off at all.
        between: the least and the most that each number of a reading may be where boards measure the same, None where that is
            not known.
    """

    at_us: float
    kind: str
    value: tuple[float | str, ...]
    pulses: int = 0
    frames: int = 0
    unclear: bool = False
    barely: bool = False
    vague_us: float = 0.0
    off: tuple[float, ...] = ()
    exact: tuple[bool, ...] = ()
    between: tuple[tuple[float, float] | None, ...] = ()

    def __str__(self) -> str:
        value = self.value[0]
        if self.kind == LEVEL:
            return value if isinstance(value, str) else "high" if value else "low"
        if self.kind == PULSES:
            return f"pulses of {value:.0f} us"
        if self.kind == WAVE and not value:
            return f"{100 * float(self.value[1]):.3g} % high on average"
        if self.kind == WAVE:
            return (
                f"{value:.6g} Hz" if float(self.value[1]) == 0.5 else f"{value:.6g} Hz, {100 * float(self.value[1]):.3g} % high"
            )
        if self.kind in (PULSE, HELD) and float(self.value[1]) < 0:
            return f"no longer {'high' if value else 'low'}"
        if self.kind == PULSE:
            return f"pulses {'high' if value else 'low'} for {self.value[1]:.1f} us"
        if self.kind == HELD:
            return f"held {'high' if value else 'low'} for {self.value[1]:.0f} us"
        return f"{value} pulses" if self.kind == BURST else repr(value)


IDLE = ActivityEvent(0.0, LEVEL, (0,))
"""What every pin does before the program does anything there, and what one does that is let go."""


def activity(trace: PinTrace, pin: str, sight: Sight = SIGHTS[0], pulses: Sequence[Pulse] | None = None) -> list[ActivityEvent]:
    """What happens at a pin, by time; it begins with `IDLE`, and no event says the same as the one before.

    Args:
        trace: what was seen.
        pin: label of the pin.
        sight: one of `SIGHTS`.
        pulses: those of the pin, where they are known already.
    """
    runs: list[list[Pulse]] = []
    unclear: list[bool] = []
    for pulse in pulses_of(trace, pin) if pulses is None else pulses:
        pause = pulse.begin - runs[-1][-1].end if runs else math.inf
        near = sight.pause_us / _CLEAR <= pause <= sight.pause_us * _CLEAR
        if pause < sight.pause_us:
            runs[-1].append(pulse)
            unclear[-1] = unclear[-1] or near
        else:
            if near:
                unclear[-1] = True
            runs.append([pulse])
            unclear.append(near)
    drives_servo = any(_is_frames(run) for run in runs)
    found: list[ActivityEvent] = []
    for run, doubtful in paired(runs, unclear):
        if not (drives_servo and len(run) == 1 and _is_servo_pulse(run[0])):  # a single frame moves nothing
            events = _run(run, _until(trace, pin), sight)
            found += [replaced(event, unclear=True) for event in events] if doubtful else events
    return merged([IDLE, *found])


def _until(trace: PinTrace, pin: str = "") -> float:
    """The instant after which nothing is known: the end of the run, but of a program that has ended and left the pin low."""
    levels = trace.levels(pin)
    left_high = bool(levels) and levels[-1][1] == 1
    return math.inf if trace.state == "done" and not left_high else trace.simulated_us


def merged(events: Sequence[ActivityEvent]) -> list[ActivityEvent]:
    """Events without those that say the same as the one before."""
    kept: list[ActivityEvent] = []
    for event in sorted(events, key=lambda each: each.at_us):
        if not kept or (event.kind, event.value) != (kept[-1].kind, kept[-1].value):
            kept.append(event)
    return kept


def _run(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The events of pulses that follow each other closely; the pauses between what they are parted into are no ends."""
    found: list[ActivityEvent] = []
    number = 0
    while number < len(pulses):
        pulse = pulses[number]
        last = number
        while last + 1 < len(pulses) and (
            pulses[last + 1].hz > 0 and same_wave(pulses[last + 1], pulse) if pulse.hz > 0 else pulses[last + 1].hz == 0
        ):
            last += 1
        until_us = pulses[last + 1].begin if last + 1 < len(pulses) else horizon_us
        if pulse.hz > 0:
            found.append(ActivityEvent(pulse.begin, WAVE, (pulse.hz, round(pulse.duty, 3))))
            found += _end(pulses[last].end, until_us, sight)
        else:
            found += _edges(pulses[number : last + 1], until_us, sight)
        number = last + 1
    return found


def _edges(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The events of high times that follow each other closely: a servo's frames, waves, a burst, or mere levels."""
    if _is_frames(pulses):
        return _frames(pulses, horizon_us, sight)
    if len(pulses) < FEWEST:
        return [event for p in pulses for event in _levels(p, horizon_us)]
    parts = wave_parts(pulses)
    ends = [*(after[0].begin for _, after in parts[1:]), horizon_us]
    return [event for (steady, part), until_us in paired(parts, ends) for event in _part(steady, part, until_us, sight)]


def _is_servo_pulse(pulse: Pulse) -> bool:
    return pulse.hz == 0 and _SERVO_WIDTH_US[0] <= pulse.end - pulse.begin <= _SERVO_WIDTH_US[1]


def _is_frames(pulses: Sequence[Pulse]) -> bool:
    """Whether pulses are frames of a servo, by their widths and their distance; the last one may be cut off."""
    periods = [after.begin - before.begin for before, after in pairwise(pulses)]
    whole = pulses[:-1] if len(pulses) > 2 and pulses[-1].end - pulses[-1].begin < _SERVO_WIDTH_US[0] else pulses
    return (
        bool(periods)
        and all(_is_servo_pulse(pulse) for pulse in whole)
        and _SERVO_PERIOD_US[0] <= median(periods) <= _SERVO_PERIOD_US[1]
    )


def _part(steady: bool, pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    if steady:
        return _wave(pulses, horizon_us, sight)
    if len(pulses) < FEWEST:
        return [event for pulse in pulses for event in _levels(pulse, horizon_us)]
    return [ActivityEvent(pulses[0].begin, BURST, (len(pulses),), len(pulses)), *_end(pulses[-1].end, horizon_us, sight)]


def _levels(pulse: Pulse, horizon_us: float) -> list[ActivityEvent]:
    down = [ActivityEvent(pulse.end, LEVEL, (0,))] if pulse.end < horizon_us else []
    return [ActivityEvent(pulse.begin, LEVEL, (1,)), *down]


def _wave(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """A wave by the middle of its periods, and its end."""
    periods = sorted(after.begin - before.begin for before, after in pairwise(pulses))
    middle = periods[len(periods) // 10 : len(periods) - len(periods) // 10] or periods
    period = sum_of(middle) / len(middle)
    duty = min(1.0, median(p.end - p.begin for p in pulses) / period)
    ended = pulses[-1].begin + period
    return [ActivityEvent(pulses[0].begin, WAVE, (1e6 / period, round(duty, 3)), len(pulses)), *_end(ended, horizon_us, sight)]


def _end(at_us: float, horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The end of an activity, where the run went on for long enough to tell it from a pause."""
    return [ActivityEvent(at_us, LEVEL, (0,))] if at_us + sight.pause_us < horizon_us else []


def _frames(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The widths that some frames of a servo have one after the other, and the end of the frames."""
    found = [
        ActivityEvent(at_us, PULSES, (width_us,), frames=frames, vague_us=vague_us, barely=barely)
        for at_us, width_us, frames, vague_us, barely in servo_widths(pulses, sight.frames)
    ]
    return [*found, *_end(pulses[-1].end, horizon_us, sight)] if found else []


def console_lines(trace: PinTrace, measures: bool = False) -> list[ActivityEvent]:
    """What was printed: a line each, at the time of its last character; also what stands without an end when it gets quiet.

    Args:
        trace: what was seen.
        measures: whether the program measures, so that what it prints may be a measured number.
    """
    return text_lines(trace, trace.console, measures)


def text_lines(trace: PinTrace, data: Sequence[ConsoleByte], measures: bool = False) -> list[ActivityEvent]:
    """Bytes that a program sent, on its console or to a device, as lines of text (see `console_lines`).

    Args:
        trace: of the run.
        data: the bytes, by time.
        measures: whether the program measures.
    """
    kind = READING if measures else LINE
    found: list[ActivityEvent] = []
    line = bytearray()
    last = 0.0
    for byte in data:
        if line and byte.at_us - last > _SILENCE_US:
            found.append(ActivityEvent(last, kind, (_text(line),)))
            line.clear()
        if byte.byte in (10, 13):
            if line:
                found.append(ActivityEvent(byte.at_us, kind, (_text(line),)))
            line.clear()
        else:
            line.append(byte.byte)
        last = byte.at_us
    if line and _until(trace) - last > _SILENCE_US:
        found.append(ActivityEvent(last, kind, (_text(line),)))
    return found


def _text(line: bytearray) -> str:
    return bytes(line).decode("utf-8", "replace")
