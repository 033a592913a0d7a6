"""dac2ch.h: mean voltages. Semantics of the library's sources (libdac2ch, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from tests.adapters.bench import Uno, proves

ALL = [f"dac2ch.h/dac2ch_{name}" for name in ("start", "set", "stop")]


@proves(*ALL)
def two_channels_have_mean_voltages(uno: Uno) -> None:
    program = """
void setup() { dac2ch *eight = dac2ch_start(8), *ten = dac2ch_start(10); dac2ch_set(eight, 5, 0, 64); dac2ch_set(ten, 6, 1, 512);
  dac2ch_set(eight, 255, 1, 9); delay(10); dac2ch_set(eight, 5, 0, -1); dac2ch_set(ten, 3, 1, 768); delay(10); dac2ch_stop(ten); }
void loop() {}
"""
    trace = uno.run(program, [*ALL, "dac2ch.h/dac2ch"], 30)

    def duties(pin: str, from_us: float, to_us: float) -> float:
        return next(wave.duty for wave in reversed(trace.waves) if wave.pin == pin and from_us <= wave.at_us < to_us)

    assert duties("D5", 0, 9_000) == pytest.approx(0.25, abs=0.01)
    assert duties("D6", 0, 9_000) == pytest.approx(0.5, abs=0.01)
    assert duties("D3", 9_000, 19_000) == pytest.approx(0.75, abs=0.01)
    assert [trace.levels(pin)[-1][1] for pin in ("D3", "D5", "D6")] == ["z"] * 3
    assert trace.levels("D6")[-1][0] == pytest.approx(10_000, abs=1000)
    assert trace.levels("D3")[-1][0] == pytest.approx(20_000, abs=1000)
