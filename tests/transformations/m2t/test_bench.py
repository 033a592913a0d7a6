"""The sketch for the bench: it compiles for every board and drawing, and on a simulator it moves and reads what is wired.

`bench/everything.csv` has a component of every kind that can be tried.
"""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, simulate
from robosmi.verify.toolchains.boards import Board, load_boards
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.running import run, tree
from tests.tiers import one_of_each, sample
from tests.tools import NO_CORE, require_engine, require_tools

FOLDER = Path(__file__).parent / "bench"
TESTS = Path(__file__).resolve().parents[2]
IDLE = FOLDER / "idle.c"
DRAWINGS = sorted(
    [
        *(TESTS.parent / "docs" / "examples").glob("*/*.fzz"),
        *TESTS.glob("transformations/constraints/plans/*_holds/wiring.csv"),
        *TESTS.glob("transformations/t2m/drawing_readers/*/robot.*"),
        *(TESTS / "targets").glob("*/wiring.csv"),
        TESTS / "transformations" / "m2t" / "reports" / "wired" / "wiring.csv",
    ]
)
BOARDS = load_boards("arduino")
COMPILED = [board for board in BOARDS if board.name not in NO_CORE]
"""The boards that programs can be compiled for here; `tests/targets` makes sure that each other one says which core it lacks."""
_MORE_TOOLS = {"rp2040": ("arm-none-eabi-g++",)}
_MORE_RULES = {"rp2040": ("RS806",)}  # the stand-in of its core is taken where this is not installed
TOOLS = ("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")


def made(folder: Path, drawing: Path, board: str = "uno", **options: Any) -> Path:
    """The output folder with the sketch for the bench of a drawing, and a program that uses nothing of it."""
    robosmi.migrate([IDLE], folder / "out", hardware=drawing, target=board, bench=True, **options)
    return folder / "out"


def compiles(out: Path, *rules: str) -> None:
    """Whether the sketch compiles for its board without a warning or a stand-in, but for these rules, and fits."""
    report = compile_sketch(out / "bench")
    assert (report.ok, report.fits, [each.rule for each in report.diagnostics]) == (True, True, [*rules])


