"""The bound of a program's stack, read off its machine code, against the stack that the simulator sees."""

from __future__ import annotations

from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.verification.jobs import job
from robosmi.transformations.verification.stack.machine_code import MachineCode
from robosmi.transformations.verification.stack.machine_stack import stack_bound
from robosmi.verify.simulation import simulate
from robosmi.verify.toolchains.compile_report import CompileReport, StackBound
from robosmi.verify.toolchains.toolchain import compile_sketch
from tests.corpus.memory_corpus import stack_room
from tests.tools import require_engine, require_tools

SKETCHES = Path(__file__).parent / "stacks"

LISTING = """
SYMBOL TABLE:
00800100 l     O .bss\t00000002 called
00800102 l     O .bss\t00000002 other

Disassembly of section .text:

00000010 <main>:
  10:\tpush\tr28
  12:\tlds\tr30, 0x0100\t; 0x800100 <called>
  16:\tlds\tr31, 0x0101\t; 0x800101 <called+0x1>
  1a:\ticall
  1c:\tpop\tr28
  1e:\tret

00000020 <near>:
  20:\tpush\tr2
  22:\trcall\t.+0      \t; 0x24 <near+0x4>
  24:\tret

00000030 <far>:
  30:\tpush\tr2
  32:\tpush\tr3
  34:\tpush\tr4
  36:\tpush\tr5
  38:\tret

00000040 <begin>:
  40:\tldi\tr24, 0x10\t; 16
\t\t\t40: R_AVR_LO8_LDI_GS\t.text+0x20
  42:\tldi\tr25, 0x00\t; 0
  44:\tsts\t0x0101, r25\t; 0x800101 <called+0x1>
  48:\tsts\t0x0100, r24\t; 0x800100 <called>
  4c:\tldi\tr24, 0x18\t; 24
\t\t\t4c: R_AVR_LO8_LDI_GS\tfar
  4e:\tldi\tr25, 0x00\t; 0
  50:\tsts\t0x0103, r25\t; 0x800103 <other+0x1>
  54:\tsts\t0x0102, r24\t; 0x800102 <other>
  58:\tlds\tr30, 0x0102\t; 0x800102 <other>
  5c:\tlds\tr31, 0x0103\t; 0x800103 <other+0x1>
  60:\tijmp
"""


def seen_stack(report: CompileReport, seconds: float) -> int:
    """The stack that a program takes on the simulator."""
    assert report.elf is not None
    assert report.hex is not None
    asked = job(report.elf, report.hex, load_board("uno"), seconds * 1e6)
    found = simulate(replace(asked, stack_room=stack_room(report.elf)), "simavr").stack_bytes
    assert found is not None
    return found


def bound_of(report: CompileReport) -> StackBound:
    """The bound that a report tells."""
    assert report.stack is not None
    return report.stack


