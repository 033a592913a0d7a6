"""Arrays that a program may write after their definition: the answer does not depend on what was asked before."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path

import pytest

import robosmi
from robosmi.metamodels import ccode
from robosmi.transformations.queries.written_arrays import WrittenArrays

PROGRAM = Path(__file__).parent / "programs" / "passed_round.c"
WRITTEN = {"first": True, "second": True, "third": False}


@pytest.mark.parametrize("order", list(permutations(WRITTEN)), ids="-".join)
def test_functions_that_call_one_another_hand_an_array_on(order: tuple[str, ...]) -> None:
    declarations = [d for unit in robosmi.load_code(PROGRAM).units for d in unit.declarations]
    arrays = {str(each.name): each for each in declarations if isinstance(each, ccode.Variable)}
    written = WrittenArrays()
    assert {name: written.is_written(arrays[name]) for name in order} == WRITTEN
