"""Adapters in C: each compiles alone without a warning, and the cases of the Arduino adapters hold for them, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from robosmi.transformations.knowledge.adapters.adapter_model import adapter_element
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.m2t.adapter_text import adapter_text
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.adapters.bench import BESIDE, CASES, NO_PIN, NOT_IN_C, NOTHING_TO_DO, broken, notices
from tests.adapters.bench_c import HEAD, MCUS, UnoInC, alone, pieces
from tests.adapters.cases import load_cases
from tests.tiers import sample
from tests.tools import require_engine, require_tools

load_cases()
KNOWN = {f"{piece.header}/{piece.name}": piece for piece in pieces()}
KEYS = [(piece.header, piece.name) for piece in pieces() if piece.kind != "helper"]
IN_C = sorted(
    name for name, (_, used) in CASES.items() if used and name not in NOT_IN_C and {*used, *BESIDE[name]} <= KNOWN.keys()
)


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-gcc")
    require_engine("simavr")


@pytest.mark.parametrize("name", sample(IN_C, 14))
def test_adapters_in_c_do_what_the_library_documents(name: str) -> None:
    CASES[name][0](UnoInC())


def test_every_adapter_in_c_is_proved() -> None:
    proved = {adapter for name in IN_C for adapter in CASES[name][1]}
    assert {key for key, piece in KNOWN.items() if piece.kind == "adapter"} - proved == NOTHING_TO_DO & KNOWN.keys()


@pytest.mark.parametrize("name", sample([name for name in IN_C if KNOWN[CASES[name][1][0]].kind == "adapter"][4::8], 4))
def test_some_cases_fail_when_an_adapter_in_c_is_broken(name: str) -> None:
    """A sample; `python -m tests.adapters.mutants` does it for all of them."""
    case, adapters = CASES[name]
    ways = broken(KNOWN[adapters[0]])
    assert [way for way, text in ways.items() if not notices(case, adapters[0], text, UnoInC)] == []


@pytest.mark.parametrize(("header", "name"), sample(KEYS[::6], 18))
def test_some_adapters_in_c_compile_alone(header: str, name: str, tmp_path: Path) -> None:
    """A sample; `make adapters` compiles each."""
    assert [said for mcu in MCUS if (said := alone((header, name), mcu, tmp_path))] == []


def test_a_32u4_plays_tones_with_a_timer_that_it_has(tmp_path: Path) -> None:
    needed = AdapterPieces(pieces(), architecture="avr").needed(
        [("simpletools.h", "freqout"), ("simpletools.h", "pause")], "atmega32u4"
    )
    assert not needed.unserved
    text = adapter_text([adapter_element(piece) for piece in needed.pieces], {}, NO_PIN)
    setup = "".join(f"{statement} " for piece in needed.pieces for statement in piece.setup)
    main = f"int main(void) {{ {setup} freqout(12, 20, 3000); pause(5); freqout(12, 100, 50); for (;;) {{}} }}"  # pin 12: PB4
    folder = tmp_path / "case"
    folder.mkdir()
    (folder / "case.c").write_text(f"{HEAD}{text}\n{main}\n")
    (folder / "Makefile").write_text("BOARD := leonardo\nMCU := atmega32u4\nF_CPU := 16000000\n")
    report = compile_sketch(folder, keep=tmp_path)
    assert report.ok
    assert report.elf is not None
    assert report.hex is not None
    trace = simulate(job(report.elf, report.hex, load_board("leonardo"), 140_000, []))
    begun = [at for at, _ in trace.pulses("D8")]
    high, low = [at for at in begun if at < 21_000], [at for at in begun if at > 24_000]
    assert (len(high) - 1) / (high[-1] - high[0]) * 1e6 == pytest.approx(3000, rel=0.01)
    assert (len(low) - 1) / (low[-1] - low[0]) * 1e6 == pytest.approx(50, rel=0.01)
    assert high[-1] == pytest.approx(20_000, abs=500)
