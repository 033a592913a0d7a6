"""`robosmi undo`, the diff of a dry run, and what the history counts when runs are repeated or taken back."""

from __future__ import annotations

import base64
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

import robosmi
from robosmi.errors import RobosmiError, SourceError, StoppedError
from robosmi.files import run_lock
from robosmi.generate.undo import steps, undo
from robosmi.transformations.chains.migrate import migrate
from tests.running import run, tree

FIRST = '#include "simpletools.h"\nint main() { while (1) { high(3); pause(5); } }\n'
SECOND = FIRST.replace("high(3)", "low(3)").replace("pause(5)", "ping_cm(7)")


@pytest.fixture
def program(tmp_path: Path) -> Path:
    """A program that can be changed."""
    path = tmp_path / "blink.c"
    path.write_text(FIRST)
    return path


def run_twice(folder: Path) -> None:
    """Migrate the program to `out`, and a changed one once more; `first` is what `out` was between."""
    source = folder / "blink.c"
    source.write_text(FIRST)
    robosmi.migrate([source], folder / "out")
    shutil.copytree(folder / "out", folder / "first")
    source.write_text(SECOND)
    robosmi.migrate([source], folder / "out")


@pytest.fixture
def twice(program: Path, restored: Callable[[str, Callable[[Path], None]], Path]) -> tuple[dict[str, str], dict[str, str], Path]:
    """The output folder after a first run and after a second one with another program, and its place."""
    folder = restored("blink migrated twice", run_twice)
    program.write_text(SECOND)
    return tree(folder / "first"), tree(folder / "out"), folder / "out"


@pytest.fixture
def twice_here(program: Path) -> tuple[dict[str, str], dict[str, str], Path]:
    """The same by runs of this test: a folder that was moved is known by its number on the disk, which no copy has."""
    run_twice(program.parent)
    return tree(program.parent / "first"), tree(program.parent / "out"), program.parent / "out"


def test_undo_puts_the_last_state_back_and_again_forth(twice: tuple[dict[str, str], dict[str, str], Path]) -> None:
    first, second, out = twice
    assert first != second
    done = undo(out)
    assert tree(out) == first
    assert "blink/blink.ino" in done.restored
    assert done.removed == []
    undo(out)
    assert tree(out) == second


def test_several_runs_are_listed_and_undone_at_once(
    twice: tuple[dict[str, str], dict[str, str], Path], program: Path, tmp_path: Path
) -> None:
    first, second, out = twice
    program.write_text(FIRST.replace("high(3)", "low(9)"))
    robosmi.migrate([program], out)
    third = tree(out)
    listed = run("undo", out, "--list", "--json").result["steps"]
    assert [step["number"] for step in listed] == [1, 2, 3]
    assert all("blink/blink.ino" in step["files"] and step["at"] for step in listed)
    assert [step["run"] for step in listed] == ["migrate blink.c"] * 3
    assert "migrate blink.c: blink/" in run("undo", out, "--list").out
    assert tree(out) == third
    assert run("undo", out, "--steps", "4").code == 3
    assert run("undo", out, "--steps", "0").code == 2
    assert run("undo", out, "--steps", "2").code == 0
    assert tree(out) == first
    assert [step.number for step in steps(out)] == [0, 1]
    undo(out)  # redoes both
    assert tree(out) == third
    undo(out)
    undo(out, 1)  # one more
    assert tree(out) == {}
    undo(out)
    assert tree(out) == third
    assert second != third


def test_one_run_after_another_is_undone_and_all_are_redone(
    twice: tuple[dict[str, str], dict[str, str], Path], program: Path
) -> None:
    first, second, out = twice
    undo(out, 1)
    assert tree(out) == first
    undo(out, 1)
    assert tree(out) == {}
    undo(out)
    assert tree(out) == second
    undo(out)
    program.write_text(FIRST)
    robosmi.migrate([program], out)  # a run takes the place of what could be redone
    assert {step.number > 0 for step in steps(out)} == {True}


