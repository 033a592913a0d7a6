"""What a compiler says where the machine let it down, and what it says of a program."""

from __future__ import annotations

import signal
import subprocess
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.verify.toolchains.machine_faults import check_machine
from robosmi.verify.toolchains.tools import run
from tests.tools import require_tools

LET_DOWN = {
    "cc1plus: fatal error: error writing to /tmp/ccA.s: No space left on device": "No space left on device",
    "a.cpp:7:1: fatal error: error writing to /tmp/ccA.s: No space left on device": "No space left on device",
    "/tmp/ccA.s: Fatal error: can't write 76 bytes to section .text of a.o: 'No space left on device'": "No space left on device",
    "/usr/bin/ld: final link failed: No space left on device": "No space left on device",
    "Cannot create temporary file in /tmp/: Read-only file system": "Read-only file system",
    "virtual memory exhausted: Cannot allocate memory": "Cannot allocate memory",
    "avr-g++: internal compiler error: Killed (program cc1plus)": "Killed",
    "gcc: fatal error: Killed signal terminated program cc1": "Killed",
}


@pytest.mark.parametrize("said", LET_DOWN)
@pytest.mark.parametrize("before", ["", "a.c:3:1: warning: unused\n    3 | int a;\n"])
def test_a_fault_of_the_machine_is_told_with_its_cause(said: str, before: str) -> None:
    with pytest.raises(SourceError, match=LET_DOWN[said]) as caught:
        check_machine("/usr/bin/avr-g++", subprocess.CompletedProcess([], 1, "", f"{before}{said}\ncompilation terminated.\n"))
    assert "'avr-g++'" in caught.value.message
    assert caught.value.location is not None
    assert caught.value.fix
    assert caught.value.exit_code == 3


def test_a_compiler_that_is_ended_from_outside_is_told() -> None:
    with pytest.raises(SourceError, match="'cc': the system ended it: Killed"):
        check_machine("cc", subprocess.CompletedProcess([], -signal.SIGKILL, "", ""))


@pytest.mark.parametrize(
    "said", ["a.c:1:2: error: expected ';'", "gcc: internal compiler error: Segmentation fault (program cc1)"]
)
def test_a_fault_of_a_program_is_left_to_the_caller(said: str) -> None:
    done = subprocess.CompletedProcess([], 1, "", said)
    assert check_machine("cc", done) is done


@pytest.mark.parametrize("tool", ["avr-gcc", "gcc"])
@pytest.mark.parametrize(
    "line",
    [
        "#error disk: No space left on device",
        '_Static_assert(0, "disk: No space left on device");',
        '#include "disk: No space left on device"',
        '__asm__(".error \\"disk: No space left on device\\"");',
        "#error x: fatal error: Killed (program cc1)",
    ],
)
def test_a_program_may_use_the_words_of_the_system(tool: str, line: str, tmp_path: Path) -> None:
    require_tools(tool)
    (tmp_path / "a.c").write_text("\n" * 12345 + line + "\n")
    done = run([tool, "-c", "a.c", "-o", "a.o"], tmp_path, {"LC_ALL": "C", "PATH": "/usr/bin:/bin"})
    assert done.returncode != 0
    assert check_machine(tool, done) is done
