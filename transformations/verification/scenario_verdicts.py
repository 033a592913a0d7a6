"""Run the migrated program in each scenario, and compare it with what the original has done there.

Of each run of the migrated program only the events of the channels are kept, since a trace may have some hundred thousand
edges: only the traces of the runs in progress are in memory.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from msgspec import Struct

from robosmi.doing import doing
from robosmi.errors import VerificationError
from robosmi.transformations.verification.after_the_end import simulated_longer
from robosmi.transformations.verification.judging import ended_badly, judged, without_target
from robosmi.transformations.verification.original_side import CONSOLE_CHANNEL, SourceRuns, channel_events, run_further
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.transformations.verification.second_look import looked_at_again
from robosmi.transformations.verification.target_side import LIMIT_S, NOTHING_SEEN, TargetSide
from robosmi.verify.activity import ActivityEvent
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.verdict import NOT_DECIDABLE, ScenarioVerdict

Case = tuple[Scenario, SourceRuns]


class ComparedScenario(Struct):
    """A scenario that was compared.

    Attributes:
        told: the verdict on it.
        runs: the original's runs.
        target: channel -> the events of the migrated program.
        trace: its whole trace, if that was asked for.
    """

    told: ScenarioVerdict
    runs: SourceRuns
    target: dict[str, list[ActivityEvent]]
    trace: PinTrace | None = None


class ComparedScenarios(Struct):
    """The results of all scenarios.

    Attributes:
        kept: the scenarios that were compared.
        racy: generated scenarios that were dropped because a second look shows that the source differs from itself there.
        undecided: the errors because of which a run of the migrated program is not known and a verdict is not possible.
    """

    kept: list[ComparedScenario] = []
    racy: list[Case] = []
    undecided: list[VerificationError] = []


def compare_scenarios(
    program: OriginalProgram, ports: Sequence[BoundPort], cases: Sequence[Case], side: TargetSide, one_thread: bool,
    at_rest: Mapping[str, int], whole: bool = False,
) -> ComparedScenarios:  # fmt: skip
    """Run the migrated program in each scenario, and compare what both do.

    Args:
        program: the original.
        ports: the ports.
        cases: the scenarios with the original's runs.
        side: the migrated program on its board.
        one_thread: whether a single thread of the source does all that is observed.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
        whole: whether to keep the whole traces of the migrated program.
    """

    def further(scenario: Scenario, runs: SourceRuns) -> SourceRuns:
        doing(f"look whether the source differs from itself in '{scenario.name}'")
        return run_further(program, ports, scenario, runs, LIMIT_S)

    found = ComparedScenarios()
    number = 0
    for (scenario, runs), trace in zip(cases, side.run([simulated_longer(*case) for case in cases]), strict=True):
        number += 1
        doing(f"compare what both do: {number} of {len(cases)}")
        if not side.shows_console:
            runs.channels.pop(CONSOLE_CHANNEL, None)
        if isinstance(trace, VerificationError):
            told, seen = without_target(scenario, runs, trace), NOTHING_SEEN
            found.undecided += [] if ended_badly(runs) else [trace]
        else:
            first, seen = judged(scenario, runs, trace, ports, one_thread, at_rest), trace
            told = looked_at_again(first, scenario, trace, ports, one_thread, runs, further, at_rest)
            if told is not first and told.verdict == NOT_DECIDABLE and scenario.origin == "generated":
                found.racy.append((scenario, runs))
                continue
        target = {name: events for name, (events, *_) in channel_events(seen, ports, target=True).items()}
        found.kept.append(ComparedScenario(told, runs, target, seen if whole else None))
    return found
