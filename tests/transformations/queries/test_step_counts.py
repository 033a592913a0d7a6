"""How many steps a program tells apart: by moduli, comparisons, cases and arrays of what it moves on itself."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.queries.constants.step_counts import most_steps
from robosmi.transformations.t2m.c_source import read_program


@pytest.mark.parametrize(
    ("declared", "body", "steps"),
    [
        ("int mode;", "mode = (mode + 1) % 4;", 4),
        ("int mode;", "mode++; if (mode == 6) mode = 0;", 7),
        ("int mode;", "mode += 1; switch (mode) { case 0: break; case 8: break; }", 9),
        ("#define LAST 5\nint mode;", "if (mode >= LAST) mode = 0; else mode++;", 6),
        ("struct { int mode; } r;", "r.mode++; if (r.mode > 2) r.mode = 0;", 3),
        ("int at; int tones[7] = {1};", "at++; high(tones[at]);", 7),
        (
            "enum { RED, AMBER, GREEN }; int light;",
            "if (light == RED) light = AMBER; else if (light == AMBER) light = GREEN; else light = RED;",
            2,
        ),
        ("int state;", "if (state == 2) state = 0; else if (state == 0) state = 1; else state = 2;", 3),
        ("int tones[7] = {1};", "for (int i = 0; i < 7; i++) high(tones[i]);", 0),
        ("int side;", "side = -side; if (side == 0) side = 1;", 0),
        ("int far;", "far = input(3); if (far > 9) high(4);", 0),
        ("int turns;", "turns++; if (turns == 900) turns = 0;", 0),
    ],
)
def test_steps_that_a_program_tells_apart(declared: str, body: str, steps: int, tmp_path: Path) -> None:
    path = tmp_path / "p.c"
    path.write_text(f'#include "simpletools.h"\n{declared}\nint main() {{ while (1) {{ {body} }} }}\n')
    assert most_steps(read_program(path)[0]) == steps
