"""What a command does at its start: it loads nothing that it does not use, and leaves the process of a caller as it is."""

from __future__ import annotations

import gc
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from robosmi.cli.main import main

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "docs" / "examples" / "line_follower"
CODE = """
import json, sys
from robosmi.__main__ import start
code = start()
import gc
print(json.dumps({"code": code, "modules": sorted(sys.modules), "threshold": gc.get_threshold()}), file=sys.stderr)
"""
LONG_TO_LOAD = {
    "pyecore.resources", "ssl", "urllib.request", "networkx", "numpy", "asyncio", "email", "html", "filelock", "difflib",
}  # fmt: skip

ENDING = """
import atexit, threading, time
from robosmi.__main__ import command
atexit.register(print, "registered")
def later():
    time.sleep(0.5)
    print("thread")
if {threads}:
    threading.Thread(target=later).start()
command()
"""


@pytest.mark.parametrize("threads", [False, True])
@pytest.mark.parametrize(("words", "code"), [(["--version"], 0), (["hardware", "nowhere.fzz"], 3)])
def test_what_is_registered_for_the_end_of_the_process_and_threads_are_done(words: list[str], code: int, threads: bool) -> None:
    done = subprocess.run(
        [sys.executable, "-c", ENDING.format(threads=threads), *words], capture_output=True, text=True, cwd=ROOT
    )
    assert done.returncode == code
    assert done.stdout.split()[-1 - threads :] == (["thread"] if threads else []) + ["registered"]


@pytest.mark.parametrize(
    "words",
    [
        ["migrate", str(EXAMPLE / "line_follower.c"), "-o", "{out}"],
        ["hardware", str(EXAMPLE / "line_following_robot.fzz")],
        ["analyse", str(EXAMPLE / "line_follower.c")],
    ],
    ids=["migrate", "hardware", "analyse"],
)
def test_a_command_loads_nothing_heavy_that_it_does_not_use(words: list[str], tmp_path: Path) -> None:
    words = [word.format(out=tmp_path / "out") for word in words]
    environment = {**os.environ, "ROBOSMI_HOME": str(tmp_path / "home")}
    done = subprocess.run([sys.executable, "-c", CODE, *words], capture_output=True, text=True, cwd=ROOT, env=environment)
    told = json.loads(done.stderr.splitlines()[-1])
    assert told["code"] == 0
    assert LONG_TO_LOAD & set(told["modules"]) == set()
    assert told["threshold"][0] > 10_000


def test_a_caller_keeps_its_own_garbage_collection(capsys: pytest.CaptureFixture[str]) -> None:
    before = gc.get_threshold()
    assert main(["hardware", str(EXAMPLE / "line_following_robot.fzz")]) == 0
    assert gc.get_threshold() == before
    assert capsys.readouterr().out
