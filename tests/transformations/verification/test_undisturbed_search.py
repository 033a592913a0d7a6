"""A loop that waits is let go on alone: a countdown that a person starts and then leaves."""

from __future__ import annotations

import pytest

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.search.scenario_goals import UNDISTURBED
from robosmi.transformations.verification.search.scenario_inputs import is_steady, press, scenario_inputs
from robosmi.transformations.verification.search.scenario_search import search, try_undisturbed
from robosmi.transformations.verification.search.scenario_trials import Trials
from robosmi.transformations.verification.search.search_effort import SearchEffort
from tests.host_model.bench import original
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
    with original(COUNTDOWN) as program:
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


SWITCHES = """#include "simpletools.h"
int main() {
  while (1) {
    if (input(3)) high(5); else low(5);
    if (input(4)) high(6); else low(6);
    pause(30);
  }
}
"""


@pytest.mark.processes
def test_inputs_change_in_a_scenario_though_the_first_such_are_not_repeatable() -> None:
    require_tools("gcc")
    ports = [BoundPort(name, name, name, device="levels", pin="pin") for name in ("P3", "P4")]
    ports += [BoundPort(name, name, name) for name in ("P5", "P6")]
    with original(SWITCHES) as program:
        found = search(program, ports, (), False, 1)
    assert found.racy
    assert any(not is_steady(scenario.signals) for scenario, _ in found.scenarios)
