"""How a program drives a line that it shares with a device: for how long it holds it high or low before it lets go or goes on.

A sensor that is charged, or asked by a long pulse, answers only if that lasts long enough; a simulated one may be more patient
than a real one. So how long is looked at, too. What a device answers is its own business.
"""

from __future__ import annotations

from statistics import median

from robosmi.verify.activity import HELD, ActivityEvent
from robosmi.verify.simulation import PinTrace

_SHORTEST_US = 100.0
"""What lasts less is not looked at: nothing is claimed of the source below that."""
_AGREE = 3
"""So many that follow one another tell a new length where a line is held often: single ones are stretched by interrupts."""
_OFTEN_US = 200_000.0


def held_levels(trace: PinTrace, pin: str) -> list[ActivityEvent]:
    """The lengths for which a line is held, by time: an event wherever they become others.

    Args:
        trace: what was seen.
        pin: label of the pin.
    """
    found: list[ActivityEvent] = []
    for level in (0, 1):
        held = _held(trace, pin, level)
        lately: list[tuple[float, float]] = []
        at_first = sum(begin - held[0][0] < _OFTEN_US for begin, _ in held)
        for begin, length in held:
            lately = [*[each for each in lately if begin - each[0] < _OFTEN_US][1 - _AGREE :], (begin, length)]
            often = len(lately) == _AGREE or (at_first >= _AGREE and begin - held[0][0] < _OFTEN_US)
            if often and len(lately) < _AGREE:
                continue
            told = median(each[1] for each in lately)
            last = next((event for event in reversed(found) if event.value[0] == level), None)
            if last is None or not lengths_alike(float(last.value[1]), told):
                found.append(ActivityEvent(lately[0][0], HELD, (level, told)))
    return sorted(found, key=lambda event: event.at_us)


def lengths_alike(one_us: float, other_us: float) -> bool:
    """Whether two lengths are the same, within 100 us and 5 %."""
    return abs(one_us - other_us) <= _SHORTEST_US + 0.05 * max(one_us, other_us)


def _held(trace: PinTrace, pin: str, wanted: int) -> list[tuple[float, float]]:
    found = []
    begun: float | None = None
    for at_us, level in trace.levels(pin):
        if level == wanted and begun is None:
            begun = at_us
        elif level != wanted and begun is not None:
            if at_us - begun >= _SHORTEST_US:
                found.append((begun, at_us - begun))
            begun = None
    return found
