"""What becomes of a sketch's files that the user, or a tool, has reformatted or moved."""

from __future__ import annotations

import codecs
import json
import os
import shutil
from pathlib import Path
from typing import Any

import pytest

import robosmi
from robosmi.errors import SourceError, StoppedError
from robosmi.files import commit
from robosmi.transformations.chains import generate as generate_chain
from robosmi.transformations.chains.stages import output
from robosmi.transformations.m2m import plan_tasks
from tests.running import Outcome, run, tree

SKETCH = "line_follower/line_follower.ino"
ADAPTERS = "line_follower/adapters.h"


def change_program(source: Path, new: str = "drive_speed(1, 1)") -> None:
    """Change a statement of the program, which changes the sketch and the models."""
    source.write_text(source.read_text().replace("drive_speed(0, 0)", new))


def again(source: Path, folder: Path) -> Outcome:
    """Migrate once more."""
    return run("migrate", source, "-o", folder, "--json")


def ends(data: bytes) -> set[bytes]:
    """The line ends of a file."""
    return {line[len(line.rstrip(b"\r\n")) :] for line in data.splitlines(keepends=True)}


@pytest.mark.parametrize("name", [SKETCH, ADAPTERS, "line_follower/MIGRATION.md", "line_follower/sketch.yaml"])
def test_line_ends_and_byte_order_mark_stay_when_the_file_is_made_anew(name: str, migrated: Path, line_follower: Path) -> None:
    path = migrated / name
    comment = b"# mine" if name.endswith(".yaml") else b"// mine"
    path.write_bytes(codecs.BOM_UTF8 + path.read_bytes().replace(b"\n", b"\r\n") + b"\t" + comment)
    source = line_follower.read_text()
    line_follower.write_text(source.replace("high(LED);", "high(LED); toggle(LED);").replace("drive_speed(0, 0)", "mine()"))
    before = path.read_bytes()
    none = ["--library", "Basic Servo1=none", "--library", "Basic Servo2=none"]  # so that no library is listed
    placeholders = ["--adapters", "placeholders"]
    other = {ADAPTERS: placeholders, "line_follower/sketch.yaml": [*placeholders, *none]}.get(name, [])
    outcome = run("migrate", line_follower, "-o", migrated, "--json", *other)
    after = path.read_bytes()
    assert outcome.code in (0, 1)
    assert after != before
    assert after.startswith(codecs.BOM_UTF8)
    assert ends(after) == {b"\r\n", b""}
    assert after.endswith(b"\r\n\t" + comment)
    assert not [f for f in outcome.document["findings"] if f["rule"] == "RS511"]


def test_a_checkout_with_other_line_ends_is_no_edit(migrated: Path, line_follower: Path) -> None:
    """Version control on Windows gives every text file carriage returns, the record and the models too."""
    for path in migrated.rglob("*"):
        if path.is_file() and path.suffix in (".ino", ".h", ".yaml", ".md", ".xmi"):
            path.write_bytes(path.read_bytes().replace(b"\n", b"\r\n"))
    change_program(line_follower)
    outcome = again(line_follower, migrated)
    assert outcome.code == 0, outcome.out
    assert b"drive_speed(1, 1);     // stop\r\n" in (migrated / SKETCH).read_bytes()
    assert ends((migrated / SKETCH).read_bytes()) == {b"\r\n"}
    assert ends((migrated / "models" / "plan.xmi").read_bytes()) == {b"\n"}
    said = {f["location"]["path"] for f in outcome.document["findings"] if f["rule"] == "RS523"}
    assert said == {str(migrated / "models" / f"{name}.xmi") for name in ("code", "hardware", "plan", "platform")} & said
    assert str(migrated / "models" / "plan.xmi") in said
    assert again(line_follower, migrated).document["findings"] is not None
    before = tree(migrated)
    again(line_follower, migrated)
    assert tree(migrated) == before


