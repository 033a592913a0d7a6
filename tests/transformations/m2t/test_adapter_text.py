"""The text of adapters: what is declared in front of them."""

from __future__ import annotations

import re
from pathlib import Path

import robosmi
from robosmi.transformations.knowledge.adapters.adapter_files import read_adapter_file
from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.m2t.adapter_text import adapter_text, shared

FILE = """//# header pins.h

//# helper port
//#   table: port_pins 4
int port(int number) { return port_pins[number]; }

//# adapter go
//#   for: void go(void)
//#   kind: oneToOne
//#   include: <Servo.h>
//#   port: left_servo = pins.left 12 digital out servo
//#   limit: it does not stop
void go() { port(left_servo); }
"""


def test_pins_and_tables_are_declared_with_what_is_bound(tmp_path: Path) -> None:
    path = tmp_path / "pins.cpp"
    path.write_text(FILE)
    pieces = [adapter_element(piece) for piece in read_adapter_file(path)]
    text = adapter_text(pieces, {"pins.left": "9"}, "255", {1: "A0", 3: "5"})
    assert text.split("\n") == [
        "#include <Servo.h>",
        "",
        "const uint8_t left_servo = 9;  // pins.left",
        "",
        "// The pin of each port of the source, 255 where it is not wired",
        "const uint8_t port_pins[4] = {",
        "  255, A0, 255, 5",
        "};",
        "",
        "int port(int number) { return port_pins[number]; }",
        "",
        "// void go(void)",
        "// Limit: it does not stop",
        "void go() { port(left_servo); }",
        "",
    ]
    assert "left_servo = 255;" in adapter_text(pieces, {}, "255")


def test_state_is_there_once_and_interrupts_are_handled_in_one_of_several_files() -> None:
    text = """static volatile uint32_t rounds;
static uint8_t pins[2] = {left, right};
static void (*jobs[2])();
static const uint8_t table[] = {1};
static struct {
  int16_t top;
} drive = {200};

ISR(TIMER0_OVF_vect, ISR_NOBLOCK) {
  static uint16_t waited;
  rounds++;
}

static inline uint32_t now(void) {
  return rounds;
}
static Io io_at(int32_t number) { return number; }
inline void act() {
  static bool done;
}"""
    assert shared(text).split("\n") == [
        "__attribute__((weak)) volatile uint32_t rounds;",
        "__attribute__((weak)) uint8_t pins[2] = {left, right};",
        "__attribute__((weak)) void (*jobs[2])();",
        "static const uint8_t table[] = {1};",
        "__attribute__((weak)) struct {",
        "  int16_t top;",
        "} drive = {200};",
        "",
        "#ifdef ADAPTERS_INTERRUPTS",
        "ISR(TIMER0_OVF_vect, ISR_NOBLOCK) {",
        "  static uint16_t waited;",
        "  rounds++;",
        "}",
        "#endif",
        *text.split("\n")[12:],
    ]


def test_interrupts_of_one_line_are_handled_in_one_of_several_files_too() -> None:
    text = "ISR(PCINT0_vect) { edge(); }\nISR(PCINT1_vect) { edge(); }\n\ninline void go() {\n}"
    ends = ["#ifdef ADAPTERS_INTERRUPTS", "ISR(PCINT0_vect) { edge(); }", "#endif"]
    assert shared(text).split("\n")[:6] == [*ends, *(line.replace("0", "1") for line in ends)]
    assert shared(text).endswith("inline void go() {\n}")


def test_a_number_of_the_platform_that_only_programs_change_can_be_changed(tmp_path: Path) -> None:
    programs = {"read": "pause(us + ms);", "written": "us = 90; ms += us;", "own": "int us = 3; us = 4; pause(us + ms);"}
    shown: dict[str, list[str]] = {}
    for name, change in programs.items():
        source = tmp_path / f"{name}.c"
        source.write_text(f'#include "simpletools.h"\nint main(void) {{ {change} }}\n')
        made = robosmi.migrate([source], tmp_path / name)
        text = (tmp_path / name / name / "adapters.h").read_text(encoding="utf-8")
        shown[name] = [line for line in text.splitlines() if re.search(r"\b(us|ms) = ", line)]
        assert [f.message for f in made.models.plan.findings if f.rule == "RS337"] == []
    assert shown == {
        "read": ["const int32_t ms = 80000L;", "const int32_t us = 80L;"],
        "written": ["static int32_t ms = 80000L;", "static int32_t us = 80L;"],
        "own": ["const int32_t ms = 80000L;"],
    }
