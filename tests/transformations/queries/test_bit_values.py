"""What an expression makes of the bits of a register, each of the lower four as one letter, the highest first.

`0` and `1`: set so; `s`: as it was; `n`: turned over; `=`, `|`, `&`, `^`: the bit of a value of the running program, alone or
with what was there.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries import code
from robosmi.transformations.queries.ports.bit_values import AND, EQUAL, NOT, ONE, OR, SAME, XOR, ZERO, assigned_bits
from robosmi.transformations.t2m.c_source import read_program

LETTERS = {ZERO: "0", ONE: "1", SAME: "s", NOT: "n", EQUAL: "=", OR: "|", AND: "&", XOR: "^"}


@pytest.mark.parametrize(
    ("assignment", "expected"),
    [
        ("REG = 5", "0101"),
        ("REG = ~5", "1010"),
        ("REG = REG", "ssss"),
        ("REG = ~REG", "nnnn"),
        ("REG = ~~REG", "ssss"),
        ("REG = ~(REG & 3)", "11nn"),
        ("REG = ~(REG | 3)", "nn00"),
        ("REG = REG | 5", "s1s1"),
        ("REG = REG & 5", "0s0s"),
        ("REG = REG & ~5", "s0s0"),
        ("REG = REG ^ 5", "snsn"),
        ("REG = (REG & 12) | 2", "ss10"),
        ("REG = (unsigned char)(REG & 12)", "ss00"),
        ("REG |= 5", "s1s1"),
        ("REG &= ~5", "s0s0"),
        ("REG ^= 5", "snsn"),
        ("REG = step", "===="),
        ("REG = -step", "===="),
        ("REG |= step", "||||"),
        ("REG &= step", "&&&&"),
        ("REG ^= step", "^^^^"),
        ("REG = (REG & 12) | (step & 3)", "ss=="),
        ("REG = REG | (step & 3)", "ss||"),
        ("REG = REG + 1", None),
        ("REG = -REG", None),
        ("REG = !REG", None),
        ("REG += 1", None),
        ("REG <<= 1", None),
    ],
)
def test_each_bit_becomes_what_the_operators_make_of_it(assignment: str, expected: str | None, tmp_path: Path) -> None:
    path = tmp_path / "bits.c"
    path.write_text(
        f"extern volatile unsigned char REG;\nvoid set(int step) {{ {assignment}; }}\nint main(void) {{ set(getChar()); }}\n"
    )
    program, _ = read_program(path)
    (view,) = code.views(program, ApiIndex.load("propeller"))
    (found,) = all_of_kind(program, ccode.Assignment)
    bits = assigned_bits(found, lambda name: name.name == "REG", view.values)
    assert (bits and "".join(LETTERS[bit.what] for bit in reversed(bits[:4]))) == expected