def test_bound_is_what_the_simulator_sees_but_for_interrupts_that_did_not_come_at_the_deepest_place(tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    require_engine("simavr")
    report = compile_sketch(SKETCHES / "deep", keep=tmp_path)
    bound = bound_of(report)
    assert bound.certain
    assert 0 <= bound.bytes - seen_stack(report, 0.2) <= bound.interrupts
    assert bound.deepest[0] == "main"


def test_what_nobody_can_bound_is_named(tmp_path: Path) -> None:
    require_tools("avr-gcc", "avr-g++", "avr-size", "arduino-core-avr")
    bound = bound_of(compile_sketch(SKETCHES / "endless", keep=tmp_path))
    assert not bound.certain
    assert [name for name in bound.recursive if "again" in name]
    assert [name for name in bound.unknown if "computed" in name or name in ("main", "setup")]


def test_call_through_a_variable_reaches_what_is_kept_there_and_nothing_else() -> None:
    machine = MachineCode(LISTING)
    assert machine.reached_from(0x1A) == (0x20,)
    assert machine.reached_from(0x60) == (0x30,)
    bound = stack_bound(LISTING, "avr")
    assert bound is not None
    assert (bound.bytes, bound.deepest) == (2 + 1 + 2 + 3, ("main", "near"))


COMPUTED = """
00000080 <table>:
  80:\tsubi\tr28, 0xFE\t; 254
\t\t\t80: R_AVR_LO8_LDI_NEG\tother
  82:\tsbci\tr29, 0xFE\t; 254
  84:\tcall\t0x20\t; 0x20 <near>
  88:\tmovw\tr30, r28
  8a:\tsubi\tr30, 0xF8\t; 248
  8c:\tsbci\tr31, 0xFF\t; 255
  8e:\tldi\tr24, 0x18\t; 24
\t\t\t8e: R_AVR_LO8_LDI_GS\tfar
  90:\tldi\tr25, 0x00\t; 0
  92:\tstd\tZ+1, r25\t; 0x01
  94:\tst\tZ, r24
  96:\tret
"""


def test_what_is_kept_further_on_in_a_variable_is_called_through_that_one_alone() -> None:
    bound = stack_bound(LISTING + COMPUTED, "avr")
    assert bound is not None
    assert (bound.bytes, bound.deepest) == (2 + 1 + 2 + 3, ("main", "near"))
    lost = stack_bound(LISTING + COMPUTED.replace("movw\tr30, r28", "movw\tr30, r20"), "avr")
    assert lost is not None
    assert lost.deepest == ("main", "far")


CIRCLE = """
Disassembly of section .text:

00000010 <main>:
  10:\trcall\t.+14    \t; 0x20 <shows>
  12:\tret

00000020 <shows>:
  20:\tpush\tr2
  22:\trcall\t.+12    \t; 0x30 <through>
  24:\tret

00000030 <through>:
  30:\ticall
  32:\tret

00000040 <kept>:
  40:\trcall\t.-34    \t; 0x20 <shows>
  42:\tret

00000050 <begin>:
  50:\tldi\tr24, 0x20\t; 32
\t\t\t50: R_AVR_LO8_LDI_GS\tkept
  52:\tmovw\tr30, r24
  54:\tret
"""


def test_functions_call_themselves_where_all_calls_of_the_circle_are_sure() -> None:
    guessed = stack_bound(CIRCLE, "avr")
    assert guessed is not None
    assert guessed.recursive == ()
    sure = stack_bound(CIRCLE.replace("  30:\ticall", "  30:\trcall\t.+14    \t; 0x40 <kept>"), "avr")
    assert sure is not None
    assert sure.recursive == ("shows",)


def test_functions_call_the_next_for_as_long_as_they_like() -> None:
    count = 5000
    names = ["main", *(f"f{number}" for number in range(1, count))]
    listing = ["Disassembly of section .text:"]
    for number, name in enumerate(names):
        at = 0x10 + 6 * number
        listing += ["", f"{at:08x} <{name}>:", f" {at:x}:\tpush\tr28"]
        if number + 1 < count:
            listing.append(f" {at + 2:x}:\trcall\t.+2      \t; {at + 6:#x} <{names[number + 1]}>")
        listing.append(f" {at + 4:x}:\tret")
    bound = stack_bound("\n".join(listing), "avr")
    assert bound is not None
    assert bound.certain
    assert bound.bytes == 2 + count + 2 * (count - 1)
    assert bound.deepest == tuple(names)


@pytest.mark.parametrize(("text", "architecture"), [("", "avr"), (LISTING, "arm")])
def test_no_bound_without_main_or_for_another_processor(text: str, architecture: str) -> None:
    assert stack_bound(text, architecture) is None


HANDLERS = """
SYMBOL TABLE:
00800100 l     O .bss\t00000001 _ZZ4jobsvE9under_way
00800110 l     O .data\t00000008 _ZTV4Line

Disassembly of section .text:

00000010 <main>:
  10:\tpush\tr28
  12:\tcli
  14:\trcall\t.+58     \t; 0x50 <far>
  16:\tsei
  18:\trcall\t.+38     \t; 0x40 <_Z4jobsv>
  1a:\tin\tr0, 0x3f\t; 63
  1c:\tsbrs\tr0, 7
  1e:\trcall\t.+48     \t; 0x50 <far>
  20:\tret

00000030 <__vector_1>:
  30:\tpush\tr0
  32:\tsei
  34:\trcall\t.+10     \t; 0x40 <_Z4jobsv>
  36:\treti

00000040 <_Z4jobsv>:
  40:\tpush\tr2
  42:\trcall\t.+2      \t; 0x46 <job>
  44:\tret

00000046 <job>:
  46:\tpush\tr3
  48:\tpush\tr4
  4a:\tret

00000050 <far>:
  50:\tpush\tr2
  52:\tpush\tr3
  54:\tpush\tr4
  56:\tpush\tr5
  58:\tret

0000005a <__vector_2>:
  5a:\tpush\tr0
  5c:\tpush\tr1
  5e:\treti

00000060 <call>:
  60:\tmovw\tr26, r24
  62:\tld\tr30, X+
  64:\tld\tr31, X
  66:\tldd\tr0, Z+2\t; 0x02
  68:\tldd\tr31, Z+3\t; 0x03
  6a:\tmov\tr30, r0
  6c:\tijmp

Disassembly of section .data:

00800110 <_ZTV4Line>:
  800110:\t.word\t0x0000
\t\t\t800114: R_AVR_16_PM\tjob
\t\t\t800116: R_AVR_16_PM\tfar
"""


def test_interrupts_come_where_they_may_and_what_shuts_itself_is_there_once() -> None:
    bound = stack_bound(HANDLERS, "avr")
    assert bound is not None
    jobs = 1 + 2 + 2
    main = 2 + 1 + 2 + jobs  # `far`, which is deeper in main's own frame, is called where no interrupt comes, or not at all
    first, second = 2 + 1 + 2 + 1, 2 + 2  # the handler that lets others in finds the jobs shut, but for the first byte
    assert (bound.bytes, bound.interrupts) == (main + first + second, first + second)
    assert bound.deepest == ("main", "jobs", "job")
    twice = stack_bound(HANDLERS.replace("under_way", "other"), "avr")
    assert twice is not None
    assert twice.bytes == bound.bytes + 2 + 2


def test_virtual_call_reaches_the_functions_in_its_row_of_the_tables() -> None:
    assert MachineCode(HANDLERS).reached_from(0x6C) == (0x50,)
