"""All files of a run are written or none, also when the process is killed; each file is the old or the new one, at any time."""

from __future__ import annotations

import fcntl
import os
import random
import signal
import time
from pathlib import Path
from typing import NoReturn

import pytest

from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import commit
from robosmi.files.recovery import STAGE, interrupted, recover
from robosmi.files.run_lock import bind, own_stage
from robosmi.generate import Gen
from tests.running import tree

FILES = 40
KILLS = [40, pytest.param(300, marks=pytest.mark.exhaustive)]


def text(version: int, number: int) -> str:
    return f"{version}\n" * 2000 + f"{number}\n"


def generate(folder: Path, version: int) -> None:
    g = Gen(folder, {"t": "{% print out.print(body) %}{{ n }}\n"})

    @g.rule(domain=range(FILES), template="t", target=lambda n: f"{n % 7}/{n}.txt")
    def Files(n: int) -> dict[str, str]:
        return {"body": f"{version}\n" * 2000}

    g.run()


def generate_until_killed(folder: Path, version: int) -> NoReturn:
    try:
        while True:
            generate(folder, version)
            version += 1
    finally:
        os._exit(1)


def versions(folder: Path) -> set[int]:
    """The versions of the files; every file must be one of them, whole."""
    found = {n: (folder / f"{n % 7}" / f"{n}.txt").read_text(encoding="utf-8") for n in range(FILES)}
    made = {n: int(t.partition("\n")[0]) for n, t in found.items()}
    assert found == {n: text(version, n) for n, version in made.items()}, "a file is neither old nor new"
    return set(made.values())


@pytest.mark.parametrize("kills", KILLS)
def test_kill_at_random_points_of_a_run_leaves_every_file_whole(kills: int, tmp_path: Path) -> None:
    chance = random.Random(17)
    folder = tmp_path / "out"
    generate(folder, 0)
    unfinished = mixed = 0
    begun = time.perf_counter()
    generate(folder, -2)
    span = max(0.06, 2 * (time.perf_counter() - begun))  # a machine that does other work takes longer for a run
    for number in range(kills):
        child = os.fork()
        if child == 0:
            generate_until_killed(folder, 1000 * number + 1)
        time.sleep(chance.random() * span)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        mixed += len(versions(folder)) > 1
        unfinished += interrupted(folder)
        recover(folder)  # as every run does first
        assert len(versions(folder)) == 1, "files of two runs"
        assert not (folder / STAGE).exists()
        assert sum(path.is_file() for path in folder.rglob("*")) == FILES
    generate(folder, -1)
    assert versions(folder) == {-1}
    assert unfinished > 0, "no kill fell into the moving of files: the test shows nothing"
    assert mixed > 0, "no kill fell between two files: the test shows nothing"


def test_recovery_completes_a_run_whose_journal_is_there_and_drops_one_without(tmp_path: Path) -> None:
    commit(tmp_path / "out", {"a": b"1", "b/c": b"1", "d": b"1"})
    stage = tmp_path / "out" / STAGE
    (stage / "new").mkdir(parents=True)
    own_stage(stage)
    (stage / "new" / "0").write_bytes(b"2")
    recover(tmp_path / "out")
    assert (tmp_path / "out" / "a").read_bytes() == b"1"
    assert not stage.exists()
    (stage / "new").mkdir(parents=True)
    (stage / "new" / "0").write_bytes(b"2")
    journal = b'{"move": {"new/0": "b/c", "new/1": "a"}, "remove": ["d"]}'
    (stage / "journal.json").write_bytes(journal)
    bind(tmp_path / "out", journal)
    assert interrupted(tmp_path / "out")
    recover(tmp_path / "out")
    assert (tmp_path / "out" / "b" / "c").read_bytes() == b"2"
    assert not (tmp_path / "out" / "d").exists()
    assert not stage.exists()


