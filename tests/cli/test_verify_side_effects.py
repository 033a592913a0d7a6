"""`robosmi verify` of what is no event of a channel: the console's speed, foreign pins, lines that are let go, exact pulses."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_verification

PROGRAM = """#include "simpletools.h"
int main() {
  set_output(6, 0);
  low(10);
  print("begun\\n");
  while (1) {
    if (input(3)) print("pressed\\n");
    set_direction(6, 1);
    pause(50);
    set_direction(6, 0);
    pause(80);
    pulse_out(9, 40);
    pulse_out(10, 1500);
    freqout(8, 100, 1000);
  }
}
"""
PINS = {"P3": "D3", "P6": "D6", "P8": "D8", "P9": "D9", "P10": "D10"}


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The migrated program, made once, with a scenario."""
    require_verification("simavr")
    folder = tmp_path_factory.mktemp("beside")
    (folder / "p.c").write_text(PROGRAM)
    (folder / "s.toml").write_text("horizon_ms = 1500\n[signals]\nP3 = [[0, 0], [700, 1], [1100, 0]]\n")
    binds = [word for port, pin in PINS.items() for word in ("--bind", f"{port}={pin}")]
    assert run("migrate", folder / "p.c", "-o", folder / "out", *binds).code in (0, 1)
    return folder


LOOP = r"void loop\(\) \{"
CHANGES = {
    "as it is": (LOOP, "void loop() { ", "", ()),
    "slow console": (r"begin\(115200\)", "begin(9600)", "console", ("9615",)),
    "fast console": (r"begin\(115200\)", "begin(250000)", "console", ("250000",)),
    "a foreign pin": (LOOP, "void loop() { pinMode(12, OUTPUT); digitalWrite(12, HIGH);", "D12", ("D12",)),
    "a sensor's pin": (LOOP, "void loop() { pinMode(3, OUTPUT);", "D3 (P3)", ("D3",)),
    "a line that is never let go": (r"set_direction\(6, 0\)", "set_direction(6, 1)", "P6, as it is driven", ()),
    "a line that is never driven": (r"set_direction\(6, 1\)", "set_direction(6, 0)", "P6, as it is driven", ()),
    "a line that is driven too long": (r"pause\(50\)", "pause(54)", "P6, as it is driven", ("54.", "50.")),
    "a shorter pulse": (r"pulse_out\(9, 40\)", "pulse_out(9, 10)", "P9, its pulses", ("9.9 us", "40")),
    "a longer pulse": (r"pulse_out\(10, 1500\)", "pulse_out(10, 1560)", "P10, its pulses", ("1500",)),
    "a pulse within what may be off": (r"pulse_out\(10, 1500\)", "pulse_out(10, 1512)", "", ()),
}
"""Name of a change -> what it replaces in the sketch, by what, the channel of the first difference, and the numbers in it."""


@pytest.mark.parametrize("engine", ["simavr", "avr8js"])
@pytest.mark.parametrize("change", sample(CHANGES, 6))
def test_what_is_done_beside_channels_is_compared(change: str, engine: str, made: Path, tmp_path: Path) -> None:
    if engine == "avr8js" and "console" not in change:
        pytest.skip("only the console's speed is told by each engine itself")
    require_engine(engine)
    old, new, channel, numbers = CHANGES[change]
    shutil.copytree(made / "out", tmp_path / "out")
    sketch = tmp_path / "out" / "p" / "p.ino"
    text, count = re.subn(old, new, sketch.read_text())
    assert count
    sketch.write_text(text)
    outcome = run("verify", tmp_path / "out", "--scenario", made / "s.toml", "--engine", engine, "--json")
    expected = (6, "different") if channel else (0, "no-difference-found")
    first = outcome.result["first_difference"]
    assert (outcome.code, outcome.result["verdict"]) == expected, first
    if channel:
        assert first["channel"] == channel
        assert all(number in first["message"] for number in numbers), first


ALSO_READ = """#include "simpletools.h"
int main() {
  while (1) {
    high(4);
    pause(100);
    low(4);
    pause(100);
    if ((INA >> 4) & 1) print("high\\n");
    high(7);
    pause(20);
    if (input(7)) pause(10);
  }
}
"""
DARK = {
    "as it is": ("high(4)", "high(4)", None),
    "never driven": ("high(4)", "pause(0)", 0),
    "driven at the begin alone": ("high(4)", "if (millis() < 3000UL) high(4)", 3000),
    "another pin": ("high(7)", "if (millis() < 3000UL) high(7)", 3000),
}
"""Name of a change -> what it replaces in the sketch, by what, and from when (ms) the programs differ."""


@pytest.mark.parametrize("change", sample(DARK, 2))
def test_pins_that_are_driven_and_read_back_are_compared(change: str, tmp_path: Path) -> None:
    require_verification("simavr")
    (tmp_path / "p.c").write_text(ALSO_READ)
    (tmp_path / "s.toml").write_text("horizon_ms = 5000\n")
    assert run("migrate", tmp_path / "p.c", "-o", tmp_path / "out", "--bind", "P4=D4", "--bind", "P7=D7").code in (0, 1)
    old, new, from_ms = DARK[change]
    sketch = tmp_path / "out" / "p" / "p.ino"
    pin = old[-2]
    text = sketch.read_text()
    assert text.count(old) == 1
    sketch.write_text(text.replace(old, new))
    outcome = run("verify", tmp_path / "out", "--scenario", tmp_path / "s.toml", "--json")
    expected = (0, "no-difference-found") if from_ms is None else (6, "different")
    first = outcome.result["first_difference"]
    assert (outcome.code, outcome.result["verdict"]) == expected, first
    if from_ms is not None:
        assert first["channel"] == f"P{pin}, as it is driven"
        assert from_ms - 50 <= first["at_ms"] < from_ms + 500  # the source may be a few steps ahead


