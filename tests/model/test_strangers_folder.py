"""A journal that came with a folder is not obeyed; links lead nowhere; a run waits for another; a dry run leaves no trace."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from robosmi.errors import InternalError, RobosmiError, SourceError, StoppedError
from robosmi.files.commit import commit, update
from robosmi.files.recovery import STAGE, at_work, recover
from robosmi.files.run_lock import alone, bind
from robosmi.generate import Gen
from tests.running import tree


def planted(tmp_path: Path, move: dict[str, str], remove: list[str], *, bound: bool) -> Path:
    """An output folder with a journal that a stranger has made, and a file beside it that the journal attacks."""
    folder = tmp_path / "out"
    (folder / STAGE / "new").mkdir(parents=True)
    (folder / STAGE / "new" / "0").write_text("evil")
    (tmp_path / "victim.txt").write_text("precious")
    journal = json.dumps({"move": move, "remove": remove}).encode()
    (folder / STAGE / "journal.json").write_bytes(journal)
    if bound:
        bind(folder, journal)
    return folder


ATTACKS: list[tuple[dict[str, str], list[str]]] = [
    ({"new/0": "../victim.txt"}, []),
    ({}, ["../victim.txt"]),
    ({"new/0": "..\\victim.txt"}, []),
    ({"../../victim.txt": "taken.txt"}, []),
    ({"new/0": "link/victim.txt"}, []),
    ({}, ["link/victim.txt"]),
]


@pytest.mark.parametrize("bound", [False, True], ids=["found", "even of our own"])
@pytest.mark.parametrize(("move", "remove"), ATTACKS)
def test_a_journal_never_acts_outside_of_its_folder(move: dict[str, str], remove: list[str], bound: bool, tmp_path: Path) -> None:
    folder = planted(tmp_path, move, remove, bound=bound)
    (folder / "link").symlink_to(tmp_path)
    before = tree(tmp_path)
    with pytest.raises((StoppedError, SourceError)):
        recover(folder)
    assert tree(tmp_path) == before
    with pytest.raises((StoppedError, SourceError)):
        commit(folder, {"a": b"1"})
    assert tree(tmp_path) == before


def test_an_absolute_path_in_a_journal_is_refused(tmp_path: Path) -> None:
    folder = planted(tmp_path, {}, [str(tmp_path / "victim.txt")], bound=True)
    with pytest.raises(StoppedError, match="outside"):
        recover(folder)
    assert (tmp_path / "victim.txt").read_text() == "precious"


@pytest.mark.parametrize(
    "data", ["[]", "{", "{}", '{"move": 3, "remove": []}', "[" * 100_000, '{"move": {"new/0": 5}, "remove": []}']
)
def test_a_damaged_journal_is_told(data: str, tmp_path: Path) -> None:
    folder = planted(tmp_path, {}, [], bound=False)
    (folder / STAGE / "journal.json").write_text(data)
    bind(folder, data.encode())
    with pytest.raises(StoppedError, match="interrupted run"):
        recover(folder)


def test_a_folder_that_was_moved_is_reported_and_not_half_written(tmp_path: Path) -> None:
    folder = planted(tmp_path, {"new/0": "a"}, [], bound=True)
    folder.rename(tmp_path / "elsewhere")
    before = tree(tmp_path)
    with pytest.raises(StoppedError, match="in another place"):
        commit(tmp_path / "elsewhere", {"b": b"1"})
    assert tree(tmp_path) == before
    (tmp_path / "elsewhere").rename(folder)
    recover(folder)
    assert (folder / "a").read_text() == "evil"


@pytest.mark.parametrize("place", [f"out/{STAGE}", f"{STAGE}-out"])
def test_a_stage_that_is_a_link_is_not_followed(place: str, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "precious").mkdir()
    (tmp_path / "precious" / "file").write_text("1")
    (tmp_path / place).symlink_to(tmp_path / "precious")
    with pytest.raises(SourceError, match="link"):
        commit(tmp_path / "out", {"a": b"1"})
    assert (tmp_path / "precious" / "file").read_text() == "1"
    assert not (tmp_path / "out" / "a").exists()


def test_nothing_is_written_or_removed_through_a_link(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "a").write_text("precious")
    (tmp_path / "out" / "name").symlink_to(tmp_path / "other")
    for contents, removed in (({"name/a": b"1"}, []), ({"b": b"1"}, ["name/a"])):
        with pytest.raises(SourceError, match="leads out"):
            commit(tmp_path / "out", contents, removed)
    assert (tmp_path / "other" / "a").read_text() == "precious"
    os.link(tmp_path / "other" / "a", tmp_path / "out" / "hard")
    commit(tmp_path / "out", {"hard": b"new"})
    assert (tmp_path / "other" / "a").read_text() == "precious"


@pytest.mark.parametrize("name", ["../a", "/a", "a/../../b", "..\\a", "", f"{STAGE}/x", f"{STAGE.upper()}/x"])
def test_a_path_outside_is_never_written_or_removed(name: str, tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    with pytest.raises(InternalError, match="outside"):
        commit(tmp_path / "out", {name: b"1"})
    with pytest.raises(InternalError, match="outside"):
        commit(tmp_path / "out", {"a": b"1"}, [name])
    assert list((tmp_path / "out").iterdir()) == []


def test_a_dry_run_writes_nothing_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "home"))
    folder = tmp_path / "new" / "out"

    def generation() -> Gen:
        g = Gen(folder, {"t": "text"})
        g.rule(template="t", target="a.txt")(_none)
        return g

    generation().run(dry_run=True)
    assert list(tmp_path.iterdir()) == []
    (folder / STAGE).mkdir(parents=True)
    before = tree(tmp_path)
    with pytest.raises(StoppedError, match="interrupted"):
        generation().run(dry_run=True)
    assert tree(tmp_path) == before


def _none() -> None:
    return None


HOLDER = """
import sys, time
from pathlib import Path
from robosmi.files.recovery import at_work
with at_work(Path(sys.argv[1])):
    print("in", flush=True)
    time.sleep(60)
