"""Headers that include themselves or one another: told where nothing ends it, and only there."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.t2m.c_source import read_program

MAIN = '#include "a.h"\nint main(void) { return 0; }\n'


@pytest.mark.parametrize(
    ("files", "told"),
    [
        ({"a.h": '#include "a.h"\nint a(void);\n'}, {"a.h": "the file includes itself"}),
        (
            {"a.h": '#include "b.h"\n', "b.h": '\n#include "a.h"\n'},
            {"a.h": "the include of b.h leads back to this file (a.h, b.h)",
             "b.h": "the include of a.h leads back to this file (a.h, b.h)"},
        ),
        ({"a.h": '#include "b.h"\n', "b.h": '#pragma once\n#include "a.h"\n'}, {}),
        ({"a.h": '#ifndef A\n#define A\n#include "b.h"\n#endif\n', "b.h": '#include "a.h"\n'}, {}),
        ({"a.h": '#include "b.h"\n', "b.h": '#ifdef NEVER\n#include "a.h"\n#endif\n'}, {}),
        ({"a.h": '#include "b.h"\n', "b.h": "int b(void);\n"}, {}),
        ({"a.h": "int a(void);\n", "main.c": '#include "main.c"\n' + MAIN}, {"main.c": "the file includes itself"}),
    ],
)  # fmt: skip
def test_circles_of_includes_are_told(files: dict[str, str], told: dict[str, str], tmp_path: Path) -> None:
    for name, text in ({"main.c": MAIN} | files).items():
        (tmp_path / name).write_text(text)
    _, findings = read_program([tmp_path / name for name in ("main.c", *(files.keys() - {"main.c"}))])
    found = {
        Path(f.location.path).name: f.message.partition(", without")[0] for f in findings if f.rule == "RS114" and f.location
    }
    assert found == told
    assert "RS103" not in {f.rule for f in findings}
