"""For how long a program leaves a sensor alone between two questions, and the comparison of these pauses with the target's.

A program that asks a distance sensor in a loop reacts as late as the loop is long. An output shows this only where an input
changes, and there a few tens of milliseconds are within the tolerance of a polling program. The sensor is asked in each pass, so
its pauses show the loop itself. A pause begins with the end of an answer and ends with the next question: the time of the answer
is the sensor's and not the program's.

Pauses are compared while no input changes, and only where all runs of the source agree on them: there the loop does the same in
each pass. Their median is compared, so that a single longer pass, in which the program acts, does not count.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from math import inf
from statistics import median
from typing import NamedTuple

from robosmi.base.data_text import as_number
from robosmi.transformations.verification.bound_devices.played_devices import devices_at
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import LINE, ActivityEvent
from robosmi.verify.traces.comparison import DIFFERENT, RESONATOR, SAME, ChannelComparison, FirstDifference

PAUSES = ", pauses between its questions"
"""The suffix of the channel with the pauses of the device at a port."""
_FEWEST = 5
"""Fewer pauses while no input changes do not tell what is usual there."""
_USUAL = 0.75
"""The loop does the same in each pass if this part of its pauses is near their median."""
_BASE_MS, _PART = 0.1, 0.01
"""Tolerance of a pause: the source's times are not known below 100 us, and durations may differ by the part."""
_SLOWER = 10
"""By this multiple of the time of its steps a pass may be longer: microcontrollers of 8 bits take so long for 32 bits."""
_SETTLED_MS = 50.0
"""After a change of an input the pauses are not compared for this time, since the program may not have noticed it yet."""
_LONG_MS, _LONG = 500.0, 5
"""A device is no longer asked if it is left alone for the time, and for the second times the usual pause."""


class Pause(NamedTuple):
    """A time for which the program leaves a device alone, in milliseconds: when it begins, and how long it is."""

    at_ms: float
    lasts_ms: float


class Stretch(NamedTuple):
    """A time during which no input changes, in milliseconds."""

    begin_ms: float
    end_ms: float


def observed_pauses(trace: PinTrace, ports: Sequence[BoundPort], target: bool) -> dict[str, list[Pause]]:
    """The pauses of each device in a run: channel -> pauses, by time.

    Args:
        trace: the trace of the run.
        ports: the ports of the program.
        target: whether the trace is from the target.
    """
    found: dict[str, list[Pause]] = {}
    for number, device in enumerate(devices_at(ports, target)):
        what = device_facts().get(device.kind, {}).get("pauses")
        title = next((ports[n].title for n in device.ports if ports[n].compared), "")
        if what and title:
            noted = (each for each in trace.device_events if each.device == number and each.what == what)
            lasts = ((each.at_us / 1000, as_number(each.value) / 1000) for each in noted)
            found[f"{title}{PAUSES}"] = [Pause(end_ms - pause_ms, pause_ms) for end_ms, pause_ms in lasts]
    return found


def pauses_compared(
    source: Mapping[str, Sequence[Sequence[Pause]]], nominal: PinTrace, trace: PinTrace, ports: Sequence[BoundPort],
    scenario: Scenario, horizon_ms: float,
) -> tuple[ChannelComparison, ...]:  # fmt: skip
    """The comparisons of the pauses of all devices that are asked on both sides.

    Args:
        source: channel -> the pauses in each run of the source, the nominal run first.
        nominal: the trace of the nominal run.
        trace: the trace of the migrated program.
        ports: the ports of the program.
        scenario: the scenario, with the inputs' changes.
        horizon_ms: until when both are compared.
    """
    theirs = observed_pauses(trace, ports, target=True)
    stretches = list(_stretches(scenario, horizon_ms))
    printed = [each.at_us / 1000 for each in nominal.console]
    found = (compare_pauses(name, runs, theirs[name], stretches, printed) for name, runs in source.items() if name in theirs)
    return tuple(each for each in found if each is not None)


