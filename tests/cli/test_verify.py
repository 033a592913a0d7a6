"""`robosmi verify`: the same program on two boards, faults in the migrated one, doubts, and bad input."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

import robosmi
from robosmi.transformations.chains.stages.output import Generated
from robosmi.transformations.chains.verify import verify
from robosmi.transformations.chains.watch import WatchedFolder
from robosmi.transformations.verification.search.scenario_search import search
from robosmi.transformations.verification.search.stored_search import FILE
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE
from tests.running import Outcome, run, tree
from tests.tiers import sample
from tests.tools import require_verification

HERE = Path(__file__).parent
PROGRAMS = HERE.parent / "transformations" / "verification" / "programs"


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_verification("simavr")


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated button program, made once."""
    folder = tmp_path_factory.mktemp("verify")
    shutil.copytree(PROGRAMS, folder / "input")
    assert run("migrate", folder / "input" / "button.c", "-o", folder / "out").code == 0
    return folder / "out"


@pytest.fixture
def out(made: Path, tmp_path: Path) -> Path:
    """A copy of it."""
    shutil.copytree(made, tmp_path / "out")
    return tmp_path / "out"


@pytest.fixture(scope="module")
def made_and_searched(made: Path, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Outcome]:
    """The migrated button program with the scenarios that a search has found, made once, and what that run said."""
    folder = tmp_path_factory.mktemp("searched") / "out"
    shutil.copytree(made, folder)
    return folder, run("verify", folder, "--json")


@pytest.fixture
def searched(made_and_searched: tuple[Path, Outcome], tmp_path: Path) -> Path:
    """A copy of it."""
    shutil.copytree(made_and_searched[0], tmp_path / "searched")
    return tmp_path / "searched"


@pytest.fixture
def pressed(tmp_path: Path) -> Path:
    """A scenario in which the button is pressed twice."""
    path = tmp_path / "pressed.toml"
    points = "[[0, 0], [500, 1], [900, 0], [2000, 1], [3200, 0]]"
    path.write_text(f'name = "two presses"\nhorizon_ms = 4000\n[signals]\nButton = {points}\n')
    return path


def test_no_difference_is_found_in_a_right_migration(out: Path, pressed: Path, tmp_path: Path) -> None:
    outcome = run("verify", out, "--scenario", pressed, "-o", tmp_path / "x.vcd", "--json")
    assert outcome.code == 0, outcome.err
    result = outcome.result
    assert result["verdict"] == "no-difference-found"
    assert [(s["name"], s["origin"], s["verdict"]) for s in result["scenarios"]] == [
        ("two presses", "given", "no-difference-found")
    ]
    assert {c["name"]: c["status"] for c in result["channels"]} == {
        "Lamp (P26)": "same", "Speaker (P4)": "same", "console": "same"
    }  # fmt: skip
    assert result["simulated_s"] == 4.0
    assert result["source_coverage"]["lines_pct"] == 100.0
    assert result["source_coverage"]["branches_pct"] == 100.0
    assert result["first_difference"] is None
    assert {b["port"]: b["device"] for b in result["binding"]} == {"P3": "levels", "P4": None, "P26": None}
    text = (tmp_path / "x.vcd").read_text()
    assert "$scope module source $end" in text
    assert "$scope module target $end" in text


FAULTS = {
    "pin": ("LampWriteP1 = 13", "LampWriteP1 = 12", "Lamp (P26)", []),
    "duration": ("pause(300)", "pause(290)", "Lamp (P26)", ["290.", "300."]),
    "unit": ("pause(300)", "delayMicroseconds(300)", "Lamp (P26)", ["0.", "300."]),
    "tone": ("freqout(SpeakerWriteP1, 200, 3000)", "freqout(SpeakerWriteP1, 200, 2800)", "Speaker (P4)", [" 2999"]),
    "not waiting": ("freqout(SpeakerWriteP1, 200, 3000)", "tone(SpeakerWriteP1, 3000)", "Speaker (P4)", []),
    "text": ("presses %d", "press %d", "console", ["'press 1'", "'presses 1'"]),
    "lost": ("presses++;", "", "console", ["'presses 0'", "'presses 1'"]),
}
"""Name of a fault -> old text, new text, channel, and what the message quotes: numbers and the program's own texts."""


