"""Which numbers of a text are measured: those that change where what the devices show is a little more or less.

Two boards never measure quite alike, so that a measured number may be off. All others of the same text, as a counter or a channel
that a text names, hang on nothing that is measured: they are the same on every board, to the letter. Found by two more runs of
the source. Where it is known how far off two boards measure the same, further runs tell between which numbers a measured one may
lie: one that is always more by one is not explained by that.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from robosmi.data_text import Json, as_number
from robosmi.transformations.verification.simulated_kinds import SimulatedKind, device_facts
from robosmi.typed import replaced
from robosmi.verify.activity import READING, ActivityEvent
from robosmi.verify.alignment import numbers_of, shape_of
from robosmi.verify.simulation import DeviceUse

_PARTS = (0.07, -0.07)
"""By so much more or less is measured; beyond what two boards may differ by."""
_OFF = (1.0, -1.0, 0.5, -0.5)
"""By such parts of how far two boards may be off is measured more or less."""
MEASURED = ("voltages", "capacitor", "ranger", "two_pin_ranger")
"""Devices whose values two boards never measure quite alike."""
Channels = dict[str, list[list[list[ActivityEvent]]]]
Otherwise = Callable[[float | None, SimulatedKind, float, float, float], float | None]
"""Makes another value of one: with the facts of the device's kind, the least and the most that it measures, and by what part."""


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

    def runs(other: Otherwise, parts: Sequence[float]) -> list[Mapping[str, list[list[ActivityEvent]]]]:
        return [run([_measured_otherwise(use, other, part) for use in devices]) for part in parts]

    wide = runs(_beyond_accuracy, _PARTS) if names else []
    near = runs(_within_accuracy, _OFF) if names and _all_known(devices) else []
    return {
        name: [
            [_marked(own, varied, [run[name][sight] for run in wide], [run[name][sight] for run in near]), *varied]
            for sight, (own, *varied) in enumerate(seen)
        ]
        if name in names
        else seen
        for name, seen in channels.items()
    }


def _has_numbers(event: ActivityEvent) -> bool:
    return event.kind == READING and bool(numbers_of(event))


def _all_known(devices: Sequence[DeviceUse]) -> bool:
    """Whether something is measured, and of all that is it is known how far off two boards may be."""
    kinds = [use.kind for use in devices if use.kind in MEASURED]
    return bool(kinds) and all("off_least" in device_facts()[kind] for kind in kinds)


def _marked(
    source: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    wide: Sequence[Sequence[ActivityEvent]],
    near: Sequence[Sequence[ActivityEvent]],
) -> list[ActivityEvent]:
    """Events with what is alike in all runs, and what may be off by how much, as far as all print lines of the same shape."""
    marked = list(source)
    for at, event in enumerate(source):
        if not _same_shapes(event, at, [*varied, *wide]):
            break
        if event.kind == READING:
            own = numbers_of(event)
            again = [numbers_of(run[at]) for run in (*varied, *wide)]
            exact = tuple(all(n[place] == each for n in again) for place, each in enumerate(own))
            measured = [any(n[place] != each for n in again[len(varied) :]) for place, each in enumerate(own)]
            between = tuple(None for _ in own)  # type: tuple[tuple[float, float] | None, ...]
            if near and _same_shapes(event, at, near):
                runs = [own, *again[: len(varied)], *(numbers_of(run[at]) for run in near)]
                between = tuple(_span(float(n[place]) for n in runs) if measured[place] else None for place in range(len(own)))
            marked[at] = replaced(event, exact=exact, between=between)
    return marked


def _same_shapes(event: ActivityEvent, at: int, runs: Sequence[Sequence[ActivityEvent]]) -> bool:
    return all(at < len(run) and run[at].kind == event.kind and shape_of(run[at]) == shape_of(event) for run in runs)


def _span(numbers: Iterable[float]) -> tuple[float, float]:
    listed = list(numbers)
    return min(listed), max(listed)


def _measured_otherwise(use: DeviceUse, other: Otherwise, part: float) -> DeviceUse:
    """A device that shows something else of all that it measures."""
    if use.kind not in MEASURED:
        return use
    facts = device_facts()[use.kind]
    changed: dict[str, Json] = {}
    for name, ends in facts["ends"].items():
        least, most = (as_number(end) for end in ends)
        points: Sequence[tuple[float, float | None]] = use.settings[name]
        changed[name] = [[at_ms, other(value, facts, least, most, part)] for at_ms, value in points]
    return replaced(use, settings={**use.settings, **changed})


def _within_accuracy(value: float | None, facts: SimulatedKind, least: float, most: float, part: float) -> float | None:
    """What a board sees that measures more, by a part of what two boards may be off."""
    if value is None:
        return None
    by = part * (facts["off_least"] + facts["off_percent"] / 100 * abs(value))
    return min(max(value + by, min(least, value)), max(most, value))


def _beyond_accuracy(value: float | None, facts: SimulatedKind, least: float, most: float, part: float) -> float:
    """A value that is more by a part of itself, or of a tenth of what the device can measure where that is more; where a device
    shows nothing, something.
    """
    if value is None:
        return most * (1 - abs(part))
    return min(max(value + part * max(value, 0.1 * (most - least)), least), most)
