"""The sandbox of the original: that it stands before the program starts, what it needs of the kernel, and how it ends."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from time import monotonic, sleep

import pytest

from robosmi.verify.elf_reader import DYNAMIC, EXECUTE, INTERPRETER, LOADED, STACK, WRITE, read_elf
from robosmi.verify.original_build import OriginalProgram, build_original
from tests.host_model.bench import built, model
from tests.tools import require_tools, require_verification

ENDLESS = "int main() { volatile int n; while (1) n++; }"

WITHOUT_SECCOMP = """
import ctypes, struct, sys
def step(code, k, yes=0, no=0):
    return struct.pack("HBBI", code, yes, no, k)
LOAD, EQUAL, RETURN, ALLOW, INVALID = 0x20, 0x15, 0x06, 0x7FFF0000, 0x50016
steps = [  # prctl(PR_SET_SECCOMP) and seccomp() fail, as on a kernel without them
    step(LOAD, 0), step(EQUAL, 317, 3, 0), step(EQUAL, 157, 0, 3), step(LOAD, 16), step(EQUAL, 22, 0, 1), step(RETURN, INVALID),
    step(RETURN, ALLOW),
]
text = b"".join(steps)
filter_text = ctypes.create_string_buffer(text, len(text))
library = ctypes.CDLL(None, use_errno=True)
assert library.prctl(38, 1, 0, 0, 0) == 0
assert library.prctl(22, 2, struct.pack("HxxxxxxP", len(steps), ctypes.addressof(filter_text)), 0, 0) == 0
"""
"""Lets this process, and all that it starts, have no filter of system calls of their own."""

BUILDS = """
from pathlib import Path
from robosmi.errors import MissingToolError
from robosmi.verify.host_model import load_host_model
from robosmi.verify.original_build import build_original
from robosmi.verify.original_run import run_original
source, folder, model = Path(sys.argv[1]), Path(sys.argv[2]), load_host_model("propeller")
try:
    build_original([source], model, folder)
except MissingToolError as error:
    print(error.exit_code, error.message, error.fix)
print(run_original(build_original([source], model, folder, trusted=True), 10_000).status)
"""


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def test_the_program_loads_nothing_else_and_has_no_code_that_it_can_write() -> None:
    with built(ENDLESS) as program:
        elf = read_elf(program.binary.read_bytes())
    assert {segment.kind for segment in elf.segments}.isdisjoint({DYNAMIC, INTERPRETER})
    loaded = [segment for segment in elf.segments if segment.kind in (LOADED, STACK)]
    assert len(loaded) > 2
    assert all(not (segment.flags & WRITE and segment.flags & EXECUTE) for segment in loaded)


@contextmanager
def started(program: OriginalProgram, close_fds: bool = True) -> Iterator[subprocess.Popen[bytes]]:
    """The process of a program that waits for its settings, once it has replaced the launcher."""
    with subprocess.Popen(
        program.launcher.command(program.binary, 5), stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        start_new_session=True, close_fds=close_fds,
    ) as process:  # fmt: skip
        try:
            until = monotonic() + 20
            while os.readlink(f"/proc/{process.pid}/exe") != str(program.binary) and monotonic() < until:
                sleep(0.01)
            yield process
        finally:
            process.kill()


def test_the_program_has_its_two_pipes_and_all_limits() -> None:
    inherited, other = os.pipe()
    os.set_inheritable(inherited, True)
    try:
        with built(ENDLESS) as program, started(program, close_fds=False) as process:
            place = Path(f"/proc/{process.pid}")
            assert sorted(path.name for path in (place / "fd").iterdir()) == ["0", "1"]
            status = dict(line.split(":\t", 1) for line in (place / "status").read_text().splitlines() if ":\t" in line)
            assert (status["Seccomp"].strip(), status["NoNewPrivs"].strip(), status["Threads"].strip()) == ("2", "1", "1")
            limits = {line[:26].strip(): line[26:].split()[:2] for line in (place / "limits").read_text().splitlines()}
    finally:
        os.close(inherited)
        os.close(other)
    assert limits["Max cpu time"] == ["5", "6"]
    assert limits["Max address space"] == [str(1 << 28)] * 2
    assert limits["Max file size"] == limits["Max processes"] == limits["Max locked memory"] == ["0", "0"]


def test_the_program_ends_with_the_process_that_started_it(tmp_path: Path) -> None:
    source, folder = tmp_path / "program.c", tmp_path / "built"
    source.write_text(ENDLESS)
    folder.mkdir()
    program = build_original([source], model(), folder)
    code = (
        "import os, subprocess, sys, time\n"
        "words = [sys.argv[1], str(os.getpid()), *sys.argv[3:]]\n"
        "print(subprocess.Popen(words, stdin=subprocess.PIPE, start_new_session=True).pid, flush=True)\ntime.sleep(100)"
    )
    words = [sys.executable, "-c", code, *program.launcher.command(program.binary, 50)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        place = Path(f"/proc/{int(parent.stdout.readline())}/exe")
        until = monotonic() + 20
        while os.readlink(place) != str(program.binary) and monotonic() < until:
            sleep(0.01)
        parent.send_signal(signal.SIGKILL)
        parent.wait()
        while place.exists() and monotonic() < until:
            sleep(0.01)
    assert not place.exists()


def test_a_kernel_without_filters_is_refused_unless_the_program_is_trusted(tmp_path: Path) -> None:
    source, folder = tmp_path / "program.c", tmp_path / "built"
    source.write_text("int main() { return 0; }\n")
    folder.mkdir()
    words = [sys.executable, "-c", WITHOUT_SECCOMP + BUILDS, str(source), str(folder)]
    refused, ended = subprocess.run(words, capture_output=True, text=True, check=True).stdout.splitlines()
    assert refused.startswith("4 this system cannot run a program in a sandbox; missing: filters of system calls: seccomp")
    assert "robosmi verify --trust-original" in refused
    assert ended == "finished"


def test_verify_refuses_on_such_a_kernel(tmp_path: Path) -> None:
    require_verification("simavr")
    (tmp_path / "blink.c").write_text('#include "simpletools.h"\nint main() { high(3); pause(20); low(3); }\n')
    run = "from robosmi.cli.main import main\nsys.exit(main(sys.argv[1:]))"
    environment = {**os.environ, "ROBOSMI_HOME": str(tmp_path / "home")}

    def robosmi(*words: str) -> subprocess.CompletedProcess[str]:
        command = [sys.executable, "-c", WITHOUT_SECCOMP + run, *words]
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path, env=environment)

    assert robosmi("migrate", "blink.c", "-o", "OUT", "--yes", "--bind", "P3=D9").returncode in (0, 1)
    done = robosmi("verify", "OUT", "--json")
    assert done.returncode == 4
    finding = json.loads(done.stdout)["findings"][-1]
    assert "seccomp" in finding["message"]
    assert "--trust-original" in finding["fix"]
    assert robosmi("verify", "OUT", "--json", "--trust-original").returncode == 0
