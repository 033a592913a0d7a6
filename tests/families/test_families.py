"""Whole programs of each family of adapters do what the source's library documents, and those that are spoilt do not.

The first programs of some families run here, of each family in the tier `all`, and some of the faults; `python -m
tests.families` plays all of them.
"""

from __future__ import annotations

from itertools import groupby

import pytest

from tests.families.played import CASES, Case
from tests.tiers import sample
from tests.tools import require_engine, require_tools

FAMILIES = {family: list(cases) for family, cases in groupby(map(Case, CASES), key=lambda case: case.family)}


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")


def test_each_family_has_two_programs_and_each_program_is_spoilt_in_itself_and_in_an_adapter() -> None:
    assert {family: len(cases) for family, cases in FAMILIES.items() if len(cases) < 2} == {}
    for cases in FAMILIES.values():
        for case in cases:
            files = {spoilt.file for spoilt in case.wrong()}
            assert files == {"adapters.h", f"{case.folder.name}.c"}, case.folder.name


@pytest.mark.parametrize("family", sample(FAMILIES, 5))
def test_a_program_shows_what_the_library_documents(family: str) -> None:
    assert FAMILIES[family][0].faults() == []


@pytest.mark.parametrize("family", sample([*FAMILIES][::4], 2))
def test_a_spoilt_program_does_not(family: str) -> None:
    case = FAMILIES[family][-1]
    assert case.faults(case.wrong()[0]) != []
