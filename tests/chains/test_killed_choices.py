"""A choice is in the plan, the sketch and the project file, or in none of them, wherever in between the run is killed.

A child carries the commit of a real choice out and kills itself at the first, second, third ... change of the file system.
"""

from __future__ import annotations

import os
import shutil
import signal
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NoReturn

import pytest

from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import commit, update
from robosmi.files.recovery import interrupted, recover
from robosmi.generate.undo import undo
from robosmi.transformations.chains.choose import choose
from robosmi.transformations.chains.stages import output
from tests.chains.conftest import SETTINGS
from tests.running import run, tree
from tests.tiers import sample

CHANGES = ("os.rename", "os.remove", "os.mkdir", "os.rmdir", "os.chmod")


@pytest.fixture
def data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The user's data, which a test may put back."""
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "data"))
    return tmp_path / "data"


def killed(run: Callable[[], object], at: int) -> bool:
    """Run something in a child process that kills itself at the n-th change of the file system; False if it ended before."""
    child = os.fork()
    if child == 0:
        _run(run, at)
    _, status = os.waitpid(child, 0)
    assert os.WIFSIGNALED(status) or os.WEXITSTATUS(status) == 0, "the run itself has failed"
    return os.WIFSIGNALED(status)


def _run(run: Callable[[], object], at: int) -> NoReturn:
    left = at

    def count(event: str, arguments: tuple[Any, ...]) -> None:
        nonlocal left
        if event in CHANGES or (event == "open" and isinstance(arguments[2], int) and arguments[2] & (os.O_WRONLY | os.O_CREAT)):
            left -= 1
            if left == 0:
                os.kill(os.getpid(), signal.SIGKILL)

    try:
        sys.addaudithook(count)
        run()
    except BaseException:
        os._exit(1)
    os._exit(0)


def at_each_point(run: Callable[[], object], folders: list[Path], look: Callable[[], None]) -> int:
    """Kill a run at each of its changes of the file system, check, and restore the folders; returns the number of changes."""
    kept = [Path(shutil.copytree(folder, folder.with_name(f"{folder.name}.kept"))) for folder in folders]
    at = 1
    while killed(run, at):
        look()
        for folder, copy in zip(folders, kept, strict=True):
            shutil.rmtree(folder)
            shutil.copytree(copy, folder, symlinks=True)
        at += 1
    return at - 1