CALLS = {
    "pin": ("high", "button.c", 11),
    "duration": ("pause", "button.c", 12),
    "unit": ("pause", "button.c", 12),
    "tone": ("freqout", "button.c", 14),
    "not waiting": ("freqout", "button.c", 14),
    "text": ("print", "button.c", 10),
    "lost": ("print", "button.c", 10),
}
"""Fault -> the call that the verdict names as its cause, or where it shows."""


@pytest.mark.parametrize("fault", FAULTS)
def test_a_fault_is_told_with_channel_function_and_first_difference(fault: str, out: Path, pressed: Path) -> None:
    old, new, channel, quoted = FAULTS[fault]
    sketch = out / "button" / "button.ino"
    assert old in sketch.read_text()
    sketch.write_text(sketch.read_text().replace(old, new, 1))
    outcome = run("verify", out, "--scenario", pressed, "--json")
    assert outcome.code == 6
    result = outcome.result
    assert result["verdict"] == "different"
    first = result["first_difference"]
    assert first["scenario"] == "two presses"
    assert first["channel"] == channel
    assert [each for each in quoted if each not in first["message"]] == []
    assert first["inputs"] == {"Button": first["inputs"]["Button"]}
    if channel != "console":
        assert first["functions"]
    calls = [first["call"], *first["calls_around"]]
    assert CALLS[fault] in {(call["function"], call["file"], call["line"]) for call in calls}


def test_a_person_may_write_it_otherwise(out: Path, pressed: Path) -> None:
    sketch = out / "button" / "button.ino"
    text = sketch.read_text()
    for old, new in (("pause(300);", "pause(100); pause(200);"), ("presses++;", "presses = presses + 1;")):
        assert old in text
        text = text.replace(old, new, 1)
    sketch.write_text(text)
    assert run("verify", out, "--scenario", pressed).code == 0


def test_scenarios_are_made_stored_and_used_again(made_and_searched: tuple[Path, Outcome], searched: Path) -> None:
    _, outcome = made_and_searched
    assert outcome.code == 0, outcome.document
    result = outcome.result
    assert {s["origin"] for s in result["scenarios"]} == {"generated"}
    assert result["source_coverage"]["branches_pct"] == 100.0
    stored = sorted((searched / "models" / "scenarios").glob("*.toml"))
    assert len(stored) == len(result["scenarios"]) > 1
    kinds = [a["kind"] for a in outcome.document["artifacts"] if a["kind"] != "picture"]
    assert kinds == ["scenario"] * len(stored) + ["search"]
    again = run("verify", searched, "--json").result
    assert {s["origin"] for s in again["scenarios"]} == {"stored"}
    assert sorted((searched / "models" / "scenarios").glob("*.toml")) == stored


@pytest.fixture
def searches(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """An entry for each search for scenarios, with its seed."""
    seeds: list[int] = []

    def counted(*settings: Any) -> Any:
        seeds.append(settings[4])
        return search(*settings)

    monkeypatch.setattr("robosmi.transformations.chains.verify.search", counted)
    return seeds


def test_an_edit_of_the_sketch_needs_no_new_search(searched: Path, searches: list[int]) -> None:
    first = verify(searched)
    sketch = searched / "button" / "button.ino"
    text = sketch.read_text()
    sketch.write_text(text.replace("presses++;", "presses = presses + 1;"))
    again = verify(searched)
    told = ("branches_pct", "lines_pct", "racy", "racy_branches", "missed_branches")
    assert [getattr(again.verdict, name) for name in told] == [getattr(first.verdict, name) for name in told]
    assert again.verdict.verdict == NO_DIFFERENCE
    sketch.write_text(text.replace("presses++;", "presses += 2;"))
    assert verify(searched).verdict.verdict == DIFFERENT_VERDICT
    assert searches == []


@pytest.mark.parametrize("damaged", sample(["{", "[]", '{"search": 1}'], 1))
def test_what_the_search_depends_on_makes_it_search_again(damaged: str, searched: Path, searches: list[int]) -> None:
    folder = searched / "models" / "scenarios"
    stored = sorted(folder.glob("*.toml"))
    verify(searched, seed=2)
    assert searches == [2]
    stored[-1].unlink()
    verify(searched, seed=2)
    assert searches == [2, 2]
    (folder / FILE).write_text(damaged)
    verify(searched, seed=2)
    assert searches == [2, 2, 2]


def test_two_runs_at_once_store_each_scenario_once(out: Path, searched: Path) -> None:
    command = [sys.executable, "-m", "robosmi", "verify", str(out)]
    both = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) for _ in range(2)]
    for each in both:
        said, _ = each.communicate(timeout=300)
        assert each.returncode == 0, said
    assert tree(out / "models" / "scenarios") == tree(searched / "models" / "scenarios")


