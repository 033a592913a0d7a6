"""Which numbers of printed text are measured: those that change if the devices show a little more or less.

Two boards never measure exactly alike, so a measured number may differ. All other numbers of the same text, such as a counter
or the number of a channel, do not depend on measurements and must be equal on every board. Two further runs of the source with
other measured values find them. If the accuracy of the measurements is known, more runs yield the range in which a measured
number may lie, so that a number that is always one too large is not excused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from msgspec.structs import replace

from robosmi.data_text import Json, as_number
from robosmi.transformations.verification.simulated_kinds import SimulatedKind, device_facts
from robosmi.verify.activity import READING, ActivityEvent
from robosmi.verify.alignment import numbers_of, shape_of
from robosmi.verify.simulation import DeviceUse

_PARTS = (0.07, -0.07)
"""Relative changes of measured values that are larger than two boards may differ by."""
_OFF = (1.0, -1.0, 0.5, -0.5)
"""Changes of measured values, as parts of what two boards may differ by."""
MEASURED = ("voltages", "capacitor", "ranger", "two_pin_ranger")
"""Devices whose values two boards never measure exactly alike."""
Channels = dict[str, list[list[list[ActivityEvent]]]]
Otherwise = Callable[[float | None, SimulatedKind, float, float, float], float | None]
"""Changes a value; further arguments: facts of the device's kind, its least and greatest value, and by which part."""


def with_exact_numbers(
    channels: Channels,
    devices: Sequence[DeviceUse],
    run: Callable[[Sequence[DeviceUse]], Mapping[str, list[list[ActivityEvent]]]],
) -> Channels:
    """The channels, with the exact numbers and the ranges of measured ones added to the nominal run's readings.

    Args:
        channels: name -> for each of `SIGHTS` the events of the nominal run, then those of each varied run.
        devices: the devices of the scenario.
        run: runs the source with other devices; returns its channels, name -> for each of `SIGHTS` its events.
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
    """Whether the scenario has measuring devices, and it is known of all of them by how much two boards may differ."""
    kinds = [use.kind for use in devices if use.kind in MEASURED]
    return bool(kinds) and all("off_least" in device_facts()[kind] for kind in kinds)


def _marked(
    source: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    wide: Sequence[Sequence[ActivityEvent]],
    near: Sequence[Sequence[ActivityEvent]],
) -> list[ActivityEvent]:
    """The source's events; readings get `exact` and `between`, until the runs print lines of other shapes."""
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
            marked[at] = replace(event, exact=exact, between=between)
    return marked


def _same_shapes(event: ActivityEvent, at: int, runs: Sequence[Sequence[ActivityEvent]]) -> bool:
    return all(at < len(run) and run[at].kind == event.kind and shape_of(run[at]) == shape_of(event) for run in runs)


def _span(numbers: Iterable[float]) -> tuple[float, float]:
    listed = list(numbers)
    return min(listed), max(listed)


def _measured_otherwise(use: DeviceUse, other: Otherwise, part: float) -> DeviceUse:
    """A device all of whose measured values are changed."""
    if use.kind not in MEASURED:
        return use
    facts = device_facts()[use.kind]
    changed: dict[str, Json] = {}
    for name, ends in facts["ends"].items():
        least, most = (as_number(end) for end in ends)
        points: Sequence[tuple[float, float | None]] = use.settings[name]
        changed[name] = [[at_ms, other(value, facts, least, most, part)] for at_ms, value in points]
    return replace(use, settings={**use.settings, **changed})


def _within_accuracy(value: float | None, facts: SimulatedKind, least: float, most: float, part: float) -> float | None:
    """A measured value that is changed by a part of what two boards may differ by, within the limits of the device."""
    if value is None:
        return None
    by = part * (facts["off_least"] + facts["off_percent"] / 100 * abs(value))
    return min(max(value + by, min(least, value)), max(most, value))


def _beyond_accuracy(value: float | None, facts: SimulatedKind, least: float, most: float, part: float) -> float:
    """A value that is changed by a part of itself, or of a tenth of the device's range if that is larger.

    If the device shows nothing, it is almost the greatest value instead.
    """
    if value is None:
        return most * (1 - abs(part))
    return min(max(value + part * max(value, 0.1 * (most - least)), least), most)
