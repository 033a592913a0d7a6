"""The case studies, migrated, compiled and run on a simulator with their sensors: the robots do what their programs say.

What is expected is what the sources say and what the libraries that they call document, not what sketches were seen to do.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from statistics import median

import pytest

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.plans.plan import open_choices
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, PinTrace, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_engine, require_tools


def run(source: Path, folder: Path, milliseconds: float, devices: list[DeviceUse]) -> PinTrace:
    """Migrate a program that has nothing left to do, compile the sketch without a warning, and run it."""
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    made = robosmi.migrate([source], folder / "out")
    assert [task.message for task in made.models.plan.tasks] == []
    assert [decision.choice for decision in open_choices(made.models.plan)] == []
    report = compile_sketch(folder / "out", keep=folder)
    assert [d.message for d in report.diagnostics if d.severity.name != "info"] == []
    assert report.elf is not None
    assert report.hex is not None
    return simulate(job(report.elf, report.hex, load_board("uno"), milliseconds * 1000, devices))


def widths(trace: PinTrace, pin: str, begin_ms: float, end_ms: float) -> set[int]:
    """The widths of the pulses that begin at a pin in a time, in microseconds."""
    return {round(width) for at, width in trace.pulses(pin) if begin_ms * 1000 <= at < end_ms * 1000}


def near(widths: set[int], wanted: int) -> bool:
    """Whether there are pulses, all as wide as wanted."""
    return bool(widths) and all(abs(width - wanted) <= 8 for width in widths)


def test_the_line_follower_drives_over_light_floor_and_stops_with_its_led_on_dark_floor(examples: Path, tmp_path: Path) -> None:
    """Light lets the sensors decay in 0.4 ms, dark in 5 ms; the threshold is 50 polls of 20 us.

    24 ticks/s are 37 or 38 us beyond neutral where 128 are 200 us, as drive_speed's documentation has them.
    """
    floor = {"points": [[0, 400], [2000, 5000], [4500, 400]]}
    sensors = [DeviceUse("capacitor", {"pin": pin}, floor) for pin in ("D10", "D11")]
    trace = run(examples / "line_follower" / "line_follower.c", tmp_path, 6500, sensors)
    left, right, led = "D8", "D9", "D12"
    assert near(widths(trace, left, 800, 2000), 1537)
    assert near(widths(trace, right, 800, 2000), 1463)
    lit = [(change.at_us / 1000, change.level) for change in trace.changes if change.pin == led and change.level in (0, 1)]
    on = [at for at, level in lit if level == 1]
    off = [at for at, level in lit if level == 0 and at > min(on)]
    assert 2000 < on[0] < 2300
    assert [b - a for a, b in zip(on, off, strict=False)] == pytest.approx([1000] * min(len(on), len(off)), rel=0.01)
    assert 2 <= len(on) <= 3
    assert widths(trace, left, on[0] + 100, on[0] + 1000) == set()  # no pulses: the servo stands
    assert near(widths(trace, left, max(off) + 800, 6500), 1537)


def test_the_monitoring_robot_turns_away_from_an_obstacle_and_warns_of_damp_air(examples: Path, tmp_path: Path) -> None:
    """The left receiver sees an obstacle from 2.0 to 2.1 s: stop for 200 ms, then turn for 600 ms; above 70 % a LED lights."""
    devices = [
        DeviceUse("levels", {"pin": "D11"}, {"points": [[0, 1], [2000, 0], [2100, 1]]}),
        DeviceUse("levels", {"pin": "D2"}, {"points": [[0, 1]]}),
        DeviceUse("dht22", {"signal": "D7"}, {"humidity": [[0, 75.0]], "celsius": [[0, 21.5]]}),
    ]
    trace = run(examples / "environmental_monitoring" / "environmental_monitoring.c", tmp_path, 5000, devices)
    left, right, led = "D8", "D9", "D4"
    assert near(widths(trace, left, 700, 1900), 1560)
    assert near(widths(trace, right, 700, 1900), 1440)
    assert near(widths(trace, left, 2090, 2200), 1500)
    assert near(widths(trace, right, 2300, 2800), 1560)
    assert near(widths(trace, left, 2300, 2800), 1560)
    assert near(widths(trace, right, 3000, 4900), 1440)
    rises = [at for at, _ in trace.pulses("D10")]
    periods = [b - a for a, b in pairwise(rises)]
    assert median(period for period in periods if period < 1000) == pytest.approx(1e6 / 38000, rel=0.01)
    bursts = 1 + sum(period > 1000 for period in periods)
    assert 50 < bursts < 250
    assert len(rises) / bursts == pytest.approx(38, abs=2)  # a burst of 1 ms
    on = [change.at_us / 1000 for change in trace.changes if change.pin == led and change.level == 1]
    assert len(on) == 1
    assert 3000 < on[0] < 5000
    assert trace.text.replace("\r", "") == "T 215 H 750\n"