HIGH_LATER = """#include "simpletools.h"
int main() {
  set_output(6, 0);
  for (int i = 0; i < 5; i++) {
    set_direction(6, 1);
    pause(50);
    set_direction(6, 0);
    pause(80);
  }
  int *first = (int *) 64;
  print("%d\\n", *first);
  high(6);
  pause(5000);
}
"""


@pytest.mark.parametrize("pause", [50, 54])
def test_a_line_that_is_driven_high_behind_the_end_of_the_source_is_compared_before_that(pause: int, tmp_path: Path) -> None:
    require_verification("simavr")
    (tmp_path / "p.c").write_text(HIGH_LATER)
    (tmp_path / "s.toml").write_text("horizon_ms = 2000\n")
    assert run("migrate", tmp_path / "p.c", "-o", tmp_path / "out", "--bind", "P6=D6").code in (0, 1)
    sketch = tmp_path / "out" / "p" / "p.ino"
    sketch.write_text(sketch.read_text().replace("pause(50)", f"pause({pause})"))
    outcome = run("verify", tmp_path / "out", "--scenario", tmp_path / "s.toml", "--json")
    assert outcome.result["verdict"] == ("not-decidable" if pause == 50 else "different"), outcome.result["first_difference"]


HELD = """#include "simpletools.h"
int main() {
  print("begun\\n");
  while (1) { high(4); pause(100); low(4); pause(100); }
}
"""
WHEEL = "digitalWrite(wheelWriteP1, LOW);"


@pytest.mark.parametrize(("level", "told"), [("LOW", ""), ("HIGH", "the migrated program drives D9")])
def test_a_pin_that_is_held_at_rest_is_not_foreign(level: str, told: str, tmp_path: Path) -> None:
    """The sketch itself holds what the program does not use so that it does nothing."""
    require_verification("simavr")
    (tmp_path / "p.c").write_text(HELD)
    (tmp_path / "h.csv").write_text("pin,part,title,connector\nD9,Continuous Servo,wheel,pulse\nD4,LED,lamp,anode\n")
    made = run("migrate", tmp_path / "p.c", "--hardware", tmp_path / "h.csv", "--bind", "P4=D4", "-o", tmp_path / "out")
    assert made.code in (0, 1)
    sketch = tmp_path / "out" / "p" / "p.ino"
    assert WHEEL in sketch.read_text()
    sketch.write_text(sketch.read_text().replace(WHEEL, WHEEL.replace("LOW", level)))
    (tmp_path / "s.toml").write_text("horizon_ms = 1000\n[signals]\n")
    outcome = run("verify", tmp_path / "out", "--scenario", tmp_path / "s.toml", "--json")
    assert outcome.code == (6 if told else 0), outcome.result["first_difference"]
    assert not told or told in outcome.result["first_difference"]["message"]


ENDS = {
    "two lengths": "pause(100); pulse_out(5, 20000); pause(300); pulse_out(5, 1500); pause(300);",
    "one pulse at the end": "pause(100); pulse_out(5, 20000);",
}


@pytest.mark.parametrize("name", sample(ENDS, 1))
@pytest.mark.parametrize("longer", [False, True])
def test_pulses_of_a_program_that_ends_are_compared_as_far_as_the_other_side_runs(
    name: str, longer: bool, tmp_path: Path
) -> None:
    """The original stops itself and leaves its pins as they are, while the sketch goes on with an empty loop."""
    require_verification("simavr")
    (tmp_path / "p.c").write_text('#include "simpletools.h"\nint main() { ' + ENDS[name] + " }\n")
    assert run("migrate", tmp_path / "p.c", "--bind", "P5=D5", "-o", tmp_path / "out").code in (0, 1)
    sketch = tmp_path / "out" / "p" / "p.ino"
    if longer:
        sketch.write_text(re.sub(r"pulse_out\(5, (\d+)\)", r"pulse_out(5, \1 * 11 / 10)", sketch.read_text()))
    outcome = run("verify", tmp_path / "out", "--json")
    assert outcome.code == (6 if longer else 0), outcome.result["first_difference"]


TUNE = """#include "simpletools.h"
int notes[] = { 1047, 1175, 1319, 1397 };
int main() {
  pause(200);
  for (int i = 0; i < 4; i++) freqout(4, 120, notes[i]);
  pause(300);
  freqout(4, 100, 1000); freqout(4, 100, 2000);
}
"""


@pytest.mark.parametrize(
    ("old", "new", "different"),
    sample(
        [("1047", "1047", False), ("1319", "1480", True), ("120", "180", True), ("i < 4", "i < 3", True), ("2000", "1900", True)],
        2,
    ),
)
def test_notes_without_a_pause_between_them_are_compared(old: str, new: str, different: bool, tmp_path: Path) -> None:
    """The source is silent for some microseconds between two of them, which nobody hears, and a timer of the target is not."""
    require_verification("simavr")
    (tmp_path / "p.c").write_text(TUNE)
    assert run("migrate", tmp_path / "p.c", "--bind", "P4=D4", "-o", tmp_path / "out").code in (0, 1)
    sketch = tmp_path / "out" / "p" / "p.ino"
    assert old in sketch.read_text()
    sketch.write_text(sketch.read_text().replace(old, new))
    outcome = run("verify", tmp_path / "out", "--json")
    assert outcome.code == (6 if different else 0), outcome.result["first_difference"]