def test_what_does_not_compile_is_said(out: Path, pressed: Path) -> None:
    sketch = out / "button" / "button.ino"
    sketch.write_text(sketch.read_text() + "\nint broken(\n")
    outcome = run("verify", out, "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "not-compiled")
    assert any(f["rule"] == "RS801" for f in outcome.document["findings"])


def test_a_scenario_that_names_nothing_is_wrong_usage_before_anything_is_built(out: Path, pressed: Path) -> None:
    pressed.write_text(pressed.read_text().replace("Button", "Buton"))
    outcome = run("verify", out, "--scenario", pressed)
    assert outcome.code == 2
    assert "did you mean 'Button'?" in outcome.err
    pressed.write_text("horizon_ms = 10\n[signals]\nButton = [[5, 1], [1, 0]]\n")
    assert "goes back in time" in run("verify", out, "--scenario", pressed).err


def test_a_folder_without_a_plan_is_refused(tmp_path: Path) -> None:
    outcome = run("verify", tmp_path)
    assert outcome.code == 3
    assert "has no plan" in outcome.err


@pytest.mark.parametrize("command", ["verify", "simulate"])
@pytest.mark.parametrize("linked", ["models", "models/plan.xmi"])
def test_a_plan_outside_of_the_folder_is_not_read(command: str, linked: str, out: Path, tmp_path: Path) -> None:
    away = tmp_path / "away"
    (out / linked).rename(away)
    (out / linked).symlink_to(away)
    outcome = run(command, out)
    assert outcome.code == 3
    assert "the plan is outside the output folder" in outcome.err


@pytest.mark.parametrize("linked", ["scenarios", "scenarios/one.toml"])
def test_scenarios_outside_of_the_folder_are_neither_read_nor_written(linked: str, out: Path, tmp_path: Path) -> None:
    (tmp_path / "away").mkdir()
    (tmp_path / "away" / "one.toml").write_text("horizon_ms = 100\n")
    before, place = tree(tmp_path / "away"), out / "models" / linked
    place.parent.mkdir(exist_ok=True)
    place.symlink_to(tmp_path / "away" / linked.partition("/")[2])
    outcome = run("verify", out)
    assert outcome.code == 3
    assert "behind a link" in outcome.err
    page = WatchedFolder(out)
    answers = [page.answer({"list": True}), page.answer({"scenario": "one", "ms": 100})]
    assert [answer["state"] for answer in answers] == ["refused", "refused"]
    assert "'models/scenarios" in answers[0]["message"]
    assert tree(tmp_path / "away") == before


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("int f(int n) { return f(n + 1) + 1; }\nint main() { high(26); return f(1); }", "its calls exhaust the stack"),
        (
            "int f(int n) { volatile char b[3000]; b[0] = n; return f(n + 1) + b[0]; }\nint main() { high(26); return f(1); }",
            "its calls exhaust the stack",
        ),
        (
            "int main() { char b[8] = {0}; int i = 0; high(26); while (b[i] != 1 || b[i + 1] != 2 || b[i + 2] != 3) i++; }",
            "beyond the end of a stack",
        ),
        ('int main() { wavplay_now(); high(26); return 0; }\nvoid wavplay_now(void) { wav_play("a.wav"); }', "wav_play"),
    ],
    ids=["recursion", "large frames", "past an array", "no model"],
)
def test_programs_that_cannot_be_judged_say_why(text: str, reason: str, tmp_path: Path, pressed: Path) -> None:
    program = tmp_path / "odd.c"
    more = '#include "wavplayer.h"\nvoid wavplay_now(void);\n' if "wav" in text else ""
    program.write_text(f'#include "simpletools.h"\n{more}{text}\n')
    assert run("migrate", program, "-o", tmp_path / "out", "--bind", "P26=D13").code in (0, 1)
    pressed.write_text("horizon_ms = 300\n")
    outcome = run("verify", tmp_path / "out", "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (1, "not-decidable"), outcome.result
    assert any(reason in why for why in outcome.result["reasons"])


def test_a_program_that_never_waits_ends_with_the_scenario(tmp_path: Path, pressed: Path) -> None:
    (tmp_path / "busy.c").write_text('#include "simpletools.h"\nint main() { while (1) { } }\n')
    assert run("migrate", tmp_path / "busy.c", "-o", tmp_path / "out").code in (0, 1)
    pressed.write_text("horizon_ms = 300\n")
    outcome = run("verify", tmp_path / "out", "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"], outcome.result["simulated_s"]) == (1, "not-decidable", 0.3)


