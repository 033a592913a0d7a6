"""What a program does at a pin as the user or a device perceives it: steady levels, waves, servo pulses, bursts.

A trace consists of edges and of waves made by timers; two programs that do the same on two machines never have the same edges.
`activity` turns the edges of one pin into few events, in the same way for every machine, and `console_lines` does so for the
printed text. `comparison` compares them. Times are microseconds.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise
from statistics import median

from msgspec import Struct
from msgspec.structs import replace

from robosmi.verify.simulation import ConsoleByte, PinTrace
from robosmi.verify.traces.pulses import (
    FEWEST,
    NOTE,
    SERVO_PERIOD_US,
    SERVO_WIDTH_US,
    TONE_DUTY,
    Pulse,
    pulses_of,
    same_wave,
    wave_parts,
)
from robosmi.verify.traces.servo_widths import servo_widths

LEVEL, PULSES, WAVE, BURST, LINE, READING = "level", "pulses", "wave", "burst", "line", "reading"
HELD, PULSE = "held", "pulse"
"""The kinds of events; the value of an event depends on its kind.

`level`: (0 or 1,), or (text,) for a line that is let go (see `driven_lines`). `pulses` of a servo: (width in us,). `wave`:
(frequency in Hz, duty cycle). `burst`: (number of pulses,). `line` of text: (text,). `reading`, a line of a program that
measures: (text,). `held`: (level 0 or 1, how long a line shared with a device is driven in us). `pulse`: (level 0 or 1, length
in us of the pulses that one function makes). In the last two a negative length ends the previous state.
"""


class Sight(Struct, frozen=True):
    """Resolution of the events.

    Attributes:
        pause_us: pulses with shorter pauses than this between them are one activity.
        frames: a servo's width counts only if at least this many frames have it.
    """

    pause_us: float = 60_000.0
    frames: int = 2


SIGHTS = (Sight(), Sight(90_000.0), Sight(40_000.0))
"""Several resolutions, since a pause may be just below any limit on one side and just above it on the other."""

_SILENCE_US = 200_000.0
_CLEAR = 1.2
"""A pause is clearly longer or shorter than another if their ratio exceeds this factor."""


class ActivityEvent(Struct, frozen=True):
    """A state of a channel that begins at `at_us` and lasts until the next event.

    Attributes:
        at_us: when it begins, in microseconds.
        kind: one of the kinds above.
        value: its value, as the kind defines it.
        pulses: the number of rising edges of a wave or burst that consists of edges; 0 for one made by a timer.
        frames: the number of consecutive servo frames with the width.
        unclear: whether a pause near it is about as long as one that ends an activity, so that it might be divided differently.
        barely: whether it is so marginal that another run of the same program may lack it.
        vague_us: the uncertainty of its begin, if the previous state changes into it gradually.
        off: relative tolerance of a wave's frequency, a servo width, or each number of a reading, in addition to the usual one,
            since other runs of the program differ that much.
        exact: for each number of a reading, whether it does not depend on measurements and so has no tolerance.
        between: for each number of a reading, its least and greatest value if boards measure the same, None if unknown.
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
            return f"{100 * float(self.value[1]):.3g} % PWM"
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

    def does(self) -> str:
        """The event as a verb phrase: what the program does at that moment."""
        value = self.value[0]
        if self.kind == LEVEL:
            return f"is {value}" if isinstance(value, str) else f"switches {on_or_off(self)}"
        if self.kind in (PULSE, HELD) and float(self.value[1]) < 0:
            return f"no longer drives {'high' if value else 'low'}"
        if self.kind == HELD:
            return f"drives {'high' if value else 'low'} for {self.value[1]:.0f} us"
        return str(self) if self.kind == PULSE else f"sends {self}"


def on_or_off(level: ActivityEvent) -> str:
    """The state of what a pin of this level drives."""
    return "on" if level.value[0] else "off"


IDLE = ActivityEvent(0.0, LEVEL, (0,))
"""The state of every pin before the program uses it, and of a pin that is let go."""


