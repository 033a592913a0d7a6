"""The adapters on the second architecture, the Raspberry Pi Pico with the stand-in of its core: all of a header compile.

Also: those of the hardware layer on the Arduino API, which the Pico's core has, too.
"""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.transformations.knowledge.adapters.adapter_files import HAL
from robosmi.transformations.queries.plans.adapter_needs import AdapterPieces
from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import ADAPTERS, pieces
from tests.adapters.pico import run, said
from tests.adapters.test_files import HEADERS, KEYS
from tests.tiers import sample
from tests.tools import require_engine, require_tools

REASON = "//# unsupported "
OF_HEADERS = [header for header in HEADERS if header != HAL]


@pytest.mark.parametrize("header", sample(OF_HEADERS, 14))
def test_all_of_a_header_compile_for_the_pico(header: str, tmp_path: Path) -> None:
    require_tools("arm-none-eabi-g++")
    assert said([key for key in KEYS if key[0] == header], tmp_path) == ""


@pytest.mark.parametrize("header", sample(OF_HEADERS, 14))
def test_all_of_a_header_compile_on_the_arduino_api(header: str, tmp_path: Path) -> None:
    require_tools("arm-none-eabi-g++")
    lacking = AdapterPieces(pieces(), architecture="other").needed(KEYS, "other").unserved
    assert said([key for key in KEYS if key[0] == header and key not in lacking], tmp_path, "other") == ""


def test_what_the_arduino_api_cannot_serve_are_cogs_and_lights() -> None:
    lacking = AdapterPieces(pieces(), architecture="other").needed(KEYS, "other").unserved
    assert set(lacking.values()) == {"the other has no 'cog_frame'", "the other has no 'LightLine'"}
    assert len(lacking) < len(KEYS) / 10


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


def test_timed_outputs_behave_at_the_pins_of_a_simulated_pico(tmp_path: Path) -> None:
    """What the layer makes by other means than on an AVR: exact pulses, tones, slow waves, two channels, servos, memory, USB."""
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    program = """
void setup() { Serial.begin(115200); while (!Serial) {}
  pulse_out(3, 150); freqout(4, 50, 1000); square_wave(5, 0, 10); pwm_start(5000); pwm_set(6, 0, 1500); pwm_set(7, 1, 700);
  servo_angle(16, 900); ee_putInt(123456, 32000); Serial.println(ee_getInt(32000)); pause(300); pwm_stop();
  high(8); print("%d", 123456789); low(8); simpleterm_reopen(254, 254, 0, 9600); high(8); print("%d", 123456789); low(8); }
void loop() {}
"""
    names = ("pulse_out", "freqout", "square_wave", "pwm_start", "pwm_set", "pwm_stop", "ee_putInt", "ee_getInt", "pause")
    texts = ("simpletools.h/high", "simpletools.h/low", "simpletext.h/print", "simpletext.h/simpleterm_reopen")
    trace = run([*(f"simpletools.h/{name}" for name in names), "servo.h/servo_angle", *texts], program, 600, tmp_path)
    assert trace.text.split() == ["123456", "123456789" * 2]
    sent = [width for _, width in trace.pulses("GP8")]
    assert sent == pytest.approx([9 * 87, 9 * 1042], abs=100)  # as long as a serial line takes for it
    assert [width for _, width in trace.pulses("GP3")] == pytest.approx([150], abs=1)
    begun = [at for at, _ in trace.pulses("GP4")]
    assert (len(begun) - 1) / (begun[-1] - begun[0]) * 1e6 == pytest.approx(1000, rel=0.01)
    for pin, period, width in (("GP5", 100_000, 50_000), ("GP6", 5_000, 1_500), ("GP7", 5_000, 700), ("GP16", 20_000, 1_400)):
        pulses = trace.pulses(pin)[1:-1]  # the last one may be cut
        assert len(pulses) >= 2, pin
        assert [made for _, made in pulses] == pytest.approx([width] * len(pulses), abs=4), pin
        apart = [later - at for (at, _), (later, _) in pairwise(pulses)]
        assert apart == pytest.approx([period] * len(apart), abs=4), pin


