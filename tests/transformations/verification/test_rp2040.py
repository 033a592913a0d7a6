"""What the engine of the RP2040 has to show of a program at its pins: sketches of the other engines, and what only this chip has.

Devices are those of the other engines, at the pins of the same numbers.
"""

from __future__ import annotations

import shutil
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.base.data_text import as_whole
from robosmi.errors import MissingToolError, UsageError, VerificationError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.engines import node_engine
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, Job, PinTrace, engine_for, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_engine, require_tools
from tests.transformations.verification.conftest import SKETCHES

OWN = Path(__file__).parent / "sketches_rp2040"
Run = Callable[..., PinTrace]


@pytest.fixture(scope="module")
def program(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """The linked program of a sketch; it waits until a PC has opened its console, since what it prints before is lost."""
    require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
    require_engine("rp2040js")

    @cache
    def build(name: str) -> Path:
        folder = tmp_path_factory.mktemp(name) / name
        folder.mkdir()
        place = OWN / name if (OWN / name).is_dir() else SKETCHES / name
        text = (place / f"{name}.ino").read_text()
        (folder / f"{name}.ino").write_text(text.replace("Serial.begin(115200);", "Serial.begin(115200); while (!Serial) {}"))
        report = compile_sketch(folder, "pico", keep=folder)
        assert report.ok, "\n".join(str(finding) for finding in report.diagnostics)
        assert report.elf is not None
        return report.elf

    return build


@pytest.fixture
def job_of(program: Callable[[str], Path]) -> Callable[..., Job]:
    """The job of running a sketch on a Pico for some milliseconds with these devices."""

    def made(name: str, milliseconds: float, devices: Sequence[DeviceUse] = ()) -> Job:
        elf = program(name)
        return job(elf, elf, load_board("pico"), milliseconds * 1000, devices)

    return made


@pytest.fixture
def run(job_of: Callable[..., Job]) -> Run:
    """Run a sketch on a Pico."""
    return lambda *asked: simulate(job_of(*asked))


# ---- the sketches and devices of the other engines


def test_pins_are_seen_and_inputs_read(run: Run) -> None:
    devices = [
        DeviceUse("levels", {"pin": "GP2"}, {"points": [[0, 0], [40, 1], [60, 0]]}),
        DeviceUse("levels", {"pin": "GP4"}, {"points": [[0, None], [50, 0], [70, None]]}),
        DeviceUse("voltages", {"pin": "GP27"}, {"points": [[0, 0], [45, 3000], [65, 1000]]}),
    ]
    trace = run("levels", 100, devices)
    assert trace.state == "running"
    assert trace.simulated_us == 100_000
    changes = trace.levels("GP8")
    assert [level for _, level in changes if level != 0] == [1, "z", "p", "z"]
    begun = {level: at_us for at_us, level in reversed(changes)}
    assert begun["p"] - begun[1] == pytest.approx(20_000, rel=0.01)
    assert changes[-1][1] == 0
    for pin, expected in (("GP13", [(40, 1), (60, 0)]), ("GP12", [(50, 0), (70, 1)]), ("GP11", [(45, 1), (65, 0)])):
        assert [(round(at_us / 1000), level) for at_us, level in trace.levels(pin) if at_us > 35_000] == expected


def test_the_console_is_read_and_typed_on(run: Run) -> None:
    trace = run("console", 60, [DeviceUse("typing", {}, {"points": [[20, "abc"], [40, "x"]]})])
    assert trace.text == "ready\r\nbcdy"
    assert trace.console[-1].at_us == pytest.approx(40_000, abs=500)


def test_rangers_answer_with_the_distance_of_the_time(run: Run) -> None:
    devices = [
        DeviceUse("ranger", {"signal": "GP7"}, {"points": [[0, 20], [100, 150], [300, None]]}),
        DeviceUse("two_pin_ranger", {"trigger": "GP6", "echo": "GP5"}, {"points": [[0, 3], [100, 200]]}),
    ]
    trace = run("rangers", 450, devices)
    read = [tuple(map(int, line.split())) for line in trace.text.splitlines()]
    assert read[0] == (20, 3)
    assert (150, 200) in read
    assert read[-1][0] == 0


@pytest.mark.parametrize(("humidity", "celsius", "read"), [(65.2, 35.1, "2 140 1 95 238"), (40.0, -10.1, "1 144 128 101 118")])
def test_a_dht22_sends_its_bits(humidity: float, celsius: float, read: str, run: Run) -> None:
    settings = {"humidity": [[0, humidity]], "celsius": [[0, celsius]]}
    trace = run("sensors", 60, [DeviceUse("dht22", {"signal": "GP2"}, settings)])
    assert trace.text.splitlines()[0] == read


def test_a_remote_control_is_heard(run: Run) -> None:
    points = [[20, [21, 1]], [200, [106, 30]]]
    trace = run("infrared", 400, [DeviceUse("sony_remote", {"signal": "GP10"}, {"points": points})])
    assert trace.text.split() == ["21/1"] * 3 + ["106/30"] * 3


def test_the_bus_is_answered_at_the_addresses_that_are_there(run: Run) -> None:
    devices = [
        DeviceUse("eeprom", {}, {"content": [1] * 0x0102}),
        DeviceUse("registers", {}, {"address": 0x19, "content": [10, 11, 12, 13, 14]}),
    ]
    trace = run("bus", 60, devices)
    assert trace.text.splitlines() == ["0", "1", " 1 77 78", " 13 14", "1"]
    assert [event.value for event in trace.device_events] == [[0x0102, 77], [0x0103, 78]]


def test_a_key_joins_its_row_and_column(run: Run) -> None:
    pins = {"row0": "GP4", "row1": "GP5", "column0": "GP6", "column1": "GP7"}
    points = [[0, None], [50, [0, 1]], [110, [1, 0]], [170, None]]
    keys = run("matrix", 220, [DeviceUse("keypad", pins, {"points": points})]).text.split()
    assert list(dict.fromkeys(keys)) == ["01", "10"]
    assert len(keys) >= 4


def test_a_serial_line_carries_bytes_both_ways(run: Run) -> None:
    pins = {"receive": "GP10", "transmit": "GP11"}
    trace = run("serial_line", 100, [DeviceUse("serial_line", pins, {"points": [[20, "a"], [40, "b"], [60, "z"]]})])
    assert bytes_of(trace) == "ABZ"


def bytes_of(trace: PinTrace) -> str:
    """What a serial line has heard."""
    return "".join(chr(as_whole(event.value)) for event in trace.device_events if event.what == "byte")


def test_serial_registers_are_written_and_read(run: Run) -> None:
    pins = {"select": "GP5", "clock": "GP6", "data_in": "GP7", "data_out": "GP8"}
    trace = run("serial_registers", 100, [DeviceUse("serial_registers", pins, {"content": [1, 2, 0x53, 0xA7, 5]})])
    assert trace.text.split() == ["83", "83", "167", "77"]


def test_a_program_that_runs_away_has_crashed(run: Run) -> None:
    trace = run("lost", 100)
    assert trace.state == "crashed"
    assert 18_000 < trace.simulated_us < 60_000


def test_a_run_can_be_repeated_to_the_byte(job_of: Callable[..., Job]) -> None:
    asked = job_of("rangers", 150, [DeviceUse("ranger", {"signal": "GP7"}, {"points": [[0, 20]]})])
    assert simulate(asked) == simulate(asked)


# ---- what only this chip has


def test_servos_pwm_tone_and_the_converter(run: Run) -> None:
    trace = run(
        "waves_and_servo", 260, [DeviceUse("voltages", {"pin": "GP28"}, {"points": [[0, 1000], [150, 2000], [200, 500]]})]
    )
    widths = [round(width) for _, width in trace.pulses("GP5")]
    assert widths[1:4] == [544] * 3
    assert widths[-2:] == [2400] * 2
    begins = [begun for begun, _ in trace.pulses("GP5")]
    assert begins[2] - begins[1] == pytest.approx(20_000, abs=1)
    first = {wave.pin: (round(wave.hz), round(wave.duty, 2)) for wave in trace.waves if wave.at_us < 50_000}
    assert first == {"GP9": (1000, 0.25), "GP12": (20_000, 0.75)}
    assert {wave.pin: wave.hz for wave in trace.waves if wave.at_us > 50_000} == {"GP9": 0.0}
    assert trace.levels("GP9")[-1][1] == 0
    rises = [begun for begun, _ in trace.pulses("GP7")]
    assert len(rises) == 44
    assert (rises[-1] - rises[0]) / (len(rises) - 1) == pytest.approx(1e6 / 440, rel=0.001)
    assert [(round(at_us / 1000), level) for at_us, level in trace.levels("GP25") if at_us > 120_000] == [(150, 1), (200, 0)]


def test_the_lines_of_the_chip_are_at_their_pins(run: Run) -> None:
    to = DeviceUse("serial_line", {"receive": "GP1", "transmit": "GP0"}, {"points": [[20, "a"], [40, "z"]], "baud": 9600})
    back = DeviceUse("serial_line", {"receive": "GP9", "transmit": "GP8"}, {"points": [], "baud": 19200})
    assert bytes_of(run("serial_at_pins", 80, [to, back])) == "AZ"


def test_what_is_printed_before_a_pc_listens_is_lost(run: Run) -> None:
    trace = run("early_text", 40)
    assert trace.text == "heard\r\n"
    assert 10_000 < trace.console[0].at_us < 20_000


def test_interrupts_of_pins_and_timers(run: Run) -> None:
    points = [[0, 1], *([at_ms, level] for at_ms in range(20, 90, 10) for level, at_ms in ((0, at_ms), (1, at_ms + 2)))]
    trace = run("watched", 200, [DeviceUse("levels", {"pin": "GP2"}, {"points": points})])
    assert trace.text.split() == ["7"]
    toggles = [at_us for at_us, level in trace.levels("GP3") if level in (0, 1)][2:]
    assert (toggles[-1] - toggles[0]) / (len(toggles) - 1) == pytest.approx(5000, abs=0.5)


@pytest.mark.parametrize(
    ("name", "devices"),
    [
        ("waits", [DeviceUse("levels", {"pin": "GP2"}, {"points": [[at / 7, at % 2] for at in range(0, 400, 3)]})]),
        ("rangers", [DeviceUse("ranger", {"signal": "GP7"}, {"points": [[0, 20]]})]),
        ("waves_and_servo", []),
    ],
)
def test_rounds_of_waiting_loops_are_skipped_to_the_cycle(
    name: str, devices: list[DeviceUse], job_of: Callable[..., Job], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """The whole trace is the same to the nanosecond when no round is skipped."""
    asked = job_of(name, 60, devices)
    skipping = simulate(asked)
    folder = Path(node_engine.__file__).parent
    for path in folder.glob("rp2040js_*.cjs"):
        shutil.copy(path, tmp_path)
    own = tmp_path / "rp2040js_rounds.cjs"
    own.write_text(f"{own.read_text()}\nexports.rounds = () => ({{ disturb() {{}}, jumped: () => 0 }});\n")
    monkeypatch.setattr(node_engine, "__file__", str(tmp_path / "node_engine.py"))
    assert simulate(asked) == skipping
    assert len(skipping.changes) > 5


# ---- bad input


def test_a_simulator_that_is_missing_says_how_to_install_it(
    job_of: Callable[..., Job], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    asked = job_of("console", 1)
    monkeypatch.setenv("ROBOSMI_NPM", str(tmp_path))
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path))
    monkeypatch.delenv("ROBOSMI_HOME", raising=False)
    with pytest.raises(MissingToolError) as caught:
        simulate(asked)
    assert "rp2040js@1.4.1" in str(caught.value.fix)


def test_a_program_that_is_missing_is_an_error(job_of: Callable[..., Job]) -> None:
    with pytest.raises(VerificationError, match=r"gone\.elf"):
        simulate(replace(job_of("console", 1), elf="gone.elf"))


def test_engines_of_other_microcontrollers_are_refused() -> None:
    require_engine("rp2040js")
    assert engine_for("rp2040").name == "rp2040js"
    with pytest.raises(UsageError, match="does not know the microcontroller 'rp2040'"):
        engine_for("rp2040", "avr8js")