def _stretches(scenario: Scenario, horizon_ms: float) -> Iterable[Stretch]:
    """The times of a scenario during which no input changes, without the time in which a program may notice the last change."""
    points = (point for settings in scenario.signals.values() for each in settings.values() for point in each)
    changes = sorted({0.0, horizon_ms, *(float(at_ms) for at_ms, *_ in points if 0 < at_ms < horizon_ms)})
    for begin_ms, end_ms in pairwise(changes):
        settled_ms = begin_ms + _SETTLED_MS + RESONATOR * begin_ms
        if settled_ms < end_ms:
            yield Stretch(settled_ms, end_ms * (1 - RESONATOR))


def compare_pauses(
    channel: str, runs: Sequence[Sequence[Pause]], target: Sequence[Pause], stretches: Iterable[Stretch], printed: Sequence[float]
) -> ChannelComparison | None:
    """Compare the pauses of a device, up to the first stretch of time in which they differ; None if they tell nothing.

    Args:
        channel: the name of the channel.
        runs: the pauses in each run of the source, the nominal run first.
        target: the pauses of the migrated program.
        stretches: the times during which no input changes.
        printed: when each byte of the source's console ends, which the migrated program may print beside its loop.
    """
    compared = 0
    for stretch in stretches:
        own = [_within(run, stretch) for run in runs]
        if any(len(each) < _FEWEST for each in own):
            continue
        usual = [median(each) for each in own]
        allowed_ms = _BASE_MS + _PART * usual[0] + 2 * max(abs(each - usual[0]) for each in usual)
        allowed_ms += _printing_ms(printed, stretch) / len(own[0])
        if not all(_is_steady(each, middle, allowed_ms) for each, middle in zip(own, usual, strict=True)):
            continue
        steps_ms = max(0.0, usual[1] - usual[0]) if len(usual) > 1 else 0.0  # they cost twice as much in the first varied run
        later_ms = allowed_ms + _SLOWER * steps_ms
        theirs = _within(target, stretch)
        lasts_ms = median(theirs) if theirs else inf
        if not theirs and stretch.end_ms - stretch.begin_ms < max(_LONG_MS, _LONG * usual[0]):
            continue
        compared += 1
        if not usual[0] - allowed_ms <= lasts_ms <= usual[0] + later_ms:
            allowed_ms = allowed_ms if lasts_ms < usual[0] else later_ms
            return ChannelComparison(channel, DIFFERENT, _told(channel, stretch, usual[0], lasts_ms, allowed_ms), compared)
    return ChannelComparison(channel, SAME, events=compared) if compared else None


def _within(pauses: Iterable[Pause], stretch: Stretch) -> list[float]:
    """The lengths of the pauses that lie within a stretch of time."""
    return [each.lasts_ms for each in pauses if stretch.begin_ms <= each.at_ms and each.at_ms + each.lasts_ms <= stretch.end_ms]


def _is_steady(lengths: Sequence[float], middle: float, allowed_ms: float) -> bool:
    return sum(abs(each - middle) <= allowed_ms for each in lengths) >= _USUAL * len(lengths)


def _printing_ms(printed: Sequence[float], stretch: Stretch) -> float:
    """For how long the source prints in a stretch of time."""
    times = [at_ms for at_ms in printed if stretch.begin_ms <= at_ms <= stretch.end_ms]
    shortest = min((after - before for before, after in pairwise(times) if after > before), default=0.0)
    return len(times) * shortest


def _told(channel: str, stretch: Stretch, usual_ms: float, lasts_ms: float, allowed_ms: float) -> FirstDifference:
    """The difference, with a message that states both pauses and the tolerance."""
    source, target = (
        ActivityEvent(1000 * stretch.begin_ms, LINE, (f"is left alone for {each:.2f} ms between two questions",))
        for each in (usual_ms, lasts_ms)
    )
    does = "asks no more" if lasts_ms == inf else f"pauses for {lasts_ms:.2f} ms between two questions"
    message = f"{does}; the original for {usual_ms:.2f} ms (tolerance {allowed_ms:.2f} ms)"
    return FirstDifference(stretch.begin_ms, channel, message, source, target)
