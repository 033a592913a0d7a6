"""Programs with cogs, moved whole, run on a simulator: what their cogs do beside main is what the libraries define.

Each program is compiled as it is generated, for one of each kind of microcontroller; what is expected follows from its text:
levels of pins with their times, the console.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from pathlib import Path

import pytest

from robosmi.plugins import content
from robosmi.transformations.chains.migrate import migrate, plan_migration
from robosmi.transformations.chains.stages.output import Generated
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.queries.resources.stack_depth import CORE_INTERRUPT
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import DeviceUse, PinTrace, simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tiers import sample
from tests.tools import require_engine, require_tools

PROGRAMS = Path(__file__).parent / "programs"
BIND = {"P25": "D6", "P26": "D13", "P27": "D12", "P5": "D5"}
SERVOS = ["D9", "D10"]
BOARDS = sample(["uno", "leonardo", "mega"], 1)
PICO = "pico"


def pin_of(board: str, pin: str) -> str:
    """The pin of a board with the number of a pin of an Uno."""
    return f"GP{pin[1:]}" if board == PICO else pin


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    require_engine("simavr")


def moved(name: str, folder: Path, board: str = "uno") -> Generated:
    """Migrate a program with its ports bound to their pins."""
    place = PROGRAMS / name
    files = sorted(place.glob("*.c")) if place.is_dir() else [place.with_suffix(".c")]
    text = "".join(file.read_text() for file in files)
    calls = r"\b(?:high|low|toggle|input|pulse_out|servo_angle|ping_cm)"
    bind = {port: pin_of(board, pin) for port, pin in BIND.items() if re.search(rf"{calls}\({port[1:]}\b", text)}
    if '#include "abdrive.h"' in text:
        bind |= {f"abdrive.{side}_servo": pin_of(board, pin) for side, pin in zip(("left", "right"), SERVOS, strict=True)}
    return migrate(files, folder, bind=bind, target=board)


def run(name: str, folder: Path, milliseconds: float, board: str = "uno", devices: Sequence[DeviceUse] = ()) -> PinTrace:
    """Simulate a migrated program; the generated text must give no warning."""
    if board == PICO:
        require_tools("arm-none-eabi-gcc", "arm-none-eabi-g++")
        require_engine("rp2040js")
    made = moved(name, folder / "out", board)
    report = compile_sketch(made.sketch, board, keep=folder)
    assert report.ok, [finding.message for finding in report.diagnostics]
    own = [
        f for f in report.diagnostics if f.severity.name == "warning" and "adapters.h" in (f.location.path if f.location else "")
    ]
    assert own == []
    assert report.elf is not None
    return simulate(job(report.elf, report.hex, load_board(board), milliseconds * 1000, list(devices)))


def rises(trace: PinTrace, pin: str) -> list[float]:
    """When a pin went high, in milliseconds."""
    return [at / 1000 for at, level in trace.levels(pin) if level == 1]


def gaps(times: list[float]) -> list[float]:
    """The differences between consecutive times."""
    return [b - a for a, b in itertools.pairwise(times)]


@pytest.mark.parametrize("board", BOARDS)
def test_cogs_share_a_variable_until_one_is_ended(board: str, tmp_path: Path) -> None:
    trace = run("exchange", tmp_path, 2600, board)
    times = rises(trace, "D13")
    assert gaps(times)[:4] == [pytest.approx(200, rel=0.02)] * 4
    assert gaps(times)[-4:] == [pytest.approx(100, rel=0.02)] * 4
    assert times[-1] < 2020
    (ended,) = rises(trace, "D12")
    assert ended == pytest.approx(2000, abs=20)


@pytest.mark.parametrize("board", ["uno", PICO])
def test_a_busy_wait_ends_when_the_cog_says_so(board: str, tmp_path: Path) -> None:
    trace = run("busy_wait", tmp_path, 400, board)
    first = rises(trace, pin_of(board, "D13"))[0]
    (begun,) = rises(trace, pin_of(board, "D12"))
    ended = [at_us / 1000 for at_us, level in trace.levels(pin_of(board, "D12")) if level == 0][-1]
    assert begun - first == pytest.approx(100, abs=3)
    assert ended - begun == pytest.approx(100, abs=3)
    assert trace.text == "2 1\n"
    assert len(trace.levels(pin_of(board, "D13"))) >= 18, "the cog goes on when main has nothing more to do"


def test_jumps_back_and_macros_that_are_loops_give_way(tmp_path: Path) -> None:
    trace = run("jumps_and_macros", tmp_path, 400)
    times = [at / 1000 for at, _ in trace.levels("D12")]
    assert gaps(times)[-3:] == [pytest.approx(40, abs=3)] * 3, "each wait lasts two turns of the cog"
    assert trace.text == "1 1\n"
    assert len(trace.levels("D13")) >= 18


@pytest.mark.parametrize("board", ["uno", PICO])
def test_a_lock_lets_one_cog_in(board: str, tmp_path: Path) -> None:
    assert run("locks", tmp_path, 200, board).text == "done 2, worst 1\n"


@pytest.mark.parametrize("board", [*BOARDS, PICO])
def test_each_cog_has_its_parameter(board: str, tmp_path: Path) -> None:
    trace = run("parameters", tmp_path, 350, board)
    for pin, time in (("D6", 30), ("D13", 20), ("D12", 10)):
        assert gaps(rises(trace, pin_of(board, pin))) == [pytest.approx(2 * time, abs=2)] * 3
    if board in ("uno", PICO):
        assert trace.text == "6\n"


def test_a_cog_is_started_again_in_the_place_of_one_that_ended(tmp_path: Path) -> None:
    plan = moved("again_and_again", tmp_path / "plan").models.plan
    assert plan.concurrency is not None
    assert plan.concurrency.slots == 1
    trace = run("again_and_again", tmp_path, 200)
    assert trace.text == "4 runs\n"
    assert len([level for _, level in trace.levels("D13") if level in (0, 1)]) == 4


def test_a_cog_prints_while_main_blinks(tmp_path: Path) -> None:
    trace = run("text_from_a_cog", tmp_path, 230)
    assert trace.text == "".join(f"told {n} times {n / 2:.2f}\n" for n in range(1, 5))
    assert gaps(rises(trace, "D13"))[:3] == [pytest.approx(50, abs=3)] * 3


def test_cogs_go_on_when_main_has_ended(tmp_path: Path) -> None:
    trace = run("main_ends", tmp_path, 205)
    assert len(trace.levels("D13")) >= 19
    assert rises(trace, "D12") == []


def test_computing_and_polling_keep_nobody_waiting(tmp_path: Path) -> None:
    trace = run("computing", tmp_path, 150)
    assert gaps([at / 1000 for at, _ in trace.levels("D13")][1:11]) == [pytest.approx(10, abs=1)] * 9
    assert len(rises(trace, "D6")) == 1


@pytest.mark.parametrize("board", ["uno", PICO])
def test_a_cog_keeps_its_beat(board: str, tmp_path: Path) -> None:
    trace = run("in_step", tmp_path, 190, board)
    beats = rises(trace, pin_of(board, "D13"))
    assert gaps(beats) == [pytest.approx(20, abs=0.2)] * (len(beats) - 1)
    assert len(beats) >= 8
    (up,) = rises(trace, pin_of(board, "D12"))
    down = [at_us / 1000 for at_us, level in trace.levels(pin_of(board, "D12")) if level == 0][-1]
    assert up - beats[0] == pytest.approx(40, abs=2)
    assert down - up == pytest.approx(50, abs=2)


@pytest.mark.parametrize("board", BOARDS)
def test_what_a_cog_is_held_up_by_is_taken_off_its_next_pauses(board: str, tmp_path: Path) -> None:
    trace = run("held_up", tmp_path, 3000, board)
    blinks = rises(trace, BIND["P26"])
    assert (blinks[-1] - blinks[0]) / (len(blinks) - 1) == pytest.approx(100, abs=0.5)
    assert gaps(blinks) == [pytest.approx(100, abs=12)] * (len(blinks) - 1)


@pytest.mark.parametrize("board", [*sample(["uno", "mega"], 1), PICO])
def test_threads_are_joined_and_share_a_mutex(board: str, tmp_path: Path) -> None:
    assert run("threads", tmp_path, 250, board).text == "70 4\n"


def test_code_of_a_cog_may_stand_in_another_file(tmp_path: Path) -> None:
    trace = run("two_files", tmp_path, 300)
    assert trace.text == "5 1\n"
    assert len(rises(trace, "D13")) in (5, 6)


@pytest.mark.parametrize("board", ["uno", PICO])
def test_a_cog_moves_a_servo_while_main_measures_until_it_is_ended(board: str, tmp_path: Path) -> None:
    ranger = DeviceUse("ranger", {"signal": pin_of(board, "D5")}, {"points": [[0, 20], [70, 150]]})
    trace = run("servo_in_a_cog", tmp_path, 300, board, [ranger])
    near, far, later = map(int, re.findall(r"-?\d+", trace.text))
    assert (near, later) == (20, 0)
    assert abs(far - 150) <= 1
    widths = [round(width, -1) for _, width in trace.pulses(pin_of(board, "D6"))]
    assert widths == sorted(widths)
    assert set(widths) == {1100, 1700}
    assert len(rises(trace, pin_of(board, "D12"))) == 1


def pulses(trace: PinTrace, pin: str) -> list[float]:
    """When the pulses of a servo began, in milliseconds."""
    return [at / 1000 for at, width in trace.pulses(pin) if width > 1000]


@pytest.mark.parametrize("board", [*sample(["uno", "mega"], 1), PICO])
def test_a_drive_is_started_in_a_cog(board: str, tmp_path: Path) -> None:
    trace = run("drive_in_a_cog", tmp_path, 1500, board)
    for pin in SERVOS:
        begun = pulses(trace, pin_of(board, pin))
        assert len(begun) > 60
        assert gaps(begun)[-20:] == [pytest.approx(20, abs=1.5)] * 20


@pytest.mark.parametrize("board", sample(["uno", "mega"], 1))
def test_a_cog_blinks_while_main_drives(board: str, tmp_path: Path) -> None:
    trace = run("cog_beside_a_drive", tmp_path, 3000, board)
    for pin in SERVOS:
        assert len(pulses(trace, pin)) > 140
        assert pulses(trace, pin)[-1] > 2950
    assert rises(trace, "D13")[-1] > 2980


def test_a_cog_has_the_heap_that_main_has(tmp_path: Path) -> None:
    assert run("heap_in_a_cog", tmp_path, 150).text == "5 1\n"


def test_interrupts_of_a_drive_count_for_the_stack_of_each_cog(tmp_path: Path) -> None:
    made, alone = moved("cog_beside_a_drive", tmp_path / "beside"), moved("main_ends", tmp_path / "alone").models.plan.concurrency
    beside = made.models.plan.concurrency
    assert beside is not None
    assert alone is not None
    said = next(found for each in beside.evidence if (found := re.search(r"interrupts .* up to (\d+) bytes", each)))
    assert beside.stackBytes > alone.stackBytes + int(said[1]) - 20  # blinking takes less than what main_ends does
    compiled = compile_sketch(made.sketch).stack
    assert compiled is not None
    assert int(said[1]) + CORE_INTERRUPT >= compiled.interrupts > 3 * CORE_INTERRUPT


def test_code_that_nothing_starts_has_no_stack(tmp_path: Path) -> None:
    program = tmp_path / "unused.c"
    start = "cog_run(blink, 128);"
    text = (
        '#include "simpletools.h"\n'
        "void blink(void *par) { while (1) { toggle(26); pause(100); } }\n"
        "void other(void *par) { while (1) { toggle(27); pause(100); } }\n"
        "void nobody_calls(void) { cog_run(other, 128); cog_run(other, 128); }\n"
        f"int main(void) {{ {start} while (1) pause(10); }}\n"
    )
    program.write_text(text)
    used = plan_migration([program]).plan.concurrency
    assert used is not None
    assert used.slots == 1
    program.write_text(text.replace(start, f"{start} nobody_calls();"))
    called = plan_migration([program]).plan.concurrency
    assert called is not None
    assert called.slots == 3


def test_a_pin_with_a_resting_level_is_let_go_when_its_cog_ends(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    program = PROGRAMS / "resting_pump.c"
    migrate([program], tmp_path / "out", hardware=program.with_suffix(".csv"), bind={"P4": "D7", "P5": "D8", "P6": "D9"})
    released = content("chain", "simulate")(tmp_path / "out", seconds=1).result["released"]
    assert sorted(each["pin"] for each in released if not each["pull_up"]) == ["D7", "D8", "D9"]