@pytest.mark.parametrize("drawing", sample(DRAWINGS, 7), ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_it_compiles_for_every_drawing(drawing: Path, tmp_path: Path) -> None:
    require_tools(*TOOLS)
    compiles(made(tmp_path, drawing))


TRIED = {
    "gps": [], "eye": ["tryRanger(2, 3)"], "button": ["tryLevel(4)"], "bridge": ["tryMotor(5, LOW)", "trySwitch(7, LOW)"],
    "ping": ["tryRanger(6, 6)"], "pump switch": ["trySwitch(8, HIGH)"], "arm": ["tryServo(9, 1500)"], "beeper": ["trySound(10)"],
    "weather": ["tryHumidity(11)"], "lamp": ["trySwitch(12, LOW)"], "knob": ["tryVoltage(A0)"], "heat": ["tryVoltage(A1)"],
    "wheel": ["tryCount(A2)"], "motion": ["tryBus()"],
}  # fmt: skip
"""Each component of `everything.csv` and the calls that try it."""


def test_each_component_is_tried_by_what_it_is(tmp_path: Path) -> None:
    out = made(tmp_path, FOLDER / "everything.csv")
    text = (out / "bench" / "idle_bench" / "idle_bench.ino").read_text()
    cases = re.findall(r'case \d+:\n *Serial\.println\(F\("(.*?)"\)\);\n(.*?)break;', text, re.DOTALL)
    assert {title: re.findall(r"try\w+\(.*?\)", calls) for title, calls in cases} == TRIED


def test_there_are_a_dozen_drawings_and_sixteen_boards() -> None:
    assert len(DRAWINGS) >= 12
    assert len(COMPILED) >= 16


@pytest.mark.parametrize("board", one_of_each(COMPILED, lambda board: board.values["mcu"]), ids=lambda board: board.name)
def test_it_compiles_for_every_board(board: Board, tmp_path: Path) -> None:
    require_tools(*TOOLS, *_MORE_TOOLS.get(board.values["mcu"], ()))
    labels = {label for pin in load_board(board.name).pins for label in (pin.label, *pin.aliases)}
    table = FOLDER / ("everything_pico.csv" if "GP2" in labels else "everything.csv")
    rows = [line for line in table.read_text().splitlines() if line.split(",")[0] in {"pin", *labels}]
    (tmp_path / "wired.csv").write_text("\n".join(rows) + "\n")
    out = made(tmp_path, tmp_path / "wired.csv", board.name)
    text = (out / "bench" / "idle_bench" / "idle_bench.ino").read_text()
    assert len(re.findall(r"^    case \d+:$", text, re.MULTILINE)) >= 9
    compiles(out, *_MORE_RULES.get(board.values["mcu"], ()))


@pytest.mark.parametrize("example", ["line_follower", "environmental_monitoring"])
def test_the_case_studies_have_one(example: str, examples: Path, tmp_path: Path) -> None:
    require_tools(*TOOLS)
    (program,) = (examples / example).glob("*.c")
    assert run("migrate", program, "-o", tmp_path / "out", "--bench").code == 0
    compiles(tmp_path / "out")
    report = compile_sketch(tmp_path / "out")  # which of the two is meant is not asked
    assert report.ok
    before = tree(tmp_path / "out")
    assert run("migrate", program, "-o", tmp_path / "out", "--bench").code == 0
    assert tree(tmp_path / "out") == before
    gone = run("migrate", program, "-o", tmp_path / "out", "--json")
    assert gone.code == 0
    (said,) = (f for f in gone.document["findings"] if f["rule"] == "RS526")
    assert "bench" in said["message"]
    assert "--bench" in said["fix"]
    assert not (tmp_path / "out" / "bench").exists()
    assert run("generate", tmp_path / "out" / "models" / "plan.xmi", "-o", tmp_path / "out", "--bench").code == 0
    assert (tmp_path / "out" / "bench").exists()


def test_it_compiles_in_c_for_every_microcontroller(tmp_path: Path) -> None:
    """Ports and channels of the converter are other ones; avr-c itself is for an Uno."""
    require_tools("avr-gcc", "avr-size")
    out = made(tmp_path, FOLDER / "everything.csv", "avr-c")
    compiles(out)
    program = out / "bench" / "idle_bench" / "idle_bench.c"
    assert len(re.findall(r"^    case \d+:$", program.read_text(), re.MULTILINE)) >= 9
    for mcu in ("atmega2560", "atmega32u4"):
        command = ["avr-gcc", "-std=gnu11", "-Os", "-Wall", "-Wextra", "-Werror", f"-mmcu={mcu}", "-DF_CPU=16000000UL", "-c"]
        subprocess.run([*command, program, "-o", tmp_path / "bench.o"], check=True)


# ---- on the simulator


@pytest.fixture(scope="module", params=["uno", "avr-c"])
def tried(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Callable[..., Any]:
    """Run the sketch, or the C program, with devices.

    Numbers are sent to it, each with the milliseconds after which a key stops the test.
    """
    require_tools(*TOOLS)
    require_engine("simavr")
    folder = tmp_path_factory.mktemp("bench")
    (folder / "robosmi.toml").write_text("[servos.arm]\nneutral = 1460\n")
    program = folder / "idle.c"
    program.write_text(IDLE.read_text())
    robosmi.migrate([program], folder / "out", hardware=FOLDER / "everything.csv", target=request.param, bench=True)
    report = compile_sketch(folder / "out" / "bench", keep=folder)
    assert report.elf is not None
    assert report.hex is not None
    elf, hex_file = report.elf, report.hex

    @cache
    def at(numbers: tuple[tuple[int, int], ...]) -> Any:
        now, typed = 1500.0, []
        for number, for_ms in numbers:
            typed += [(now, f"{number}\n"), (now + for_ms, "x")]
            now += for_ms + 1200
        devices = [
            DeviceUse("typing", {}, {"points": typed}),
            DeviceUse("two_pin_ranger", {"trigger": "D2", "echo": "D3"}, {"points": [[0, 57]]}),
            DeviceUse("ranger", {"signal": "D6"}, {"points": [[0, 23]]}),
            DeviceUse("levels", {"pin": "D4"}, {"points": [[0, 1], [2000, 0]]}),
            DeviceUse("dht22", {"signal": "D11"}, {"humidity": [[0, 41.5]], "celsius": [[0, 23.4]]}),
            DeviceUse("voltages", {"pin": "A0"}, {"points": [[0, 2500]]}),
            DeviceUse("registers", {}, {"address": 0x68}),
            DeviceUse("levels", {"pin": "A2"}, {"points": [[ms, ms // 50 % 2] for ms in range(0, 12000, 50)]}),
        ]
        return simulate(job(elf, hex_file, load_board("uno"), now * 1000, devices))

    return at


def number_of(port: re.Match[str]) -> str:
    """The number on an Uno of a pin that is told by its port."""
    return str({"D": 0, "B": 8, "C": 14}[port[1]] + int(port[2]))


@pytest.mark.parametrize("target", ["uno", "avr-c"])
def test_steppers_turn_to_each_side_and_no_coil_stays_on(target: str, tmp_path: Path) -> None:
    require_tools(*TOOLS)
    require_engine("simavr")
    report = compile_sketch(made(tmp_path, FOLDER / "steppers.csv", target) / "bench", keep=tmp_path)
    assert report.elf is not None
    assert report.hex is not None
    typed = [[1500, "1\n"], [4000, "2\n"]]
    trace = simulate(job(report.elf, report.hex, load_board("uno"), 6000e3, [DeviceUse("typing", {}, {"points": typed})]))
    steps = [at for at, _ in trace.pulses("D4")]
    (turned,) = [change.at_us for change in trace.changes if change.pin == "D5" and change.level == 1]
    assert (sum(at < turned for at in steps), sum(at > turned for at in steps)) == (50, 50)
    coils = sorted((at, pin) for pin in ("D8", "D9", "D10", "D11") for at, _ in trace.pulses(pin))
    assert [pin for _, pin in coils] == ["D8", "D9", "D10", "D11"] * 12 + ["D11", "D10", "D9", "D8"] * 12
    assert all(9_000 < width < 12_000 for pin in ("D8", "D9", "D10", "D11") for _, width in trace.pulses(pin))


def lines(text: str, title: str) -> list[str]:
    """The lines printed between a component's title and the next `done`; ports that C prints are replaced by pin numbers."""
    said = re.sub(r"(?<=  pin )P([BCD])(\d)", number_of, text.replace("\r", ""))
    return said.partition(f"\n{title}\n")[2].partition("\ndone")[0].splitlines()


def test_what_moves_rests_from_the_start_and_nothing_else_is_driven(tried: Callable[..., Any]) -> None:
    trace = tried(())
    assert "2 eye: Trig on D2, Echo on D3" in trace.text
    drives = {change.pin: change.level for change in trace.changes if change.level in (0, 1)}
    assert drives == {"D5": 0, "D7": 0, "D8": 1, "D9": 0}
    assert {c.level for c in trace.changes if c.pin == "D8"} <= {"z", "p", 1}  # never low, which would switch the relay


def test_sensors_print_what_they_see(tried: Callable[..., Any]) -> None:
    trace = tried(((2, 700), (3, 900), (5, 700), (11, 600)))
    assert lines(trace.text, "eye")[0] == "  pin 3: 57 cm"
    assert set(lines(trace.text, "button")[:-1]) <= {"  pin 4: 0", "  pin 4: 1"}
    assert "  pin 4: 0" in lines(trace.text, "button")
    assert lines(trace.text, "ping")[0] == "  pin 6: 23 cm"
    found = re.fullmatch(r"  pin 14: (\d+) \((\d\.\d\d) V\)", lines(trace.text, "knob")[0])
    assert found is not None
    assert abs(int(found[1]) - 511) <= 2
    assert abs(float(found[2]) - 2.5) <= 0.02
    assert lines(trace.text, "eye")[-1] == "  stopped"


def test_a_bus_says_who_answers_and_a_humidity_sensor_what_it_measures(tried: Callable[..., Any]) -> None:
    trace = tried(((14, 1500), (9, 1000)))
    assert "  0x68 answers" in lines(trace.text, "motion")
    assert lines(trace.text, "weather")[0] == "  pin 11: 41.5 %, 23.4 degrees C"


def test_a_servo_moves_a_little_around_its_neutral_pulse_and_rests(tried: Callable[..., Any]) -> None:
    trace = tried(((7, 5200),))
    widths = [width for _, width in trace.pulses("D9")]
    assert len(widths) == 200
    for wanted, part in zip((1460, 1560, 1360, 1460), (widths[:50], widths[50:100], widths[100:150], widths[150:]), strict=True):
        assert all(abs(width - wanted) <= 12 for width in part), (wanted, part)


def test_a_key_stops_a_servo(tried: Callable[..., Any]) -> None:
    trace = tried(((7, 300),))
    assert len(trace.pulses("D9")) < 25


def test_outputs_go_on_and_off_and_motors_run_at_a_third_for_half_a_second(tried: Callable[..., Any]) -> None:
    trace = tried(((10, 2600), (6, 2600), (4, 3400), (8, 700)))
    assert [c.level for c in trace.changes if c.pin == "D12" and c.level in (0, 1)] == [0, 1, 0, 1, 0, 1, 0]
    assert [c.level for c in trace.changes if c.pin == "D8" and c.level in (0, 1)] == [1, 0, 1, 0, 1, 0, 1]
    if waves := [w for w in trace.waves if w.pin == "D5" and w.duty > 0]:
        assert len(waves) == 1
        assert abs(waves[0].duty - 1 / 3) < 0.01
    else:  # in C any pin can, by the processor
        high = [width for _, width in trace.pulses("D5")]
        assert 480 <= len(high) <= 500
        assert all(abs(width - 333) <= 10 for width in high)
    assert {c.level for c in trace.changes if c.pin == "D7"} >= {0, 1}
    assert "440 Hz" in trace.text


def test_changes_are_counted(tried: Callable[..., Any]) -> None:
    trace = tried(((13, 3000),))
    (said,) = [line for line in lines(trace.text, "wheel") if "changes" in line]
    assert 50 <= int(re.findall(r"\d+", said)[1]) <= 62  # one every 50 ms
