"""Valid C is valid: what GCC takes is read and moved, and nothing of it is lost. The long run is `tests/fuzz/valid_c.py`."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.metamodels import ccode
from robosmi.model import load_model, save_model
from robosmi.transformations.t2m.c_source import read_program
from tests.fuzz.c_programs import program
from tests.fuzz.valid_c import check, judge_is_there

SEEDS = range(1, 25)


@pytest.fixture(scope="module")
def _judge() -> None:
    if not judge_is_there():
        pytest.skip("gcc for 32 bits is not installed (Debian: gcc-multilib)")


@pytest.mark.usefixtures("_judge")
def test_random_programs_that_gcc_takes_are_kept_whole() -> None:
    said = {seed: check(program(seed)) for seed in SEEDS}
    assert {seed: text for seed, text in said.items() if text not in ("kept", "not C")} == {}
    assert sum(text == "kept" for text in said.values()) >= len(SEEDS) // 2


def read(tmp_path: Path, text: bytes) -> ccode.SourceUnit:
    """The only unit of a program, as it comes back from a model file."""
    path = tmp_path / "a.c"
    path.write_bytes(text)
    model, _ = read_program(path)
    save_model(model, tmp_path / "a.xmi")
    unit: ccode.SourceUnit = load_model(tmp_path / "a.xmi").units[0]
    return unit


def initial_values(unit: ccode.SourceUnit) -> list[Any]:
    """The literals that the unit's variables begin with."""
    return [d.initializer for d in unit.declarations if isinstance(d, ccode.Variable)]


def sketch(tmp_path: Path, text: bytes) -> str:
    """The sketch that a program becomes."""
    path = tmp_path / "a.c"
    path.write_bytes(text)
    robosmi.migrate([path], tmp_path / "out")
    return (tmp_path / "out" / "a" / "a.ino").read_bytes().decode()


def test_characters_that_xml_cannot_hold_travel(tmp_path: Path) -> None:
    unit = read(tmp_path, b'/* a\f\v\x01\0 */\n#define M 1 \f + 2\nchar *s = "a\x01\f\0b";\nint main(void) { return M; }\n')
    assert [c.text for c in unit.comments] == ["/* a\f\v\x01\0 */"]
    assert [m.body for m in unit.macros] == ["1 \f + 2"]
    assert [x.text for x in initial_values(unit)] == ['"a\x01\f\0b"']


def test_constants_of_more_than_64_bits_keep_their_text(tmp_path: Path) -> None:
    unit = read(tmp_path, b"unsigned long long a = 0x1FFFFFFFFFFFFFFFFFFFF;\ndouble b = 0x1p99999;\nint main(void) { }\n")
    first, second = initial_values(unit)
    assert (first.text, first.value) == ("0x1FFFFFFFFFFFFFFFFFFFF", -1)
    assert (second.text, second.value) == ("0x1p99999", float("inf"))


def test_a_pin_is_what_a_parameter_of_32_bits_makes_of_it(tmp_path: Path) -> None:
    text = b'#include "simpletools.h"\nint main(void) { high(4294967301); high(0xFFFFFFFFFFFFFFFF); while (1) { } }\n'
    (tmp_path / "a.c").write_bytes(text)
    robosmi.migrate([tmp_path / "a.c"], tmp_path / "out")
    plan = load_model(tmp_path / "out" / "models" / "plan.xmi")
    assert [(b.name, b.sourcePin) for b in plan.portBindings] == [("P5", 5)]


def test_digraphs_are_the_braces_and_hashes_they_stand_for(tmp_path: Path) -> None:
    text = b"%:define M(a) %:a\nint a<:2:> = <% 1, 2 %>;\n"
    text += b"int f(p) int p; <% int n(int q) { return q; } return n(p); %>\nint main()\n<%\n"
    unit = read(tmp_path, text + b"f(1);\nwhile (1)\n<%\nf(2);\n%>\n%>\n")
    assert [m.name for m in unit.macros] == ["M"]
    assert [(d.name, d.body is not None) for d in unit.declarations if isinstance(d, ccode.Function)] == [
        ("f", True),
        ("main", True),
    ]
    made = sketch(tmp_path, text + b"f(1);\nwhile (1)\n<%\nf(2);\n%>\n%>\n")
    assert re.search(r"void setup\(\) \{\s*f\(1L\);\s*\}\s*void loop\(\) \{\s*f\(2L\);\s*\}", made)


def test_tabs_and_form_feeds_inside_a_line_of_main_stay(tmp_path: Path) -> None:
    made = sketch(
        tmp_path, b'int main(void)\n{\n\tprint("a\tb\fc\x85d");\t// e\ff\n\twhile (1)\n\t{\n\t\tprint("\v\t");\n\t}\n}\n'
    )
    assert '  print("a\tb\fc' in made
    assert "// e\ff" in made
    assert '  print("\v\t");' in made


@pytest.mark.parametrize("word", ["de\\\nfine", "define\\\n", "\\\ndefine"])
def test_a_directive_continued_inside_of_a_word(word: str, tmp_path: Path) -> None:
    unit = read(tmp_path, f"#{word} LED\\\nS 3\nint main(void) {{ return LEDS; }}\n".encode())
    assert [(m.name, m.body) for m in unit.macros] == [("LEDS", "3")]


def test_functions_within_functions_leave_the_others_whole(tmp_path: Path) -> None:
    text = b"int f(p) int p; { int n(int q) { high(q); return q; } return n(p); }\n"
    text += b"int g(void) { return f(1); }\nint main(void) { g(); }\n"
    unit = read(tmp_path, text)
    assert [d.name for d in unit.declarations if isinstance(d, ccode.Function) and d.body is not None] == ["f", "g", "main"]
    assert [u.name for u in unit.unresolved] == []
    assert int(unit.callsInModel) == 4


def test_operators_with_parentheses_are_no_calls(tmp_path: Path) -> None:
    text = b"int main(void) { return _Generic(1, int: 2, default: 3) + __real__(2.0) + __builtin_choose_expr(1, 2, 3); }\n"
    assert int(read(tmp_path, text).callsInText) == 0
