"""A difference that only comes from the instant at which an input changes within a pass of the source's loop is none."""

from __future__ import annotations

from collections.abc import Callable
from typing import cast

import pytest

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.judgement.scenario_verdicts import (
    hangs_on_a_pass,
    longest_pass_ms,
    looked_at_again,
    with_reactions,
)
from robosmi.transformations.verification.judgement.side_effects import NO_LEVELS
from robosmi.transformations.verification.judgement.verdict import verdict_of
from robosmi.transformations.verification.original_side import SourceRuns, run_source, run_varied
from robosmi.verify.original import LibraryCall, Original, OriginalRun
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from tests.host_model.bench import original
from tests.tools import require_tools

PROGRAM = """#include "simpletools.h"
int main() {
  while (1) {
    if (input(3)) high(5); else low(5);
    print("lit %d\\n", input(3));
    pause(100);
  }
}
"""
RELAY = """#include "simpletools.h"
int main() {
  int on = 0;
  while (1) {
    int now = input(3);
    if (now && !on) high(5);
    if (!now && on) { pause(300); low(5); }
    on = now;
    pause(50);
  }
}
"""
PORTS = [BoundPort("P3", "P3", "P3", device="levels", pin="pin"), BoundPort("P5", "P5", "P5")]


class Unrun:
    """An original that is not to run."""

    def calls(self, devices: object, begin_us: float, end_us: float, limit_s: float = 60.0) -> list[LibraryCall]:
        raise AssertionError("it was run")


def scenario(at_ms: float, lasts_ms: float = 700.0) -> Scenario:
    return Scenario("s", 3000.0, {"P3": {"points": ((0.0, 0), (at_ms, 1), (at_ms + lasts_ms, 0))}})


def judged(seen_at_ms: float, text: str = PROGRAM, lasts_ms: float = 700.0) -> str:
    """The verdict on a target that does what a program does where the input changes at another time."""
    require_tools("gcc", "gcov", "objcopy")
    asked = scenario(1000.0)
    with original(PROGRAM) as program, original(text) as other:
        runs = run_varied(program, PORTS, asked, run_source(program, PORTS, asked))
        trace: PinTrace = run_source(other, PORTS, scenario(seen_at_ms, lasts_ms)).trace
        told = verdict_of(asked, runs, trace, PORTS, True)

        def further(asked: Scenario, runs: SourceRuns) -> SourceRuns:
            return runs

        def apart(asked: Scenario, runs: SourceRuns, differs_at: Callable[[SourceRuns], float | None]) -> bool:
            return hangs_on_a_pass(program, PORTS, asked, runs, 60.0, differs_at)

        return looked_at_again(told, asked, trace, PORTS, True, runs, further, apart=apart).verdict


@pytest.mark.parametrize("seen_at_ms", [900.0, 1100.0])
def test_a_change_that_is_seen_a_pass_earlier_or_later_is_not_decidable(seen_at_ms: float) -> None:
    assert judged(seen_at_ms) == "not-decidable"


@pytest.mark.parametrize(("lasts_ms", "verdict"), [(900.0, "not-decidable"), (1300.0, "different")])
def test_each_change_may_be_seen_a_pass_earlier_or_later(lasts_ms: float, verdict: str) -> None:
    assert judged(900.0, lasts_ms=lasts_ms) == verdict


@pytest.mark.parametrize(
    ("old", "new"),
    [("if (input(3))", "if (!input(3))"), ('"lit %d\\n", input(3)', '"lit %d\\n", 1'), ("pause(100)", "pause(230)")],
    ids=["inverted", "a number that is off by one", "slower"],
)
def test_faults_stay_differences(old: str, new: str) -> None:
    assert PROGRAM.count(old) == 1
    assert judged(1000.0, PROGRAM.replace(old, new)) == "different"
    assert judged(1100.0, PROGRAM.replace(old, new)) == "different"


def test_a_difference_long_before_the_first_change_hangs_on_none() -> None:
    runs = SourceRuns(OriginalRun(PinTrace("", "running", 3e6, (), (), (), ()), "running", "", b""), (), {})
    assert not hangs_on_a_pass(cast("Original", Unrun()), PORTS, scenario(1000.0), runs, 60.0, lambda _: 750.0)
    with pytest.raises(AssertionError, match="run"):
        hangs_on_a_pass(cast("Original", Unrun()), PORTS, scenario(1000.0), runs, 60.0, lambda _: 850.0)


def test_a_change_that_is_seen_much_later_is_a_difference() -> None:
    assert judged(1400.0) == "different"


def test_a_pass_is_the_longest_time_between_two_calls_from_one_place() -> None:
    calls = [LibraryCall(1000.0 * at, "input", "p.c", 4) for at in (0, 50, 100, 180, 230, 900)]
    assert longest_pass_ms(calls) == 80.0
    assert longest_pass_ms(calls[:3]) == 0.0


@pytest.mark.parametrize(
    ("wait", "lasts_ms", "verdict"),
    [(300, 747.0, "no-difference-found"), (300, 797.0, "no-difference-found"), (315, 747.0, "different")],
    ids=["the same", "a pass later", "5 % longer"],
)
def test_a_wait_after_a_contact_is_compared_apart_from_the_pass_in_which_it_is_seen(
    wait: int, lasts_ms: float, verdict: str
) -> None:
    require_tools("gcc", "gcov", "objcopy")
    asked = scenario(1005.0, 747.0)
    with original(RELAY) as program, original(RELAY.replace("pause(300)", f"pause({wait})")) as other:
        runs = run_varied(program, PORTS, asked, run_source(program, PORTS, asked))
        trace: PinTrace = run_source(other, PORTS, scenario(1005.0, lasts_ms)).trace
        tolerant = verdict_of(asked, runs, trace, PORTS, True)
        told = with_reactions(tolerant, program, trace, PORTS, runs, True, NO_LEVELS)
    assert (tolerant.verdict, told.verdict) == ("no-difference-found", verdict)
    if told.first is not None:
        assert told.first.message == "switches off 15.0 ms too late after an input changes (tolerance 8.3 ms)"