def test_devices_answer_on_a_bus_that_the_program_makes_at_any_two_pins(tmp_path: Path) -> None:
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    program = """
void setup() { Serial.begin(115200); while (!Serial) {}
  i2c *bus = i2c_newbus(7, 6, 0);
  unsigned char got[3] = {0, 0, 0}, more[2] = {77, 78};
  Serial.println(i2c_in(bus, 0x19, 1, 1, got, 3));
  for (int n = 0; n < 3; n++) Serial.println(got[n]);
  i2c_out(bus, 0x50, 0x0102, 2, more, 2);
  Serial.println(i2c_busy(bus, 0x51));
  Serial.println(i2c_busy(bus, 0x50)); }
void loop() {}
"""
    devices = [
        DeviceUse("registers", {}, {"address": 0x19, "content": [10, 11, 0x81, 13]}),
        DeviceUse("eeprom", {}, {"content": [1] * 0x0102, "busy_ms": 1}),
    ]
    names = [f"simpletools.h/{name}" for name in ("i2c_newbus", "i2c_in", "i2c_out", "i2c_busy")]
    trace = run(names, program, 60, tmp_path, devices=devices)
    assert trace.text.split()[1:] == ["11", "129", "13", "1", "1"]
    assert [event.value for event in trace.device_events] == [[0x0102, 77], [0x0103, 78]]


def test_reasons_for_what_no_adapter_does_name_no_board() -> None:
    """They stand in programs for all boards."""
    told = {line for path in ADAPTERS.rglob("*.cpp") for line in path.read_text().splitlines() if line.startswith(REASON)}
    assert told
    assert [line for line in told if re.search(r"\b(Uno|Mega|Leonardo|Nano|Pico|AVR)\b", line)] == []


def test_a_servo_takes_its_last_width_at_each_frame_and_goes_on_until_its_pin_is_driven(tmp_path: Path) -> None:
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    program = """
void setup() { servo_angle(16, 900); pause(200); for (int us = 0; us < 300; us += 100) servo_angle(16, us); servo_angle(16, 0);
  pause(200); int32_t seen = get_state(16); pause(100);
  high(16); pause(100); Serial.println(seen); }
void loop() {}
"""
    names = ("simpletools.h/pause", "simpletools.h/high", "simpletools.h/get_state", "servo.h/servo_angle")
    trace = run(names, program, 700, tmp_path)
    widths = [round(width) for _, width in trace.pulses("GP16")]
    assert len(widths) >= 23
    assert {width for width in widths if abs(width - 1400) > 4 and abs(width - 500) > 4} <= {*widths[-1:]}
    assert trace.levels("GP16")[-1][1] == 1


@pytest.mark.exhaustive
def test_outputs_on_the_arduino_api_behave_at_the_pins(tmp_path: Path) -> None:
    """With the looser tolerances that the pieces state: pulses within 2 us, jobs in the background when the program waits.

    The Pico's delay() does not call yield(), as those of the cores do that have this layer: the program waits by itself.
    """
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")
    program = """
void wait(uint32_t ms) { for (uint32_t begun = millis(); millis() - begun < ms;) yield(); }
void setup() { Serial.begin(115200); while (!Serial) {}
  pulse_out(3, 150); pulse_out(3, 12); freqout(4, 50, 1000); square_wave(5, 0, 10); pwm_start(5000); pwm_set(6, 0, 1500);
  servo_angle(16, 900); ee_putInt(123456, 32000); Serial.println(ee_getInt(32000)); high(18); Serial.println(get_state(18));
  servo_set(20, 1000); wait(100); servo_setramp(20, 20); servo_set(20, 1500); wait(600); pwm_stop(); }
void loop() {}
"""
    names = ["pulse_out", "freqout", "square_wave", "pwm_start", "pwm_set", "pwm_stop", "ee_putInt", "ee_getInt"]
    names += ["high", "get_state"]
    uses = [f"simpletools.h/{name}" for name in names]
    uses += [f"servo.h/{name}" for name in ("servo_angle", "servo_set", "servo_setramp")]
    trace = run(uses, program, 1100, tmp_path, "other")
    assert trace.text.split() == ["123456", "1"]
    assert [width for _, width in trace.pulses("GP3")] == pytest.approx([150, 12], abs=2)
    begun = [at for at, _ in trace.pulses("GP4")]
    assert (len(begun) - 1) / (begun[-1] - begun[0]) * 1e6 == pytest.approx(1000, rel=0.01)
    waves = [width for _, width in trace.pulses("GP5")[1:-1]]
    assert waves == pytest.approx([50_000] * len(waves), abs=100)
    assert len(waves) >= 4
    assert next(wave.duty for wave in trace.waves if wave.pin == "GP6") == pytest.approx(0.3, abs=0.01)
    servo = [width for _, width in trace.pulses("GP16")[1:-1]]
    assert servo == pytest.approx([1400] * len(servo), abs=4)
    ramp = [width for _, width in trace.pulses("GP20")[6:-1]]
    assert ramp == sorted(ramp)
    assert len({round(width, -1) for width in ramp}) > 10, "the ramp goes on in the background of a pause"
