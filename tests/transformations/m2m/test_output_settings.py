"""What pins get before the program moves them, and pulses of servos as a person has measured them: seen on the simulator."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import SourceError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import PinTrace, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.running import run
from tests.tools import require_engine, require_tools

WIRING = """pin,part,title,connector
D8,Relay Module,pump,IN
D9,Basic Servo,left,pulse
D10,Basic Servo,right,pulse
D5,L298N Motor Driver,bridge,IN1
D12,Red LED,lamp,anode
D7,Pushbutton,button,
"""
SPEEDS = """#include "simpletools.h"
#include "servo.h"

int main() {
  pause(40);
  servo_speed(12, 0);
  servo_speed(13, 100);
  pause(300);
  servo_speed(12, -200);
  servo_speed(13, 250);
  while (1) pause(100);
}
"""
DRIVE = """#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_speed(64, 64);
  while (1) pause(100);
}
"""
PORTS = '[bind]\nP12 = "D9"\nP13 = "D10"\n'
ROLES = '[bind]\n"abdrive.left_servo" = "D9"\n"abdrive.right_servo" = "D10"\n'
MEASURED = """
[servos.left]
neutral = 1480

[servos.right]
speeds = [[-200, 1300], [0, 1510], [200, 1650]]
"""


def migrated(folder: Path, program: str, settings: str, target: str = "uno", head: str = "") -> Path:
    """Migrate a program on the wiring above; returns the output folder."""
    (folder / "robot.c").write_text(program)
    (folder / "wiring.csv").write_text(WIRING)
    (folder / "robosmi.toml").write_text(f'{head}[migrate]\nhardware = "wiring.csv"\n{settings}')
    robosmi.migrate([folder / "robot.c"], folder / "out", target=target)
    return folder / "out"


def seen(folder: Path, program: str, settings: str, milliseconds: float, target: str = "uno") -> PinTrace:
    """Migrate and simulate a program."""
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    report = compile_sketch(migrated(folder, program, settings, target), keep=folder)
    assert report.ok, report.diagnostics
    return simulate(job(report.elf, report.hex, load_board("uno"), milliseconds * 1000))  # type: ignore[arg-type]


def widths(trace: PinTrace, pin: str) -> list[int]:
    """The widths of a pin's pulses, rounded to 4 us, without repetitions."""
    found: list[int] = []
    for _, width in trace.pulses(pin):
        if not found or abs(width - found[-1]) > 6:
            found.append(round(width))
    return found


def near(found: list[int], wanted: list[int]) -> bool:
    """Whether widths are as expected within 6 us."""
    return len(found) == len(wanted) and all(abs(a - b) <= 6 for a, b in zip(found, wanted, strict=True))


@pytest.mark.parametrize("target", ["uno", "avr-c"])
@pytest.mark.parametrize(
    ("settings", "left", "right"), [("", [1500, 1300], [1600, 1750]), (MEASURED, [1480, 1280], [1580, 1650])]
)
def test_speeds_of_servos_are_the_pulses_that_were_measured(
    settings: str, left: list[int], right: list[int], target: str, tmp_path: Path
) -> None:
    trace = seen(tmp_path, SPEEDS, PORTS + settings, 600, target)
    assert near(widths(trace, "D9"), left), widths(trace, "D9")
    assert near(widths(trace, "D10"), right), widths(trace, "D10")


@pytest.mark.parametrize(
    ("settings", "left", "right"),
    [
        ("", 1600, 1400),
        (
            '[servos."abdrive.right_servo"]\nneutral = 1520\n[servos.left]\nspeeds = [[-128, 1300], [0, 1490], [128, 1700]]\n',
            1595,
            1420,
        ),
    ],
)
def test_a_drive_takes_them_too(settings: str, left: int, right: int, tmp_path: Path) -> None:
    trace = seen(tmp_path, DRIVE, ROLES + settings, 900)
    assert abs(widths(trace, "D9")[-1] - left) <= 6
    assert abs(widths(trace, "D10")[-1] - right) <= 6


@pytest.mark.parametrize("target", ["uno", "avr-c"])
def test_outputs_have_their_level_before_they_drive(target: str, tmp_path: Path) -> None:
    """A relay that a low level switches never sees one, motors and servos no high one, and what is harmless is left as it is."""
    trace = seen(tmp_path, SPEEDS, PORTS, 38, target)
    first = {pin: [(at, level) for at, level in trace.levels(pin) if level in (0, 1)] for pin in ("D5", "D8", "D9", "D10")}
    assert {pin: [level for _, level in levels] for pin, levels in first.items()} == {"D5": [0], "D8": [1], "D9": [0], "D10": [0]}
    assert all(levels[0][0] < 2000 for levels in first.values())
    assert [level for _, level in trace.levels("D8") if level == 0] == []
    assert {c.pin for c in trace.changes if c.level in (0, 1)} == {"D5", "D8", "D9", "D10"}


