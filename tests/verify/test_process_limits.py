"""Compilers that a stranger's text makes grow are stopped, with the cause."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from robosmi.errors import VerificationError
from robosmi.verify.toolchains.process_limits import FILE_MB, MEMORY_MB, PROCESSOR_S, exceeded
from robosmi.verify.toolchains.tools import run
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
    [
        (TEMPLATES, f"{MEMORY_MB} MB of memory"),
        ('asm(".space 1000000000, 1");', f"{FILE_MB} MB in a file"),
        ("constexpr int f(int n) { return n < 2 ? 1 : f(n - 1) + f(n - 2); } int made = f(60);", f"{PROCESSOR_S} s of processor"),
    ],
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


@pytest.mark.parametrize(
    "said", ["a.cpp:3:2: error: #error out of memory", "    3 | #error out of memory", "the compiler says nothing of the kind"]
)
def test_a_program_that_speaks_of_memory_is_no_limit(said: str) -> None:
    assert exceeded(ALL, 1, said) == ""
    assert exceeded(ALL, 1, f"{said}\ncc1plus: out of memory allocating 65536 bytes") == f"{MEMORY_MB} MB of memory"
    assert exceeded(frozenset(), 1, "cc1plus: out of memory allocating 65536 bytes") == ""
    assert exceeded(ALL, 0, "cc1plus: out of memory allocating 65536 bytes") == ""
