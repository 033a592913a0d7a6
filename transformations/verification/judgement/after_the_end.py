"""What a migrated program does after its original has ended: nothing may be driven or printed any more.

A scenario ends soon after the original does, so what the migrated program does some seconds later would not be observed. If the
original ends in all of its runs, the migrated program is simulated for longer than the scenario lasts.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import SourceRuns, channel_events
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.comparison import DIFFERENT, RACY, RESONATOR, ChannelComparison, FirstDifference

_LONGER_MS = 5_000.0
_LATE_MS = 500.0
"""The migrated program may end later than the original by this, and by the error of its resonator."""


def simulated_longer(scenario: Scenario, runs: SourceRuns) -> Scenario:
    """The scenario for the migrated program: longer than the given one if the original ends.

    Args:
        scenario: the scenario.
        runs: the runs of the original.
    """
    quiet_ms = _quiet_from_ms(scenario, runs)
    return scenario if quiet_ms is None else replace(scenario, horizon_ms=quiet_ms + _LONGER_MS)


def compared_after_the_end(
    found: tuple[ChannelComparison, ...], scenario: Scenario, runs: SourceRuns, trace: PinTrace, ports: Sequence[BoundPort]
) -> tuple[ChannelComparison, ...]:
    """The comparisons of the channels, with a difference where the migrated program does something after the original's end.

    Args:
        found: the comparisons until the end of the scenario.
        scenario: the scenario.
        runs: the runs of the original.
        trace: the whole trace of the migrated program.
        ports: the ports of the program.
    """
    quiet_ms = _quiet_from_ms(scenario, runs)
    if quiet_ms is None or trace.simulated_us / 1000 <= quiet_ms or any(each.status in (DIFFERENT, RACY) for each in found):
        return found
    seen = channel_events(trace, ports, target=True)
    compared = []
    for each in found:
        events = seen[each.channel][0] if each.channel in seen else ()
        event = next((e for e in events if e.at_us / 1000 > quiet_ms and not e.barely), None)
        if event is not None:
            message = f"{event.does()}; the original ended at {runs.nominal.trace.simulated_us / 1000:.1f} ms"
            difference = FirstDifference(event.at_us / 1000, each.channel, message, None, event)
            each = replace(each, status=DIFFERENT, difference=difference)
        compared.append(each)
    return tuple(compared)


def _quiet_from_ms(scenario: Scenario, runs: SourceRuns) -> float | None:
    """When nothing may happen any more, in milliseconds; None if a run of the original does not end."""
    every = (runs.nominal, *runs.varied)
    if runs.given_up or any(run.status != "finished" for run in every):
        return None
    ended_ms = max(run.trace.simulated_us for run in every) / 1000
    return max(scenario.horizon_ms, ended_ms * (1 + RESONATOR) + _LATE_MS)
