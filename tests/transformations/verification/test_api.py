"""The engine `api`: programs for boards that no simulator has, judged at the Arduino API on this computer."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import MissingToolError, VerificationError
from robosmi.transformations.chains.simulate import Simulated, simulate
from robosmi.transformations.chains.verify import Verified, verify
from robosmi.transformations.verification.api_build import AT_THE_API
from robosmi.transformations.verification.engines import api
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE, NOT_DECIDABLE
from tests.tiers import sample
from tests.tools import require_engine

PROGRAMS = Path(__file__).parent / "api_programs"
BINDINGS = {
    "blink": {"P26": "D13"},
    "button": {"P5": "D5", "P6": "D6"},
    "servo": {"P16": "D9"},
    "ranger": {"P9": "D7", "P6": "D6"},
    "analog": {"AD2": "A1", "P6": "D6"},
    "tone": {"P4": "D8", "P5": "D5"},
    "text": {},
}
ON_ESP32 = {"analog": {"AD2": "IO34", "P6": "IO19"}, "tone": {"P4": "IO26", "P5": "IO25"}}
FAULTS = {
    "blink": ("pause(300)", "pause(360)"),
    "button": ("if (input(", "if (!input("),
    "servo": (", 900)", ", 1000)"),
    "ranger": ("< 50", "< 5"),
    "analog": ("> 2000", "> 3900"),
    "tone": (", 250, ", ", 350, "),
    "text": ("count %d", "counts %d"),
}


def moved(name: str, folder: Path, target: str, bindings: dict[str, str]) -> Path:
    require_engine("api")
    shutil.copy2(PROGRAMS / f"{name}.c", folder)
    robosmi.migrate([folder / f"{name}.c"], folder / "out", target=target, bind=bindings)
    return folder / "out"


def judged(name: str, out: Path) -> Verified:
    return verify(out, scenarios=[PROGRAMS / f"{name}.toml"], report=False)


def change(out: Path, old: str, new: str) -> None:
    (path,) = out.glob("*/*.ino")
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@pytest.mark.parametrize("name", sample(BINDINGS, 2))
def test_a_moved_program_shows_no_difference_and_a_wrong_one_does(name: str, tmp_path: Path) -> None:
    out = moved(name, tmp_path, "uno-r4-minima", BINDINGS[name])
    done = judged(name, out)
    assert done.verdict.verdict == NO_DIFFERENCE, done.lines()
    assert not done.verdict.partial
    assert done.verdict.judged_at == AT_THE_API
    change(out, *FAULTS[name])
    assert judged(name, out).verdict.verdict == DIFFERENT_VERDICT


@pytest.mark.parametrize("name", ON_ESP32)
def test_pins_and_voltages_are_those_of_the_board(name: str, tmp_path: Path) -> None:
    done = judged(name, moved(name, tmp_path, "esp32", ON_ESP32[name]))
    assert done.verdict.verdict == NO_DIFFERENCE, done.lines()


def test_every_text_of_the_verdict_says_where_it_was_judged(tmp_path: Path) -> None:
    out = moved("blink", tmp_path, "uno-r4-minima", BINDINGS["blink"])
    done = verify(out, scenarios=[PROGRAMS / "blink.toml"])
    said = "judged at the Arduino API"
    assert said in done.lines()[0]
    assert said in (out / "blink" / "MIGRATION.md").read_text()
    result = done.result
    assert result["judged_at"] == "api"
    assert {"times below 10 us", "heap and stack"} <= set(result["not_seen"])
    assert "arduino:renesas_uno" in result["not_compiled"]


@pytest.mark.parametrize(
    ("statement", "said"),
    [
        ("*(volatile int *)0 = 1;", "crashes on this computer"),
        ("pinMode(4, INPUT_PULLDOWN);", "INPUT_PULLDOWN"),
        ("pinMode(77, OUTPUT);", "a pin that the board's data does not have"),
        ("Serial1.begin(9600);", "Serial1"),
        ('FILE *file = fopen("/etc/passwd", "r"); (void)file;', "fopen"),
        ('asm volatile("int $0x80" : : "a"(20));', "calls the operating system"),
    ],
)
def test_nothing_is_claimed_of_what_the_model_does_not_have(statement: str, said: str, tmp_path: Path) -> None:
    out = moved("blink", tmp_path, "uno-r4-minima", BINDINGS["blink"])
    change(out, "void loop() {", f"void loop() {{\n  {statement}")
    done = judged("blink", out)
    assert done.verdict.verdict == NOT_DECIDABLE
    assert any(said in reason for reason in done.verdict.all_reasons()), done.verdict.all_reasons()
    with pytest.raises(VerificationError, match=r"."):
        simulate(out, seconds=0.5)


def sketch(folder: Path, fqbn: str) -> Path:
    """A sketch of a user's own."""
    require_engine("api")
    place = folder / "button_sketch"
    place.mkdir()
    shutil.copy2(PROGRAMS / "button_sketch.ino", place)
    (place / "sketch.yaml").write_text(f"default_fqbn: {fqbn}\n")
    return place


def run(place: Path) -> Simulated:
    done = simulate(place, scenario=PROGRAMS / "button_sketch.toml")
    assert done.trace is not None
    return done


@pytest.mark.parametrize(
    ("fqbn", "sign"),
    [
        ("arduino:renesas_uno:minima", "signed"),
        ("teensy:avr:teensy40", "unsigned"),
        ("arduino:samd:arduino_zero_edbg", "unsigned"),
    ],
)
def test_a_sketch_runs_with_the_widths_of_its_board(fqbn: str, sign: str, tmp_path: Path) -> None:
    trace = run(sketch(tmp_path, fqbn)).trace
    assert trace is not None
    assert trace.text.splitlines() == [f"widths 4 8 4 {sign}", "three"]
    levels = [(round(at_us / 1000, -1), level) for at_us, level in trace.levels("D6")]
    assert levels == [(0, 0), (300, 1), (600, 0)]  # driven since its constructor; the button pulls low
    assert {round(width) for _, width in trace.pulses("D9")[1:]} == {1700}


def test_a_loop_that_does_not_end_leaves_the_pins_as_they_are(tmp_path: Path) -> None:
    place = sketch(tmp_path, "arduino:renesas_uno:minima")
    main = place / "button_sketch.ino"
    main.write_text(main.read_text().replace("void loop() {", "void loop() {\n  while (edges < 1000) {}"))
    done = run(place)
    assert done.trace is not None
    assert done.trace.state == "running"
    assert [level for _, level in done.trace.levels("D6")] == [0]


def test_a_missing_compiler_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    place = sketch(tmp_path, "arduino:renesas_uno:minima")
    monkeypatch.setattr(api, "_missing", lambda path: "apt-get install g++ gcc-multilib")
    with pytest.raises(MissingToolError) as raised:
        simulate(place)
    assert raised.value.exit_code == 4
    assert "gcc-multilib" in str(raised.value.fix)