@pytest.mark.processes
def test_bytes_of_another_encoding_in_an_edit_stay(migrated: Path, line_follower: Path) -> None:
    mine = "// für später\n".encode("latin-1")
    path = migrated / SKETCH
    path.write_bytes(mine + path.read_bytes())
    change_program(line_follower)
    assert again(line_follower, migrated).code == 0
    assert path.read_bytes().startswith(mine)
    assert b"drive_speed(1, 1);" in path.read_bytes()
    assert run("compile", migrated).code in (0, 4)


def test_a_file_that_is_no_utf_8_is_left_or_stops_the_run(migrated: Path, line_follower: Path) -> None:
    path = migrated / SKETCH
    path.write_bytes((path.read_text() + "// mine\n").encode("utf-16"))
    before = tree(migrated)
    outcome = again(line_follower, migrated)
    assert "RS522" in outcome.rules()
    assert tree(migrated)[SKETCH] == before[SKETCH]
    before = tree(migrated)
    change_program(line_follower)
    outcome = again(line_follower, migrated)
    assert outcome.code == 5
    assert "UTF-8" in outcome.err
    assert tree(migrated) == before


@pytest.mark.parametrize("damage", ["missing", "damaged", "the edited file", "no text"])
def test_without_the_text_that_was_made_last_an_edit_stops_the_run_and_nothing_else_does(
    damage: str, migrated: Path, line_follower: Path
) -> None:
    """The manifest says what was made, so that neither an edit of now nor one that was merged before is taken for made."""
    sketch, copy = migrated / SKETCH, migrated / ".robosmi" / "generated" / SKETCH
    sketch.write_text("// mine\n" + sketch.read_text())
    assert again(line_follower, migrated).code == 0  # the edit is in the manifest's digest of the file from here on
    if damage == "missing":
        copy.unlink()
    elif damage == "damaged":
        copy.write_bytes(copy.read_bytes()[100:])
    elif damage == "no text":
        copy.write_bytes(b"\xff\xfe")
    else:
        shutil.copy(sketch, copy)
    before = tree(migrated)
    change_program(line_follower)
    outcome = again(line_follower, migrated)
    assert outcome.code == 5
    assert "edits cannot be detected" in outcome.err
    assert tree(migrated) == before
    sketch.write_text(sketch.read_text().removeprefix("// mine\n"))  # without the edit, the file is what was made
    outcome = again(line_follower, migrated)
    assert outcome.code == 0
    assert "RS521" in outcome.rules()
    assert "drive_speed(1, 1)" in sketch.read_text()
    assert copy.read_bytes() == sketch.read_bytes()


@pytest.mark.parametrize("name", [SKETCH, "models/plan.xmi", "models/source/line_follower.c"])
@pytest.mark.parametrize("inside", [True, False])
def test_a_link_in_place_of_a_file_stops_the_run(
    name: str, inside: bool, migrated: Path, line_follower: Path, tmp_path: Path
) -> None:
    elsewhere = migrated / "mine" if inside else tmp_path / "mine"
    (migrated / name).rename(elsewhere)
    (migrated / name).symlink_to(elsewhere)
    change_program(line_follower)
    before, there = tree(migrated), elsewhere.read_bytes()
    outcome = again(line_follower, migrated)
    assert outcome.code == 3
    assert "is a link" in outcome.err
    assert "a copy" in outcome.err
    assert tree(migrated) == before
    assert elsewhere.read_bytes() == there
    assert (migrated / name).is_symlink()


def test_a_link_that_leads_nowhere_stops_the_run(migrated: Path, line_follower: Path, tmp_path: Path) -> None:
    (migrated / SKETCH).unlink()
    (migrated / SKETCH).symlink_to(tmp_path / "nowhere")
    assert again(line_follower, migrated).code == 3
    assert os.readlink(migrated / SKETCH) == str(tmp_path / "nowhere")


@pytest.mark.parametrize("name", [SKETCH, "models/plan.xmi"])
def test_a_folder_in_place_of_a_file_stops_the_run(name: str, migrated: Path, line_follower: Path) -> None:
    (migrated / name).unlink()
    (migrated / name).mkdir()
    (migrated / name / "mine.txt").write_text("mine")
    before = tree(migrated)
    outcome = again(line_follower, migrated)
    assert outcome.code == 3
    assert "folder" in outcome.err
    assert tree(migrated) == before


