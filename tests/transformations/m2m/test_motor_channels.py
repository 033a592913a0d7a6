"""Motor drivers in the place of continuous servos: which channels turn a motor, and what the pins do on a simulator."""

from __future__ import annotations

from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.plans.choices import available_choices
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, PinTrace, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_tools

FOLDER = Path(__file__).parent / "motor_channels"
DRIVE, SPEED = FOLDER / "drive.c", FOLDER / "speed.c"


def drive(left: str, right: str) -> dict[str, str]:
    """Where a person puts the two servos of a drive."""
    return {"abdrive.left_servo": left, "abdrive.right_servo": right}


COMPLETE = {
    "l298n": drive("D5", "D6"),
    "l298n_jumpers": drive("D5", "D9"),
    "l293d": drive("D3", "D12"),  # one at the PWM input, one at a direction
    "tb6612": drive("D9", "D10"),
    "drv8833": drive("D3", "D10"),
    "drv8871": drive("D3", "D9"),
}
"""Table -> the pins of the two servos. An Uno has PWM on D3, D5, D6, D9, D10 and D11."""
INPUTS = {
    "l298n": (("D5", "D7", "D8"), ("D6", "D12", "D13")),
    "l298n_jumpers": (("", "D5", "D6"), ("", "D9", "D10")),
    "l293d": (("D3", "D2", "D4"), ("D11", "D12", "D13")),
    "tb6612": (("D9", "D7", "D8"), ("D10", "D11", "D12")),
    "drv8833": (("", "D3", "D11"), ("", "D9", "D10")),
    "drv8871": (("", "D3", "D11"), ("", "D9", "D10")),
}
"""Table -> for the left and the right motor the pins at PWM (empty: at the directions), first and second direction input."""


@pytest.mark.parametrize("table", COMPLETE)
def test_a_complete_channel_takes_the_place_of_a_servo(table: str) -> None:
    plan = robosmi.plan_migration([DRIVE], hardware=FOLDER / f"{table}.csv", bind=COMPLETE[table]).plan
    assert not [f for f in plan.findings if f.rule in ("RS269", "RS727")]
    assert [channel.missing for channel in plan.motorChannels] == [[], []]
    assert plan.target is not None
    assert "motors" in {piece.name for piece in plan.target.adapters}
    assert not [task for task in plan.tasks if task.rule == "RS331"]  # the driver's other inputs are used


@pytest.mark.parametrize(
    ("program", "table", "port", "motors"),
    [
        (DRIVE, "l298n", "abdrive.left_servo", ["D5", "D6"]),
        (DRIVE, "l298n_by_kind", "abdrive.left_servo", ["D5", "D6"]),  # no servo is called so
        (DRIVE, "l298n_no_pwm", "abdrive.left_servo", ["D6"]),  # the other channel is not complete
        (SPEED, "l298n_by_kind", "P12", ["D5", "D6"]),
        (SPEED, "l298n_by_kind", "P14", []),  # it sets an angle
    ],
)
def test_complete_channels_are_offered_first_where_no_servo_is(program: Path, table: str, port: str, motors: list[str]) -> None:
    plan = robosmi.plan_migration([program], hardware=FOLDER / f"{table}.csv").plan
    options = next(choice.options for choice in available_choices(plan) if choice.subject == port)
    pins = {str(each.name): str(each.pin.label) for each in plan.connections if each.pin is not None}
    turning = [pins[option.value] for option in options if option.why == "turns a motor instead of a servo"]
    assert turning == motors
    assert [pins.get(option.value, option.value) for option in options[: len(motors) or 1]] == (motors or ["none"])


@pytest.mark.parametrize(
    ("program", "table", "bind", "said"),
    [
        (DRIVE, "l298n_one_direction", drive("D5", "D6"), "second direction input"),
        (DRIVE, "l298n_no_pwm", drive("D4", "D6"), "D4 has no PWM"),
        (DRIVE, "tb6612_no_pwm", drive("D7", "D10"), "PWM input is on no pin"),
        (DRIVE, "tb6612", drive("D4", "D10"), "D4 is at no input"),
        (DRIVE, "l298n", drive("D5", "D7"), "same channel"),
        (SPEED, "l298n", {"P12": "D5", "P14": "D6"}, "servo_angle sets an angle"),
    ],
)
def test_what_cannot_turn_a_motor_is_an_error(program: Path, table: str, bind: dict[str, str], said: str) -> None:
    plan = robosmi.plan_migration([program], hardware=FOLDER / f"{table}.csv", bind=bind).plan
    found = [f for f in plan.findings if f.rule == "RS269"]
    assert found
    assert all(str(f.severity) == "error" for f in found)
    assert any(said in f.message for f in found)


def test_a_target_without_such_adapters_says_so() -> None:
    plan = robosmi.plan_migration([SPEED], hardware=FOLDER / "l298n.csv", bind={"P12": "D5"}, target="avr-c").plan
    assert [f for f in plan.findings if f.rule == "RS269" and "no adapter" in f.message]


