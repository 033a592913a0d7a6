"""A small run of what `python -m tests.faults` does: faults of some kinds are noticed, harmless rewritings are not."""

from __future__ import annotations

import re
from pathlib import Path
from types import SimpleNamespace

import pytest

import robosmi
from robosmi.transformations.chains.verify import Verified
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import SourceRuns, channel_events
from robosmi.verify.original import OriginalRun
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinChange, PinTrace
from robosmi.verify.traces.verdict import Verdict
from tests.faults import campaign
from tests.faults.__main__ import stale
from tests.faults.campaign import FOLDERS, ROOT, SKETCH_FILES, STUDIES, Study, executed
from tests.faults.executed_lines import built_for_lines, lines_of
from tests.faults.harmless import rewritings
from tests.faults.seeding import KINDS, faults
from tests.tiers import sample
from tests.tools import require_verification

HERE = Path(__file__).parent
FAULTS = {
    "swapped pins": "const int BasicServo2WriteP1 = 8; // Basic Servo2: pulse on D8 const int BasicServo1WriteP1 = 9;",
    "wrong unit": "pause(1000 / 1000)",
    "mirrored servo": "1500 + beyond : 1500 - beyond",
    "16-bit overflow": "(uint16_t)micros()",
    "missing wait": "pause(500)",
    "wrong constant": "drive_speed(24, 18)",
    "wrong level": "low(LED); // switch on LED",
}
"""Kind -> a part of the text that tells one of that kind."""
SHOWN_FAULTS = {
    "number in a text": "parking aid 3",
    "offset of a number": "looks + 1",
    "start value": "looks = 1;",
    "console's speed": "Serial.begin(57600)",
    "foreign pin": "digitalWrite(13, HIGH)",
    "pulse width": "pulse_out(barrier, (1700) * 113L / 100)",
    "lost direction": "set_direction(bell, 0);",
    "moved border": "nearBy = 16",
}
"""The same for a program that prints and asks a ranger."""


@pytest.fixture(scope="module")
def study(tmp_path_factory: pytest.TempPathFactory) -> Study:
    """The line follower under one scenario."""
    require_verification("simavr")
    return Study.made("line_follower", tmp_path_factory.mktemp("faults"), scenarios=[HERE / "light_and_dark.toml"])


@pytest.mark.processes
def test_the_right_program_shows_no_difference(study: Study) -> None:
    assert study.right.verdict.verdict == "no-difference-found"
    assert study.judge({}).verdict == "same machine code"


@pytest.mark.parametrize("kind", sample(FAULTS, 3))
def test_a_fault_is_noticed(study: Study, kind: str) -> None:
    known = [fault for name, text in study.files.items() for fault in faults(name, text) if fault.kind == kind]
    fault = next(each for each in known if FAULTS[kind] in each.now or FAULTS[kind] in each.was)
    outcome = study.judge({fault.file: fault.put_into(study.files[fault.file])})
    assert outcome.verdict == "different"
    assert outcome.told


@pytest.fixture(scope="module")
def parking_aid(tmp_path_factory: pytest.TempPathFactory) -> Study:
    """The parking aid under one scenario."""
    require_verification("simavr")
    return Study.made("parking_aid", tmp_path_factory.mktemp("shown"), scenarios=[HERE / "near_and_far.toml"])


@pytest.mark.processes
@pytest.mark.parametrize("kind", SHOWN_FAULTS)
def test_a_fault_of_what_is_shown_is_noticed(parking_aid: Study, kind: str) -> None:
    assert parking_aid.right.verdict.verdict == "no-difference-found"
    known = [fault for name, text in parking_aid.files.items() for fault in faults(name, text) if fault.kind == kind]
    fault = next(each for each in known if SHOWN_FAULTS[kind] in each.now)
    outcome = parking_aid.judge({fault.file: fault.put_into(parking_aid.files[fault.file])})
    assert outcome.verdict == "different", fault.name
    assert outcome.told


@pytest.mark.parametrize("number", sample([0, 2, 5], 1))
def test_a_harmless_rewriting_is_not_called_different(study: Study, number: int) -> None:
    outcome = study.judge(rewritings("line_follower")[number].put_into(study.files), early=False)
    assert outcome.verdict == "no-difference-found", outcome.told


