"""Inline assembler of the source leaves the program as comments and tasks; what any microcontroller takes stays."""

from __future__ import annotations

from pathlib import Path

import robosmi
from robosmi.metamodels import migration
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.tools import require_tools

PROGRAM = Path(__file__).parent / "programs" / "source_assembler.c"


def test_assembler_is_a_construct_that_is_not_supported_and_a_task(tmp_path: Path) -> None:
    made = robosmi.migrate([PROGRAM], tmp_path)
    left = [d for d in made.models.plan.dispositions if "source-assembler" in d.rules]
    assert sorted(d.element.line for d in left if d.element is not None) == [8, 9, 16, 22]
    assert {d.action for d in left} == {migration.Action.unsupported}
    tasks = [(task.line, task.message.partition(":")[0]) for task in made.models.plan.tasks if task.rule == "RS503"]
    assert sorted(tasks) == [
        (8, "assembler was left out (2 pieces, the first here)"),
        (16, "assembler in 'bits' was left out (2 pieces, the first here)"),
    ]


def test_its_text_stays_as_a_comment(tmp_path: Path) -> None:
    robosmi.migrate([PROGRAM], tmp_path)
    text = (tmp_path / "source_assembler" / "source_assembler.ino").read_text()
    assert "/* _dat_(   max     counter, #8   ) */;" in text
    assert "/ * its pins * /" in text
    assert "/* wait_at(t); */;" in text
    assert '\n    __asm__("nop");\n    __asm__ volatile("" ::: "memory");\n' in text
    assert "extern void other_core(void *place) {\n" in text


def test_the_rest_of_the_program_compiles(tmp_path: Path) -> None:
    require_tools("avr-gcc", "arduino-core-avr")
    robosmi.migrate([PROGRAM], tmp_path)
    assert compile_sketch(tmp_path / "source_assembler", "uno").ok


def test_a_program_of_plain_c_has_no_such_assembler_either(tmp_path: Path) -> None:
    robosmi.migrate([PROGRAM], tmp_path, target="avr-c")
    assert "/* wait_at(t); */;" in (tmp_path / "source_assembler" / "source_assembler.c").read_text()
