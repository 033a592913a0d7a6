"""Programs that attack this machine: none has an effect outside of its sandbox, and a bad end is a result of the run."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

import pytest
from msgspec.structs import replace

from robosmi.errors import VerificationError
from robosmi.transformations.verification.originals import original_program
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_coverage import coverage
from robosmi.verify.original_run import run_original
from robosmi.verify.sandbox import Launcher
from tests.fuzz import native
from tests.host_model.attacked import ATTACKS, EFFECTS, Judge, judge
from tests.host_model.bench import model
from tests.tools import require_tools

CALLS = "it calls the operating system, which is not allowed"


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


@pytest.fixture
def judged() -> Iterator[Judge]:
    with tempfile.TemporaryDirectory(prefix="at-") as place, judge(Path(place)) as found:
        yield found


def built(judged: Judge, attack: str, tmp_path: Path, effect: int, effects: int = len(EFFECTS)) -> OriginalProgram:
    folder, source = tmp_path / "built", tmp_path / "source"
    for each in (folder, source):
        shutil.rmtree(each, ignore_errors=True)
        each.mkdir()
    return original_program([judged.source(ATTACKS / f"{attack}.c", source, effect, effects)], model(), folder)


RECORDS = "it writes into the host model's pipe"
TEXT = "the program has assembler text that cannot be compiled on this machine"
KIND = "the program has a kind of symbol that its platform does not have"
HARMLESS = "finished"
"""What an attack tries never runs."""
OUTCOMES = {
    "absolute_symbols": CALLS,
    "aliases_of_the_c_library": HARMLESS,
    "code_of_init": HARMLESS,
    "code_on_the_stack": "goes on where no code is, as after a value was put beyond the end of a local array",
    "common_data": CALLS,
    "constructor": CALLS,
    "constructor_with_priority": CALLS,
    "ctors": CALLS,
    "data_of_the_c_library": HARMLESS,
    "data_of_threads": CALLS,
    "debug_sections": CALLS,
    "destructor": HARMLESS,
    "dtors": HARMLESS,
    "fini_array": HARMLESS,
    "fork_of_the_coverage": "__gcov_fork",
    "group_of_the_c_library": HARMLESS,
    "hidden_and_protected": HARMLESS,
    "ignores_signals": CALLS,
    "in_main": CALLS,
    "includes_a_file": f"{TEXT}: '.include'",
    "init_array_by_name": CALLS,
    "interpreter": "the program has a section that cannot be linked on this machine: '.dynamic'",
    "labels_of_the_assembler": HARMLESS,
    "linked_once": HARMLESS,
    "linker_symbols": "the program defines names that its compiler uses: _GLOBAL_OFFSET_TABLE_",
    "memory_that_becomes_code": CALLS,
    "much_data": "the program's data are 107374",
    "names_of_the_compiler": "the program defines names that its compiler uses: __sanitizer_cov_trace_pc",
    "names_of_the_coverage": "the program defines names that its compiler uses: __gcov_init",
    "names_of_the_model": HARMLESS,
    "names_with_lines": f"{TEXT}: '\"'",
    "names_with_spaces": f"{TEXT}: '\"'",
    "never_reads": RECORDS,
    "optimiser_of_links": "the program cannot be compiled on this machine",
    "preinit_array": CALLS,
    "reads_a_file": f"{TEXT}: '.incbin'",
    "reads_a_file_behind_a_string": f"{TEXT}: '.incbin'",
    "reads_a_file_behind_a_type": f"{TEXT}: '.incbin'",
    "reads_a_file_by_a_label": f"{TEXT}: '.incbin'",
    "reads_a_file_by_a_macro": f"{TEXT}: '.macro'",
    "reads_a_file_by_a_section": f"{TEXT}: '.incbin'",
    "resolver": KIND,
    "resolver_for_the_c_library": KIND,
    "sections_of_the_c_library": HARMLESS,
    "sections_of_the_model": "the program uses a section of the host model",
    "sends_a_huge_end": RECORDS,
    "spins": "running",
    "start_of_the_program": HARMLESS,
    "symbols_of_every_kind": KIND,
    "takes_all_memory": "reaches for memory that is not there",
    "unique_symbols": CALLS,
    "versioned_symbols": "the program has a name that is not a C identifier: 'write@@GLIBC_2.0'",
    "waits_for_ever": "it waits forever",
    "weak_functions_of_the_c_library": HARMLESS,
    "writable_code": "the program has writable code",
    "writes_garbage": RECORDS,
}
"""Attack -> how its run ends, or why it is not run: the beginning of the text."""


def test_each_attack_has_an_outcome() -> None:
    assert sorted(OUTCOMES) == sorted(path.stem for path in ATTACKS.glob("*.c"))


@pytest.mark.parametrize("attack", OUTCOMES)
def test_an_attack_has_no_effect(attack: str, judged: Judge, tmp_path: Path) -> None:
    effect = list(OUTCOMES).index(attack) % len(EFFECTS)
    try:
        program = built(judged, attack, tmp_path, effect)
    except VerificationError as error:
        outcome = error.message
    else:
        run = run_original(program, 100_000, limit_s=1.0)
        outcome = run.cause or run.status
        coverage(program, [run.counts])
    assert judged.seen(tmp_path / "built") == []
    assert outcome.startswith(OUTCOMES[attack])


@pytest.mark.parametrize("effect", range(len(EFFECTS)), ids=EFFECTS)
def test_no_effect_gets_out_of_the_sandbox(effect: int, judged: Judge, tmp_path: Path) -> None:
    program = built(judged, "constructor_with_priority", tmp_path, effect, 1)
    run = run_original(program, 100_000)
    assert (run.status, run.cause) == ("crashed", CALLS)
    assert judged.seen(program.binary) == []


@pytest.mark.parametrize("effect", [n for n, name in enumerate(EFFECTS) if name != "start again"])
def test_the_judge_sees_each_effect_of_a_program_without_a_sandbox(effect: int, judged: Judge, tmp_path: Path) -> None:
    program = built(judged, "constructor_with_priority", tmp_path, effect, 1)
    script = tmp_path / "no-sandbox"
    script.write_text('#!/bin/sh\nexec "$4"\n')
    script.chmod(0o755)
    run_original(replace(program, launcher=Launcher(script)), 100_000, limit_s=1.0)
    assert judged.seen(program.binary)


@pytest.mark.parametrize(
    "name",
    [
        "425, 8, (int)room, 0",  # io_uring_setup
        "356, (int)PLACE, 0, 0",  # memfd_create
        "374, 1, 0, 0",  # userfaultfd
        '5, (int)"/proc/self/mem", 2, 0',
        '295, -100, (int)"/proc/self/fd/1", 1',  # openat
        "54, 0, 0x541B, (int)room",  # ioctl of its own pipe
        "55, 1, 4, 04000",  # fcntl: make the pipe non-blocking
        "42, (int)room, 0, 0",  # pipe
        "348, VICTIM, (int)room, 1",  # process_vm_writev
        "434, VICTIM, 0, 0",  # pidfd_open
        "270, VICTIM, VICTIM, 10",  # tgkill
        "120, 0x11, 0, 0",  # clone
        "357, 0, (int)room, 8",  # bpf
        "336, (int)room, 0, -1",  # perf_event_open
        "354, 1, 0, (int)room",  # seccomp: a filter of its own
        "172, 22, 0, 0",  # prctl
        "4, 2, (int)PLACE, 1",  # write to another descriptor
        "3, 1, (int)room, 1",  # read from the wrong pipe
    ],
)
def test_a_call_that_a_run_does_not_need_ends_the_program(name: str, judged: Judge, tmp_path: Path) -> None:
    attack = tmp_path / "calls.c"
    attack.write_text(
        f'#include "attack.h"\nstatic int room[64];\nvoid high(int pin);\nint main(void) {{ call({name}); high(3); return 0; }}\n'
    )
    (tmp_path / "source").mkdir()
    (tmp_path / "made").mkdir()
    source = judged.source(attack, tmp_path / "source", 0)
    program = original_program([source], model(), tmp_path / "made")
    run = run_original(program, 100_000, limit_s=2.0)
    assert (run.status, run.cause) == ("crashed", "it calls the operating system, which is not allowed")
    assert not run.trace.levels("P3")
    assert judged.seen(tmp_path / "made") == []


@pytest.mark.parametrize("number", range(0, 200, 20))
def test_a_variation_of_an_attack_has_no_effect(number: int) -> None:
    with tempfile.TemporaryDirectory(prefix="at-") as place:
        outcome, seen = native.ended(number, Path(place))
    assert seen == []
    assert not outcome.startswith("FAILURE"), f"{outcome}\n{native.variation(number)}"
