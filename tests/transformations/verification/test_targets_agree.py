"""The same verdict on every engine and for every kind of target: five robots on two simulators, one program on four boards."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.transformations.chains.verify import verify
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE
from tests.tiers import sample
from tests.tools import require_engine, require_verification

CASES = Path(__file__).parent / "device_cases"
LINE = """horizon_ms = 3500
[signals]
leftQTI = [[0, 400], [1500, 5000], [2900, 400]]
rightQTI = [[0, 400], [1440, 5000], [2840, 400]]
"""
AIR = """horizon_ms = 4000
[signals]
irReceiverLeft = [[0, 1], [2000, 0], [2100, 1]]
DHT22 = { humidity = [[0, 75]], celsius = [[0, 21.5]] }
"""
ROBOTS: dict[str, tuple[Sequence[str], str]] = {
    "line_follower": (("pause(1000)", "pause(900)"), LINE),
    "environmental_monitoring": (("pause(200)", "pause(320)"), AIR),
    "ranger": (("distance < 20", "distance < 50"), ""),
    "drive": (("drive_speed(64, 64)", "drive_speed(64, 48)"), ""),
    "serial_line": (("got %c", "gut %c"), ""),
}


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_verification()


def made(name: str, examples: Path, out: Path, **options: Any) -> tuple[Path, Path]:
    """A migrated robot: its sketch and its scenario."""
    scenario = CASES / name / "scenario.toml"
    if ROBOTS[name][1]:
        scenario = out.with_name("scenario.toml")
        scenario.write_text(ROBOTS[name][1])
        robosmi.migrate([examples / name / f"{name}.c"], out, **options)
    else:
        facts = tomllib.loads((CASES / name / "case.toml").read_text())
        robosmi.migrate([CASES / name / "program.c"], out, bind=facts.get("bind", {}), **options)
    [sketch] = [path for suffix in ("ino", "c") for path in out.glob(f"[!m]*/*.{suffix}")][:1]
    return sketch, scenario


@pytest.mark.exhaustive
@pytest.mark.parametrize("name", ROBOTS)
def test_both_engines_say_the_same_of_a_robot(name: str, examples: Path, tmp_path: Path) -> None:
    for engine in ("simavr", "avr8js"):
        require_engine(engine)
    sketch, scenario = made(name, examples, tmp_path / "out")
    right = [verify(tmp_path / "out", scenarios=[scenario], engine=engine).verdict for engine in ("simavr", "avr8js")]
    assert [verdict.verdict for verdict in right] == [NO_DIFFERENCE] * 2, [verdict.sentence() for verdict in right]
    names = [[(channel["name"], channel["status"]) for channel in verdict.channels()] for verdict in right]
    assert names[0] == names[1]
    old, new = ROBOTS[name][0]
    text = sketch.read_text()
    assert old in text
    sketch.write_text(text.replace(old, new))
    wrong = [verify(tmp_path / "out", scenarios=[scenario], engine=engine).verdict for engine in ("simavr", "avr8js")]
    assert [verdict.verdict for verdict in wrong] == [DIFFERENT_VERDICT] * 2
    first, other = (verdict.first_difference for verdict in wrong)
    assert first is not None
    assert other is not None
    assert (first[1].channel, first[1].at_ms) == (other[1].channel, other[1].at_ms)


@pytest.mark.parametrize("target", sample(["avr-c", "nano", "mega"], 1))
def test_other_targets_are_verified_too(target: str, tmp_path: Path) -> None:
    require_engine("simavr")
    case = CASES / "button"
    robosmi.migrate([case / "program.c"], tmp_path, bind={"P3": "D2"}, target=target)
    right = verify(tmp_path, scenarios=[case / "scenario.toml"]).verdict
    assert right.verdict == NO_DIFFERENCE, right.sentence()
    assert [channel["status"] for channel in right.channels()] == ["same"]
    [program] = [path for suffix in ("ino", "c") for path in tmp_path.glob(f"*/*.{suffix}") if "presses++" in path.read_text()]
    program.write_text(program.read_text().replace("presses++", "presses += 2"))
    assert verify(tmp_path, scenarios=[case / "scenario.toml"]).verdict.verdict == DIFFERENT_VERDICT


def test_a_console_that_no_simulator_shows_is_not_compared(tmp_path: Path) -> None:
    """The Leonardo's console is its USB connection."""
    require_engine("simavr")
    case = CASES / "button"
    robosmi.migrate([case / "program.c"], tmp_path, bind={"P3": "D2"}, target="leonardo")
    verdict = verify(tmp_path, scenarios=[case / "scenario.toml"]).verdict
    assert verdict.verdict == "not-decidable", verdict.sentence()
    assert "console" in verdict.not_compared
