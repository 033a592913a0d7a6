"""Headers that need those which are included before them: nothing of them is lost, and those are told in their order."""

from __future__ import annotations

from pathlib import Path

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.t2m.c_source.parsing.included_before import included_before
from robosmi.transformations.t2m.c_source.reader import read_program

FOLDER = Path(__file__).parents[3] / "behaviour" / "programs" / "headers_behind_others"
FILES = [FOLDER / name for name in ("main.c", "queue.h", "route.h", "shown.h")]


def test_a_header_is_read_behind_those_that_are_included_before_it() -> None:
    program, findings = read_program(FILES)
    assert findings == []
    route = program.units[2]
    assert [call.callee.name for call in all_of_kind(route, ccode.Call) if call.callee is not None] == [
        "get",
        "get",
        "best",
        "steps",
    ]


def test_what_is_before_a_header_is_told_in_its_order() -> None:
    program, _ = read_program(FILES)
    assert included_before(str(FILES[3]), list(program.units)) == [str(FILES[1]), str(FILES[2])]
    assert included_before(str(FILES[0]), list(program.units)) == []
