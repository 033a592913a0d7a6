"""Programs given as a folder, or by the compile commands that a build tool wrote."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

from tests.running import run, tree


def test_a_folder_is_migrated_as_its_files_are_with_its_own_project_file(line_follower: Path, tmp_path: Path) -> None:
    robot = tmp_path / "robot"
    shutil.copytree(line_follower.parent, robot)
    assert run("migrate", robot / line_follower.name, "-o", tmp_path / "by_file").code == 0
    outcome = run("migrate", robot, "-o", tmp_path / "by_folder", "--json")
    assert outcome.code == 0
    made = {name: data for name, data in tree(tmp_path / "by_folder").items() if not name.endswith("/")}
    assert made == {name: data for name, data in tree(tmp_path / "by_file").items() if not name.endswith("/")}
    assert any(name.endswith("hardware.xmi") for name in made), "robosmi.toml in the folder names the drawing"


def test_compile_commands_give_include_folders_and_macros(tmp_path: Path) -> None:
    (tmp_path / "inc").mkdir()
    (tmp_path / "inc" / "pins.h").write_text("enum { LED_PIN = 3 };\n")
    (tmp_path / "main.c").write_text('#include "pins.h"\nint main(void) { high(LED_PIN + OFFSET); while (1) { } }\n')
    commands = [{"directory": ".", "file": "main.c", "arguments": ["cc", "-Iinc", "-DOFFSET=2", "-c", "main.c"]}]
    (tmp_path / "compile_commands.json").write_text(json.dumps(commands))
    outcome = run("migrate", tmp_path / "compile_commands.json", "-o", tmp_path / "out", "--json")
    assert outcome.code == 0
    assert (tmp_path / "out" / "main" / "pins.h").is_file()
    assert 'resolvedPath="source/pins.h"' in (tmp_path / "out" / "models" / "code.xmi").read_text()
    made = [path for path in (tmp_path / "out").rglob("*") if path.is_file()]
    assert not [path for path in made if str(tmp_path) in path.read_text()], "a model knows where it was made"
    assert not [f for f in outcome.document["findings"] if "pins.h" in f["message"] or "OFFSET" in f["message"]]


def test_a_folder_without_sources_is_refused(tmp_path: Path) -> None:
    (tmp_path / "notes.txt").write_text("nothing")
    outcome = run("migrate", tmp_path, "-o", tmp_path / "out")
    assert outcome.code == 3
    assert "folder without C sources" in outcome.err
    assert not (tmp_path / "out").exists()
