"""How a reference uses its variable, by the expression around it."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.queries.constants.compiled_code import way
from robosmi.transformations.t2m.c_source import read_program

BEGIN = "struct pair { int first; int rows[3]; };\nint v, i, list[4];\nstruct pair s;\nvoid take(int *);\n"


@pytest.mark.parametrize(
    ("statement", "name", "expected"),
    [
        ("i = v;", "v", "read"),
        ("v = 1;", "v", "written"),
        ("v += 1;", "v", "written"),
        ("i = v = 1;", "v", "both"),
        ("v++;", "v", "written"),
        ("--v;", "v", "written"),
        ("i = v++;", "v", "both"),
        ("if (--v) i = 1;", "v", "both"),
        ("for (v = 0; i; v++) i = 1;", "v", "written"),
        ("i = -v;", "v", "read"),
        ("take(&v);", "v", "address"),
        ("i = sizeof(v);", "v", "size"),
        ("take(list);", "list", "address"),
        ("i = list[2];", "list", "read"),
        ("i = list[i];", "list", "any"),
        ("list[i] = 2;", "list", "written"),
        ("i = 3; list[1]++;", "list", "written"),
        ("i = s.first;", "s", "read"),
        ("s.first = 2;", "s", "written"),
        ("i = s.rows[i + 1];", "s", "any"),
        ("take(&s.first);", "s", "address"),
    ],
)
def test_the_way_of_a_use(statement: str, name: str, expected: str, tmp_path: Path) -> None:
    path = tmp_path / "uses.c"
    path.write_text(f"{BEGIN}int main(void) {{ {statement} }}\n")
    program, _ = read_program(path)
    uses = [each for each in all_of_kind(program, ccode.NameReference) if each.name == name]
    assert {way(each) for each in uses} == {expected}
