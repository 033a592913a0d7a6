"""Undeclared names are predicted from a text's tokens alone, or not at all."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from robosmi.metamodels import ccode
from robosmi.model.xmi_writer import to_xmi
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.t2m.c_source import clang, parsing, read_program
from robosmi.transformations.t2m.c_source.foresight import foresee

ROOT = Path(__file__).resolve().parents[4]
PROGRAMS = [
    p for p in sorted([*(ROOT / "docs" / "examples").rglob("*.c"), *(ROOT / "tests" / "transformations" / "t2m").rglob("*.c")])
    if p.parent.name not in ("bad", "damaged")
]  # fmt: skip


def undeclared(text: str, *known: str) -> list[str] | None:
    """The predicted undeclared names of a text."""
    found = foresee(tokens(text.encode()), lambda name: name in known)
    return None if found is None else found.undeclared


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("void f(int a) { int b = a, *c = &b; b = a * c[0]; }", []),
        ("int main() { high(LED); while (1) pause(100); }", ["LED"]),
        ("fdserial *bus; int f(i2c *b, datetime t) { return t.h + b->x; }", ["fdserial", "i2c", "datetime"]),
        ("#define PIN (BASE + 1)\n#define UNUSED OTHER\nint main() { low(PIN); }", ["BASE"]),
        ("#define MAX(a, b) ((a) > (b) ? (a) : (b))\nint main() { return MAX(1, 2); }", []),
        ("typedef struct { int x; } T; T t; struct s *u; enum { A, B = 2 } e; int main() { t.x = A + B; }", []),
        ("int run(void); int main() { start(run, run2); } void run2() {}", None),
        ("int main() { again: clear(); clear; goto again; }", []),
        ("void (*handler)(int); int f(const char *s, unsigned n) { return s[n] + CNT; }", ["CNT"]),
        ("int main() { switch (x) { case ENTER: OUTA |= 1; } }", ["x", "ENTER", "OUTA"]),
        ("int i; int main() { i = i * STEP; for (int k = 0, n = 3; k < n; k++) ; }", ["STEP"]),
        ("int table[SIZE];", None),
        ("#ifdef DEBUG\nint d = LEVEL;\n#endif\n", None),
        ('void f() { __asm__ volatile ("nop" : [out] "=r" (x)); }', None),
    ],
)
def test_names_are_foreseen(text: str, names: list[str] | None) -> None:
    assert undeclared(text) == names


def test_names_of_headers_are_known() -> None:
    assert undeclared("uint8_t x = NULL;", "uint8_t", "NULL") == []


def parses(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """A list that grows with every parse."""
    done: list[int] = []
    parse: Any = clang.parse

    def counting(*given: Any, **more: Any) -> Any:
        done.append(1)
        return parse(*given, **more)

    monkeypatch.setattr(clang, "parse", counting)
    return done


def test_a_program_without_headers_is_parsed_once(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path = tmp_path / "robot.c"
    path.write_text('#include "simpletools.h"\nfdserial *bus;\nint main() { bus = fdserial_open(31, 30, 0, BAUD); OUTA = CNT; }')
    read_program(path)  # the first of a process asks the parser for its own macros
    done = parses(monkeypatch)
    program, findings = read_program(path)
    assert len(done) == 1
    assert [f.rule for f in findings] == []
    assert {str(d.name) for d in program.externals} == {"fdserial_open", "fdserial", "BAUD", "OUTA", "CNT"}


def test_what_is_foreseen_wrong_is_parsed_as_if_nothing_was(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    path = tmp_path / "robot.c"
    path.write_text("int main() { twice(A) B; }\n")  # a lost semicolon, with undeclared names
    monkeypatch.setattr(parsing, "_foresee", lambda *_: False)
    expected, findings = read_program(path)
    monkeypatch.undo()
    program, same = read_program(path)
    assert [str(f) for f in same] == [str(f) for f in findings] != []
    assert to_xmi({"m": program}) == to_xmi({"m": expected})


@pytest.mark.parametrize("path", PROGRAMS, ids=lambda p: p.stem)
def test_the_model_is_that_of_two_parses(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    program, _ = read_program(path)
    monkeypatch.setattr(parsing, "_foresee", lambda *_: False)
    expected, _ = read_program(path)
    assert to_xmi({"m": program}) == to_xmi({"m": expected})


def test_a_second_variable_of_an_unknown_type_is_the_programs_own(tmp_path: Path) -> None:
    path = tmp_path / "robot.c"
    path.write_text("sound *left, *right;\nint main() { right = sound_run(1, 2); }\n")
    program, _ = read_program(path)
    reference = program.units[0].declarations[2].body.statements[0].expression.left  # type: ignore[attr-defined]
    assert isinstance(reference.target, ccode.Variable)
    assert reference.target.name == "right"
