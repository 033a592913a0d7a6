"""No small input ends a command by a signal, or takes more than 10 s of processor time or 500 MB.

Each command runs in a process of its own, with these limits; how cost grows is `test_growth`'s.
"""

from __future__ import annotations

import resource
import subprocess
import sys
from pathlib import Path

import pytest

from tests.growing import FAMILIES

SECONDS, MEGABYTES = 10, 500
NAMES = (
    "terms",
    "commas within brackets",
    "loops within loops",
    "labels before one statement",
    "structures within structures",
    "operators in a condition",
    "brackets in a condition",
    "lists within lists",
)
"""Families that a parser with a stack of 8 MB cannot take, or one with 500 MB, unless somebody bounds them."""
_CODE = """
import re, sys
from robosmi.cli.main import main
code = main(sys.argv[1:])
print(int(re.search(r"VmHWM:\\s+(\\d+)", open("/proc/self/status").read())[1]) // 1024, file=sys.stderr)
sys.exit(code)
"""
"""Runs a command and tells the most memory it had; `ru_maxrss` would tell that of this process where it is more."""


def _limited() -> None:
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))


@pytest.mark.processes
@pytest.mark.parametrize("name", NAMES)
def test_a_small_input_costs_little(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    family = next(each for each in FAMILIES if each.name == f"{name}: migrate")
    words = [str(word) for word in family.make(tmp_path, family.size)]
    assert (tmp_path / "program.c").stat().st_size < 100_000
    done = subprocess.run([sys.executable, "-c", _CODE, *words], capture_output=True, text=True, preexec_fn=_limited)
    assert done.returncode in (0, 1), done.stderr[-500:]
    assert int(done.stderr.split()[-1]) < MEGABYTES
