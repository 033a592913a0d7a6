"""Which pins a migrated program moves on a simulator: those that its ports are bound to, and no other."""

from __future__ import annotations

from pathlib import Path

from tests.running import run
from tests.tools import require_engine, require_tools

PROGRAM = Path(__file__).parent / "ports_on_pins" / "lights.c"
MACROS = PROGRAM.with_name("macros.c")
IN_MACROS = [26, 4, 12, 14, 5, 6, 10, 8, 16, 11, 21, 25, 22, 23]
PORTS = [26, 27, 4, 5, 6, 10, 8, 16, 11, 12, 14, 20, 21, 22]
PINS = ["D2", "D3", "D4", "D5", "D6", "D7", "D8", "D9", "D10", "D11", "D12", "D13", "A0", "A1"]


def moved(tmp_path: Path, bound: dict[int, str], program: Path = PROGRAM, code: int = 0) -> list[str]:
    """The pins that go high in turn, each once, when these ports are bound."""
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    said = [text for port, pin in bound.items() for text in ("--bind", f"P{port}={pin}")]
    assert run("migrate", program, "-o", tmp_path / "out", *said, "--json").code == code
    outcome = run("simulate", tmp_path / "out", "--seconds", "1", "--json")
    assert outcome.code == 0, outcome.err
    high = [e["pin"] for e in outcome.result["events"] if e.get("level") == 1 and e["pin"] not in ("D0", "D1")]
    return list(dict.fromkeys(high))


def test_each_port_moves_its_own_pin(tmp_path: Path) -> None:
    bound = dict(zip(PORTS, PINS, strict=True))
    assert moved(tmp_path, bound) == PINS


def test_ports_that_are_not_wired_move_no_pin(tmp_path: Path) -> None:
    assert moved(tmp_path, {4: "D5", 16: "none", 22: "D9"}) == ["D5", "D9"]


def test_each_port_of_a_call_that_a_macro_makes_moves_its_own_pin(tmp_path: Path) -> None:
    bound = dict(zip(IN_MACROS, PINS, strict=True)) | {20: "none"}
    assert moved(tmp_path, bound, MACROS) == PINS


def test_ports_that_no_text_can_look_up_move_no_pin(tmp_path: Path) -> None:
    bound = {7: "A0", 8: "A1", 9: "A2", 3: "none", 4: "none"}
    assert moved(tmp_path, bound, MACROS.with_name("told_by_no_text.c"), code=1) == ["A0", "A1", "A2"]
