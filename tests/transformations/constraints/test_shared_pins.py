"""RS726: what a sketch that moves to another board needs of a pin, and what two pins of a board cannot have at once."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.constraints.plan_ports import port_faults

SKETCH = """const int POT = A0, LEFT = 9, RIGHT = 10, KEY = 2, WHEEL = 3, LAMP = 8;
volatile long turns;
void turned() { turns++; }
void setup() { attachInterrupt(digitalPinToInterrupt(KEY), turned, CHANGE);
  attachInterrupt(digitalPinToInterrupt(WHEEL), turned, CHANGE); }
void loop() { analogWrite(LEFT, analogRead(POT) / 4); analogWrite(RIGHT, 200); digitalWrite(LAMP, HIGH); }
"""
ON_A_PICO = {"POT": "GP26", "LEFT": "GP4", "RIGHT": "GP6", "KEY": "GP2", "WHEEL": "GP3", "LAMP": "GP9"}
ON_A_NUCLEO = {"POT": "A2", "LEFT": "D14", "RIGHT": "D15", "KEY": "D2", "WHEEL": "D8", "LAMP": "D4"}
ON_AN_R4 = {"POT": "A0", "LEFT": "D9", "RIGHT": "D10", "KEY": "D2", "WHEEL": "D8", "LAMP": "D4"}
ON_AN_ESP32 = {"POT": "IO33", "LEFT": "IO4", "RIGHT": "IO21", "KEY": "IO2", "WHEEL": "IO5", "LAMP": "IO18"}


@pytest.mark.parametrize(
    ("target", "pins", "said"),
    [
        ("pico", ON_A_PICO, ""),
        ("pico", ON_A_PICO | {"RIGHT": "GP20"}, "GP20 of the port 'RIGHT' has the same output of PWM2 as the port 'LEFT' on GP4"),
        ("pico", ON_A_PICO | {"POT": "GP5"}, "analogRead measures a voltage, but GP5 of the port 'POT' cannot"),
        ("nucleo-f401re", ON_A_NUCLEO, ""),
        ("nucleo-f401re", ON_A_NUCLEO | {"WHEEL": "D6"}, "D6 of the port 'WHEEL' has the same line of interrupts as"),
        ("nucleo-f401re", ON_A_NUCLEO | {"RIGHT": "A4"}, "A4 of the port 'RIGHT' has no PWM"),
        ("uno-r4-minima", ON_AN_R4 | {"WHEEL": "D7"}, "D7 of the port 'WHEEL' has no interrupt"),
        ("esp32", ON_AN_ESP32 | {"LAMP": "IO34"}, "digitalWrite drives the port 'LAMP', but IO34 cannot be an output"),
        ("esp32", ON_AN_ESP32, ""),  # its core gives each pin an output of its own
    ],
)  # fmt: skip
def test_a_pin_can_what_the_sketch_asks(target: str, pins: dict[str, str], said: str, tmp_path: Path) -> None:
    sketch = tmp_path / "robot" / "robot.ino"
    sketch.parent.mkdir()
    sketch.write_text(SKETCH)
    plan = robosmi.plan_migration([sketch], target=target, bind=pins).plan
    found = [finding.message for finding in port_faults(plan) if finding.rule == "RS726"]
    assert len(found) == bool(said)
    assert all(message.startswith(said) for message in found)


@pytest.mark.parametrize(
    ("target", "pin", "said"),
    [
        ("esp32", "IO34", ["high drives the port 'P4', but IO34 cannot be an output"]),
        ("esp32", "IO32", []),
        ("nano", "A6", ["high drives the port 'P4', but A6 cannot be an output"]),
    ],
)
def test_a_pin_that_only_measures_is_not_driven(target: str, pin: str, said: list[str], tmp_path: Path) -> None:
    assert on_the_pin(target, pin, "high(4);", tmp_path) == said


def test_a_pin_that_only_measures_reads_no_level_but_one_with_an_interrupt_does(tmp_path: Path) -> None:
    assert on_the_pin("esp32", "IO34", "input(4);", tmp_path) == []
    (found,) = on_the_pin("nano", "A6", "input(4);", tmp_path)
    assert found == "input reads the level of the port 'P4', but A6 only measures voltages"


def on_the_pin(target: str, pin: str, text: str, folder: Path) -> list[str]:
    """What is said of a program that does this at port 4, which is on the pin."""
    source = folder / "robot.c"
    source.write_text(f'#include "simpletools.h"\nint main(void) {{ {text} }}\n')
    plan = robosmi.plan_migration([source], target=target, bind={"P4": pin}).plan
    return [finding.message for finding in port_faults(plan) if finding.rule == "RS726"]


def test_what_the_old_board_did_not_do_is_not_asked(tmp_path: Path) -> None:
    """D7 of an Uno has no PWM, so that analogWrite only switches it there, too."""
    sketch = tmp_path / "lamp" / "lamp.ino"
    sketch.parent.mkdir()
    sketch.write_text("void setup() {}\nvoid loop() { analogWrite(7, 255); }\n")
    plan = robosmi.plan_migration([sketch], target="nucleo-f401re", bind={"D7": "A4"}).plan
    assert "RS726" not in {finding.rule for finding in port_faults(plan)}