@pytest.mark.parametrize("begun", sample(["with a project file", "without one"], 1))
def test_a_killed_choice_is_whole_or_not_at_all(begun: str, data: Path, robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out, project, states = robot / "out", robot / "robosmi.toml", list[tuple[dict[str, str], str]]()
    if begun == "without one":
        project.unlink()
    unfinished, points = 0, 0

    def state() -> tuple[dict[str, str], str]:
        return tree(out), project.read_text() if project.exists() else ""

    def look() -> None:
        nonlocal unfinished
        unfinished += interrupted(out)
        recover(out)  # as every run does first
        states.append(state())
        undo(out)  # the run before the killed one can be taken back where that did not come to its end
        assert state() != states[-1]
        undo(out)
        assert state() == states[-1]
        assert [p.name for p in robot.iterdir() if p.name not in ("blink.c", "robosmi.toml", "out")] == []

    def all_points(folder: Path, *arguments: Any) -> None:
        nonlocal points
        points = at_each_point(lambda: update(folder, *arguments), [robot, data], look)
        shutil.rmtree(robot)
        shutil.copytree(robot.with_name("robot.kept"), robot)  # the last child has done it all
        shutil.rmtree(data)
        shutil.copytree(data.with_name("data.kept"), data)
        update(folder, *arguments)

    before = state()
    monkeypatch.setattr(output, "update", all_points)
    choose(out, {"eye": "D9"})
    after = state()
    assert 'eye = "D9"' in after[1]
    assert after[0] != before[0]
    assert points > 20
    assert unfinished > 5
    assert {states.index(found) for found in states} == {0, states.index(after)}, "some are of both"
    assert states[0] == before
    undo(out)
    assert state() == before


def killed_before_moving(run: Callable[[], object], monkeypatch: pytest.MonkeyPatch) -> None:
    """Kill a run after its journal is written and before a file is moved."""
    with monkeypatch.context() as patched:
        patched.setattr("robosmi.files.commit.finish", lambda _: os.kill(os.getpid(), signal.SIGKILL))
        assert killed(run, 0)


def test_a_migration_after_a_killed_choice_reads_the_file_that_the_recovery_has_written(
    data: Path, robot: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (robot / "robosmi.toml").write_text(f'{SETTINGS}[bind]\neye = "D4"\n')
    killed_before_moving(lambda: choose(robot / "out", {"eye": "D9"}), monkeypatch)
    assert 'eye = "D4"' in (robot / "robosmi.toml").read_text()
    outcome = run("migrate", robot / "blink.c", "-o", robot / "out", "--json")
    assert outcome.code == 0, outcome.err
    assert outcome.result["plan"]["choices"][0]["chosen"] == "D9"
    assert 'eye = "D9"' in (robot / "robosmi.toml").read_text()


def test_a_new_folder_and_a_file_elsewhere_come_together(data: Path, tmp_path: Path) -> None:
    place = tmp_path / "place"
    place.mkdir()
    (place / "settings").write_bytes(b"old")
    elsewhere = {place / "settings": (b"old", b"new")}
    unfinished = 0

    def look() -> None:
        nonlocal unfinished
        unfinished += interrupted(place / "out")
        recover(place / "out")
        found = (place / "settings").read_bytes()
        assert (place / "out" / "a.txt").exists() == (found == b"new")
        assert sorted(path.name for path in place.iterdir()) == ["out", "settings"] if found == b"new" else ["settings"]

    data.mkdir()
    points = at_each_point(lambda: commit(place / "out", {"a.txt": b"1"}, elsewhere=elsewhere), [place, data], look)
    assert points > 10
    assert unfinished > 1
    assert (place / "settings").read_bytes() == b"new"
    assert sorted(path.name for path in (place / "out").iterdir()) == ["a.txt"]


def test_what_a_person_does_to_the_file_before_the_recovery_stays(
    data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    commit(tmp_path / "out", {"a.txt": b"1"})
    (tmp_path / "settings").write_bytes(b"old")
    elsewhere = {tmp_path / "settings": (b"old", b"new")}
    killed_before_moving(lambda: commit(tmp_path / "out", {"a.txt": b"2"}, elsewhere=elsewhere), monkeypatch)
    (tmp_path / "settings").write_bytes(b"mine")
    recover(tmp_path / "out")
    assert (tmp_path / "out" / "a.txt").read_bytes() == b"2"
    assert (tmp_path / "settings").read_bytes() == b"mine"
    assert sorted(path.name for path in tmp_path.iterdir() if path != data) == ["out", "settings"]


def _read_only(path: Path) -> None:
    path.chmod(0o444)


def _link(path: Path) -> None:
    path.rename(path.with_name("other"))
    path.symlink_to("other")


def _folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


@pytest.mark.parametrize("odd", [_read_only, _link, _folder, lambda path: path.write_bytes(b"mine")])
def test_nothing_is_written_where_the_file_elsewhere_cannot_be(odd: Callable[[Path], object], tmp_path: Path) -> None:
    commit(tmp_path / "out", {"a.txt": b"1"})
    (tmp_path / "settings").write_bytes(b"old")
    odd(tmp_path / "settings")
    before = sorted((path.relative_to(tmp_path), path.lstat().st_mode) for path in tmp_path.rglob("*"))
    with pytest.raises((SourceError, StoppedError), match=r"read-only|in the place of a file|changed during"):
        commit(tmp_path / "out", {"a.txt": b"2"}, elsewhere={tmp_path / "settings": (b"old", b"new")})
    assert sorted((path.relative_to(tmp_path), path.lstat().st_mode) for path in tmp_path.rglob("*")) == before
    assert (tmp_path / "out" / "a.txt").read_bytes() == b"1"


def test_a_file_elsewhere_alone_is_a_commit_and_an_unchanged_one_is_none(tmp_path: Path) -> None:
    commit(tmp_path / "out", {"a.txt": b"1"})
    path = tmp_path / "settings"
    steps: list[Mapping[Path, tuple[bytes | None, bytes | None]]] = [{path: (None, b"1")}, {path: (b"1", b"1")}]
    for files in steps:
        update(tmp_path / "out", {"a.txt": b"1"}, elsewhere=files)
        assert path.read_bytes() == b"1"
    update(tmp_path / "out", {}, elsewhere={path: (b"1", None)})
    assert not path.exists()
    assert sorted(found.name for found in tmp_path.iterdir()) == ["out"]
