"""The C reader on what is no C, damaged, deep, or cannot be read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robosmi.errors import SourceError, UsageError
from robosmi.metamodels import ccode
from robosmi.query import all_contents, all_of_kind
from robosmi.transformations.t2m.c_source import read_program

HERE = Path(__file__).parent


@pytest.mark.parametrize("path", sorted((HERE / "bad").iterdir()), ids=lambda p: p.stem)
def test_what_is_no_c_is_refused(path: Path) -> None:
    with pytest.raises(SourceError) as caught:
        read_program(path)
    assert caught.value.location is not None
    assert caught.value.location.path == str(path)
    assert caught.value.fix


def test_missing_folder_and_forbidden(tmp_path: Path) -> None:
    for path, cause in ((tmp_path / "no.c", "no such file"), (tmp_path, "folder")):
        with pytest.raises(SourceError, match=cause):
            read_program(path)
    secret = tmp_path / "secret.c"
    secret.write_text("int main() { }")
    secret.chmod(0)
    if not os.access(secret, os.R_OK):  # root may read everything
        with pytest.raises(SourceError, match="may not be read"):
            read_program(secret)
    with pytest.raises(UsageError):
        read_program([])


def test_a_missing_semicolon_is_a_finding_and_the_rest_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "damaged.c"
    path.write_text('#include "simpletools.h"\nint main()\n{\n  int x = 3\n  high(x);\n  pause(1);\n  low(4);\n}\n')
    program, findings = read_program(path)
    errors = [f for f in findings if f.rule == "RS101"]
    assert [(f.location.line if f.location else 0, f.severity.name) for f in errors] == [(4, "error")]
    assert [str(c.calleeName) for c in all_of_kind(program, ccode.Call)] == ["high", "pause", "low"]
    assert [f.rule for f in findings] == ["RS101"]
    assert program.units[0].callsInText == 3


def test_what_the_parser_says_twice_of_one_place_is_one_finding(tmp_path: Path) -> None:
    path = tmp_path / "open.c"
    path.write_text("int x = 1;\nint main() { if (x) { x = 2; \n")  # two braces are missing at the end
    program, findings = read_program(path)
    assert [f.rule for f in findings] == ["RS101"]
    assert len(program.units[0].problems) == 1


def test_a_call_that_is_lost_is_listed(tmp_path: Path) -> None:
    path = tmp_path / "lost.c"
    path.write_text("int main()\n{\n  high(3 @ 4);\n  low(5);\n}\n")
    program, findings = read_program(path)
    unit = program.units[0]
    assert [(str(u.name), u.line) for u in unit.unresolved] == [("high", 3)]
    assert (unit.callsInText, unit.callsInModel) == (2, 1)
    assert [f.rule for f in findings] == ["RS102", "RS101"]
    assert [bool(p.fatal) for p in unit.problems] == [True]


@pytest.mark.parametrize(
    "text",
    [
        "int x = " + "(" * 200 + "1" + ")" * 200 + ";\n",
        "int f() { return " + "1 + " * 900 + "1; }\n",
        "void f() { " + "{" * 200 + "go();" + "}" * 200 + " }\n",
        "int f(int a) { return " + "-".join(["a"] * 3000) + "; }\n",
        "int f(int a) {" + "if (a) g(a); else " * 400 + "h(); }\n",
        "int f(int a) { return " + "g(" * 180 + "a" + ")" * 180 + "; }\n",
    ],
    ids=["parentheses", "sum", "blocks", "differences", "else-if", "calls"],
)
def test_depth_is_bounded(tmp_path: Path, text: str) -> None:
    path = tmp_path / "deep.c"
    path.write_text(text)
    program, findings = read_program(path)
    unit = program.units[0]
    assert unit.callsInText == unit.callsInModel + len(unit.unresolved)
    assert unit.declarations
    if any(isinstance(e, (ccode.UnknownExpression, ccode.UnknownStatement)) for e in all_contents(program)):
        assert "RS104" in {f.rule for f in findings}


def test_conditional_text_and_unknown_headers_are_reported(tmp_path: Path) -> None:
    path = tmp_path / "conditional.c"
    path.write_text('#include "mine.h"\n#if 0\nvoid old(void) { gone(); }\n#else\nvoid now(void) { here(); }\n#endif\n')
    program, findings = read_program(path)
    assert [f.rule for f in findings] == ["RS103", "RS106"]
    assert [str(c.calleeName) for c in all_of_kind(program, ccode.Call)] == ["here"]
    assert [(str(c.directive), bool(c.active)) for c in program.units[0].conditionals] == [
        ("if", False),
        ("else", True),
        ("endif", True),
    ]
