"""The target `avr-c`: C stays C, main stays main, and what is made builds with make and with `robosmi compile`."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import SourceError, UsageError
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_tools

HERE = Path(__file__).parent
CASES = HERE.parent / "transformations" / "m2t" / "cases"
PROGRAMS = sorted(path for path in CASES.iterdir() if any(path.rglob("input/*.c")) and path.name != "broken_source")


@pytest.fixture
def line_follower(examples: Path, tmp_path: Path) -> Path:
    """The line follower moved to the target, with the Uno of its drawing."""
    shutil.copytree(examples / "line_follower", tmp_path / "input")
    outcome = run("migrate", tmp_path / "input" / "line_follower.c", "--target", "avr-c", "-o", tmp_path / "out")
    assert outcome.code in (0, 1), outcome.err
    assert "[RS412]" in outcome.out + outcome.err
    return tmp_path / "out"


def test_main_and_the_text_of_the_program_stay(line_follower: Path) -> None:
    text = (line_follower / "line_follower" / "line_follower.c").read_text()
    assert "int main() {\n  while (1) {\n    long sLeft  = GetQTIState(leftQTI);\n" in text
    assert "enum { Red633nmLED1WriteP1 = AVR_PIN('B', 4) };  // Red (633nm)-LED1: anode on D12\n" in text
    assert "setup" not in text
    assert sorted(p.name for p in (line_follower / "line_follower").iterdir()) == [
        "MIGRATION.md", "Makefile", "adapters.h", "line_follower.c",
    ]  # fmt: skip


def test_listing_1_of_the_paper_runs_at_the_pins(examples: Path, tmp_path: Path) -> None:
    """Every call has a body; the robot drives straight, both servos 37 us beyond neutral (24 ticks/s)."""
    require_tools("avr-gcc", "avr-objcopy", "avr-size")
    require_engine("simavr")
    made = robosmi.migrate([examples / "listing_1" / "listing_1.c"], tmp_path / "out", target="avr-c")
    assert [use.name for use in made.models.plan.adapterUses if use.adapter is None] == []
    report = compile_sketch(tmp_path / "out", keep=tmp_path)
    assert report.ok
    assert report.diagnostics == ()
    assert report.elf is not None
    assert report.hex is not None
    trace = simulate(job(report.elf, report.hex, load_board("uno"), 400_000, []))
    for pin, width in (("D8", 1537), ("D9", 1463)):
        begun, last = trace.pulses(pin)[-1]
        assert begun > 350_000
        assert last == pytest.approx(width, abs=3)


def test_a_function_of_the_same_name_in_another_header_is_not_its_adapter(tmp_path: Path) -> None:
    """drive_rampStep of abdrive360.h, which has no adapters in C, looks like that of abdrive.h, which drives other pins."""
    program = tmp_path / "robot.c"
    program.write_text('#include "abdrive360.h"\nint main() { drive_rampStep(9, 9); }\n')
    plan = robosmi.plan_migration([program], target="avr-c").plan
    assert [(use.name, use.adapter) for use in plan.adapterUses] == [("drive_rampStep", None)]


def test_nothing_that_is_made_speaks_of_a_sketch(line_follower: Path, tmp_path: Path) -> None:
    """Of a program that reads wrong and leaves something out, too: the tasks say where to do what."""
    program = tmp_path / "odd.c"
    program.write_text(
        '#include "simpletools.h"\n#include "missing.h"\ntypedef struct { int a; } pair;\nint broken( {\n'
        "int main() { pair p; p.a = 1; pause(p.a); return 0; }\n"
    )
    robosmi.migrate([program], tmp_path / "odd", target="avr-c")
    reports = [line_follower / "line_follower" / "MIGRATION.md", tmp_path / "odd" / "odd" / "MIGRATION.md"]
    texts = [path.read_text() for path in reports]
    assert "name in the program" in texts[0]
    assert "or correct the program" in texts[1]
    assert [text for text in texts if "sketch" in text] == []


def test_the_makefile_builds_what_compile_builds(line_follower: Path) -> None:
    require_tools("avr-gcc", "avr-objcopy", "avr-size", "make")
    report = compile_sketch(line_follower)
    assert report.ok
    assert report.fits
    assert (report.board, report.flash_limit, report.ram_limit) == ("uno", 32768, 2048)
    assert report.diagnostics == ()
    folder = line_follower / "line_follower"
    done = subprocess.run(["make", "-C", folder], capture_output=True, text=True, check=True)
    assert "warning" not in done.stderr
    size = subprocess.run(["avr-size", folder / "line_follower.elf"], capture_output=True, text=True, check=True)
    text, data, *_ = map(int, size.stdout.splitlines()[1].split()[:2])
    assert text + data == report.flash_bytes
    assert (folder / "line_follower.hex").is_file()


def test_the_makefile_says_for_which_board_it_is(tmp_path: Path) -> None:
    """A drawing, here a table, may have any AVR board; the same folder compiles for another one that is asked for."""
    require_tools("avr-gcc", "avr-objcopy", "avr-size")
    shutil.copytree(HERE / "program", tmp_path / "input")
    table = tmp_path / "input" / "wiring.csv"
    table.write_text(table.read_text().replace("connector\n", "connector,board\n").replace("anode\n", "anode,leonardo\n"))
    robosmi.migrate([tmp_path / "input" / "beacon.c"], tmp_path / "out", target="avr-c")
    make = (tmp_path / "out" / "beacon" / "Makefile").read_text()
    assert "BOARD := leonardo\nMCU := atmega32u4\nF_CPU := 16000000\n" in make
    assert compile_sketch(tmp_path / "out").board == "leonardo"
    other = compile_sketch(tmp_path / "out", "mega")
    assert other.board == "mega"
    said = [d for d in other.diagnostics if d.rule == "RS809"]
    assert [d.severity.name for d in said] == ["warning"]
    assert "for 'leonardo' (atmega32u4)" in said[0].message
    assert compile_sketch(tmp_path / "out", "micro").diagnostics == ()  # the same microcontroller


@pytest.mark.parametrize("case", sample(PROGRAMS, 16), ids=lambda path: path.name)
def test_programs_compile_as_c(case: Path, tmp_path: Path) -> None:
    """Programs with all that C has and C++ has not, of one file and of several."""
    require_tools("avr-gcc", "avr-objcopy", "avr-size")
    robosmi.migrate(sorted(case.rglob("input/*.c")), tmp_path, target="avr-c")
    report = compile_sketch(tmp_path)
    assert [d.message for d in report.diagnostics if d.severity.name == "error"] == []
    assert report.ok


@pytest.mark.parametrize("rule", ["RS320", "RS321", "RS323", "RS324"])
def test_advice_is_that_of_the_target(rule: str, tmp_path: Path) -> None:
    program = HERE.parent / "transformations" / "constraints" / "moves" / f"{rule}_fails.c"
    words = {"RS320": ("pinMode", "DDRB"), "RS321": ("from loop", "from main"), "RS323": ("of loop", "of main")}
    said = {}
    for target in ("uno", "avr-c"):
        outcome = run("migrate", program, "--target", target, "-o", tmp_path / target, "--json")
        found = next(f for f in outcome.document["findings"] + outcome.document["tasks"] if f["rule"] == rule)
        said[target] = f"{found['message']} / {found['fix']}"
    first, other = words.get(rule, ("the sketch includes", "the program includes"))
    assert first in said["uno"]
    assert first not in said["avr-c"]
    assert other in said["avr-c"]


def test_a_library_cannot_be_chosen_where_there_are_none(examples: Path, tmp_path: Path) -> None:
    program = examples / "line_follower" / "line_follower.c"
    with pytest.raises(UsageError, match="the target 'avr-c' has no libraries to choose"):
        robosmi.migrate([program], tmp_path, target="avr-c", libraries={"Basic Servo1": "Servo"})
    with pytest.raises(UsageError, match="the target 'avr-c' has no libraries"):
        robosmi.recommend_libraries(examples / "line_follower" / "line_following_robot.fzz", target="avr-c")


def test_cplusplus_is_refused_where_c_alone_is_taken(tmp_path: Path) -> None:
    program = tmp_path / "robot.cpp"
    program.write_text("class Robot {};\nint main() { Robot r; (void)r; return 0; }\n")
    with pytest.raises(SourceError, match=r"the file is C\+\+, and the target 'avr-c' takes C alone"):
        robosmi.migrate([program], tmp_path / "out", target="avr-c")