NOTHING = {
    "not bound": ("int main() { high(26); pause(100); low(26); while (1) pause(5); }", (), ["P26", "--bind P26=PIN", "console"]),
    "hangs": (
        "int main() { while (input(3) == 0) pause(5); high(26); while (1) pause(5); }",
        ("--bind", "P26=D13", "--bind", "P3=D2"), ["P26", "--scenario FILE", "console"],
    ),
    "does nothing": ("int main() { while (1) { } }", (), ["console"]),
}  # fmt: skip


@pytest.mark.parametrize("case", NOTHING)
def test_where_nothing_was_compared_nothing_is_decided(case: str, tmp_path: Path, pressed: Path) -> None:
    text, options, told = NOTHING[case]
    (tmp_path / "mute.c").write_text(f'#include "simpletools.h"\n{text}\n')
    assert run("migrate", tmp_path / "mute.c", "-o", tmp_path / "out", *options).code in (0, 1)
    pressed.write_text("horizon_ms = 500\n")
    outcome = run("verify", tmp_path / "out", "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (1, "not-decidable"), outcome.result
    (reason,) = [why for why in outcome.result["reasons"] if why.startswith("nothing was compared: ")]
    assert [each for each in told if each not in reason] == []
    assert outcome.result["source_coverage"]["scenarios"] == 0
    text = run("verify", tmp_path / "out", "--scenario", pressed).out
    assert "no source line counts as reached" in text
    assert "source lines" not in text


def test_a_crash_of_the_migrated_program_alone_is_a_difference(out: Path, pressed: Path) -> None:
    """After 1.5 s it jumps to where no program is; until then it does what the original does."""
    sketch = out / "button" / "button.ino"
    old = "void loop() {"
    assert old in sketch.read_text()
    sketch.write_text(sketch.read_text().replace(old, f"{old} if (millis() > 1500) ((void (*)(void))0x3f00)();"))
    outcome = run("verify", out, "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different"), outcome.result
    first = outcome.result["first_difference"]
    assert first["channel"] == "program"
    assert first["at_ms"] == pytest.approx(1502, abs=10)
    assert {c["name"]: (c["status"], c["events"]) for c in outcome.result["channels"]} == {
        "Lamp (P26)": ("same", 2), "Speaker (P4)": ("same", 2), "console": ("same", 1)
    }  # fmt: skip
    assert {c["until_ms"] for c in outcome.result["channels"]} == {first["at_ms"]}
    text = run("verify", out, "--scenario", pressed).out
    assert f"Lamp (P26) (2 events), compared until {first['at_ms']:.1f} ms" in text
    assert "source lines" not in text


def test_a_crash_before_anything_happens_leaves_no_channel_called_the_same(out: Path, pressed: Path) -> None:
    sketch = out / "button" / "button.ino"
    sketch.write_text(sketch.read_text().replace("void loop() {", "void loop() { ((void (*)(void))0x3f00)();"))
    outcome = run("verify", out, "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different"), outcome.result
    assert {c["status"] for c in outcome.result["channels"]} == {"not-exercised"}


def test_a_crash_on_both_sides_decides_nothing(tmp_path: Path, pressed: Path) -> None:
    program = "int main() { high(26); pause(300); low(26); pause(200); ((void (*)(void))0x3f00)(); return 0; }"
    (tmp_path / "lost.c").write_text(f'#include "simpletools.h"\n{program}\n')
    assert run("migrate", tmp_path / "lost.c", "-o", tmp_path / "out", "--bind", "P26=D13").code in (0, 1)
    pressed.write_text("horizon_ms = 1000\n")
    outcome = run("verify", tmp_path / "out", "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (1, "not-decidable"), outcome.result
    (reason,) = outcome.result["reasons"]
    assert reason.startswith("both programs crash: ")
    assert outcome.result["source_coverage"]["scenarios"] == 0


def test_a_migrated_program_that_halts_early_is_compared_to_the_end(out: Path, pressed: Path) -> None:
    sketch = out / "button" / "button.ino"
    text = sketch.read_text().replace("#include <Arduino.h>", "#include <Arduino.h>\n#include <avr/sleep.h>")
    text = text.replace("void loop() {", "void loop() { if (millis() > 1500) { cli(); sleep_enable(); sleep_cpu(); }")
    sketch.write_text(text)
    outcome = run("verify", out, "--scenario", pressed, "--json")
    assert (outcome.code, outcome.result["verdict"]) == (6, "different"), outcome.result
    assert outcome.result["first_difference"]["at_ms"] > 1500


@pytest.mark.parametrize(("verdict", "said"), [("no-difference-found", "compiles"), ("not-compiled", "does not compile")])
def test_migrate_says_what_its_run_has_compiled(verdict: str, said: str, tmp_path: Path) -> None:
    shutil.copytree(PROGRAMS, tmp_path / "input")
    made = robosmi.migrate([tmp_path / "input" / "button.c"], tmp_path / "out")
    assert isinstance(made, Generated)
    plan = (tmp_path / "out" / "models" / "plan.xmi").read_bytes()
    [works] = [line for line in made.lines() if line.split()[0] == "works"]
    assert works.endswith("; not compiled yet")
    made.verification = ({"verdict": verdict}, 0)
    [works] = [line for line in made.lines() if line.split()[0] == "works"]
    assert works.endswith(f"; {said}")
    assert (tmp_path / "out" / "models" / "plan.xmi").read_bytes() == plan


def test_migrate_verifies_at_the_end_and_the_report_carries_the_verdict(tmp_path: Path) -> None:
    shutil.copytree(PROGRAMS, tmp_path / "input")
    outcome = run("migrate", tmp_path / "input" / "button.c", "-o", tmp_path / "out", "--verify", "--json")
    assert outcome.code == 0, outcome.document
    assert outcome.result["verification"]["verdict"] == "no-difference-found"
    assert [f["severity"] for f in outcome.document["findings"] if f["rule"] == "RS850"] == ["info"]
    report = (tmp_path / "out" / "button" / "MIGRATION.md").read_text()
    many = len(outcome.result["verification"]["scenarios"])
    assert f"in {many} test case" in report
    [picture] = re.findall(r"!\[.*\]\((.*\.svg)\)", report)
    drawn = next((tmp_path / "out").glob("*/MIGRATION.md")).parent / picture
    assert "Lamp" in "".join(ElementTree.parse(drawn).getroot().itertext())
    assert run("generate", tmp_path / "out" / "models" / "plan.xmi", "-o", tmp_path / "out").code == 0
    assert (tmp_path / "out" / "button" / "MIGRATION.md").read_text() == report
    sketch = tmp_path / "out" / "button" / "button.ino"
    sketch.write_text(sketch.read_text().replace("pause(300)", "pause(200)"))
    outcome = run("migrate", tmp_path / "input" / "button.c", "-o", tmp_path / "out", "--verify", "--json")
    assert (outcome.code, outcome.result["verification"]["verdict"]) == (6, "different")
    assert "Lamp (P26): " in (tmp_path / "out" / "button" / "MIGRATION.md").read_text()


def test_a_body_counts_as_it_stands_now(tmp_path: Path) -> None:
    program = tmp_path / "blink.c"
    program.write_text('#include "simpletools.h"\nint main() {\n  while (1) { high(5); pause(100); low(5); pause(100); }\n}\n')
    out = tmp_path / "out"
    assert run("migrate", program, "-o", out, "--adapters", "placeholders", "--bind", "P5=D5").code == 0
    adapters = out / "blink" / "adapters.h"
    text = adapters.read_text()
    bodies = {"high(int32_t pin)": "pinMode(pin, OUTPUT); digitalWrite(pin, HIGH);", "pause(int32_t time)": "delay(time);"}
    for signature, body in bodies.items():
        begin = text.index(f"void {signature}")
        text = text[:begin] + text[begin:].replace("// TODO: complete method", body, 1)
    adapters.write_text(text)
    half = run("verify", out, "--json")
    assert half.code == 6
    low = "digitalWrite(pin, LOW);"
    adapters.write_text(text.replace("// TODO: complete method", low))
    assert run("verify", out, "--json").code == 0  # nothing was generated in between
    adapters.write_text(adapters.read_text().replace(low, f"// TODO: complete method\n  {low}"))
    undone = run("verify", out, "--json")
    assert (undone.code, undone.result["verdict"]) == (1, "not-decidable")
    assert "the program calls low, which has no body yet" in str(undone.result)
