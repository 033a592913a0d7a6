"""In what type a target computes, and between which values: the lines of two programs are cases, the comments answers."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.queries.constants.ranges import Range, Ranges
from robosmi.transformations.queries.numbers import Machine, Number, Numbers
from robosmi.transformations.queries.values import Values
from robosmi.transformations.t2m.c_source import read_program

PROGRAMS = Path(__file__).parent / "programs"
SOURCE, TARGET = Machine(32, 32, 32, False), Machine(16, 32, 16, True)
CASE = re.compile(r"^ .*?(\S.*?);.*?//(.*)$|^static .*\{ (passed);.*//(.*)$")


def cases(name: str) -> list[tuple[int, str, str]]:
    """Line, text and answer of each case."""
    found = []
    for line, text in enumerate((PROGRAMS / name).read_text().splitlines(), 1):
        match = CASE.match(text)
        if match:
            found.append((line, (match[1] or match[3]).strip(), (match[2] or match[4]).strip()))
    return found


def program(name: str) -> ccode.Program:
    return read_program(PROGRAMS / name)[0]


def by_line(read: ccode.Program) -> dict[int, ccode.Expression]:
    """Line -> the first expression that is a statement of its own there."""
    found: dict[int, ccode.Expression] = {}
    for statement in all_of_kind(read, ccode.ExpressionStatement):
        if statement.expression is not None:
            found.setdefault(int(statement.line), statement.expression)
    return found


def numbers(read: ccode.Program, machine: Machine) -> Numbers:
    return Numbers(machine, {}, {}, {m.name: m.body or "" for u in read.units for m in u.macros})


def shown_number(number: Number | None) -> str:
    """A type as the comments write it."""
    if number is None:
        return "-"
    return "real" if number.real else f"{number.bits}{'' if number.signed else ' u'}"


def shown_range(found: Range | None) -> str:
    """A range as the comments write it."""
    return "-" if found is None else f"{found.low} {found.high}{'' if found.given else ' ?'}"


@pytest.fixture(scope="module")
def read() -> dict[str, ccode.Program]:
    return {name: program(name) for name in ("numbers.c", "ranges.c")}


@pytest.mark.parametrize(("line", "text", "answer"), cases("numbers.c"))
def test_the_type_on_the_target(read: dict[str, ccode.Program], line: int, text: str, answer: str) -> None:
    expression = by_line(read["numbers.c"])[line]
    assert shown_number(numbers(read["numbers.c"], TARGET).of(expression)) == answer, text


@pytest.mark.parametrize(("line", "text", "answer"), cases("ranges.c"))
def test_the_values_that_the_text_gives(read: dict[str, ccode.Program], line: int, text: str, answer: str) -> None:
    tree = read["ranges.c"]
    found = Ranges(numbers(tree, SOURCE), Values(tree, tree.units[0]), tree).of(by_line(tree)[line])
    assert shown_range(found) == answer, text


def test_what_another_file_may_write_has_no_range(tmp_path: Path) -> None:
    (tmp_path / "a.c").write_text("int seen;\nstatic int own;\nint main(void)\n{\n  seen;\n  own;\n}\n")
    (tmp_path / "b.c").write_text("extern int seen;\nvoid set(void) { seen = 7; }\n")
    answers = []
    for files in (["a.c"], ["a.c", "b.c"]):
        tree = read_program([tmp_path / f for f in files])[0]
        ranges = Ranges(numbers(tree, SOURCE), Values(tree, tree.units[0]), tree)
        answers.append([shown_range(ranges.of(by_line(tree)[line])) for line in (5, 6)])
    assert answers == [["0 0", "0 0"], ["-", "0 0"]]


def test_there_are_cases() -> None:
    assert len(cases("numbers.c")) > 40
    assert len(cases("ranges.c")) > 25