"""


def test_a_second_run_says_who_is_at_work_and_goes_on_when_that_run_is_killed(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    with subprocess.Popen([sys.executable, "-c", HOLDER, str(folder)], stdout=subprocess.PIPE, text=True) as other:
        assert other.stdout is not None
        assert other.stdout.readline() == "in\n"
        assert not folder.exists()
        with pytest.raises(StoppedError, match=rf"process {other.pid}\) is active"), alone(folder, patience=0.2):
            pass
        other.kill()
    commit(folder, {"a": b"1"})
    assert (folder / "a").read_bytes() == b"1"


def write_version(folder: Path, version: int) -> None:
    """One run: reads what is there and writes five files that belong together."""
    with at_work(folder):
        update(folder, {f"{n}/f": b"%d" % version * 999 for n in range(5)})


def test_rounds_of_two_to_four_first_and_later_runs_into_one_folder(tmp_path: Path) -> None:
    for number in range(12):
        folder = tmp_path / str(number // 2)
        children = []
        for one in range(2 + number % 3):
            child = os.fork()
            if child == 0:
                code = 1
                try:
                    write_version(folder, one)
                    code = 0
                finally:
                    os._exit(code)
            children.append(child)
        assert [os.waitpid(child, 0)[1] for child in children] == [0] * len(children)
        assert len({(folder / str(n) / "f").read_bytes() for n in range(5)}) == 1
        assert sorted(p.name for p in folder.iterdir()) == list("01234")
    assert not [p for p in tmp_path.iterdir() if p.name.startswith(STAGE)]


def test_kills_in_first_runs_leave_the_whole_folder_or_none(tmp_path: Path) -> None:
    folder, whole = tmp_path / "out", 0
    for number in range(40):
        child = os.fork()
        if child == 0:
            try:
                write_version(folder, number)
            finally:
                os._exit(0)
        time.sleep(number * 0.0003)
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        if folder.exists():
            whole += 1
            assert len({(folder / str(n) / "f").read_bytes() for n in range(5)}) == 1
        with at_work(folder):
            assert not [p for p in tmp_path.iterdir() if p.name.startswith(STAGE)]
        shutil.rmtree(folder, ignore_errors=True)
    assert whole < 40, "every run came through: the kills show nothing"


def test_a_folder_without_permission_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("ROBOSMI_HOME", str(tmp_path / "file" / "home"))
    monkeypatch.setattr("tempfile.gettempdir", lambda: str(tmp_path / "file"))
    with pytest.raises(RobosmiError, match="lock of a run cannot be written"):
        commit(tmp_path / "out", {"a": b"1"})
    assert not (tmp_path / "out").exists()
