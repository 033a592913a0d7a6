"""Every case of every adapter, with the adapters as they are, on the simulator."""

from __future__ import annotations

import pytest

from tests.adapters.bench import CASES, NOTHING_TO_DO, Uno, broken, notices, pieces
from tests.adapters.cases import load_cases
from tests.tiers import one_of_each, sample
from tests.tools import require_engine, require_tools

load_cases()


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")


def headers(name: str) -> frozenset[str]:
    """The headers whose adapters a case proves."""
    return frozenset(adapter.partition("/")[0] for adapter in CASES[name][1])


@pytest.mark.parametrize("name", one_of_each(sorted(CASES), headers))
def test_adapters_do_what_the_library_documents(name: str) -> None:
    CASES[name][0](Uno())


def test_cases_prove_what_is_there() -> None:
    known = {f"{piece.header}/{piece.name}" for piece in pieces() if piece.kind != "helper"}
    wrong = [(name, adapter) for name, (_, adapters) in CASES.items() for adapter in adapters if adapter not in known]
    assert wrong == []


def test_every_adapter_is_proved() -> None:
    proved = {adapter for _, adapters in CASES.values() for adapter in adapters}
    bodies = {f"{piece.header}/{piece.name}" for piece in pieces() if piece.kind == "adapter"}
    assert bodies - proved == NOTHING_TO_DO


def test_every_adapter_can_be_broken() -> None:
    """Also one whose parameters are functions."""
    assert [piece.name for piece in pieces() if piece.kind == "adapter" and not broken(piece)] == []


@pytest.mark.parametrize("name", sample(sorted(CASES)[5::10], 3))
def test_some_cases_fail_when_an_adapter_is_broken(name: str) -> None:
    """A sample; `python -m tests.adapters.mutants` does it for all of them."""
    case, adapters = CASES[name]
    known = {f"{piece.header}/{piece.name}": piece for piece in pieces() if piece.kind == "adapter"}
    adapter = next((each for each in adapters if each in known), "")
    if not adapter:
        pytest.skip("the case is about registers and objects, which are no functions that could be emptied")
    ways = broken(known[adapter])
    assert ways
    assert [way for way, text in ways.items() if not notices(case, adapter, text)] == []
