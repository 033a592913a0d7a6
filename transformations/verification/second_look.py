"""A second look at a scenario in which the migrated program differs: does the source differ from itself there as well?

The few varied runs of a scenario are a sample. If an input changes just beside the instant at which the program reads it, only
some of them, by chance, see it at the next read; the same holds for the servo frame in which a new speed takes effect. So if
there is a difference, further runs are made, and it counts only if they do not show it themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from robosmi.transformations.verification.judging import SAME_MS, judged
from robosmi.transformations.verification.original_side import SourceRuns
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.transformations.verification.seen_beside import NO_LEVELS
from robosmi.verify.alignment import alike
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.verdict import DIFFERENT_VERDICT, ScenarioVerdict


def looked_at_again(
    told: ScenarioVerdict,
    scenario: Scenario,
    trace: PinTrace,
    ports: Sequence[BoundPort],
    one_thread: bool,
    runs: SourceRuns,
    further: Callable[[Scenario, SourceRuns], SourceRuns],
    at_rest: Mapping[str, int] = NO_LEVELS,
) -> ScenarioVerdict:
    """The verdict on a scenario, with further runs of the source if it is a difference.

    Args:
        told: the verdict from the runs so far.
        scenario: the scenario.
        trace: the run of the migrated program.
        ports: the ports.
        one_thread: whether a single thread of the source does all that is observed.
        runs: the runs of the source.
        further: adds further runs of the source.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
    """
    first = told.first
    if told.verdict != DIFFERENT_VERDICT or first is None or told.crash is not None:
        return told
    more = further(scenario, runs)
    again = judged(scenario, more, trace, ports, one_thread, at_rest)
    selves = [each.itself for each in again.channels if each.channel == first.channel]
    itself = selves[0] if selves else None
    if itself is None or again.verdict == DIFFERENT_VERDICT:
        return again
    until_ms = first.at_ms
    if first.source is not None and first.target is not None and alike(first.source, first.target):  # only its duration differs
        events = more.channels[first.channel][0][0]
        later_ms = [event.at_us / 1000 for event in events if event.at_us / 1000 > first.at_ms]
        until_ms = min(later_ms) if later_ms else scenario.horizon_ms
    return again if itself.at_ms <= until_ms + SAME_MS else told  # a later one explains nothing
