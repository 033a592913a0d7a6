"""Scenarios that a search makes tell a program from one with a border moved: of durations, of several inputs, of what is typed.

Both programs run in the host model here, which takes far less time than a migration.
"""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import SourceRuns, channel_events, compared, run_source
from robosmi.transformations.verification.search.scenario_search import search
from robosmi.verify.scenario import Scenario
from robosmi.verify.traces.comparison import DIFFERENT
from tests.host_model.bench import original
from tests.tiers import sample
from tests.tools import require_tools

BUTTONS = [BoundPort(f"P{n}", f"P{n}", f"D{n}", device="levels", pin="pin") for n in (3, 4, 5)]
LAMPS = [BoundPort(f"P{n}", f"P{n}", f"D{n}") for n in (9, 10, 11)]
BITS = [
    BoundPort(f"P{n}", f"P{n}", f"D{n}", device="shifted_bits", pin=pin, group="P7") for n, pin in ((7, "data_in"), (8, "clock"))
]
VOLTAGE = BoundPort("AD2", "AD2", "A2", device="voltages", pin="pin")

HELD = """
  while (1) {
    int t = 0;
    while (input(3) == 0) pause(5);
    while (input(3) == 1) { pause(10); t += 10; }
    if (t < 1200) toggle(10); else toggle(11);
  }"""
TICKS = """
  while (1) {
    while (input(3) == 0);
    unsigned since = CNT;
    while (input(3) == 1);
    if ((CNT - since) / (CLKFREQ / 1000) > 800) toggle(10); else toggle(11);
  }"""
WAITS = """
  while (1) {
    if (input(3)) {
      mark();
      while (input(3) && !timeout(2000000)) pause(1);
      if (timeout(2000000)) toggle(10); else toggle(11);
      while (input(3));
    }
    pause(10);
  }"""
LASTS = """
  int since = 0;
  while (1) {
    if (input(3)) since += 20; else since = 0;
    if (since >= 500) high(10); else low(10);
    pause(20);
  }"""
TWICE = """
  int clicks = 0, quiet = 0, last = 0;
  while (1) {
    int b = input(3);
    if (b && !last) { clicks++; quiet = 0; }
    last = b;
    if (clicks && ++quiet > 40) {
      if (clicks == 2) toggle(10); else toggle(11);
      clicks = 0;
    }
    pause(10);
  }"""
LOW_ACTIVE = """
  int held = 0;
  while (1) {
    if (input(3) == 0) held++;
    else {
      if (held > 75) high(10);
      else if (held > 2) low(10);
      held = 0;
    }
    pause(10);
  }"""
TOGETHER = """
  adc_init(21, 20, 19, 18);
  while (1) {
    if (input(3) && input(4) && !input(5)) {
      if (adc_in(2) > 3000) high(10); else low(10);
    } else low(10);
    pause(50);
  }"""
ONCE = """
  adc_init(21, 20, 19, 18);
  while (input(3) == 0) pause(10);
  if (adc_in(2) > 3000) high(10); else high(11);"""
LOCK = """
  int state = 0;
  while (1) {
    int l = pressed(3), r = pressed(4);
    switch (state) {
      case 0: if (l) state = 1; break;
      case 1: if (r) state = 2; else if (l) state = 0; break;
      case 2: if (r) state = 3; else if (l) state = 0; break;
      case 3: if (l) { state = 4; high(10); } else if (r) state = 0; break;
      case 4: if (r) { state = 0; low(10); } break;
    }
    pause(20);
  }"""
TYPED = """
  int n; float v;
  while (1) {
    scan("%d\\n", &n);
    int x = n * 3 + 7;
    if (x * x > 10000) high(10); else low(10);
    scan("%f\\n", &v);
    if (v > 2.5) high(11); else low(11);
  }"""
SHIFTED = """
  while (1) {
    if (shift_in(7, 8, MSBPRE, 8) > 100) high(10); else low(10);
    pause(50);
  }"""
HYSTERESIS = """
  int stage = 0;
  adc_init(21, 20, 19, 18);
  while (1) {
    int raw = adc_in(2);
    if (stage == 0 && raw > 2000) stage = 1;
    else if (stage == 1 && raw > 3000) stage = 2;
    else if (stage == 2 && raw < 2600) stage = 1;
    else if (stage == 1 && raw < 1200) stage = 0;
    if (raw > 3600) high(9); else if (raw < 3300) low(9);
    set_outputs(11, 10, stage);
    set_directions(11, 10, 3);
    pause(50);
  }"""
