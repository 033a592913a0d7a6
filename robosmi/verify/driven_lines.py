"""How a program drives a line that it shares with a device: for how long it holds it high or low before it lets go or goes on.

A sensor that is charged, or asked by a long pulse, answers only if that lasts long enough; a simulated one may be more patient
than a real one. So how long is looked at, too. What a device answers is its own business.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from statistics import median

from robosmi.typed import replaced
from robosmi.verify.activity import HELD, LEVEL, PULSE, ActivityEvent
from robosmi.verify.servo_widths import EQUAL_US
from robosmi.verify.simulation import PinTrace

DRIVEN_LOW, LET_GO = "driven low", "let go"
_SHORTEST_US = 100.0
"""What lasts less is not looked at: nothing is claimed of the source below that."""
_AGREE = 3
"""So many that follow one another tell a new length where a line is held often: single ones are stretched by interrupts."""
_OFTEN_US = 200_000.0
_LEAST_PAUSE_US, _PAUSES, _CLEAR = 500_000.0, 5, 1.5
"""A line is not held any more, or not for a long time: for so long at least, and so many times as long as usual. Another run may
see a pause otherwise that is less than so many times as long as that."""
NO_MORE = -1_000.0
"""The length in an event that says so."""


def held_levels(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """The lengths for which a line is held, by time: an event wherever they become others.

    Args:
        trace: what was seen.
        pin: label of the pin.
    """
    held = [(level, _held(trace, pin, level, _SHORTEST_US)) for level in (0, 1)]
    found = [event for level, each in held for event in _lengths(HELD, level, each, lengths_alike, trace.known_us)]
    return sorted(found, key=lambda event: event.at_us)


def pulse_lengths(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """How long the pulses are at a pin where one function alone makes them, in one go: an event wherever that becomes other.

    Args:
        trace: what was seen.
        pin: label of the pin.
    """
    low, high = _held(trace, pin, 0, 0.0), _held(trace, pin, 1, 0.0)
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
    for number, (begin, length) in enumerate(held):
        lately = [*[each for each in lately if begin - each[0] < _OFTEN_US][1 - _AGREE :], (begin, length)]
        often = len(lately) == _AGREE or (at_first >= _AGREE and begin - held[0][0] < _OFTEN_US)
        if not often or len(lately) >= _AGREE:
            told = median(each[1] for each in lately)
            if not found or not are_alike(float(found[-1].value[1]), told):
                found.append(ActivityEvent(lately[0][0], kind, (level, told)))
        rests_us = (held[number + 1][0] if number + 1 < len(held) else until_us) - begin - length
        if found and rests_us > pause_us:
            near = rests_us < _CLEAR * pause_us
            found.append(ActivityEvent(begin + length, kind, (level, NO_MORE), barely=near))
            lately = []
    return found


def _long_pause(held: list[tuple[float, float]]) -> float:
    """How long a line is not held where that is no part of what goes on: much longer than usual."""
    pauses = sorted(held[at + 1][0] - held[at][0] - held[at][1] for at in range(len(held) - 1))
    return max(_LEAST_PAUSE_US, _PAUSES * pauses[len(pauses) // 2]) if pauses else inf


def let_go_levels(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """When a line is driven low and when it is let go, up to where the program drives it high, if it does: others may pull it up.

    What comes later changes nothing about what was before, since the two sides need not be seen for equally long. Where the line
    is first let go so near to the end that another run may do so after it, all of that only just happens.

    Args:
        trace: what was seen.
        pin: label of the pin.

    Returns:
        The events, the first one being that of the begin, the only one where the line is not let go again, as at an output that
        rests, or where a timer makes a wave at it.
    """
    changes = trace.levels(pin)
    waves = [wave.at_us for wave in trace.waves if wave.pin == pin and wave.hz > 0]
    high_us = min([*waves, *(at_us for at_us, level in changes if level == 1)], default=inf)
    driven = next((number for number, (_, level) in enumerate(changes) if level == 0), len(changes))
    found = [ActivityEvent(0.0, LEVEL, (LET_GO,))]
    if not any(level != 0 and at_us < high_us for at_us, level in changes[driven:]):
        return found
    ends = [at_us for at_us, _ in changes[driven + 1 :]]
    for number, (at_us, level) in enumerate(changes[driven:]):
        if at_us >= high_us:
            break
        lasts_us = ends[number] - at_us if number < len(ends) else _OFTEN_US
        value = DRIVEN_LOW if level == 0 else LET_GO
        if lasts_us >= _SHORTEST_US and found[-1].value != (value,):
            found.append(ActivityEvent(at_us, LEVEL, (value,)))
    first_us = next((event.at_us for event in found[1:] if event.value == (LET_GO,)), inf)
    near = trace.simulated_us - _LEAST_PAUSE_US < first_us < inf
    return [found[0], *(replaced(event, barely=True) for event in found[1:])] if near else found


def lengths_alike(one_us: float, other_us: float) -> bool:
    """Whether two lengths are the same, within 100 us and 5 %."""
    return abs(one_us - other_us) <= _SHORTEST_US + 0.05 * max(one_us, other_us)


def pulses_alike(one_us: float, other_us: float) -> bool:
    """Whether two pulses are as long, within what interrupts delay both edges by, and 1 %."""
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
