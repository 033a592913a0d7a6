"""A command opens each file of toolchains and boards once, however many of its steps read them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from tests.running import run
from tests.tools import require_tools, require_verification

ROOT = Path(__file__).resolve().parents[2]
OPENED = """
import collections, json, os, sys
seen = collections.Counter()
def look(event, given):
    if event == "open" and isinstance(given[0], (str, bytes)):
        seen[os.path.realpath(os.fsdecode(given[0]))] += 1
sys.addaudithook(look)
from robosmi.cli.main import main
code = main(sys.argv[1:])
data = {path: n for path, n in seen.items() if path.endswith("/toolchain.toml") or "/boards/" in path}
print(json.dumps([code, {path: n for path, n in data.items() if n > 1}, sum("toolchain" in path for path in data)]))
"""


@pytest.mark.parametrize("command", ["compile", "verify", "upload"])
def test_files_of_toolchains_and_boards_are_opened_once(command: str, tmp_path: Path) -> None:
    if command == "verify":
        require_verification()
    else:
        require_tools("avr-gcc", "avr-g++", "arduino-core-avr")
    program, out = tmp_path / "blink.c", tmp_path / "out"
    program.write_text('#include "simpletools.h"\nint main() { while (1) { toggle(26); pause(500); } }\n')
    assert run("migrate", program, "-o", out, "--bind", "P26=D13").code == 0
    if command == "upload":
        require_tools("avrdude")
        assert run("compile", out).code == 0
    more = ["--port", "/dev/null", "--dry-run"] if command == "upload" else []
    call = [sys.executable, "-c", OPENED, command, str(out), *more]
    done = subprocess.run(call, capture_output=True, text=True, check=True, cwd=ROOT)
    code, again, toolchains = json.loads(done.stdout.splitlines()[-1])
    assert code == 0, done.stdout + done.stderr
    assert again == {}
    assert toolchains == 2, "no file of a toolchain was opened"