def test_a_record_of_an_earlier_version_is_read(twice: tuple[dict[str, str], dict[str, str], Path]) -> None:
    first, _, out = twice
    place = run_lock.place_of(out, run_lock.STATE)
    state = json.loads(place.read_text())
    for entry in state["files"].values():
        if entry[0] is not None:
            entry[0] = base64.b85encode(base64.b64decode(entry[0].removeprefix(":"))).decode()
    place.write_text(json.dumps(state))
    undo(out)
    assert tree(out) == first


def test_undo_of_the_first_run_leaves_nothing_of_it(program: Path, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "notes.txt").write_text("mine")
    (program.parent / "robosmi.toml").write_text('[migrate]\ntarget = "nano"\n')
    robosmi.migrate([program], tmp_path / "out")
    done = undo(tmp_path / "out")
    assert "blink/blink.ino" in done.removed
    assert list(tree(tmp_path / "out")) == ["notes.txt"]
    assert (program.parent / "robosmi.toml").read_text() == '[migrate]\ntarget = "nano"\n'


def test_a_folder_that_was_moved_has_its_way_back(
    twice_here: tuple[dict[str, str], dict[str, str], Path], tmp_path: Path
) -> None:
    first, second, out = twice_here
    (tmp_path / "elsewhere").mkdir()
    moved = tmp_path / "elsewhere" / "moved"
    out.rename(moved)
    done = undo(moved)
    assert tree(moved) == first
    assert "blink/blink.ino" in done.restored
    undo(moved)
    assert tree(moved) == second
    (tmp_path / "elsewhere").rename(tmp_path / "again")  # with the folder around it
    undo(tmp_path / "again" / "moved")
    assert tree(tmp_path / "again" / "moved") == first


def test_a_folder_that_was_undone_elsewhere_and_moved_back_goes_on_from_there(
    twice_here: tuple[dict[str, str], dict[str, str], Path], program: Path, tmp_path: Path
) -> None:
    first, second, out = twice_here
    moved = tmp_path / "moved"
    out.rename(moved)
    undo(moved)
    moved.rename(out)
    assert [step.number for step in steps(out)] == [0, 1]
    undo(out)
    assert tree(out) == second
    undo(out)
    out.rename(moved)
    program.write_text(FIRST.replace("high(3)", "low(9)"))
    robosmi.migrate([program], moved)
    moved.rename(out)
    assert [step.number for step in steps(out)] == [1, 2]
    undo(out)
    assert tree(out) == first


def test_a_new_folder_has_no_steps_of_one_that_was_in_its_place(
    twice: tuple[dict[str, str], dict[str, str], Path], program: Path
) -> None:
    _, _, out = twice
    shutil.rmtree(out)
    robosmi.migrate([program], out)
    assert [step.number for step in steps(out)] == [1]


def test_the_first_run_into_a_folder_that_was_moved_is_undone(program: Path, tmp_path: Path) -> None:
    robosmi.migrate([program], tmp_path / "out")
    (tmp_path / "out").rename(tmp_path / "moved")
    undo(tmp_path / "moved")
    assert tree(tmp_path / "moved") == {}


def test_a_moved_folder_whose_former_place_is_taken_has_no_way_back(
    twice: tuple[dict[str, str], dict[str, str], Path], tmp_path: Path
) -> None:
    _, second, out = twice
    out.rename(tmp_path / "moved")
    out.mkdir()
    with pytest.raises(SourceError):
        undo(tmp_path / "moved")
    assert tree(tmp_path / "moved") == second


def test_an_edit_in_a_moved_folder_stops_undo(twice_here: tuple[dict[str, str], dict[str, str], Path], tmp_path: Path) -> None:
    _, _, out = twice_here
    out.rename(tmp_path / "moved")
    sketch = tmp_path / "moved" / "blink" / "blink.ino"
    sketch.write_text(sketch.read_text() + "// mine\n")
    before = tree(tmp_path / "moved")
    with pytest.raises(StoppedError):
        undo(tmp_path / "moved")
    assert tree(tmp_path / "moved") == before


