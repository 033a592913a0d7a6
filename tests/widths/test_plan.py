"""The changes of a program's text that keep its widths: in the plan with their reasons, small, and taken back when asked."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.queries.width_types import retyped
from tests.running import tree

FOLDER = Path(__file__).parent
PASSED = FOLDER / "passed.c"
DEDUCED = FOLDER / "deduced.cpp"


@cache
def changed(program: Path) -> str:
    """A program's text with the changes of its widenings alone, the last first."""
    plan = plan_migration([program]).plan
    data = program.read_bytes()
    changes = [c for w in plan.widenings for c in w.changes]
    assert all(c.rule and c.reason for c in changes)
    opening = sorted((c for c in changes if c.replacement != ")"), key=lambda c: c.startOffset)
    for change in reversed(opening):
        data = data[: change.startOffset] + change.replacement.encode() + data[change.endOffset :]
    return data.decode()


@pytest.mark.parametrize("name", ["passed.c", "cases.c"])
def test_every_change_has_its_declaration_and_comments_and_layout_stay(name: str) -> None:
    plan = plan_migration([FOLDER / name]).plan
    assert plan.widths is migration.Widths.fix
    assert all(w.element is not None and w.evidence and w.choice == "fix" for w in plan.widenings)
    assert all(
        widening.element is not None
        and widening.element.startOffset <= change.startOffset <= change.endOffset <= widening.element.endOffset
        for widening in plan.widenings
        for change in widening.changes
    )
    assert plan.program is not None
    text = (FOLDER / name).read_text()
    comments = [text.encode()[c.startOffset : c.endOffset].decode() for u in plan.program.units for c in u.comments]
    assert comments
    assert all(comment in changed(FOLDER / name) for comment in comments)
    assert changed(FOLDER / name).count("\n") == text.count("\n")


def test_what_is_passed_has_the_width_that_it_is_said_to_have() -> None:
    text = changed(PASSED)
    for line in (
        "int32_t list[3] = { 70000, -5L, 70001 };  // compared as 32 bits",
        'note("%d %x" " %c%%", x, (int32_t)s, (int32_t)(uint8_t)c);',  # the adapter of vsprintf reads 32 bits each
        "int32_t x = 70000, *p = &x;",
        "sum: x += list[1] * s;",
        "int main(void);",
    ):
        assert line in text
    assert "qsort(list, 3, sizeof(int32_t), [](const void *a, const void *b) -> int {" in text


def test_a_second_run_changes_no_byte(tmp_path: Path) -> None:
    robosmi.migrate([PASSED], tmp_path / "out")
    first = tree(tmp_path / "out")
    robosmi.migrate([PASSED], tmp_path / "out")
    assert tree(tmp_path / "out") == first


def test_a_person_keeps_a_declaration_as_it_is_in_the_plan(tmp_path: Path) -> None:
    robosmi.migrate([PASSED], tmp_path / "out")
    plan = tmp_path / "out" / "models" / "plan.xmi"
    text = plan.read_text()
    start = text.index("<widenings")
    plan.write_text(text[:start] + text[start:].replace('choice="fix"', 'choice="keep"', 1))
    robosmi.generate_sketch(plan, tmp_path / "again")
    sketch = next((tmp_path / "again").rglob("*.ino")).read_text()
    assert "\nint list[3] = {" in sketch
    assert "int32_t compare(" in sketch


def test_the_text_stays_when_it_is_to_be_kept_and_every_line_is_named(tmp_path: Path) -> None:
    program = tmp_path / "kept.c"
    program.write_text(
        "int list[2], sum, i;\nunsigned r;\nint main(void) {\n  for (i = 0; i < 2; i++)\n    sum += list[i];\n"
        "  r |= 0xFFFFFF00;\n  return sum;\n}\n"
    )
    made = robosmi.migrate([program], tmp_path / "out", widths="keep")
    assert len(made.models.plan.widenings) == 0
    assert "sum += list[i];" in next(made.sketch.glob("*.ino")).read_text()
    found = {f.rule: f for f in made.findings}
    assert "line 1" in found["RS310"].message or "lines 1, 2" in found["RS310"].message
    assert "line 5" in found["RS314"].message
    assert found["RS311"].location is not None
    assert found["RS311"].location.line == 6
    fixed = robosmi.migrate([program], tmp_path / "fixed")
    assert {"RS310", "RS311", "RS314"}.isdisjoint(f.rule for f in fixed.findings)


