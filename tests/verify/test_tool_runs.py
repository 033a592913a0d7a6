"""Runs of compilers: ended after a time, with all that they have started, and nothing of theirs left."""

from __future__ import annotations

import os
import sys
import tempfile
import time
from pathlib import Path

import pytest

from robosmi.errors import MissingToolError, VerificationError
from robosmi.verify.toolchains.tools import run
from tests.running import alive
from tests.tools import require_tools

PARENT = """
import subprocess, sys, tempfile
child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
open(sys.argv[1], "w").write(f"{child.pid} {tempfile.gettempdir()}")
child.wait()
"""

pytestmark = pytest.mark.processes


def test_what_a_tool_started_ends_with_it_and_its_temporary_folder_goes(tmp_path: Path) -> None:
    told = tmp_path / "told"
    with pytest.raises(VerificationError, match="exceeded 2 s"):
        run([sys.executable, "-c", PARENT, str(told)], limit_s=2)
    child, folder = told.read_text().split()
    assert folder != tempfile.gettempdir()
    assert not Path(folder).exists()
    for _ in range(50):
        if not alive(int(child)):
            break
        time.sleep(0.1)
    assert not alive(int(child))


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("line", ['#include "{}"', '__asm__(".incbin \\"{}\\"");'])
def test_a_compiler_that_reads_a_pipe_is_ended(line: str, tmp_path: Path) -> None:
    require_tools("avr-gcc")
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "a.c").write_text(line.format(tmp_path / "pipe") + "\n")
    begun = time.monotonic()
    with pytest.raises(VerificationError, match="'avr-gcc' exceeded"):
        run(["avr-gcc", "-c", "a.c", "-o", "a.o"], tmp_path, limit_s=2)
    assert time.monotonic() - begun < 20


def test_output_and_state_of_a_tool_are_told() -> None:
    done = run([sys.executable, "-c", "import sys; print('said'); sys.exit('wrong')"])
    assert (done.returncode, done.stdout.strip(), done.stderr.strip()) == (1, "said", "wrong")


def test_a_tool_that_is_not_there_is_named() -> None:
    with pytest.raises(MissingToolError, match="'no-such-compiler' cannot be started"):
        run(["no-such-compiler"])
