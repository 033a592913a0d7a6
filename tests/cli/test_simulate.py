"""`robosmi simulate`: a program alone on a simulator, with a scenario, as text, JSON and VCD."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest

from tests.running import run
from tests.tools import require_engine, require_tools

BLINK = """
void setup() { pinMode(13, OUTPUT); pinMode(2, INPUT); Serial.begin(115200); analogWrite(5, 64); }
void loop() {
  digitalWrite(13, HIGH); delay(100); digitalWrite(13, LOW); delay(100);
  Serial.print(digitalRead(2)); Serial.print(' '); Serial.println(analogRead(A0));
}
"""


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")


@pytest.fixture
def blink(tmp_path: Path) -> Path:
    """A sketch without models."""
    folder = tmp_path / "blink"
    folder.mkdir()
    (folder / "blink.ino").write_text(BLINK)
    return folder


def test_a_bare_sketch_runs_five_seconds_and_tells_its_console_and_pins(blink: Path) -> None:
    outcome = run("simulate", blink, "--json", "--engine", "simavr")
    assert outcome.code == 0, outcome.err
    result = outcome.result
    assert result["engine"].startswith("simavr")
    assert result["simulated_s"] == 5.0
    assert len(result["console"].splitlines()) == 24
    light = [e for e in result["events"] if e["pin"] == "D13"]
    assert [e["level"] for e in light[:5]] == [0, 1, 0, 1, 0] or [e["level"] for e in light[:4]] == [1, 0, 1, 0]
    spans = [b["t_us"] - a["t_us"] for a, b in pairwise(light[1:])]
    assert all(abs(span - 100_000) < 1_000 for span in spans)
    (wave,) = [e["pwm"] for e in result["events"] if e["pin"] == "D5" and "pwm" in e]
    assert wave == {"hz": 976.5625, "duty": pytest.approx(0.254, abs=0.01)}
    assert result["events_total"] == len(result["events"])


def test_the_document_says_where_a_pin_is_let_go(tmp_path: Path) -> None:
    folder = tmp_path / "free"
    folder.mkdir()
    text = (
        "void setup() { pinMode(7, INPUT); pinMode(4, OUTPUT); digitalWrite(4, HIGH); delay(100); pinMode(4, INPUT);\n"
        "  pinMode(6, OUTPUT); delay(100); pinMode(6, INPUT_PULLUP); }\nvoid loop() {}\n"
    )
    (folder / "free.ino").write_text(text)
    result = run("simulate", folder, "--json", "--seconds", "1", "--engine", "simavr").result
    assert all(event["level"] in (0, 1) for event in result["events"])
    found = [(each["pin"], each["pull_up"], round(each["t_us"] / 1e5)) for each in result["released"]]
    assert ("D6", True, 2) in found
    assert [each for each in found if each[0] == "D4"][-1] in (("D4", False, 1), ("D4", True, 1))
    assert "D7" not in {pin for pin, *_ in found}


def test_a_scenario_names_pins_and_its_horizon_counts(blink: Path, tmp_path: Path) -> None:
    scenario = tmp_path / "s.toml"
    scenario.write_text("horizon_ms = 1000\n[signals]\nD2 = [[0, 0], [500, 1]]\nA0 = [[0, 1000], [500, 4000]]\n")
    outcome = run("simulate", blink, "--scenario", scenario, "-o", tmp_path / "x.vcd", "--json", "--engine", "simavr")
    assert outcome.result["simulated_s"] == 1.0
    lines = outcome.result["console"].splitlines()
    assert lines[0].startswith("0 20")
    assert lines[-1].startswith("1 8")
    assert outcome.document["artifacts"] == [{"path": str(tmp_path / "x.vcd"), "kind": "vcd"}]
    assert "$var wire 1 " in (tmp_path / "x.vcd").read_text()
    assert run("simulate", blink, "--scenario", scenario, "--seconds", "0.2", "--json").result["simulated_s"] == 0.2
    scenario.write_text("horizon_ms = 1000\n[signals]\nD99 = [[0, 0]]\n")
    outcome = run("simulate", blink, "--scenario", scenario)
    assert outcome.code == 2
    assert f"{scenario}: the scenario has a signal for 'D99', but there is no such component, port or pin" in outcome.err


def test_a_migrated_program_has_its_components_at_its_pins(migrated: Path, tmp_path: Path) -> None:
    """The line follower's own ports are inputs that the scenario names by component, port, or pin."""
    scenario = tmp_path / "s.toml"
    for name in ("HIH4030 2", "leftQTI", "D10", "P6"):
        scenario.write_text(f'horizon_ms = 100\n[signals]\n"{name}" = [[0, 300], [50, 2000]]\n')
        outcome = run("simulate", migrated, "--scenario", scenario, "--json", "--engine", "simavr")
        assert outcome.code == 0, outcome.err
    scenario.write_text('horizon_ms = 100\n[signals]\n"LED" = [[0, 1]]\n')
    outcome = run("simulate", migrated, "--scenario", scenario)
    assert outcome.code == 2
    assert "the program does not read it" in outcome.err


def test_what_does_not_compile_or_exist_says_so(blink: Path, tmp_path: Path) -> None:
    (blink / "blink.ino").write_text("void setup() { nothing(); }\nvoid loop() {}\n")
    outcome = run("simulate", blink, "--json")
    assert (outcome.code, outcome.document["ok"]) == (6, False)
    assert any(f["rule"] == "RS801" for f in outcome.document["findings"])
    assert run("simulate", tmp_path / "nothing").code == 3
    assert run("simulate", blink, "--engine", "nobodys").code in (2, 6)
    assert run("simulate", blink, "--seconds", "-1").code == 2
    assert run("simulate", blink, "--scenario", tmp_path / "no.toml").code == 3


def test_a_program_that_crashes_is_an_error_that_is_told_with_its_time(blink: Path) -> None:
    (blink / "blink.ino").write_text("void setup() { delay(50); ((void (*)(void))0x3f00)(); }\nvoid loop() { }\n")
    outcome = run("simulate", blink, "--json", "--engine", "simavr")
    assert (outcome.code, outcome.result["state"]) == (1, "crashed"), outcome.document
    (found,) = outcome.document["findings"]
    assert (found["rule"], found["severity"]) == ("RS854", "error")
    assert found["message"].startswith("the program crashed on the simulator at 5")


def test_what_a_program_does_is_told_in_words(tmp_path: Path) -> None:
    folder = tmp_path / "words"
    folder.mkdir()
    (folder / "words.ino").write_text(
        'void setup() { Serial.begin(115200); Serial.print("\\x01here\\x1b[2J\\n"); pinMode(9, OUTPUT); }\n'
        "void loop() { digitalWrite(9, HIGH); delayMicroseconds(1400); digitalWrite(9, LOW); delay(18); }\n"
    )
    text = run("simulate", folder, "--engine", "simavr", "--seconds", "1").out
    assert "  \\x01here\\x1b[2J\n" in text
    assert "\x1b[2J" not in text
    assert re.search(r"D9 +\d+ events, at the end pulses of 14\d\d us", text)
    (folder / "words.ino").write_text("void setup() {}\nvoid loop() {}\n")
    assert "no output and no driven pin" in run("simulate", folder, "--engine", "simavr", "--seconds", "1").out
