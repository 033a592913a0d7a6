"""Traces as value change dumps: what a viewer finds in them."""

from __future__ import annotations

import re
from io import BytesIO

from vcd.reader import RealChange, ScalarChange, TokenKind, VectorChange, tokenize

from robosmi.verify.simulation import ConsoleByte, PinChange, PinTrace, Wave
from robosmi.verify.traces.vcd import vcd_text

TRACE = PinTrace(
    "engine 1", "running", 2000.0,
    (PinChange(1.5, "D13", 1), PinChange(10.0, "D13", "z"), PinChange(10.0, "A 0", "p"), PinChange(1000.0, "D13", 0)),
    (Wave(20.0, "D9", 38000.0, 0.5), Wave(1020.0, "D9", 0.0, 0.0)),
    (ConsoleByte(5.0, 65),),
    (),
)  # fmt: skip


def test_pins_waves_and_the_console_of_both_sides_are_in_one_file() -> None:
    text = vcd_text({"source": TRACE, "target": TRACE}, "line 1\nline $end 2")
    assert text.startswith("$comment line 1 line end 2 $end\n$timescale 1ns $end\n")
    assert text.count("$scope module") == text.count("$upscope") == 2
    codes = re.findall(r"^\$var \w+ \d+ (\S+) (\S+) \$end$", text, re.MULTILINE)
    assert [name for _, name in codes[:5]] == ["D13", "A_0", "D9_hz", "D9_duty", "console"]
    assert len({code for code, _ in codes}) == 10
    first = {name: code for code, name in codes[:5]}
    times = [int(t) for t in re.findall(r"^#(\d+)$", text, re.MULTILINE)]
    assert times == sorted(times)
    assert times[-1] == 2_000_000
    assert f"#1500\n1{first['D13']}\n" in text
    assert f"r38000 {first['D9_hz']}\n" in text
    assert f"b1000001 {first['console']}\n" in text


def test_another_reader_finds_the_same_changes() -> None:
    """pyvcd, which follows IEEE 1364, judges."""
    names: dict[str, str] = {}
    seen: dict[str, list[tuple[int, object]]] = {}
    scope, now = "", 0
    for token in tokenize(BytesIO(vcd_text({"source": TRACE, "target": TRACE}, "both").encode())):
        if token.kind is TokenKind.SCOPE:
            scope = token.scope.ident
        elif token.kind is TokenKind.VAR:
            names[token.var.id_code] = f"{scope}.{token.var.reference}"
        elif token.kind is TokenKind.CHANGE_TIME:
            now = token.time_change
        elif token.kind in (TokenKind.CHANGE_SCALAR, TokenKind.CHANGE_VECTOR, TokenKind.CHANGE_REAL):
            change = token.data
            assert isinstance(change, (ScalarChange, VectorChange, RealChange))
            seen.setdefault(names[change.id_code], []).append((now, change.value))
    for side in ("source", "target"):
        assert seen[f"{side}.D13"] == [(0, "z"), (1500, "1"), (10_000, "z"), (1_000_000, "0")]
        assert seen[f"{side}.A_0"] == [(0, "z"), (10_000, "1")]
        assert seen[f"{side}.D9_hz"] == [(20_000, 38_000.0), (1_020_000, 0.0)]
        assert seen[f"{side}.console"] == [(5000, 65)]


def test_names_are_enough_for_many_pins() -> None:
    many = PinTrace("e", "running", 1.0, tuple(PinChange(0.0, f"P{n}", 1) for n in range(200)), (), (), ())
    codes = re.findall(r"^\$var wire 1 (\S+) ", vcd_text({"a": many}), re.MULTILINE)
    assert len(set(codes)) == 200
