"""A folder that is held open: nothing is read, written or removed through a link, whenever the link comes to be there."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from robosmi.errors import SourceError
from robosmi.files import commit as commit_module, directory_fd
from robosmi.files.commit import commit, update
from robosmi.files.directory_fd import DirectoryFd
from robosmi.files.recovery import STAGE, recover
from robosmi.files.run_lock import bind
from tests.running import tree

FOLDERS = [f"f{n}" for n in range(9)]
"""More than are kept open at once."""


@pytest.fixture(params=[True, False], ids=["held open", "by paths"])
def held(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> bool:
    """Whether the system can open folders; where it cannot, paths are looked at."""
    monkeypatch.setattr(directory_fd, "_HELD", directory_fd._HELD and request.param)
    return bool(request.param)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """An output folder with folders in it, and a folder of somebody's beside it."""
    commit(tmp_path / "out", {f"{name}/a": b"old" for name in FOLDERS})
    (tmp_path / "precious").mkdir()
    (tmp_path / "precious" / "a").write_text("precious")
    return tmp_path / "out"


@pytest.mark.usefixtures("held")
def test_files_are_written_moved_and_removed(folder: Path) -> None:
    (folder / "f1" / "a").chmod(0o640)
    update(folder, {"f1/a": b"new", "g/h/i": b"new", "f2/a": b"old"}, ["f3/a"])
    assert (folder / "f1" / "a").read_bytes() == (folder / "g" / "h" / "i").read_bytes() == b"new"
    assert (folder / "f1" / "a").stat().st_mode & 0o777 == 0o640
    assert not (folder / "f3").exists()
    assert sorted(path.name for path in folder.parent.iterdir()) == ["out", "precious"]
    assert not (folder / STAGE).exists()


@pytest.mark.parametrize("turn", ["before the journal", "after the journal"])
def test_a_link_that_comes_while_a_run_writes_leads_nowhere(turn: str, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Who may write in the folder puts a link in a folder's place after it was looked at."""
    name = "_untouched" if turn == "before the journal" else "finish"
    real = getattr(commit_module, name)

    def swapped(*arguments: object) -> None:
        if turn == "before the journal":
            real(*arguments)
        for one in FOLDERS:
            (folder / one).rename(folder / f"{one}-moved")
            (folder / one).symlink_to(folder.parent / "precious")
        if turn == "after the journal":
            real(*arguments)

    before = tree(folder.parent / "precious")
    with monkeypatch.context() as patched:
        patched.setattr(commit_module, name, swapped)
        with pytest.raises(SourceError):
            commit(folder, {f"{one}/a": b"new" for one in FOLDERS}, [f"{one}/b" for one in FOLDERS])
    assert tree(folder.parent / "precious") == before
    with pytest.raises(SourceError, match="leads out"):
        recover(folder)
    assert tree(folder.parent / "precious") == before
    for one in FOLDERS:
        (folder / one).unlink()
        (folder / f"{one}-moved").rename(folder / one)
    recover(folder)
    assert {(folder / one / "a").read_bytes() for one in FOLDERS} == {b"new"}
    assert not (folder / STAGE).exists()


def test_a_folder_whose_place_a_link_took_is_not_opened(folder: Path) -> None:
    """The look-up before it may be old: the system itself is told to follow no link."""
    with DirectoryFd(folder) as held:
        assert held.look("f1/a") is not None
        held._let_go()
        held._real["f1"] = "f1"  # as it was found before
        (folder / "f1").rename(folder / "moved")
        (folder / "f1").symlink_to(folder.parent / "precious")
        for work in (lambda: held.read("f1/a"), lambda: held.write("f1/new", b""), lambda: held.move("f2/a", "f1/a")):
            with pytest.raises(OSError, match=r"Not a directory|symbolic links") as raised:
                work()
            assert str(raised.value.filename).startswith(str(folder))
    assert tree(folder.parent / "precious") == {"a": tree(folder.parent / "precious")["a"]}


@pytest.mark.usefixtures("held")
@pytest.mark.parametrize("where", ["folder", "file", "waiting files"])
def test_what_is_there_by_a_link_is_neither_compared_nor_replaced(where: str, folder: Path) -> None:
    place = {"folder": "f1", "file": "f1/a", "waiting files": f"{STAGE}/new"}[where]
    if where == "waiting files":
        (folder / STAGE).mkdir()
        journal = b'{"move": {"new/a": "f1/a"}, "remove": []}'
        (folder / STAGE / "journal.json").write_bytes(journal)
        bind(folder, journal)
    elif where == "file":
        (folder / place).unlink()
    else:
        (folder / place).rename(folder / "moved")
    (folder / place).symlink_to(folder.parent / "precious" / ("a" if where == "file" else ""))
    before = tree(folder.parent)
    for data in (b"precious", b"new"):
        with pytest.raises(SourceError, match="link"):
            update(folder, {"f1/a": data})
        assert tree(folder.parent) == before


def test_a_pipe_in_a_files_place_is_told(folder: Path) -> None:
    (folder / "f1" / "a").unlink()
    os.mkfifo(folder / "f1" / "a")
    with pytest.raises(SourceError, match="in the place of a file"):
        update(folder, {"f1/a": b"new"})


def test_few_folders_are_held_at_once(tmp_path: Path) -> None:
    before = len(os.listdir("/proc/self/fd"))
    commit(tmp_path / "out", {f"{n}/{n}/{n}": b"1" for n in range(60)})
    with DirectoryFd(tmp_path / "out") as held:
        for n in range(60):
            assert held.has(f"{n}/{n}/{n}", b"1")
        assert len(os.listdir("/proc/self/fd")) <= before + 6
    assert len(os.listdir("/proc/self/fd")) == before
