"""dacctr.h: mean voltages. Semantics of the library's source (libdacctr, Simple-Libraries 1cc167c10)."""

from __future__ import annotations

import pytest

from tests.adapters.bench import Uno, proves

ALL = [f"dacctr.h/dac_{name}" for name in ("setup", "set", "close", "start", "stop")]


@proves(*ALL)
def counters_of_this_and_of_another_cog_put_out_mean_voltages(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); dac own = dac_setup(6, 0, 8), fine = dac_setup(5, 1, 10); dacmem memory; dac_set(&own, 64);
  dac_set(&fine, 512); dac late = dac_setup(3, 1 + NEW_COG, 8); dac_set(&late, 192); delay(20); Serial.print(digitalRead(3));
  int32_t cog = dac_start(memory, 44100, 0, &late); delay(20); dac_set(&late, 32); dac_set(&own, 128); delay(20);
  Serial.print(cog > 0); dac_stop(cog); dac_set(&late, 128); dac_close(&own); delay(20); }
void loop() {}
"""
    trace = uno.run(program, [*ALL, "dacctr.h/NEW_COG"], 100)
    assert trace.text == "01"

    def duties(pin: str, from_ms: float, to_ms: float) -> float:
        return next(wave.duty for wave in reversed(trace.waves) if wave.pin == pin and from_ms * 1e3 <= wave.at_us < to_ms * 1e3)

    assert duties("D6", 0, 15) == pytest.approx(0.25, abs=0.01)
    assert duties("D5", 0, 15) == pytest.approx(0.5, abs=0.01)
    assert not [wave for wave in trace.waves if wave.pin == "D3" and wave.at_us < 15_000]
    assert duties("D3", 15, 35) == pytest.approx(0.75, abs=0.01)
    assert duties("D3", 35, 55) == pytest.approx(0.125, abs=0.01)
    assert duties("D6", 35, 55) == pytest.approx(0.5, abs=0.01)
    assert [trace.levels(pin)[-1][1] for pin in ("D3", "D6")] == ["z", "z"]