@pytest.mark.parametrize("name", [SKETCH, "models/code.xmi"])
def test_a_read_only_file_stops_the_run_that_would_change_it_and_no_other(name: str, migrated: Path, line_follower: Path) -> None:
    (migrated / name).chmod(0o444)
    assert again(line_follower, migrated).code == 0
    change_program(line_follower)
    before = tree(migrated)
    outcome = again(line_follower, migrated)
    assert outcome.code == 5
    assert "read-only" in outcome.err
    assert tree(migrated) == before


@pytest.mark.parametrize("name", [SKETCH, "models/code.xmi", "models/source/line_follower.c", f".robosmi/generated/{SKETCH}"])
def test_an_edit_while_the_run_is_at_work_stops_it(
    name: str, migrated: Path, line_follower: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    update = commit.update

    def slow(folder: Path, *rest: Any) -> None:
        (folder / name).write_bytes((folder / name).read_bytes() + b"// mine\n")
        before.update(tree(folder))
        update(folder, *rest)

    before: dict[str, str] = {}
    monkeypatch.setattr(output, "update", slow)
    change_program(line_follower)
    told = r"changed (during the run|since the last run)"  # the latter where the run begins anew
    with pytest.raises(StoppedError, match=told):
        robosmi.migrate([line_follower], migrated)
    assert tree(migrated) == before


def test_an_edit_of_the_plan_while_generate_follows_it_stops_it(migrated: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    plan = migrated / "models" / "plan.xmi"
    plan.write_text(plan.read_text().replace('toolVersion="', 'toolVersion="edited '))
    settle = plan_tasks.settle

    def slow(found: Any, *rest: Any) -> None:
        settle(found, *rest)
        plan.write_text(plan.read_text().replace('toolVersion="edited ', 'toolVersion="edited twice '))

    monkeypatch.setattr(generate_chain, "settle", slow)
    with pytest.raises(StoppedError, match="changed during the run"):
        robosmi.generate_sketch(plan, migrated)
    assert "edited twice" in plan.read_text()


def test_comments_in_the_plan_are_told_of_and_the_old_file_is_kept(migrated: Path) -> None:
    plan = migrated / "models" / "plan.xmi"
    made = plan.read_bytes()
    head, _, rest = made.partition(b">\n  <")
    noted = head + b">\n  <!-- D9: the motor is there -->\n  <?todo ask?>\n  <" + rest
    plan.write_bytes(noted)
    looked = robosmi.generate_sketch(plan, migrated, dry_run=True)
    assert "RS524" in {f.rule for f in looked.findings}
    assert plan.read_bytes() == noted
    first = robosmi.generate_sketch(plan, migrated)
    (told,) = [f for f in first.findings if f.rule == "RS524"]
    assert told.location is not None
    assert (told.location.path, told.location.line) == (str(plan), head.count(b"\n") + 2)
    assert "2 comments" in told.message
    assert "plan.xmi.orig" in told.message
    assert (migrated / "models" / "plan.xmi.orig").read_bytes() == noted
    assert plan.read_bytes() == made
    assert "RS524" not in {f.rule for f in robosmi.generate_sketch(plan, migrated).findings}
    assert not (migrated / "models" / "plan.xmi.orig.2").exists()


def test_a_sketch_of_another_name_leaves_the_edited_one_and_says_so(own_output: Path, line_follower: Path) -> None:
    sketch = own_output / SKETCH
    sketch.write_text(sketch.read_text() + "// mine\n")
    kept = sketch.read_bytes()
    other = line_follower.rename(line_follower.with_name("follower.c"))
    outcome = again(other, own_output)
    assert outcome.code == 0
    assert [f["location"]["path"] for f in outcome.document["findings"] if f["rule"] == "RS514"] == [str(sketch)]
    assert sketch.read_bytes() == kept
    assert (own_output / "follower" / "follower.ino").is_file()
    assert not (own_output / ADAPTERS).exists()
    assert [f["rule"] for f in again(other, own_output).document["findings"]].count("RS514") == 1
    back = other.rename(line_follower)
    assert again(back, own_output).code == 0
    assert sketch.read_bytes() == kept, "the edit is merged again when the file is made again"


def test_a_program_whose_sketch_has_the_name_of_another_program_s_is_said(tmp_path: Path, line_follower: Path) -> None:
    first, second = line_follower.with_name("two words.c"), line_follower.with_name("two_words.c")
    for each in (first, second):
        each.write_text(line_follower.read_text())
    folder = tmp_path / "shared"
    assert again(first, folder).code == 0
    assert not [f for f in again(first, folder).document["findings"] if f["rule"] == "RS526"]
    (said,) = (f for f in again(second, folder).document["findings"] if f["rule"] == "RS526")
    assert said["message"].startswith("this program replaces 'two words.c' in the sketch 'two_words'")
    assert not [f for f in again(second, folder).document["findings"] if f["rule"] == "RS526"]


def test_a_sketch_that_gives_way_to_another_program_s_is_said(own_output: Path, line_follower: Path) -> None:
    other = line_follower.with_name("other.c")
    other.write_text(line_follower.read_text())
    outcome = again(other, own_output)
    said = [finding for finding in outcome.document["findings"] if finding["rule"] == "RS526"]
    assert [finding["message"] for finding in said] == [
        "the sketch 'line_follower' of an earlier run is removed: this run generates 'other' here"
    ]
    assert not (own_output / SKETCH).exists()
    assert not [f for f in again(other, own_output).document["findings"] if f["rule"] == "RS526"]


def test_deleted_files_are_made_again_and_said(migrated: Path, line_follower: Path) -> None:
    before = tree(migrated)
    gone = [SKETCH, "models/plan.xmi", "models/source/line_follower.c"]
    for name in gone:
        (migrated / name).unlink()
    outcome = again(line_follower, migrated)
    assert {f["location"]["path"] for f in outcome.document["findings"] if f["rule"] == "RS517"} == {
        str(migrated / name) for name in gone
    }
    assert tree(migrated) == before


def test_a_damaged_or_missing_manifest_stops_the_run_before_an_edit(migrated: Path, line_follower: Path) -> None:
    sketch, manifest = migrated / SKETCH, migrated / ".robosmi.json"
    sketch.write_text("// mine\n" + sketch.read_text())
    change_program(line_follower)
    text = manifest.read_text()
    for damaged in ("", "{", "[]", '{"files": 3}', json.dumps({"files": {"../x": "0"}})):
        manifest.write_text(damaged)
        before = tree(migrated)
        with pytest.raises(SourceError, match="record of the last run"):
            robosmi.migrate([line_follower], migrated)
        assert tree(migrated) == before
    manifest.unlink()
    with pytest.raises(StoppedError, match="was not made by robosmi"):
        robosmi.migrate([line_follower], migrated)
    manifest.write_text(text)
    assert again(line_follower, migrated).code == 0
    assert sketch.read_text().startswith("// mine\n")


def test_blanks_that_an_editor_trims_are_an_edit_like_any_other(migrated: Path, line_follower: Path) -> None:
    """Where nothing new is made in these lines they stay trimmed, and where something is, it comes and they stay so, too."""
    source = line_follower.read_text()
    line_follower.write_text(source.replace("drive_speed(0, 0);     // stop", "drive_speed(0, 0);     // stop   "))
    again(line_follower, migrated)
    sketch = migrated / SKETCH
    assert "// stop   \n" in sketch.read_text()
    sketch.write_text("".join(f"{line.rstrip()}\n" for line in sketch.read_text().splitlines()))
    line_follower.write_text(line_follower.read_text().replace("pause(1000)", "pause(2000)"))
    assert again(line_follower, migrated).code == 0
    assert "// stop\n" in sketch.read_text()
    assert "pause(2000)" in sketch.read_text()
    change_program(line_follower)
    outcome = again(line_follower, migrated)
    assert outcome.code == 0
    assert "RS512" in outcome.rules()
    assert "drive_speed(1, 1);     // stop\n" in sketch.read_text()
