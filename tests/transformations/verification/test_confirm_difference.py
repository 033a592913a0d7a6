"""A second look at a difference: one that further runs of the source show as well is none, one that they do not is."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from types import SimpleNamespace
from typing import cast

import pytest
from msgspec.structs import replace

from robosmi.errors import VerificationError
from robosmi.transformations.verification.judgement import scenario_verdicts
from robosmi.transformations.verification.judgement.scenario_verdicts import compare_scenarios, looked_at_again
from robosmi.transformations.verification.judgement.verdict import verdict_of
from robosmi.transformations.verification.original_side import SourceRuns, channel_events
from robosmi.transformations.verification.target_side import TargetSide
from robosmi.verify.original import Original
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinChange, PinTrace
from tests.transformations.verification.test_verdict import SCENARIO, original, printed

SILENT = cast("Original", SimpleNamespace(store_bytes=0))
"""An original whose runs are there already."""
SOURCE = ((100.0, "far"), (300.0, "near"), (500.0, "far"))


@pytest.mark.parametrize(
    ("again", "target", "verdict"),
    [
        (((100.0, "far"), (300.0, "far"), (500.0, "far")), ((100.0, "far"), (300.0, "far"), (500.0, "far")), "not-decidable"),
        (SOURCE, ((100.0, "far"), (300.0, "far"), (500.0, "far")), "different"),
        (((100.0, "far"), (300.0, "near"), (500.0, "near")), ((100.0, "far"), (300.0, "none"), (500.0, "far")), "different"),
        (((100.0, "far"), (300.0, "near"), (500.0, "near")), ((100.0, "none"), (300.0, "near"), (500.0, "far")), "different"),
        (
            ((100.0, "far"), (390.0, "near"), (500.0, "far")),
            ((100.0, "far"), (420.0, "near"), (500.0, "far")),
            "no-difference-found",
        ),
    ],
    ids=["it does so itself", "it never does so", "it does something else later", "the difference comes before", "later by luck"],
)  # fmt: skip
def test_what_the_source_does_as_well_is_no_difference(
    again: tuple[tuple[float, str], ...], target: tuple[tuple[float, str], ...], verdict: str
) -> None:
    runs = original(printed(*SOURCE))
    trace = printed(*target)
    told = verdict_of(SCENARIO, runs, trace, [], one_thread=True)
    assert told.verdict == "different"

    def further(scenario: Scenario, before: SourceRuns) -> SourceRuns:
        return with_run(before, printed(*again))

    assert looked_at_again(told, SCENARIO, trace, [], True, runs, further).verdict == verdict


def test_no_further_runs_are_made_where_nothing_differs() -> None:
    runs = original(printed(*SOURCE))
    told = verdict_of(SCENARIO, runs, printed(*SOURCE), [], one_thread=True)

    def further(scenario: Scenario, before: SourceRuns) -> SourceRuns:
        raise AssertionError("there was nothing to look at")

    assert looked_at_again(told, SCENARIO, printed(*SOURCE), [], True, runs, further) is told


@pytest.mark.parametrize(
    ("origin", "looks"), [("stored", 1), ("generated", 3)], ids=["stored", "generated ones that are racy are not stored"]
)
def test_a_difference_that_is_confirmed_is_not_looked_at_again(origin: str, looks: int, monkeypatch: pytest.MonkeyPatch) -> None:
    looked: list[str] = []

    def further(program: object, ports: object, scenario: Scenario, runs: SourceRuns, limit_s: float) -> SourceRuns:
        looked.append(scenario.name)
        return runs

    monkeypatch.setattr(scenario_verdicts, "run_further", further)
    lamp = replace(printed(*SOURCE), changes=(PinChange(200_000.0, "D9", 1),))
    wrong = printed((100.0, "far"), (300.0, "far"), (500.0, "far"))
    traces = [wrong, printed(*SOURCE), wrong, wrong]
    cases = [(Scenario(f"s{number}", 1000.0, origin=origin), original(printed(*SOURCE))) for number in range(len(traces))]
    found = compare_scenarios(SILENT, [], cases, Shown(traces), True, {})
    assert [each.told.verdict == "different" for each in found.kept] == [True, False, True, True]
    assert len(looked) == looks
    looked.clear()
    other = [replace(cases[0][0], name="console"), replace(cases[0][0], name="a pin")]
    compare_scenarios(
        SILENT, [], [(each, original(printed(*SOURCE))) for each in other], Shown([printed(*SOURCE[:2]), lamp]), True, {}
    )
    assert looked == ["console", "a pin"]


def test_a_pin_without_a_port_is_looked_at_again_like_a_channel() -> None:
    runs = original(printed(*SOURCE))
    trace = replace(printed(*SOURCE), changes=(PinChange(200_000.0, "D9", 1),))
    told = verdict_of(SCENARIO, runs, trace, [], one_thread=True)
    asked: list[float | None] = []

    def apart(scenario: Scenario, before: SourceRuns, differs_at: Callable[[SourceRuns], float | None]) -> bool:
        asked.append(differs_at(before))
        return False

    found = looked_at_again(told, SCENARIO, trace, [], True, runs, lambda _, before: before, apart=apart)
    assert (told.verdict, found.verdict, asked) == ("different", "different", [200.0])


class Shown(TargetSide):
    """A migrated program whose runs are there already."""

    def __init__(self, traces: Sequence[PinTrace]) -> None:
        self.traces, self.shows_console = traces, True

    def run(self, scenarios: Sequence[Scenario]) -> Iterator[PinTrace | VerificationError]:
        assert len(scenarios) == len(self.traces)
        yield from self.traces


def with_run(runs: SourceRuns, trace: PinTrace) -> SourceRuns:
    """The runs with a further one."""
    seen = channel_events(trace, [], target=False)
    return replace(
        runs, channels={name: [[*each, seen[name][at]] for at, each in enumerate(its)] for name, its in runs.channels.items()}
    )
