"""What a compiler of the target refuses is a task of the plan before anybody compiles, with the line of the source."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.chains.stages.compiler_errors import compiler_complaints
from robosmi.transformations.m2t.first_screen import written
from robosmi.transformations.queries.reports.work import Work
from robosmi.transformations.t2m.c_source.parsing.generated_program import GeneratedProgram
from tests.tools import require_tools

PROGRAM = Path(__file__).parent / "refused_text" / "robot.c"


def test_each_line_that_a_compiler_refuses_is_a_task_with_its_place_in_the_source(tmp_path: Path) -> None:
    made = robosmi.migrate([PROGRAM], tmp_path / "out")
    plan = made.models.plan
    wanted = {
        (path.name, number)
        for path in PROGRAM.parent.iterdir()
        for number, line in enumerate(path.read_text().splitlines(), 1)
        if line.endswith("// told")
    }
    assert {(Path(f.path).name, f.line) for f in plan.findings if f.rule == "RS337"} == wanted
    assert {(Path(t.path).name, t.line) for t in plan.tasks if t.rule == "RS504"} == wanted
    assert not written(Work(plan)).startswith("nothing")
    again = robosmi.generate_sketch(tmp_path / "out" / "models" / "plan.xmi", tmp_path / "again")
    assert again.contents == made.contents


def test_a_compiler_refuses_what_is_told(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    made = robosmi.migrate([PROGRAM], tmp_path / "out")
    said = [f for f in robosmi.compile_sketch(made.sketch).diagnostics if f.rule == "RS801" and f.location is not None]
    lines = {f"line {f.location.line} of {Path(f.location.path).name}" for f in said if f.location is not None}
    assert {f.message.partition(":")[0] for f in made.models.plan.findings if f.rule == "RS337"} == lines


def test_names_of_headers_that_are_not_there_are_not_told() -> None:
    sketch = b"""#include <Arduino.h>
#include <Other.h>
Thing thing = thing_of(LED_BUILTIN);
void setup() { clock_t start = clock(), now; now = start; Serial.begin(9600); thing.turn((Kind *)start, F("a")); }
void loop() { PORTB |= _BV(3); Stream &line = Serial; Print &out = Serial; Kind &kind = Things[0];
  digitalWrite(3, HIGH); int32_t x = (FILE *)0 == stdout; }
"""
    assert compiler_complaints(GeneratedProgram({"robot.ino": sketch}, "Arduino.h")) == []


def test_pointers_and_references_to_what_stands_for_a_register_and_a_parenthesis_too_many_are_told() -> None:
    sketch = b"""#define PLACE(name) &name
struct Register { operator int() const; void operator&() const = delete; };
const Register OUTPUTS = {};
void setup() {
  int *place = (int *)&OUTPUTS;
  place = PLACE(OUTPUTS);
  volatile int &same = OUTPUTS;
  auto &itself = OUTPUTS;
}
int *p) ;
void loop() { PLACE(OUTPUTS; }
"""
    lines = [each.line for each in compiler_complaints(GeneratedProgram({"robot.ino": sketch}, "Arduino.h"))]
    assert lines == [5, 6, 7, 10, 11]


def test_a_function_that_the_program_defines_below_its_use_is_told() -> None:
    sketch = b"void setup() {\n  later(3);\n}\nvoid later(int x) { (void)x; }\nvoid loop() {}\n"
    assert [(each.file, each.line) for each in compiler_complaints(GeneratedProgram({"robot.ino": sketch}, "Arduino.h"))] == [
        ("robot.ino", 2)
    ]


def test_errors_of_syntax_are_told_where_each_word_is_known() -> None:
    sketch = b"""typedef int op;
void high(int pin);
const char *text = "%" PRIu32;
int near;
int main_of(void) { return 0; }
void setup() { ((op))high)(3); }
void loop() {}
int last(op) { return op; }
"""
    program = GeneratedProgram({"robot.ino": sketch}, "Arduino.h")
    known = {"op", "high", "setup", "loop", "last", "text", "main_of"}
    assert [each.line for each in compiler_complaints(program, known.issuperset)] == [6, 8]
    assert compiler_complaints(program) == []


@pytest.mark.parametrize(("int_bits", "char_signed", "told"), [(16, True, [1, 2]), (32, False, []), (32, True, [2])])
def test_types_have_the_widths_of_the_target(int_bits: int, char_signed: bool, told: list[int]) -> None:
    sketch = b"int four[sizeof(int)] = {1, 2, 3, 4};\nint two[(char)-1 < 0 ? 1 : 2] = {1, 2};\n"
    program = GeneratedProgram({"robot.ino": sketch}, "Arduino.h", int_bits=int_bits, char_signed=char_signed)
    assert [each.line for each in compiler_complaints(program)] == told


def test_a_program_for_a_pico_is_read_with_its_widths(tmp_path: Path) -> None:
    text = '#include "simpletools.h"\nint four[sizeof(int)] = {1, 2, 3, 4};\nint main() { print("%d", four[3]); }\n'
    (tmp_path / "four.c").write_text(text)
    plan = robosmi.migrate([tmp_path / "four.c"], tmp_path / "out", target="pico").models.plan
    assert [finding.line for finding in plan.findings if finding.rule == "RS337"] == []


def test_forms_of_later_standards_are_told_where_the_compiler_of_the_target_refuses_them() -> None:
    sketch = b"""auto deduced(int p) { return p + 1; }
constexpr int summed(int n) { int s = 0; return s + n; }
constexpr int chosen(int n) { if (n) return 1; return 2; }
struct Lamp { int pin; constexpr Lamp(int p) : pin(p) { pin = p; } };
void setup() { auto any = [](auto q) { return q + 1; }; }
void loop() { auto kept = [k = 9](int q) { return q + k; }; int bits = 0b101; kept(bits); }
auto single = [](int p) { return p; };
"""
    lines = {
        bits: [each.line for each in compiler_complaints(GeneratedProgram({"a.ino": sketch}, "Arduino.h", int_bits=bits))]
        for bits in (16, 32)
    }
    assert lines == {16: [1, 2, 3, 4, 5], 32: []}