def test_a_run_that_changes_nothing_keeps_the_way_back(twice: tuple[dict[str, str], dict[str, str], Path], program: Path) -> None:
    first, second, out = twice
    robosmi.migrate([program], out)
    assert tree(out) == second
    undo(out)
    assert tree(out) == first


def test_an_edit_since_the_last_run_stops_it(twice: tuple[dict[str, str], dict[str, str], Path]) -> None:
    _, _, out = twice
    sketch = out / "blink" / "blink.ino"
    sketch.write_text(sketch.read_text() + "// mine\n")
    before = tree(out)
    with pytest.raises(StoppedError, match=r"changed since the last run: blink/blink\.ino"):
        undo(out)
    assert tree(out) == before
    assert run("undo", out).code == 5


def test_the_command_says_what_it_put_back(twice: tuple[dict[str, str], dict[str, str], Path]) -> None:
    _, _, out = twice
    done = run("undo", out, "--json")
    assert done.code == 0
    assert "blink/blink.ino" in json.loads(done.out)["result"]["restored"]


@pytest.mark.parametrize("text", ["", "{}", '{"files": {"../x": [null, null]}}', '{"files": {"a": ["?", null]}}', "nonsense"])
def test_a_damaged_record_is_refused(text: str, twice: tuple[dict[str, str], dict[str, str], Path]) -> None:
    _, second, out = twice
    run_lock.store(out, run_lock.STATE, text)
    with pytest.raises(SourceError, match="damaged"):
        undo(out)
    assert tree(out) == second


def test_there_must_be_a_state_to_go_back_to(tmp_path: Path) -> None:
    (tmp_path / "empty").mkdir()
    with pytest.raises(SourceError, match="no earlier state"):
        undo(tmp_path / "empty")


def test_a_folder_from_elsewhere_is_left_alone(twice: tuple[dict[str, str], dict[str, str], Path], tmp_path: Path) -> None:
    _, _, out = twice
    shutil.copytree(out, tmp_path / "copy")
    before = tree(tmp_path / "copy")
    with pytest.raises(RobosmiError, match="no earlier state"):
        undo(tmp_path / "copy")
    assert tree(tmp_path / "copy") == before


def test_a_dry_run_shows_what_would_change(twice: tuple[dict[str, str], dict[str, str], Path], program: Path) -> None:
    _, second, out = twice
    program.write_text(FIRST)
    made = robosmi.migrate([program], out, dry_run=True)
    assert tree(out) == second
    changed = [line for line in made.diff.splitlines() if line[:1] in "+-"]
    assert any(line.startswith("-  low(") for line in changed)
    assert any(line.startswith("+  high(") for line in changed)
    assert "+++ b/blink/blink.ino" in made.lines()
    assert made.result()["diff"] == made.diff
    assert "diff" not in robosmi.migrate([program], out).result()


def test_a_choice_is_counted_once_whatever_runs_come_between(examples: Path, tmp_path: Path) -> None:
    folder = tmp_path / "robot"
    shutil.copytree(examples / "line_follower", folder)
    (folder / "robosmi.toml").unlink()
    drawing, history = next(folder.glob("*.fzz")), str(tmp_path / "history.db")
    source, out = folder / "line_follower.c", tmp_path / "out"

    def moved(**libraries: str) -> int:
        named = {title.replace("_", " "): name for title, name in libraries.items()}
        return len(migrate([source], out, hardware=drawing, libraries=named, history=history).new_choices)

    assert moved(Basic_Servo1="Servo") == 1
    assert moved(Basic_Servo1="Servo") == 0
    assert moved() == 0
    assert moved(Basic_Servo1="Servo") == 0, "a run without the choice in between makes it no new one"
    assert moved(Basic_Servo1="ServoEasing") == 1
    undo(out)
    assert moved(Basic_Servo1="ServoEasing") == 0, "what was counted stays counted when the run is taken back"
