"""Output folders that several accounts of the system share: what another account left is neither obeyed nor half replaced.

The other account is a real one: a child process gives up its rights for good. Only root can do so.
"""

from __future__ import annotations

import os
import shutil
import signal
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest.mock import patch

import pytest

from robosmi.errors import RobosmiError
from robosmi.files.commit import commit, update
from robosmi.files.directory_fd import DirectoryFd
from robosmi.files.recovery import STAGE, at_work, interrupted, recover
from robosmi.generate import Gen
from tests.running import tree

OTHER = 65534
"""The account `nobody`."""
pytestmark = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root can become another account, as this test does"
)


@pytest.fixture
def shared_folder() -> Iterator[Path]:
    """A folder that all accounts reach; pytest's own is closed to others."""
    folder = Path(tempfile.mkdtemp(prefix="robosmi-accounts-"))
    folder.chmod(0o755)
    (folder / "home").mkdir()
    os.chown(folder / "home", OTHER, OTHER)
    yield folder
    shutil.rmtree(folder)


def as_other(work: Callable[[], object], home: Path) -> str:
    """Do some work as another account with data of its own; returns an empty text, or the error's class and message."""
    with tempfile.TemporaryDirectory() as warm:  # what is loaded late must be there: the other account may not read it
        commit(Path(warm) / "out", {"a": b"1"})
        commit(Path(warm) / "out", {"a": b"2"})
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        said = "no answer"
        try:
            os.setgroups([])
            os.setresgid(OTHER, OTHER, OTHER)
            os.setresuid(OTHER, OTHER, OTHER)
            os.environ["ROBOSMI_HOME"] = str(home)
            try:
                work()
                said = ""
            except RobosmiError as error:
                said = f"{type(error).__name__}: {error.message}"
        except BaseException as error:
            said = repr(error)
        finally:
            os.write(writing, said.encode())
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading, encoding="utf-8") as answer:
        said = answer.read()
    os.waitpid(child, 0)
    return said


def killed_with_a_journal(folder: Path) -> None:
    """A run of this account that is killed after its journal is there."""
    child = os.fork()
    if child == 0:
        with patch("robosmi.files.commit.finish", lambda _: os.kill(os.getpid(), signal.SIGKILL)):
            commit(folder, {"a": b"new", "b": b"new"})
    os.waitpid(child, 0)
    assert interrupted(folder)


def test_another_account_does_not_carry_out_a_journal(shared_folder: Path) -> None:
    folder = shared_folder / "out"
    commit(folder, {"a": b"old", "b": b"old"})
    folder.chmod(0o777)
    killed_with_a_journal(folder)
    before = tree(folder)
    said = as_other(lambda: update(folder, {"a": b"other"}), shared_folder / "home")
    assert said.startswith("StoppedError: ")
    assert tree(folder) == before
    recover(folder)
    assert (folder / "a").read_bytes() == (folder / "b").read_bytes() == b"new"


def test_a_journal_of_another_account_is_not_carried_out_by_root(shared_folder: Path) -> None:
    folder = shared_folder / "out"
    (folder / "sub").mkdir(parents=True)
    (folder / "sub" / "mine").write_bytes(b"precious")
    os.chown(folder, OTHER, OTHER)

    def plant() -> None:
        (folder / STAGE / "new").mkdir(parents=True)
        (folder / STAGE / "new" / "0").write_text("evil")
        (folder / STAGE / "journal.json").write_text('{"move": {"new/0": "sub/mine"}, "remove": []}')

    assert as_other(plant, shared_folder / "home") == ""
    before = tree(folder)
    with pytest.raises(RobosmiError, match="another user"):
        update(folder, {"a": b"1"})
    assert tree(folder) == before


def test_a_folder_of_another_account_is_not_written(shared_folder: Path) -> None:
    folder = shared_folder / "out"
    commit(folder, {"a": b"old", "deep/b": b"old"})
    before = tree(shared_folder)
    for inner in ("a", "deep/b", "deep/c"):
        said = as_other(lambda inner=inner: update(folder, {inner: b"other"}), shared_folder / "home")  # type: ignore[misc]
        assert said == "SourceError: cannot write here: Permission denied"
    assert as_other(lambda: commit(shared_folder / "new", {"a": b"1"}), shared_folder / "home").startswith("SourceError")
    assert {name: data for name, data in tree(shared_folder).items() if not name.startswith("home/")} == before


def test_files_of_others_in_a_folder_where_only_owners_replace_are_left_whole(shared_folder: Path) -> None:
    folder = shared_folder / "out"
    commit(folder, {"z": b"old"})
    folder.chmod(0o1777)
    for contents, removed in (({"a": b"other", "z": b"other"}, []), ({"a": b"other"}, ["z"])):
        said = as_other(lambda c=contents, r=removed: commit(folder, c, r), shared_folder / "home")  # type: ignore[misc]
        assert "belongs to another account" in said
        assert [path.name for path in folder.iterdir()] == ["z"]
    assert as_other(lambda: update(folder, {"a": b"other"}), shared_folder / "home") == ""
    assert {path.name: path.read_bytes() for path in folder.iterdir()} == {"a": b"other", "z": b"old"}


def test_a_run_of_another_account_is_kept_out_while_files_are_written(shared_folder: Path) -> None:
    folder = shared_folder / "out"
    commit(folder, {"a": b"old"})
    folder.chmod(0o777)
    with at_work(folder), DirectoryFd(folder) as held, held.locked():
        said = as_other(lambda: update(folder, {"a": b"other"}), shared_folder / "home")
    assert said == "StoppedError: another run is writing into this folder"
    assert (folder / "a").read_bytes() == b"old"
    assert as_other(lambda: update(folder, {"a": b"other"}), shared_folder / "home") == ""
    assert (folder / "a").read_bytes() == b"other"


def test_a_record_of_another_account_removes_nothing(shared_folder: Path) -> None:
    """The files that a run of another account has made are not its to remove."""
    folder = shared_folder / "out"

    def run(*names: str) -> None:
        g = Gen(folder, {"t": "x"}, keep=True)
        g.rule(domain=names, template="t", target=lambda n: f"sub/{n}")(lambda n: None)
        g.run()

    run("a", "b")
    for path in (folder, *folder.rglob("*")):
        path.chmod(0o777 if path.is_dir() else 0o666)
    assert as_other(lambda: run("a"), shared_folder / "home") == ""
    assert (folder / "sub" / "b").read_text() == "x"
    run("a")
    assert (folder / "sub" / "a").read_text() == "x"
