"""Which numbers of a text are measured: those that change where what the devices show is a little more or less.

Two boards never measure quite alike, so that a measured number may be off. All others of the same text, as a counter or a channel
that a text names, hang on nothing that is measured: they are the same on every board, to the letter. Found by two more runs of
the source.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from robosmi.data_text import Json, as_number
from robosmi.transformations.verification.simulated_kinds import device_facts
from robosmi.typed import replaced
from robosmi.verify.activity import READING, ActivityEvent
from robosmi.verify.alignment import numbers_of, shape_of
from robosmi.verify.simulation import DeviceUse

_PARTS = (0.07, -0.07)
"""By so much more or less is measured; beyond what two boards may differ by."""
MEASURED = ("voltages", "capacitor", "ranger", "two_pin_ranger")
"""Devices whose values two boards never measure quite alike."""
Channels = dict[str, list[list[list[ActivityEvent]]]]


def with_exact_numbers(
    channels: Channels,
    devices: Sequence[DeviceUse],
    run: Callable[[Sequence[DeviceUse]], Mapping[str, list[list[ActivityEvent]]]],
) -> Channels:
    """The channels, of which the nominal run's readings know which of their numbers are not measured.

    Args:
        channels: name -> for each sight the events of the nominal run, then of each varied one.
        devices: those of the scenario.
        run: the channels of a run of the source with other devices.
    """
    names = [name for name, seen in channels.items() if any(_has_numbers(event) for event in seen[0][0])]
    others = [run([_showing(use, part) for use in devices]) for part in _PARTS] if names else []
    return {
        name: [
            [_marked(own, [*varied, *(other[name][sight] for other in others)]), *varied]
            for sight, (own, *varied) in enumerate(seen)
        ]
        if name in names
        else seen
        for name, seen in channels.items()
    }


def _has_numbers(event: ActivityEvent) -> bool:
    return event.kind == READING and bool(numbers_of(event))


def _marked(source: Sequence[ActivityEvent], runs: Sequence[Sequence[ActivityEvent]]) -> list[ActivityEvent]:
    """Events with what is alike in all runs, as far as all print lines of the same shape."""
    marked = list(source)
    for at, event in enumerate(source):
        if any(at >= len(run) or run[at].kind != event.kind or shape_of(run[at]) != shape_of(event) for run in runs):
            break
        if event.kind == READING:
            again = [numbers_of(run[at]) for run in runs]
            marked[at] = replaced(
                event, exact=tuple(all(n[place] == own for n in again) for place, own in enumerate(numbers_of(event)))
            )
    return marked


def _showing(use: DeviceUse, part: float) -> DeviceUse:
    """A device that shows more of all that it measures by a part of it, and something where it shows nothing."""
    if use.kind not in MEASURED:
        return use
    changed: dict[str, Json] = {}
    for name, ends in device_facts()[use.kind]["ends"].items():
        least, most = (as_number(end) for end in ends)
        points: Sequence[tuple[float, float | None]] = use.settings[name]
        changed[name] = [[at_ms, _shifted(value, part, least, most)] for at_ms, value in points]
    return replaced(use, settings={**use.settings, **changed})


def _shifted(value: float | None, part: float, least: float, most: float) -> float:
    """A value that is more by a part of itself, or of a tenth of what the device can measure where that is more."""
    if value is None:
        return most * (1 - abs(part))
    return min(max(value + part * max(value, 0.1 * (most - least)), least), most)
