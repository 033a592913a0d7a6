"""Compilers that a stranger's text makes grow are stopped, with the cause."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from robosmi import inputs
from robosmi.errors import VerificationError
from robosmi.verify.toolchains import tools
from robosmi.verify.toolchains.tools import FILE_MB, MEMORY_MB, PROCESSOR_S, exceeded, run
from tests.tiers import sample
from tests.tools import require_tools

TEMPLATES = """
template <int A, int B> struct F { static constexpr int v = F<A - 1, B>::v + F<A - 1, B + 1>::v; };
template <int B> struct F<0, B> { static constexpr int v = B; };
int made = F<880, 0>::v;
"""
ALL = frozenset(["RLIMIT_AS", "RLIMIT_CPU", "RLIMIT_FSIZE"])

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="only Linux enforces the limits")


@pytest.mark.parametrize(
    ("text", "allowed"),
    sample([
        (TEMPLATES, f"{MEMORY_MB} MB of memory"),
        ('asm(".space 1000000000, 1");', f"{FILE_MB} MB in a file"),
        ("constexpr int f(int n) { return n < 2 ? 1 : f(n - 1) + f(n - 2); } int made = f(60);", f"{PROCESSOR_S} s of processor"),
    ], 1),
    ids=["memory", "file", "time"],
)  # fmt: skip
def test_a_compiler_that_grows_is_stopped(text: str, allowed: str, tmp_path: Path) -> None:
    require_tools("g++")
    path = tmp_path / "made.cpp"
    path.write_text(text)
    more = ["-fconstexpr-ops-limit=1000000000000", "-fconstexpr-loop-limit=1000000000"]
    with pytest.raises(VerificationError) as caught:
        run(["g++", *more, "-c", str(path), "-o", str(tmp_path / "made.o")], tmp_path)
    assert allowed in caught.value.message
    assert caught.value.fix


def test_what_a_compiler_starts_is_limited_too(tmp_path: Path) -> None:
    tells = "import resource; print(resource.getrlimit(resource.RLIMIT_AS)[0])"
    started = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {tells!r}])"
    done = run([sys.executable, "-c", f"import time; time.sleep(0.2); {started}"], tmp_path)
    assert int(done.stdout) == MEMORY_MB << 20


def test_a_compiler_that_waits_for_a_pipe_is_stopped(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tools, "_LOOK_S", 0.03)
    os.mkfifo(pipe := tmp_path / "pipe.h")
    opens = f"open({str(pipe)!r})"
    waits = f"import subprocess, sys; subprocess.run([sys.executable, '-S', '-c', {opens!r}])"
    with inputs.read_once(), pytest.raises(VerificationError, match="waited for a named pipe or a device"):
        run([sys.executable, "-S", "-c", waits], tmp_path, limit_s=60)


def test_a_compiler_that_works_does_not_wait(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tools, "_LOOK_S", 0.01)
    works = "import time\nwhile time.process_time() < 0.2: pass\nprint('done')"
    with inputs.read_once():
        assert run([sys.executable, "-S", "-c", works], tmp_path).stdout == "done\n"


def test_an_uploader_may_wait_for_its_board(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tools, "_LOOK_S", 0.01)
    assert run([sys.executable, "-S", "-c", "import time; time.sleep(0.2)"], tmp_path, reads_files=False).returncode == 0


@pytest.mark.parametrize(
    "said", ["a.cpp:3:2: error: #error out of memory", "    3 | #error out of memory", "the compiler says nothing of the kind"]
)
def test_a_program_that_speaks_of_memory_is_no_limit(said: str) -> None:
    assert exceeded(ALL, 1, said) == ""
    assert exceeded(ALL, 1, f"{said}\ncc1plus: out of memory allocating 65536 bytes") == f"{MEMORY_MB} MB of memory"
    assert exceeded(frozenset(), 1, "cc1plus: out of memory allocating 65536 bytes") == ""
    assert exceeded(ALL, 0, "cc1plus: out of memory allocating 65536 bytes") == ""
