"""A loop that waits is let go on alone: a countdown that a person starts and then leaves."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import longest_pass_ms
from robosmi.transformations.verification.search.scenario_goals import UNDISTURBED
from robosmi.transformations.verification.search.scenario_inputs import press, scenario_inputs
from robosmi.transformations.verification.search.scenario_trials import Trials
from robosmi.transformations.verification.search.search_effort import SearchEffort
from robosmi.transformations.verification.search.undisturbed_search import try_undisturbed
from robosmi.verify.original_calls import LibraryCall
from tests.host_model.bench import built
from tests.tools import require_tools

COUNTDOWN = """#include "simpletools.h"
int main() {
  while (1) {
    while (!input(3)) pause(5);
    for (int t = 9; t >= 0; t--) {
      print("t = %d\\n", t);
      pause(700);
    }
  }
}
"""


@pytest.mark.processes
def test_what_a_button_starts_is_watched_until_it_has_waited_often() -> None:
    require_tools("gcc")
    port = BoundPort("start", "P3", "D3", device="levels", pin="pin")
    with built(COUNTDOWN) as program:
        trials = Trials(program, [port], set(), SearchEffort(60.0))
        trials.horizon = 3000.0
        inputs = scenario_inputs([port], (), False)
        trials.try_signals({})
        trials.try_signals(press(inputs[0], 150.0, 900.0))
        before = len(trials.found.scenarios)
        try_undisturbed(trials, inputs)
        (scenario, _) = trials.found.scenarios[-1]
        assert len(trials.found.scenarios) == before + 1
        assert any(place[0] == UNDISTURBED for place in trials.reached_by[-1])
        assert scenario.horizon_ms >= 900 + 6 * 700


def test_a_pass_is_the_longest_time_between_two_calls_from_one_place_that_polls() -> None:
    polled = [LibraryCall(1000.0 * at, "input", "p.c", 4) for at in (0, 20, 40, 160, 180, 200)]
    slept = [LibraryCall(1000.0 * at, "pause", "p.c", 9) for at in (0, 900, 1800, 2700, 3600)]
    assert longest_pass_ms([*polled, *slept]) == 120.0
    assert longest_pass_ms(polled[:3]) == 0.0
