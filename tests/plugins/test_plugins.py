"""A plug-in as it is installed: an entry point whose reader, endings and target every command then knows."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
PROGRAM = HERE.parent / "targets" / "program" / "beacon.c"


def command(*words: str | Path, path: Path) -> dict[str, object]:
    """The document of a command in a process that has a plug-in on its path."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([str(path), str(ROOT)])}
    done = subprocess.run(
        [sys.executable, "-m", "robosmi", *map(str, words), "--json"], capture_output=True, text=True, env=environment, cwd=path
    )
    assert done.returncode in (0, 1), done.stderr
    document: dict[str, object] = json.loads(done.stdout)
    return document


def test_a_plug_in_brings_a_reader_with_its_ending_and_a_target(tmp_path: Path) -> None:
    plugin = tmp_path / "plugin"
    shutil.copytree(HERE / "beacon", plugin)
    (tmp_path / "wired.beacon").write_text("D3 Red LED\nD5 Pushbutton\n")
    shutil.copy(PROGRAM, tmp_path / "beacon.c")
    document = command(
        "migrate", tmp_path / "beacon.c", "--hardware", tmp_path / "wired.beacon", "--target", "beacon", "-o", tmp_path / "out",
        path=plugin,
    )  # fmt: skip
    assert document["command"] == "migrate"
    project = (tmp_path / "out" / "beacon" / "sketch.yaml").read_text()
    assert "arduino:avr:pro" in project


def test_without_the_plug_in_nobody_knows_its_files(tmp_path: Path) -> None:
    from tests.running import run

    (tmp_path / "wired.beacon").write_text("D3 Red LED\n")
    outcome = run("hardware", tmp_path / "wired.beacon")
    assert outcome.code == 3
    assert "no drawing reader takes a '.beacon' file" in outcome.err