def traced(program: Path, table: str, bind: dict[str, str], folder: Path, ms: float, *devices: DeviceUse) -> PinTrace:
    """What the pins do."""
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")
    made = robosmi.migrate([program], folder / "out", hardware=FOLDER / f"{table}.csv", bind=bind)
    (folder / "built").mkdir()
    report = compile_sketch(made.sketch, "uno", keep=folder / "built")
    assert report.ok, report.diagnostics
    assert report.elf is not None
    assert report.hex is not None
    return simulate(job(report.elf, report.hex, load_board("uno"), 1000 * ms, list(devices)))


def duty(trace: PinTrace, pin: str, at_ms: float) -> float:
    """The share of the time that a pin is high at a time; 1 for a pin that is not wired."""
    if not pin:
        return 1.0
    waves = [wave for wave in trace.waves if wave.pin == pin and wave.at_us <= 1000 * at_ms]
    if waves and waves[-1].hz:
        return waves[-1].duty
    levels = [change.level for change in trace.changes if change.pin == pin and change.at_us <= 1000 * at_ms]
    return float(bool(levels) and levels[-1] == 1)


@pytest.mark.processes
@pytest.mark.parametrize("table", sample(COMPLETE, 3))
def test_forward_backward_turn_and_stop_set_pwm_and_directions(table: str, tmp_path: Path) -> None:
    trace = traced(DRIVE, table, COMPLETE[table], tmp_path, 3200)
    half = pytest.approx(0.5, abs=0.01)
    for at_ms, shares in ((700, (1, 1)), (1450, (-1, -1)), (2250, (1, -1)), (3150, (0, 0))):
        for (enable, first, second), share in zip(INPUTS[table], shares, strict=True):
            ahead, behind = (duty(trace, pin, at_ms) for pin in ((first, second) if share >= 0 else (second, first)))
            power = duty(trace, enable, at_ms)
            assert behind == 0, (at_ms, first)
            assert ahead * power == (half if share else 0), (at_ms, first)
            assert not enable or ahead == abs(share), (at_ms, first)
    if table in ("tb6612", "drv8833"):
        assert duty(trace, "D4", 700) == 1  # the driver does not sleep


@pytest.mark.processes
def test_a_servo_and_a_motor_are_told_apart(tmp_path: Path) -> None:
    trace = traced(SPEED, "l298n_and_servo", {"P12": "D5", "P14": "D2"}, tmp_path, 1400)
    assert [duty(trace, pin, 400) for pin in ("D5", "D7", "D8")] == pytest.approx([0.5, 1, 0], abs=0.01)
    assert [duty(trace, pin, 900) for pin in ("D5", "D7", "D8")] == pytest.approx([1, 0, 1], abs=0.01)
    assert [change.level for change in trace.changes if change.pin == "D7"][-1] == "z"  # servo_disable lets go
    rises = [change.at_us for change in trace.changes if change.pin == "D2" and change.level == 1]
    falls = [change.at_us for change in trace.changes if change.pin == "D2" and change.level == 0 and change.at_us > rises[0]]
    assert falls[0] - rises[0] == pytest.approx(1400, abs=4)


@pytest.mark.processes
@pytest.mark.parametrize("slower", [1.0, 0.6])
def test_encoders_correct_the_speed(slower: float, tmp_path: Path) -> None:
    wheels = [
        DeviceUse(
            "motor_wheel",
            {"enable": enable, "first": first, "second": second, "awake": "D4", "encoder": encoder},
            {"ticks_per_s_per_us": 0.64 * slower},
        )
        for enable, first, second, encoder in (("D9", "D7", "D8", "A0"), ("D10", "D11", "D12", "A1"))
    ]
    program = tmp_path / "straight.c"
    program.write_text('#include "abdrive.h"\nint main() { drive_speed(64, 64); while (1); }\n')
    bind = {**COMPLETE["tb6612"], "abdrive.left_encoder": "A0", "abdrive.right_encoder": "A1"}
    trace = traced(program, "tb6612_encoders", bind, tmp_path, 4000, *wheels)
    ticks = [event.value for event in trace.device_events if event.what == "ticks"]
    assert ticks == pytest.approx([64 * 3.75] * 2, abs=8)  # within the ticks by which a motor of 60 % lags behind


@pytest.mark.processes
def test_verify_compares_the_motion_of_the_wheels(tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr", "gcc")
    require_engine("simavr")
    out = tmp_path / "out"
    robosmi.migrate([DRIVE], out, hardware=FOLDER / "l298n.csv", bind=COMPLETE["l298n"])
    same = run("verify", out, "--json")
    assert same.result["verdict"] == "no-difference-found"
    assert same.result["compared"] == {"outputs": 2, "of": 2, "lines_pct": 100.0}
    sketch = out / "drive" / "drive.ino"
    assert "drive_speed(64, -64L)" in sketch.read_text()
    sketch.write_text(sketch.read_text().replace("drive_speed(64, -64L)", "drive_speed(-64L, 64)"))
    assert run("verify", out, "--json").result["verdict"] == "different"
