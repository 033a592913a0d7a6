"""The memory that programs take, estimated from the models: of the program's variables as each says in its first line, and in sum
as the linker says it.
"""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.metamodels import migration
from robosmi.transformations.chains.migrate import plan_migration
from robosmi.transformations.queries.reports.board_needs import PinNeeds, board_needs, needs_in_words, shortages
from robosmi.transformations.queries.resources.memory import memory
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.corpus.memory_corpus import stack_bytes
from tests.tools import require_engine, require_tools

PROGRAMS = sorted((Path(__file__).parent / "memory").glob("*.c"))
BOUND = 0.1
"""How far the estimate may be from what the linker says."""


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: str(path.stem))
def test_the_variables_that_last_are_counted(program: Path) -> None:
    said = program.read_text().splitlines()[0].removeprefix("// bytes: ")
    assert memory(plan_migration([program]).plan).of_variables == sum(map(int, said.split(" + ")))


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: str(path.stem))
def test_the_linker_says_nearly_the_same(program: Path, tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    made = robosmi.migrate([program], tmp_path / "out")
    report = robosmi.compile_sketch(tmp_path / "out")
    assert report.ok
    assert memory(made.models.plan).total == pytest.approx(report.ram_bytes, rel=BOUND)


def test_a_text_is_counted_once_and_not_where_another_ends_with_it() -> None:
    found = memory(plan_migration([PROGRAMS[0].with_name("texts.c")]).plan)
    alone = memory(plan_migration([PROGRAMS[0].with_name("cogs.c")]).plan)
    assert found.texts >= len("a text that is said twice: %d\n") + 1
    assert found.texts < 2 * len("a text that is said twice: %d\n") + 70  # and what prints it
    assert alone.stacks > 0


def test_what_does_not_fit_is_said_before_it_is_compiled(tmp_path: Path) -> None:
    program = tmp_path / "big.c"
    program.write_text(
        '#include "simpletools.h"\nint samples[900];\nint main() { for (int i = 0; ; i++) samples[i % 900] += samples[i % 7]; }\n'
    )
    made = robosmi.migrate([program], tmp_path / "out")
    plan: Any = made.result()["plan"]
    needs = plan["needs"]["memory"]
    assert needs["variables"] == 3600
    assert needs["largest"][0] == {"name": "samples", "bytes": 3600, "line": 2}
    assert needs["estimated_bytes"] > needs["ram_bytes"] == 2048
    first = next(text for name, text in made.contents.items() if name.endswith("MIGRATION.md")).decode()
    assert "the board has 2048 ('samples' 3600" in first[: first.index("## ")]
    said = "'Arduino Mega 2560' may have enough"
    assert any("the board has 2048" in line and f"; {said}" in line for line in made.lines())
    assert said in first[: first.index("## ")]


def test_the_stack_is_still_said_when_the_program_is_compiled() -> None:
    plan = plan_migration([PROGRAMS[0].with_name("texts.c")]).plan
    before = board_needs(plan)
    stack = f"stack about {before.memory.depth} bytes"
    assert f"about {before.memory.total} of 2048 bytes, {stack}" in needs_in_words(before)
    plan.build = migration.Build(board="uno", flashBytes=4000, flashLimit=32256, ramBytes=300, ramLimit=2048)
    after = board_needs(plan)
    assert "RAM 300 of 2048 bytes (compiled)" in needs_in_words(after)
    assert stack in needs_in_words(after)
    assert not shortages(after)
    plan.build.ramBytes = 1900
    assert shortages(board_needs(plan)) == [
        f"the stack needs about {before.memory.depth} bytes, but only 148 of 2048 bytes of RAM are left; "
        "'Arduino Leonardo' may have enough"
    ]
    plan.build.ramBytes = 2560 - before.memory.depth - 1  # the models' stack alone would fit into the Leonardo
    assert shortages(board_needs(plan))[0].endswith("; 'Arduino Mega 2560' may have enough")


@pytest.mark.parametrize(
    ("used", "drawn", "wanted", "missing"), [(9, 7, 5, 0), (9, 7, 11, 0), (9, 7, 12, 1), (0, 0, 27, 7), (20, 0, 0, 0)]
)
def test_open_ports_may_take_drawn_pins_that_no_port_uses(used: int, drawn: int, wanted: int, missing: int) -> None:
    assert PinNeeds(20, used, drawn, wanted).missing == missing


def test_the_stack_that_a_simulator_sees_is_nearly_the_one_estimated(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    require_engine("simavr")
    program = tmp_path / "deep.c"
    program.write_text(
        '#include "simpletools.h"\n'
        "int sum(volatile char *p) { volatile char more[60]; for (int i = 0; i < 60; i++) more[i] = p[i]; return more[7]; }\n"
        "int filled(int value) { volatile char many[200]; for (int i = 0; i < 200; i++) many[i] = value; return sum(many); }\n"
        "int main() { while (1) { if (filled(input(3)) > 5) high(4); pause(5); } }\n"
    )
    made = robosmi.migrate([program], tmp_path / "out")
    seen = stack_bytes(compile_sketch(tmp_path / "out", keep=tmp_path), 0.1)
    assert seen is not None
    assert seen > 260
    assert memory(made.models.plan).depth == pytest.approx(seen, abs=60)


def test_the_name_of_a_constant_takes_no_stack(tmp_path: Path) -> None:
    depths = []
    for value in ("SMALL", "0"):
        program = tmp_path / f"text_{value}.c"
        program.write_text(f'#include "badgetools.h"\nint main(void) {{ badge_setup(); text_size({value}); }}\n')
        depths.append(memory(plan_migration([program]).plan).depth)
    assert depths[0] == depths[1]


def test_loops_within_loops_take_no_time_to_look_at(tmp_path: Path) -> None:
    program = tmp_path / "nested.c"
    loops = "".join(f"for (int i{n} = 0; i{n} < 3; i{n}++) " for n in range(25))
    program.write_text(f"int sum;\nint main() {{ {loops} {{ sum += i3; if (sum > i7) i9++; }} while (1); }}\n")
    plan = plan_migration([program]).plan
    begun = time.process_time()
    assert memory(plan).of_variables == 4
    assert time.process_time() - begun < 5


@pytest.mark.parametrize(
    ("statements", "timers", "contested"),
    [
        ("pwm_start(20000); pwm_set(9, 0, 1500); pwm_stop();", {"Timer1": ["pwm_set"]}, []),
        ("square_wave(5, 0, 1000); pause(5); square_wave_stop();", {"Timer2": ["square_wave"]}, []),
        ("square_wave(5, 0, 1000); freqout(4, 10, 3000);", {"Timer2": ["freqout", "square_wave"]}, ["Timer2"]),
        ("servo_angle(16, 900); drive_speed(9, 9); high(3);", {"Timer1": ["Servo"]}, []),
    ],
)
def test_functions_that_share_a_timer_are_one_taker(
    statements: str, timers: dict[str, list[str]], contested: list[str], tmp_path: Path
) -> None:
    program = tmp_path / "timers.c"
    headers = "".join(f'#include "{name}.h"\n' for name in ("simpletools", "servo", "abdrive"))
    program.write_text(f"{headers}int main() {{ {statements} }}\n")
    needs = board_needs(plan_migration([program]).plan)
    assert {timer.timer: list(timer.takers) for timer in needs.timers} == timers
    assert [said.split(" ")[0] for said in shortages(needs) if "is needed by" in said] == contested