def test_what_a_fault_does_after_the_end_of_the_original_is_noticed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    scenario = Scenario("rest", 3000.0)
    until_us: list[float] = []

    def pin(name: str, *changes: tuple[float, int]) -> PinTrace:
        seen = tuple(PinChange(at_us, name, level) for at_us, level in changes if at_us <= (until_us or [3e6])[-1])
        return PinTrace("", "done" if name == "P26" else "running", (until_us or [1e6])[-1], seen, (), (), ())

    class Side:
        def run(self, scenarios: list[Scenario]) -> list[PinTrace]:
            until_us.append(scenarios[0].horizon_ms * 1000)
            return [pin("D13", (100.0, 1), (900_000.0, 0), (6_000_000.0, 1), (6_100_000.0, 0))]

    ports = [BoundPort("lamp", "P26", "D13")]
    run = OriginalRun(pin("P26", (100.0, 1), (900_000.0, 0)), "finished", "", b"")
    events = channel_events(run.trace, ports, target=False)
    runs = SourceRuns(run, (run,), {name: [[each] * 2 for each in events[name]] for name in events})
    monkeypatch.setattr(campaign, "resting_pins", lambda plan: {})
    plan = SimpleNamespace(plan=SimpleNamespace(concurrency=None))
    found = Study("p", tmp_path, tmp_path, Verified(Verdict(), None), ports, [(scenario, runs)], {}, _models=plan)  # type: ignore[arg-type]
    monkeypatch.setattr(found, "_further", lambda scenario, runs: runs)
    outcome = found._compared(Side(), early=True)  # type: ignore[arg-type]
    assert (outcome.verdict, outcome.channel) == ("different", "lamp")
    assert "the original ended at 1000.0 ms" in outcome.told


@pytest.mark.processes
def test_each_line_that_does_something_stands_for_instructions(tmp_path: Path) -> None:
    require_verification("avr8js")
    name = "environmental_monitoring"
    robosmi.migrate([ROOT / "docs" / "examples" / name / f"{name}.c"], tmp_path / "out")
    (tmp_path / "built").mkdir()
    report = built_for_lines(tmp_path / "out", tmp_path / "built")
    text = (tmp_path / "out" / name / f"{name}.ino").read_text()
    assert report.flash_bytes is not None
    lines = lines_of(report, range(0, report.flash_bytes, 2), [f"{name}.ino"])[f"{name}.ino"]
    rows = text.splitlines()
    calls = {number for number, row in enumerate(rows, 1) if re.match(r"\s+(?:[\w.]+\(.*\);)", row)}
    assert {row for number, row in enumerate(rows, 1) if number in calls - lines} == set()


def test_a_constant_runs_where_a_line_that_names_it_does() -> None:
    text = "const int NEAR    = 50;\nint far = 3;\nvoid loop() {\n  if (seen < NEAR) stop();\n}\n"
    files = {"a.ino": text}
    assert executed((1,), text, {"a.ino": {4}}, "a.ino", files)
    assert not executed((2,), text, {"a.ino": {4}}, "a.ino", files)


@pytest.mark.parametrize("name", STUDIES)
def test_what_is_listed_as_equivalent_is_a_fault_of_the_present_program(name: str, tmp_path: Path) -> None:
    folder = next(each / name for each in FOLDERS if (each / name).is_dir())
    robosmi.migrate([folder / f"{name}.c"], tmp_path / "out")
    files = [path for path in (tmp_path / "out" / name).iterdir() if path.suffix in SKETCH_FILES]
    assert stale(name, {fault.name for path in files for fault in faults(path.name, path.read_text())}) == []


def test_there_are_twenty_rewritings_of_several_kinds() -> None:
    listed = [each for name in STUDIES for each in rewritings(name)]
    assert len(listed) >= 20
    assert len({each.kind for each in listed}) >= 6


def test_each_fault_changes_the_text_and_tells_its_line() -> None:
    text = "const int A = 3;\nvoid loop() {\n  pause(100);\n  if (x < 2) high(A);\n  x = A;\n}\n"
    found = faults("a.ino", text)
    assert {"wrong constant", "wrong condition", "missing wait", "wrong level", "left out"} <= {fault.kind for fault in found}
    assert {fault.kind for fault in found} <= set(KINDS)
    for fault in found:
        changed = fault.put_into(text)
        assert changed != text
        line = next(n for n, (a, b) in enumerate(zip(text.splitlines(), changed.splitlines(), strict=False), 1) if a != b)
        assert line == fault.line
    waits = [fault for fault in found if fault.kind == "missing wait"]
    assert sorted(fault.now for fault in waits) == [";", "pause(150);", "pause(50);"]
    assert len({fault.put_into(text) for fault in found}) == len({fault.name for fault in found}) == len(found)
