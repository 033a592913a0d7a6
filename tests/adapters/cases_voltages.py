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


SCALED = [f"abvolts.h/da_{name}" for name in ("setupScale", "useScale", "volts", "stop")]


@proves(*[f"abvolts.h/da_{name}" for name in ("setupScale", "stop")])
def outputs_are_measured_and_corrected(uno: Uno) -> None:
    program = """
void setup() { Serial.begin(115200); da_setupScale(); da_volts(0, 2.0); da_volts(1, 2.0); delay(20); da_stop(); delay(20);
  Serial.print(ee_getByte(63400)); }
void loop() {}
"""
    ports = {"abvolts.channel_0": "A2", "abvolts.channel_1": "A3", "abvolts.output_0": "6", "abvolts.output_1": "5"}
    read_back = [DeviceUse("voltages", {"pin": f"A{pin}"}, {"points": [[0, mv]]}) for pin, mv in ((2, 4800), (3, 4900))]
    used = [*SCALED, "simpletools.h/ee_getByte"]
    trace = replace(uno, ports=ports).run(program, used, 200, read_back)
    first, second = (float(line.partition("= ")[2]) for line in trace.text.splitlines()[:2])
    assert [first, second] == pytest.approx([5 / 4.8, 5 / 4.9], abs=0.003)
    assert trace.text.split()[-1] == str(ord("a"))
    duties = {pin: next(wave.duty for wave in trace.waves if wave.pin == pin and wave.duty) for pin in ("D5", "D6")}
    assert [duties["D6"], duties["D5"]] == pytest.approx([2 / 4.8, 2 / 4.9], abs=0.008)
    assert [trace.levels(pin)[-1][1] for pin in ("D5", "D6")] == ["z", "z"]
    wrong = replace(uno, ports=ports).run(program, used, 200, [DeviceUse("voltages", {"pin": "A2"}, {"points": [[0, 3000]]})])
    assert wrong.text.startswith("Error")


@proves("abvolts.h/da_useScale")
def a_correction_that_was_kept_is_used(uno: Uno) -> None:
    program = """
void setup() { da_useScale(); da_volts(0, 1.0); delay(10); ee_putStr("abvolts", 8, 63400); ee_putFloat32(1.5, 63408);
  ee_putFloat32(0.5, 63412); da_useScale(); da_volts(0, 1.0); da_volts(1, 1.0); delay(20); }
void loop() {}
"""
    used = [*SCALED, "simpletools.h/ee_putStr", "simpletools.h/ee_putFloat32"]
    trace = replace(uno, ports={"abvolts.output_0": "6", "abvolts.output_1": "5"}).run(program, used, 120)
    duties = {pin: [wave.duty for wave in trace.waves if wave.pin == pin] for pin in ("D5", "D6")}
    assert [*duties["D6"], *duties["D5"]] == pytest.approx([0.2, 0.3, 0.1], abs=0.01)
