"""The headers that each unit of a program includes, found for all units at once."""

from __future__ import annotations

from pathlib import Path

from robosmi.transformations.queries.own_headers import all_includes, includes_of_units
from robosmi.transformations.t2m.c_source import read_program


def test_all_at_once_gives_the_same_as_one_by_one(tmp_path: Path) -> None:
    texts = {
        "main.c": '#include <stdio.h>\n#include "a.h"\nint main() { return 0; }\n',
        "a.h": '#include "b.h"\n#include <math.h>\n',
        "b.h": '#include "a.h"\n#include <string.h>\n',
        "c.h": "#include <ctype.h>\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    program, _ = read_program([tmp_path / name for name in texts])
    found = includes_of_units(program)
    assert [found[id(unit)] for unit in program.units] == [all_includes(unit) for unit in program.units]
    assert found[id(program.units[2])] != found[id(program.units[3])]
