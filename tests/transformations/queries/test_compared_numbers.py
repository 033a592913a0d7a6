"""The numbers with which a program compares numbers that it reads: constants, macros and cases, through functions and structs."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.t2m.c_source import read_program
from robosmi.transformations.verification.search.scenario_inputs import compared_numbers

READS = frozenset(["getDec", "scan"])


@pytest.mark.parametrize(
    ("declared", "body", "numbers"),
    [
        ("", "int n = getDec(); if (n > 20 && 1000 >= n) high(4);", [20, 1000]),
        ("", 'int n; scan("%d\\n", &n); if (n == -5) high(4);', [-5]),
        ("#define MOST 300", "int n; n = getDec() + 1; if (n > MOST) high(4);", [300]),
        ("", "switch (getDec()) { case 3: high(4); break; case 7: low(4); break; }", [3, 7]),
        ("int ok(int v) { return v < 90; }", "if (ok(getDec())) high(4);", [90]),
        ("int ask(void) { return getDec(); }", "if (ask() != 11) high(4);", [11]),
        ('void ask(int *to) { scan("%d\\n", to); }', "int v; ask(&v); if (v >= 60) high(4);", [60]),
        ("struct { int low; } r;", "r.low = getDec(); if (r.low < 15) high(4);", [15]),
        ("int v[3];", "v[1] = getDec(); if (v[1] < 15) high(4);", [15]),
        ("", "int n = getDec(); int far = input(3); if (far > 9) high(n);", []),
        ("", "int c = getChar(); if (c == 'a' || c == 13) high(4);", []),
        ("", "int n = getDec(); if (n == 'a') high(4);", []),
    ],
)
def test_numbers_that_typed_ones_are_compared_with(declared: str, body: str, numbers: list[int], tmp_path: Path) -> None:
    path = tmp_path / "p.c"
    path.write_text(f'#include "simpletools.h"\n{declared}\nint main() {{ while (1) {{ {body} }} }}\n')
    assert compared_numbers(read_program(path)[0], READS) == numbers
