"""adcDCpropab.h and abvolts.h. Semantics of the libraries' sources (libadcDCpropab, libabvolts; Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from dataclasses import replace

import pytest

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

VOLTAGES = [
    DeviceUse("voltages", {"pin": "A2"}, {"points": [[0, 1250]]}),
    DeviceUse("voltages", {"pin": "A3"}, {"points": [[0, 4000]]}),
]


def read(uno: Uno, header: str, prefix: str) -> None:
    """Read two voltages with the functions of a header."""
    names = [f"{header}.h/{prefix}_{name}" for name in ("init", "in", "volts")]
    program = f"""
void setup() {{ Serial.begin(115200); high(A2); high(A3); delay(2); {prefix}_init(21, 20, 19, 18);
  Serial.print({prefix}_in(0)); Serial.print(' '); Serial.print({prefix}_in(1)); Serial.print(' ');
  Serial.print({prefix}_volts(1), 3); Serial.print(' '); Serial.print({prefix}_in(2)); }}
void loop() {{}}
"""
    ports = {f"{header}.channel_0": "A2", f"{header}.channel_1": "A3"}
    trace = replace(uno, ports=ports).run(program, [*names, "simpletools.h/high"], 40, VOLTAGES)
    first, second, volts, none = map(float, trace.text.split())
    assert [first, second, none] == pytest.approx([1024, 3277, 0], abs=9)
    assert volts == pytest.approx(4.0, abs=0.011)
    assert trace.levels("A2")[-1][1] == "z"


@proves(*[f"adcDCpropab.h/adc_{name}" for name in ("init", "in", "volts")])
def four_channels_are_converted(uno: Uno) -> None:
    read(uno, "adcDCpropab", "adc")


@proves(*[f"abvolts.h/ad_{name}" for name in ("init", "in", "volts")])
def four_channels_of_the_activity_board_are_converted(uno: Uno) -> None:
    read(uno, "abvolts", "ad")


@proves(*[f"abvolts.h/da_{name}" for name in ("init", "res", "out", "volts")])
def mean_voltages_are_put_out(uno: Uno) -> None:
    used = [f"abvolts.h/da_{name}" for name in ("init", "res", "out", "volts")]
    program = """
void setup() { da_out(0, 64); da_volts(1, 1.25); delay(20); da_init(5, 3); da_res(10); da_out(0, 512);
  da_volts(1, 2.5); delay(20);
  da_volts(1, 5.0); delay(20); }
void loop() {}
"""
    trace = replace(uno, ports={"abvolts.output_0": "6", "abvolts.output_1": "5"}).run(program, used, 70)

    def duties(pin: str, from_us: float, to_us: float) -> float:
        return next(wave.duty for wave in reversed(trace.waves) if wave.pin == pin and from_us <= wave.at_us < to_us)

    assert duties("D6", 0, 20_000) == pytest.approx(0.25, abs=0.01)
    assert duties("D5", 0, 20_000) == pytest.approx(0.25, abs=0.01)
    assert duties("D5", 20_000, 40_000) == pytest.approx(0.5, abs=0.01)
    assert duties("D3", 20_000, 40_000) == pytest.approx(0.5, abs=0.01)
    assert duties("D3", 40_000, 70_000) == pytest.approx(0.66, abs=0.01)