def test_a_new_folder_appears_in_one_step_and_nothing_stays_beside_it(tmp_path: Path) -> None:
    (tmp_path / f"{STAGE}-out").mkdir()
    own_stage(tmp_path / f"{STAGE}-out")
    (tmp_path / f"{STAGE}-out" / "half").write_text("left by a killed run")
    commit(tmp_path / "out", {"x/y.txt": b"1"})
    assert [p.name for p in tmp_path.iterdir()] == ["out"]
    assert [p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*.txt")] == ["out/x/y.txt"]


def test_removed_files_go_with_the_folders_that_they_leave_empty(tmp_path: Path) -> None:
    commit(tmp_path / "out", {"x/y/z.txt": b"1", "x/b.txt": b"1"})
    commit(tmp_path / "out", {}, ["x/y/z.txt"])
    assert sorted(p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*")) == ["out", "out/x", "out/x/b.txt"]


def test_the_mode_of_a_file_stays(tmp_path: Path) -> None:
    commit(tmp_path / "out", {"run.sh": b"1"})
    (tmp_path / "out" / "run.sh").chmod(0o750)
    commit(tmp_path / "out", {"run.sh": b"2"})
    assert (tmp_path / "out" / "run.sh").stat().st_mode & 0o777 == 0o750


@pytest.mark.parametrize(
    "contents",
    [
        {"a.txt": b"2", "x" * 300: b"2"},
        {"a.txt": b"2", "a.txt/b": b"2"},
        {"a.txt": b"2", "b": b"2", "b/c": b"2"},
        {"a.txt": b"2", "folder": b"2"},
    ],
    ids=["name too long", "a file where a folder is needed", "both a file and a folder", "a folder that is there"],
)
def test_nothing_is_moved_when_one_file_cannot_be(contents: dict[str, bytes], tmp_path: Path) -> None:
    commit(tmp_path / "out", {"a.txt": b"1", "folder/x": b"1"})
    with pytest.raises(SourceError, match=r"cannot write here|in the place of|the same name"):
        commit(tmp_path / "out", contents)
    assert (tmp_path / "out" / "a.txt").read_bytes() == b"1"
    assert not (tmp_path / "out" / STAGE).exists()


def test_two_runs_do_not_write_into_one_folder_at_once(tmp_path: Path) -> None:
    commit(tmp_path / "out", {"a.txt": b"1"})
    other = os.open(tmp_path / "out", os.O_RDONLY)
    try:
        fcntl.flock(other, fcntl.LOCK_EX)
        with pytest.raises(StoppedError, match="another run is writing") as stopped:
            commit(tmp_path / "out", {"a.txt": b"2"})
        assert str(stopped.value.location) == str(tmp_path / "out")
    finally:
        os.close(other)
    assert (tmp_path / "out" / "a.txt").read_bytes() == b"1"


@pytest.mark.parametrize("changed", ["edited", "deleted", "a folder"])
def test_a_file_that_somebody_changed_since_it_was_read_stops_the_run(changed: str, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    commit(folder, {"a.txt": b"first", "b.txt": b"first"})
    (folder / "b.txt").unlink()
    if changed == "edited":
        (folder / "b.txt").write_bytes(b"mine")
    elif changed == "a folder":
        (folder / "b.txt").mkdir()
    before = tree(folder)
    with pytest.raises((StoppedError, SourceError)):
        commit(folder, {"a.txt": b"second", "b.txt": b"second"}, (), {"a.txt": b"first", "b.txt": b"first"})
    assert tree(folder) == before


def test_a_file_that_came_since_the_run_looked_stops_it(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    commit(folder, {"a.txt": b"first"})
    (folder / "b.txt").write_bytes(b"mine")
    before = tree(folder)
    with pytest.raises(StoppedError, match="changed during the run"):
        commit(folder, {"b.txt": b"second"}, (), {"b.txt": None})
    with pytest.raises(StoppedError, match="changed during the run"):
        commit(folder, {}, ["b.txt"], {"b.txt": b"other"})
    assert tree(folder) == before


def test_a_read_only_file_is_neither_replaced_nor_removed(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    commit(folder, {"a.txt": b"first", "b.txt": b"first"})
    (folder / "b.txt").chmod(0o444)
    before = tree(folder)
    for contents, removed in (({"a.txt": b"second", "b.txt": b"second"}, []), ({"a.txt": b"second"}, ["b.txt"])):
        with pytest.raises(StoppedError, match="read-only") as stopped:
            commit(folder, contents, removed)
        assert stopped.value.fix == "make it writable, or move it away"
        assert tree(folder) == before
    commit(folder, {"a.txt": b"second"})
    assert (folder / "a.txt").read_bytes() == b"second"
