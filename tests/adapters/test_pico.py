"""The adapters on the second architecture: all of a header compile for the Raspberry Pi Pico with the stand-in of its core."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.transformations.knowledge.adapters.adapter_files import HAL
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from tests.adapters.bench import pieces
from tests.adapters.pico import said
from tests.adapters.test_files import HEADERS, KEYS
from tests.tools import require_tools

OF_HEADERS = [header for header in HEADERS if header != HAL]


@pytest.mark.parametrize("header", OF_HEADERS)
def test_all_of_a_header_compile_for_the_pico(header: str, tmp_path: Path) -> None:
    require_tools("arm-none-eabi-g++")
    assert said([key for key in KEYS if key[0] == header], tmp_path) == ""


def test_a_piece_that_does_not_compile_is_noticed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_tools("arm-none-eabi-g++")
    broken = [replace(piece, text=f"{piece.text}\nSREG;") if piece.name == "high" else piece for piece in pieces()]
    monkeypatch.setattr("tests.adapters.pico.pieces", lambda: tuple(broken))
    assert "SREG" in said([("simpletools.h", "high")], tmp_path)


@pytest.mark.parametrize("architecture", ["avr", "rp2040"])
def test_the_layer_serves_every_name(architecture: str) -> None:
    known = AdapterPieces(pieces(), architecture=architecture)
    assert known.needed(KEYS, "any").unserved == {}


def test_both_architectures_have_the_same_layer() -> None:
    """Pieces that only pieces of their own architecture need are not part of the contract."""
    outside = {need for piece in pieces() if piece.header != HAL for need in piece.needs if need.startswith(f"{HAL}/")}
    of = {
        name: {f"{HAL}/{piece.name}" for piece in pieces() if piece.header == HAL and name in piece.architectures}
        for name in ("avr", "rp2040")
    }
    assert outside - of["avr"] == outside - of["rp2040"] == set()


def test_limits_of_an_avr_board_are_not_those_of_a_pico() -> None:
    known = AdapterPieces(pieces(), architecture="rp2040")
    words = ("Uno", "Timer1", "1,024 bytes", "10 bits;", "12 servos")
    limits = {key: [*piece.limits, piece.fidelity] for key in KEYS if (piece := known.variant(key, "rp2040"))}
    assert {key: text for key, texts in limits.items() for text in texts if any(word in text for word in words)} == {}