CAME_FROM = """
  int near = 0;
  adc_init(21, 20, 19, 18);
  while (1) {
    int raw = adc_in(2);
    if (raw > 3000) near = 0;
    else if (raw > 2000) low(10);
    else if (raw > 1000) pulse_out(9, 1000);
    else if (!near) { near = 1; toggle(11); }
    else high(10);
    pause(50);
  }"""
COUNTED = """
  int lines = 0, on = 0;
  adc_init(21, 20, 19, 18);
  while (1) {
    int dark = adc_in(2) > 2500;
    if (dark && !on) { lines++; if (lines == 3) high(10); }
    on = dark;
    pause(50);
  }"""
Case = tuple[Scenario, SourceRuns]
BEFORE = """#include <simpletools.h>
#include <adcDCpropab.h>
int pressed(int pin) { if (input(pin) == 0) return 0; while (input(pin)) pause(5); return 1; }
int main() {"""


def is_noticed(body: str, cases: Sequence[Case], ports: Sequence[BoundPort]) -> bool:
    """Whether scenarios tell a program from the one for which they were made."""
    with original(f"{BEFORE}{body}}}") as program:
        for scenario, runs in cases:
            seen = channel_events(run_source(program, ports, scenario).trace, ports, target=False)
            for name, source in runs.channels.items():
                if compared(name, source, seen[name], scenario.horizon_ms, runs.loop).status == DIFFERENT:
                    return True
    return False


PROGRAMS = {
    "a button is held": (HELD, BUTTONS[:1], [("t < 1200", "t < 1260"), ("t < 1200", "t < 1140")]),
    "for ticks": (TICKS, BUTTONS[:1], [("> 800", "> 740"), ("> 800", "> 1600")]),
    "until a timeout": (WAITS, BUTTONS[:1], [("2000000", "2100000")]),
    "a level lasts": (LASTS, BUTTONS[:1], [("since >= 500", "since >= 580")]),
    "two presses": (TWICE, BUTTONS[:1], [("quiet > 40", "quiet > 50")]),
    "a button to ground": (LOW_ACTIVE, BUTTONS[:1], [("held > 75", "held > 85")]),
    "several at once": (TOGETHER, [*BUTTONS, VOLTAGE], [("> 3000", "> 3100"), ("> 3000", "> 2900")]),
    "measured once": (ONCE, [*BUTTONS[:1], VOLTAGE], [("> 3000", "> 3100"), ("> 3000", "> 2900")]),
    "a code": (LOCK, BUTTONS[:2], [("state = 3; else if (l) state = 0", "state = 3; else if (l) state = 1")]),
    "whole numbers": (SHIFTED, BITS, [("> 100", "> 108"), ("> 100", "> 92")]),
    "a hysteresis": (HYSTERESIS, [VOLTAGE], [("raw < 2600", "raw < 2500"), ("raw < 1200", "raw < 1300"), ("< 3300", "< 3200")]),
    "a state for each way": (CAME_FROM, [VOLTAGE], [("low(10)", "near = 0")]),
    "lines are counted": (COUNTED, [VOLTAGE], [("lines == 3", "lines == 4"), ("lines == 3", "lines == 2")]),
    "numbers": (TYPED, [], [("x > 10000", "x > 10404"), ("v > 2.5", "v > 2.6"), ("v > 2.5", "v > 2.3")]),
}


@pytest.mark.parametrize("name", sample(PROGRAMS, 3))
def test_a_moved_border_is_noticed_by_what_the_search_finds(name: str) -> None:
    require_tools("gcc", "gcov", "objcopy")
    body, inputs, edits = PROGRAMS[name]
    ports = [*inputs, *LAMPS]
    numbers = [("", 0), ("1\r", 0)] if "scan" in body else []
    with original(f"{BEFORE}{body}}}") as program:
        cases = search(program, ports, ("5\r",) if numbers else (), bool(numbers), 1, numbers=numbers).scenarios
    assert not is_noticed(body, cases, ports)
    assert all(old in body for old, _ in edits)
    assert [edit for edit in edits if not is_noticed(body.replace(*edit), cases, ports)] == []