@pytest.mark.parametrize(
    ("text", "said", "line"),
    [
        ("[servos.left]\nneutral = 15\n", "neutral = 15 is no pulse", 3),
        ("[servos.left]\nneutral = 1500.5\n", "neutral = 1500.5 is no pulse", 3),
        ("[servos.left]\nneutral = true\n", "neutral = True is no pulse", 3),
        ('[servos."left"]\nneutrall = 1500\n', "'neutrall' is no key of it (did you mean 'neutral'?)", 3),
        ("[servos.left]\nspeeds = [[0, 1500]]\n", "speeds is no list of two [speed, microseconds] or more", 3),
        ("[servos.left]\nspeeds = [[0, 1500], [10]]\n", "speeds is no list of two [speed, microseconds] or more", 3),
        ("[servos.left]\nspeeds = 7\n", "speeds is no list of two", 3),
        ("[servos.left]\nspeeds = [[0, 1500], [10, 3000]]\n", "[10, 3000] in speeds has no pulse or speed that can be", 3),
        ("[servos.left]\nspeeds = [[0, 1500], [99999, 1600]]\n", "[99999, 1600] in speeds has no pulse", 3),
        ("[servos.left]\nspeeds = [[10, 1500], [10, 1600]]\n", "[10, 1600] in speeds does not come behind a lower speed", 3),
        ("[servos.left]\nneutral = 1490\nspeeds = [[0, 1500], [9, 1600]]\n", "neutral is 1490, and speeds has 1500", 3),
        (
            f"[servos.left]\nspeeds = {[[speed, 1000 + speed] for speed in range(65)]}\n",
            "speeds has 65 points",
            3,
        ),
        (
            '[bind]\nP12 = "D9"\n[servos.left]\nneutral = 1490\n[servos.P12]\nneutral = 1500\n',
            "'P12' and 'left' are the same servo",
            7,
        ),
        ("[servos.left]\n", "there is no table with neutral or speeds", 3),
        ("[servos]\nleft = 1500\n", "there is no table with neutral or speeds", 4),
        ("servos = 5\n", "[servos]", None),
        ("[servos.leftt]\nneutral = 1490\n", "'leftt' is not a component, role or port (did you mean 'left'?)", 3),
        ("[servos.button]\nneutral = 1490\n", "'button' has no pin that drives it", 3),
    ],
)
def test_what_cannot_be_is_an_error_with_its_place(text: str, said: str, line: int | None, tmp_path: Path) -> None:
    settings, head = (text, "") if line is not None else ("", text)
    with pytest.raises(SourceError) as refused:
        migrated(tmp_path, SPEEDS, settings, head=head)
    assert said in refused.value.message
    assert refused.value.fix
    place = refused.value.location
    assert place is not None
    assert (place.path, place.line) == (str(tmp_path / "robosmi.toml"), line)
    assert not (tmp_path / "out").exists()


def test_a_stored_plan_has_them(tmp_path: Path) -> None:
    out = migrated(tmp_path, SPEEDS, PORTS + MEASURED)
    assert run("generate", out / "models" / "plan.xmi", "-o", tmp_path / "again").code == 0
    again = (tmp_path / "again" / "robot" / "adapters.h").read_text()
    assert again == (out / "robot" / "adapters.h").read_text()
    assert "{9, 1480, 0, 0}," in again
    assert "static const int16_t servo_speeds_1[] = {-200, 1300, 0, 1510, 200, 1650};" in again


@pytest.mark.parametrize(("attributes", "level"), [({}, "LOW"), ({"transistor": "npn"}, "LOW"), ({"transistor": "pnp"}, "HIGH")])
def test_the_transistor_of_a_drawn_relay_says_at_which_level_it_is_off(
    attributes: dict[str, str], level: str, tmp_path: Path
) -> None:
    program, drawing = tmp_path / "pump.c", tmp_path / "diagram.json"
    program.write_text(
        '#include "simpletools.h"\n#define RELAY 9\nint main() { while (1) { high(RELAY); pause(500); low(RELAY); } }\n'
    )
    parts = [{"type": "wokwi-arduino-uno", "id": "uno"}, {"type": "wokwi-relay-module", "id": "relay1", "attrs": attributes}]
    wires = [[f"uno:{pin}", f"relay1:{name}", "", []] for pin, name in (("7", "IN"), ("5V", "VCC"), ("GND.2", "GND"))]
    drawing.write_text(json.dumps({"version": 1, "parts": parts, "connections": wires}))
    made = robosmi.migrate([program], tmp_path / "out", hardware=drawing)
    sketch = next(text for name, text in made.contents.items() if name.endswith(".ino")).decode()
    assert f"digitalWrite(relay1WriteP1, {level});" in sketch