def activity(trace: PinTrace, pin: str, sight: Sight = SIGHTS[0], pulses: Sequence[Pulse] | None = None) -> list[ActivityEvent]:
    """The events at a pin in order of time, beginning with `IDLE`; consecutive events differ.

    Args:
        trace: the trace of the run.
        pin: label of the pin.
        sight: one of `SIGHTS`.
        pulses: the pin's pulses, if computed already.
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
    until_us = _until(trace, pin)
    found: list[ActivityEvent] = []
    for run, doubtful in zip(runs, unclear, strict=True):
        if not (drives_servo and len(run) == 1 and _is_servo_pulse(run[0])):  # a single frame moves nothing
            events = _run(run, until_us, sight)
            found += [replace(event, unclear=True) for event in events] if doubtful else events
    return merged([IDLE, *found])


def _until(trace: PinTrace, pin: str = "") -> float:
    """The time after which nothing is known: the end of the run, or infinity for a program that ended and left the pin low."""
    levels = trace.levels(pin)
    left_high = bool(levels) and levels[-1][1] == 1
    return math.inf if trace.state == "done" and not left_high else trace.known_us


def merged(events: Sequence[ActivityEvent]) -> list[ActivityEvent]:
    """The events without those that are equal to their predecessor."""
    kept: list[ActivityEvent] = []
    for event in sorted(events, key=lambda each: each.at_us):
        if not kept or (event.kind, event.value) != (kept[-1].kind, kept[-1].value):
            kept.append(event)
    return kept


def with_joined_tones(events: Sequence[ActivityEvent], until_us: float) -> list[ActivityEvent]:
    """The events with a timer's tones that follow each other at less than the distance of two notes as one tone.

    Edges do not tell such tones apart (`wave_parts`), so the events are compared in this form with tones that consist of edges.
    The joined tone has the mean frequency, as that of edges has.

    Args:
        events: those of one channel, in order of time.
        until_us: the time of the run's end.
    """
    tones: list[list[tuple[ActivityEvent, float]]] = []
    for event, end_us in zip(events, [*(after.at_us for after in events[1:]), until_us], strict=True):
        if not tones or not _is_same_note(tones[-1][-1][0], event):
            tones.append([])
        tones[-1].append((event, end_us - event.at_us))
    joined: list[ActivityEvent] = []
    for (first, us), *others in tones:
        if others:
            turns = sum(float(event.value[0]) * lasts for event, lasts in [(first, us), *others])
            first = replace(first, value=(turns / (us + sum(lasts for _, lasts in others)), first.value[1]))
        joined.append(first)
    return joined


def _is_same_note(tone: ActivityEvent, after: ActivityEvent) -> bool:
    """Whether two events are tones of a timer that are no two notes."""
    if not all(event.kind == WAVE and not event.pulses for event in (tone, after)):
        return False
    (hz, duty), (other_hz, other_duty) = ((float(event.value[0]), float(event.value[1])) for event in (tone, after))
    tones = all(TONE_DUTY[0] <= each <= TONE_DUTY[1] for each in (duty, other_duty))
    return tones and abs(other_hz - hz) <= NOTE * hz


def _run(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The events of a sequence of pulses with short pauses; boundaries between its parts are not ends of activity."""
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
    """The events of a sequence of high times with short pauses: servo frames, waves, a burst, or plain levels."""
    if _is_frames(pulses):
        return _frames(pulses, horizon_us, sight)
    if len(pulses) < FEWEST:
        return [event for p in pulses for event in _levels(p, horizon_us)]
    parts = wave_parts(pulses)
    ends = [*(after[0].begin for _, after in parts[1:]), horizon_us]
    return [event for (steady, part), until_us in zip(parts, ends, strict=True) for event in _part(steady, part, until_us, sight)]


def _is_servo_pulse(pulse: Pulse) -> bool:
    return pulse.hz == 0 and SERVO_WIDTH_US[0] <= pulse.end - pulse.begin <= SERVO_WIDTH_US[1]


def _is_frames(pulses: Sequence[Pulse]) -> bool:
    """Whether pulses are servo frames, judged by their widths and distances; the last one may be cut off."""
    periods = [after.begin - before.begin for before, after in pairwise(pulses)]
    whole = pulses[:-1] if len(pulses) > 2 and pulses[-1].end - pulses[-1].begin < SERVO_WIDTH_US[0] else pulses
    return (
        bool(periods)
        and all(_is_servo_pulse(pulse) for pulse in whole)
        and SERVO_PERIOD_US[0] <= median(periods) <= SERVO_PERIOD_US[1]
    )


def _part(steady: bool, pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    if steady:
        return _wave(pulses, horizon_us, sight)
    if len(pulses) < FEWEST:
        return [event for pulse in pulses for event in _levels(pulse, horizon_us)]
    return [ActivityEvent(pulses[0].begin, BURST, (len(pulses),), len(pulses)), *_end(pulses[-1].end, horizon_us, sight)]


def _levels(pulse: Pulse, horizon_us: float) -> list[ActivityEvent]:
    down = [ActivityEvent(pulse.end, LEVEL, (0,))] if pulse.end < horizon_us else []
    return [ActivityEvent(pulse.begin, LEVEL, (1,), barely=pulse.barely), *down]


def _wave(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """A wave event with the median period, and its end."""
    periods = sorted(after.begin - before.begin for before, after in pairwise(pulses))
    middle = periods[len(periods) // 10 : len(periods) - len(periods) // 10] or periods
    period = sum(middle) / len(middle)
    duty = min(1.0, median(p.end - p.begin for p in pulses) / period)
    ended = pulses[-1].begin + period
    return [ActivityEvent(pulses[0].begin, WAVE, (1e6 / period, round(duty, 3)), len(pulses)), *_end(ended, horizon_us, sight)]


def _end(at_us: float, horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The end of an activity, unless the run ends too early to distinguish it from a pause."""
    return [ActivityEvent(at_us, LEVEL, (0,))] if at_us + sight.pause_us < horizon_us else []


def _frames(pulses: list[Pulse], horizon_us: float, sight: Sight) -> list[ActivityEvent]:
    """The successive widths of servo frames, and the end of the frames."""
    found = [
        ActivityEvent(at_us, PULSES, (width_us,), frames=frames, vague_us=vague_us, barely=barely)
        for at_us, width_us, frames, vague_us, barely in servo_widths(pulses, sight.frames)
    ]
    return [*found, *_end(pulses[-1].end, horizon_us, sight)] if found else []


def console_lines(trace: PinTrace, measures: bool = False) -> list[ActivityEvent]:
    """The printed lines, each at the time of its last character; text without a line end counts when the console gets quiet.

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
