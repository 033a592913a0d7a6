"""What a command does at its start: it loads nothing that it does not use, and leaves the process of a caller as it is."""

from __future__ import annotations

import gc
import json
import os
import subprocess
import sys
from hashlib import sha256
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


def test_a_migration_gives_the_same_with_and_without_a_cache(tmp_path: Path) -> None:
    """Nothing is written into the installation, so that it may be read-only."""
    (tmp_path / "file").touch()
    found = []
    before = files_of(ROOT / "platform_repo")
    for number, cache in enumerate([tmp_path / "file", tmp_path / "cache", tmp_path / "cache"]):
        output = tmp_path / str(number) / "out"
        words = [sys.executable, "-m", "robosmi", "migrate", str(EXAMPLE / "line_follower.c"), "-o", str(output)]
        environment = {**os.environ, "ROBOSMI_HOME": str(tmp_path / f"home{number}"), "XDG_CACHE_HOME": str(cache)}
        subprocess.run(words, cwd=ROOT, env=environment, check=True, capture_output=True)
        found.append(files_of(output))
    assert found[0] == found[1] == found[2]
    assert files_of(ROOT / "platform_repo") == before
    assert {file.name for file in (tmp_path / "cache" / "robosmi").iterdir()} == {"adapters.json", "tables.json", "templates"}


def files_of(folder: Path) -> dict[str, str]:
    """The digest of each file in a folder, by its path there."""
    paths = (path for path in folder.rglob("*") if path.is_file() and path.suffix != ".pyc")
    return {path.relative_to(folder).as_posix(): sha256(path.read_bytes()).hexdigest() for path in paths}


def test_a_caller_keeps_its_own_garbage_collection(capsys: pytest.CaptureFixture[str]) -> None:
    before = gc.get_threshold()
    assert main(["hardware", str(EXAMPLE / "line_following_robot.fzz")]) == 0
    assert gc.get_threshold() == before
    assert capsys.readouterr().out
