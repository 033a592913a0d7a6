"""How long a pass of the loop waits: as each program of the folder says in its first line, and as a simulator measures it.

The first line of a program has the least and the longest time of a pass in milliseconds; each pass toggles port 26.
"""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import pytest

import robosmi
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.queries.resources.loop_time import Time, loop_time
from tests.running import run
from tests.tiers import sample
from tests.tools import require_engine, require_tools

PROGRAMS = sorted((Path(__file__).parent / "loops").glob("*.c"))


def said(program: Path) -> tuple[float, float]:
    """The least and the greatest time that a program's first line gives."""
    low, high = program.read_text().splitlines()[0].removeprefix("// ").split(" to ")
    return float(low), float(high)


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: str(path.stem))
def test_the_time_of_a_pass_is_between_what_the_text_gives(program: Path) -> None:
    time = loop_time(plan_migration([program]).plan)
    assert time is not None
    assert (time.low / 1000, time.high / 1000, time.unbounded) == (*said(program), ())


@pytest.mark.parametrize("program", sample(PROGRAMS, 4), ids=lambda path: str(path.stem))
def test_a_simulator_measures_passes_within_it(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    robosmi.migrate([program], tmp_path / "out", bind={"P26": "D12"} | ports_of(program))
    events = run("simulate", tmp_path / "out", "--seconds", "4", "--json", "--engine", "simavr").result["events"]
    times = [e["t_us"] / 1000 for e in events if e["pin"] == "D12"]
    passes = [b - a for a, b in pairwise(times[1:])]
    low, high = said(program)
    assert len(passes) > 5
    assert min(passes) >= low * 0.99
    assert max(passes) <= high * 1.02 + 2  # and what is computed


def ports_of(program: Path) -> dict[str, str]:
    """Pins for the other ports of a program."""
    bindings = plan_migration([program]).plan.portBindings
    return {b.name: f"D{number}" for number, b in enumerate((b for b in bindings if b.name != "P26"), 4)}


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ("getChar();", ["getChar"]),
        ("while (input(3));", ["the while loop"]),
        ("pause(input(3));", ["pause"]),
        ("drive_goto(1, 1);", ["drive_goto"]),
        ("for (int i = 0; i < input(3); i++) pause(5);", ["the for loop"]),
        ("extern void (*task)(void); task();", ["the function behind task"]),
        ("extern void (*tasks[3])(void); tasks[1]();", ["the function behind tasks"]),
        ("pause(5);", []),
        ("int i = 0; while (i < 5) i++;", []),
    ],
)
def test_a_wait_for_what_comes_from_outside_has_no_bound_and_is_named(body: str, names: list[str], tmp_path: Path) -> None:
    program = tmp_path / "robot.c"
    program.write_text(f'#include "simpletools.h"\n#include "abdrive.h"\nint main() {{ while (1) {{ {body} }} }}\n')
    time = loop_time(plan_migration([program]).plan)
    assert time is not None
    assert [wait.what for wait in time.unbounded] == names


def test_a_program_that_runs_once_has_no_pass(tmp_path: Path) -> None:
    program = tmp_path / "robot.c"
    program.write_text('#include "simpletools.h"\nint main() { pause(1000); }\n')
    assert loop_time(plan_migration([program]).plan) is None


def test_a_function_that_calls_itself_has_no_bound_where_it_waits(tmp_path: Path) -> None:
    program = tmp_path / "robot.c"
    program.write_text(
        '#include "simpletools.h"\nvoid again(int n) { pause(10); if (n) again(n - 1); }\nint main() { while (1) again(3); }\n'
    )
    time = loop_time(plan_migration([program]).plan)
    assert time is not None
    assert (time.low, time.high, [wait.what for wait in time.unbounded]) == (10_000, 10_000, ["again"])
    program.write_text(program.read_text().replace("pause(10)", "n++"))
    assert loop_time(plan_migration([program]).plan) == Time()
