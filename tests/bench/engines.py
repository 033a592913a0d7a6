"""Do both simulators see the same? Five robots on libsimavr and on avr8js, under the scenarios that a search makes for each.

`python -m tests.bench.engines [--budget SECONDS] [ROBOT...]`, the seconds being those of the search for each robot. A row for
each: both verdicts, the scenarios with their simulated time, the events that both engines show, how far those that belong
together are from each other at most, and where the engines differ. Exit 1 when verdicts or events differ.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
import tomllib
from collections.abc import Sequence
from pathlib import Path

from msgspec.structs import replace

import robosmi
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.chains.verify import FOLDER, verify
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.bound_devices.played_devices import played
from robosmi.transformations.verification.bound_devices.port_devices import bound_ports
from robosmi.transformations.verification.jobs import job
from robosmi.transformations.verification.original_side import channel_events
from robosmi.verify.scenario import read_scenario
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from robosmi.verify.traces.activity import ActivityEvent
from robosmi.verify.traces.comparison import NOT_EXERCISED, SAME, compare

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ("line_follower", "environmental_monitoring")
CASES = ("ranger", "drive", "serial_line")
ENGINES = ("simavr", "avr8js")


def migrated(name: str, out: Path) -> None:
    """Migrate a robot: a case study, or a program of the devices' tests."""
    if name in STUDIES:
        robosmi.migrate([ROOT / "docs" / "examples" / name / f"{name}.c"], out)
        return
    case = ROOT / "tests" / "transformations" / "verification" / "device_cases" / name
    robosmi.migrate([case / "program.c"], out, bind=tomllib.loads((case / "case.toml").read_text()).get("bind", {}))


def agree(name: str, folder: Path, budget: float) -> bool:
    """Verify a robot on both engines, compare the engines with each other, and print the row."""
    out = folder / name
    migrated(name, out)
    first = verify(out, engine=ENGINES[0], budget_s=budget).verdict
    files = sorted((out / "models" / FOLDER).glob("*.toml"))
    verdicts = [first, verify(out, engine=ENGINES[1], scenarios=files).verdict]
    built = folder / f"{name}-built"
    built.mkdir()
    report = compile_sketch(out, keep=built)
    assert report.elf is not None
    assert report.hex is not None
    ports = bound_ports(load_models(out / "models" / "plan.xmi").plan, out / "models")
    differences, greatest, events = [], 0.0, 0
    for path in files:
        scenario = read_scenario(path)
        asked = job(
            report.elf, report.hex, load_board(report.board), scenario.horizon_ms * 1000, played(ports, scenario, target=True)
        )
        one, other = (channel_events(simulate(asked, engine), ports, target=True) for engine in ENGINES)
        for channel in one:
            found = compare(channel, _uncounted(one[channel][0]), _uncounted(other[channel][0]), [], scenario.horizon_ms)
            events += found.events
            greatest = max(greatest, abs(found.greatest_dt_ms))
            if found.status not in (SAME, NOT_EXERCISED):
                told = found.difference.message if found.difference else found.status
                differences.append(f"'{scenario.name}', {channel}: {told}")
    said = [verdict.verdict for verdict in verdicts]
    seconds = sum(scenario.scenario.horizon_ms for scenario in first.scenarios) / 1000
    print(f"{name} | {' | '.join(said)} | {len(files)} scenarios, {seconds:g} s | {events} events of both engines, "
          f"at most {greatest:.2f} ms apart | {'; '.join(differences) or 'no difference'}", flush=True)  # fmt: skip
    return not differences and said[0] == said[1] and len(files) > 0


def _uncounted(events: Sequence[ActivityEvent]) -> list[ActivityEvent]:
    """The events without their number of edges, which no verdict compares where a timer makes the source's wave."""
    return [replace(event, pulses=0) for event in events]


def main() -> int:
    """All robots."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.engines")
    parser.add_argument("robots", nargs="*", default=[*STUDIES, *CASES])
    parser.add_argument("--budget", type=float, default=60.0)
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        npm = os.environ.get("ROBOSMI_NPM", str(ROOT / ".npm"))
        os.environ.update(ROBOSMI_HOME=str(Path(place) / "home"), ROBOSMI_NPM=npm)
        said = [agree(name, Path(place), asked.budget) for name in asked.robots]
    return 0 if all(said) else 1


if __name__ == "__main__":
    sys.exit(main())