def test_a_macro_that_is_used_for_other_things_is_said_where_no_change_fits(tmp_path: Path) -> None:
    program = tmp_path / "mixed.c"
    program.write_text(
        "#define RAISE(x) ((x)++ * (x))\nshort s;\nfloat f;\nint main(void) { int a = RAISE(s); f = RAISE(f); return a; }\n"
    )
    made = robosmi.migrate([program], tmp_path / "out")
    lost = [f for f in made.findings if f.rule == "RS319"]
    assert [f.location.line for f in lost if f.location is not None] == [1]


@pytest.mark.parametrize(("deep", "told"), [(300, []), (450, [453])])
def test_macros_that_are_too_deep_to_be_read_are_said(deep: int, told: list[int], tmp_path: Path) -> None:
    program = tmp_path / "deep.c"
    macros = "".join(f"#define M{number} M{number - 1} + 10\n" for number in range(1, deep + 1))
    program.write_text(f"#define M0 30000\n{macros}int a;\nint main(void) {{ a = M{deep} * 3; return 0; }}\n")
    findings = robosmi.plan_migration([program]).plan.findings
    assert [int(f.line) for f in findings if f.rule == "RS319"] == told


def test_a_macro_that_writes_its_changed_argument_is_said(tmp_path: Path) -> None:
    program = tmp_path / "shown.c"
    program.write_text(
        '#include <stdio.h>\n#define SHOW(x) printf(#x " = %d\\n", (int)(x))\n#define NAMED(name, value) printf(#name, value)\n'
        "int a = 3;\nint main(void) {\n  SHOW(a);\n  SHOW((int)a * 2);\n  NAMED(a, (int)1);\n  return 0;\n}\n"
    )
    plan = robosmi.plan_migration([program]).plan
    assert [int(f.line) for f in plan.findings if f.rule == "RS329"] == [7]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("unsigned", "uint32_t"), ("const unsigned int *", "const uint32_t *"), ("int const", "int32_t const"),
        ("unsigned static x", "uint32_t static x"), ("unsigned const int x", "uint32_t const  x"), ("long int", "long int"),
        ("short unsigned", "short unsigned"), ("unsigned char", "unsigned char"), ("unsigned long long", "unsigned long long"),
        ("int (*)(int, char)", "int32_t (*)(int32_t, char)"), ('print("int") /* int */', 'print("int") /* int */'),
        ("#define WORD unsigned int /* int */", "#define WORD uint32_t /* int */"), ("#include <int.h>", "#include <int.h>"),
        ("printer point", "printer point"), ("double", "double"),
    ],
)  # fmt: skip
def test_types_are_written_with_their_width(before: str, after: str) -> None:
    assert retyped(before) == after


def test_what_gives_its_type_has_the_bits_of_the_source() -> None:
    before, after = DEDUCED.read_text(), changed(DEDUCED)
    marked = [pair for pair in zip(before.splitlines(), after.splitlines(), strict=True) if "  // " in pair[0]]
    assert len(marked) >= 12
    for old, new in marked:
        code, _, wanted = new.partition("  // ")
        assert wanted.removeprefix("becomes: ") in code if wanted != "stays" else new == old


def test_a_pin_whose_type_counts_is_cast(tmp_path: Path) -> None:
    program = tmp_path / "lamp.cpp"
    program.write_text(
        '#include "simpletools.h"\ntemplate <class T> void put(T p, T v) { set_output(p, v); set_direction(p, 1); }\n'
        "int main() { put(8, 1); auto pin = 9U; high(pin); }\n"
    )
    made = robosmi.migrate([program], tmp_path / "out", bind={"P8": "D12", "P9": "D5"}).sketch
    text = (made / "lamp.ino").read_text()
    assert "put((int32_t)12, 1L);" in text
    assert "auto pin = (uint32_t)5;" in text
