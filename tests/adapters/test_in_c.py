"""Adapters in C: each compiles alone without a warning, and the cases of the Arduino adapters hold for them, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.adapters.bench import BESIDE, CASES, NOTHING_TO_DO, broken, notices
from tests.adapters.bench_c import MCUS, UnoInC, alone, pieces
from tests.adapters.cases import load_cases
from tests.tools import require_engine, require_tools

load_cases()
KNOWN = {f"{piece.header}/{piece.name}": piece for piece in pieces()}
KEYS = [(piece.header, piece.name) for piece in pieces() if piece.kind != "helper"]
IN_C = sorted(name for name, (_, adapters) in CASES.items() if adapters and {*adapters, *BESIDE[name]} <= KNOWN.keys())


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-gcc")
    require_engine("simavr")


@pytest.mark.parametrize("name", IN_C)
def test_adapters_in_c_do_what_the_library_documents(name: str) -> None:
    CASES[name][0](UnoInC())


def test_every_adapter_in_c_is_proved() -> None:
    proved = {adapter for name in IN_C for adapter in CASES[name][1]}
    assert {key for key, piece in KNOWN.items() if piece.kind == "adapter"} - proved == NOTHING_TO_DO


@pytest.mark.parametrize("name", IN_C[::8])
def test_some_cases_fail_when_an_adapter_in_c_is_broken(name: str) -> None:
    """A sample; `python -m tests.adapters.mutants` does it for all of them."""
    case, adapters = CASES[name]
    ways = broken(KNOWN[adapters[0]])
    assert [way for way, text in ways.items() if not notices(case, adapters[0], text, UnoInC)] == []


@pytest.mark.parametrize("key", KEYS[::6], ids="/".join)
def test_some_adapters_in_c_compile_alone(key: tuple[str, str], tmp_path: Path) -> None:
    """A sample; `make adapters` compiles each."""
    assert [said for mcu in MCUS if (said := alone(key, mcu, tmp_path))] == []
