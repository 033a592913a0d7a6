"""Nothing is removed on the word of a record that came with a folder; records of one's own work as ever."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import RobosmiError, SourceError, StoppedError
from robosmi.files.files import digest
from robosmi.generate import Gen
from robosmi.generate.packages import generate_packages
from robosmi.project import load_project
from robosmi.verify.toolchains.sketch import read_project_file
from tests.running import run


def forge(folder: Path, *names: str) -> None:
    """A manifest that calls files made by a run."""
    files = {name: digest((folder / name).read_bytes()) for name in names}
    (folder / ".robosmi.json").write_text(json.dumps({"schema": "robosmi-manifest/1", "choices": [], "files": files}))


def test_a_forged_manifest_removes_nothing(line_follower: Path) -> None:
    folder = line_follower.parent
    victims = [".git/HEAD", line_follower.name, "notes/thesis.txt", ".robosmi/generated/notes/thesis.txt"]
    for name in victims:
        if name != line_follower.name:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text("precious\n")
    forge(folder, *victims)
    before = {name: (folder / name).read_bytes() for name in victims}
    outcome = run("migrate", line_follower, "-o", folder, "--json")
    assert outcome.code in (0, 1), outcome.out
    told = {f["location"]["path"] for f in outcome.document["findings"] if f["rule"] == "RS525"}
    assert told == {str(folder / name) for name in victims[:3]}
    for _ in range(2):  # the manifest is of one's own run now, and must not have taken over what it was told
        assert {name: (folder / name).read_bytes() for name in victims} == before
        line_follower.write_text(line_follower.read_text().replace("drive_speed(0, 0)", "drive_speed(1, 1)"))
        before[line_follower.name] = line_follower.read_bytes()
        assert run("migrate", line_follower, "-o", folder, "--json").code in (0, 1)


def test_a_folder_that_was_copied_goes_on_and_removes_nothing_at_first(own_output: Path, line_follower: Path) -> None:
    copy = Path(shutil.copytree(own_output, own_output.with_name("copy")))
    other = line_follower.rename(line_follower.with_name("follower.c"))
    robosmi.migrate([other], own_output)
    assert not (own_output / "line_follower").exists(), "one's own record, where it was made"
    made = robosmi.migrate([other], copy)
    told = {f.location.path for f in made.findings if f.rule == "RS525" and f.location}
    assert str(copy / "line_follower" / "line_follower.ino") in told
    assert (copy / "line_follower" / "line_follower.ino").is_file()
    third = other.rename(other.with_name("third.c"))
    robosmi.migrate([third], copy)
    assert (copy / "line_follower" / "line_follower.ino").is_file()
    assert not (copy / "follower").exists(), "what runs have made here since goes as ever"


def test_a_header_that_the_program_reads_is_not_made_anew(line_follower: Path, tmp_path: Path) -> None:
    """A forged manifest that calls it the run's own is of no use."""
    folder = tmp_path / "project" / "line_follower"
    folder.mkdir(parents=True)
    header = folder / "adapters.h"
    header.write_text("int helper(int x);\n")
    program = folder / "line_follower.c"
    program.write_text('#include "adapters.h"\n' + line_follower.read_text())
    forge(folder.parent, "line_follower/adapters.h")
    outcome = run("migrate", program, "-o", folder.parent, "--json")
    assert outcome.code == 5, outcome.out
    assert "the program's source would be overwritten" in outcome.out
    assert header.read_text() == "int helper(int x);\n"


def test_forged_lists_of_last_texts_remove_nothing(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    for path in ("thesis.txt", ".last/thesis.txt"):
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text("precious\n")
    (folder / ".last.sha256").write_text(f"{digest(b'precious' + bytes([10]))}  thesis.txt\n")
    for _ in range(2):
        g = Gen(folder, {"t": "made\n"}, keep=".last")
        g.rule(template="t", target="made.txt")(lambda: None)
        result = g.run()
        assert "RS525" in {f.rule for f in result.findings}
        assert (folder / "thesis.txt").read_text() == "precious\n"
        assert not result.removed


def test_forged_manifests_of_packages_remove_nothing(tmp_path: Path, ecore: Path) -> None:
    made = generate_packages([ecore], tmp_path / "out")
    (root,) = {path.relative_to(tmp_path / "out").parts[0] for path in made.written}
    folder = tmp_path / "out" / root
    (folder / ".git").mkdir()
    for name in ("mine.py", ".git/HEAD"):
        (folder / name).write_text("precious\n")
    forge(folder, *(p.relative_to(folder).as_posix() for p in folder.rglob("*") if p.is_file() and p.name != ".robosmi.json"))
    for _ in range(2):
        made = generate_packages([ecore], tmp_path / "out")
        assert not made.removed
        assert (folder / "mine.py").read_text() == (folder / ".git" / "HEAD").read_text() == "precious\n"


@pytest.fixture
def ecore(tmp_path: Path) -> Path:
    """A metamodel with one class."""
    path = tmp_path / "tiny.ecore"
    path.write_text(
        '<?xml version="1.0" encoding="UTF-8"?>\n<ecore:EPackage xmi:version="2.0" xmlns:xmi="http://www.omg.org/XMI" '
        'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xmlns:ecore="http://www.eclipse.org/emf/2002/Ecore" '
        'name="tiny" nsURI="urn:tiny" nsPrefix="tiny"><eClassifiers xsi:type="ecore:EClass" name="Thing"/></ecore:EPackage>\n'
    )
    return path


@pytest.mark.parametrize("text", ["[]", "null", '{"files": 1}', '{"files": {"a": 1}}', '{"files": {}, "choices": 3}'])
def test_a_manifest_of_another_form_is_told_in_words(text: str, migrated: Path, line_follower: Path) -> None:
    (migrated / ".robosmi.json").write_text(text)
    with pytest.raises(SourceError, match=r"must (say|be)") as raised:
        robosmi.migrate([line_follower], migrated)
    assert raised.value.fix


@pytest.mark.parametrize("kind", ["link", "dangling link", "named pipe", "folder"])
@pytest.mark.parametrize("name", [".robosmi.json", "robosmi.toml"])
def test_records_and_settings_that_are_no_files_are_refused(
    kind: str, name: str, migrated: Path, line_follower: Path, tmp_path: Path
) -> None:
    path = (migrated if name == ".robosmi.json" else line_follower.parent) / name
    path.rename(tmp_path / "moved")
    if kind == "folder":
        path.mkdir()
    elif kind == "named pipe":
        os.mkfifo(path)
    else:
        path.symlink_to(tmp_path / ("moved" if kind == "link" else "nowhere"))
    if (kind, name) == ("link", "robosmi.toml"):
        assert load_project(path.parent).path == path, "settings may be a link"
        return
    with pytest.raises((SourceError, StoppedError), match=r"cannot be read|a folder is in the place of a file") as raised:
        robosmi.migrate([line_follower], migrated)
    assert raised.value.fix
    assert raised.value.location is not None
    assert raised.value.location.path == str(path)
    assert "Errno" not in str(raised.value)


def test_a_project_file_that_is_too_large_is_told_in_words(tmp_path: Path) -> None:
    path = tmp_path / "sketch.yaml"
    path.write_bytes(b"#" * (1024 * 1024 + 1))
    with pytest.raises(RobosmiError, match="larger than 1 MB") as raised:
        read_project_file(path, {})
    assert "Errno" not in str(raised.value)
    assert raised.value.fix
