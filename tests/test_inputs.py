"""Opening a file to read it: what is no ordinary file, what is too large, and what changes between the look and the opening."""

from __future__ import annotations

import os
import socket
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi import inputs
from robosmi.base.user_cache import read_own
from robosmi.inputs import InputRejectedError, Kind

SMALL = Kind("note", 1024 * 1024)


def pipe(path: Path) -> None:
    os.mkfifo(path)


def bound_socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(os.path.relpath(path))  # the name of a socket may have about 100 bytes


def null_device(path: Path) -> None:
    path.symlink_to(os.devnull)


def endless_device(path: Path) -> None:
    path.symlink_to("/dev/zero")


@pytest.mark.parametrize(
    ("make", "named"),
    [(pipe, "a named pipe"), (bound_socket, "a socket"), (null_device, "a device"), (endless_device, "a device")],
)
def test_what_is_no_ordinary_file_is_refused_without_waiting(
    make: Callable[[Path], None], named: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    make(tmp_path / "odd")
    with pytest.raises(InputRejectedError, match=named) as refused:
        inputs.read_bytes(tmp_path / "odd", SMALL)
    assert refused.value.fix


def test_a_pipe_that_takes_the_place_of_a_file_after_the_look_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").write_text("x")
    os.mkfifo(tmp_path / "pipe")
    ordinary = os.stat(tmp_path / "file")
    monkeypatch.setattr(os, "stat", lambda *_, **__: ordinary)
    with pytest.raises(InputRejectedError, match="a named pipe"):
        inputs.read_bytes(tmp_path / "pipe", SMALL)


def test_a_folder_and_a_missing_file_are_the_systems_errors(tmp_path: Path) -> None:
    with pytest.raises(IsADirectoryError):
        inputs.read_bytes(tmp_path, SMALL)
    with pytest.raises(FileNotFoundError):
        inputs.read_bytes(tmp_path / "none", SMALL)


@pytest.mark.parametrize("name", ["a\0b", "a\ud800"])
def test_what_no_file_can_be_called_is_refused(name: str) -> None:
    with pytest.raises(InputRejectedError, match="no file can have such a name"):
        inputs.read_bytes(name, SMALL)


def test_a_kinds_size_is_the_last_that_is_read(tmp_path: Path) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"")
    os.truncate(path, SMALL.most)
    assert len(inputs.read_bytes(path, SMALL)) == SMALL.most
    os.truncate(path, SMALL.most + 1)
    with pytest.raises(InputRejectedError, match="larger than 1 MB, the most that a note may have"):
        inputs.read_bytes(path, SMALL)


def test_a_size_that_is_wrong_is_not_believed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "file"
    path.write_bytes(b"x" * (SMALL.most + 1))
    empty = tmp_path / "empty"
    empty.write_bytes(b"")
    said = os.stat(empty)
    monkeypatch.setattr(os, "fstat", lambda _: said)
    with pytest.raises(InputRejectedError, match="larger than 1 MB"):
        inputs.read_bytes(path, SMALL)


def test_a_link_is_followed_unless_it_must_not_be(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x")
    (tmp_path / "link").symlink_to("file")
    assert inputs.read_bytes(tmp_path / "link", SMALL) == b"x"
    with pytest.raises(OSError, match="symbolic links"):
        inputs.read_bytes(tmp_path / "link", SMALL, follow=False)


def test_a_text_has_line_feeds(tmp_path: Path) -> None:
    (tmp_path / "file").write_bytes(b"a\r\nb\rc\n")
    assert inputs.read_text(tmp_path / "file", SMALL) == "a\nb\nc\n"


def test_nothing_stays_open(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("x" * 10)
    before = len(os.listdir("/proc/self/fd"))
    inputs.read_bytes(tmp_path / "file", SMALL)
    with pytest.raises(IsADirectoryError):
        inputs.read_bytes(tmp_path, SMALL)
    assert len(os.listdir("/proc/self/fd")) == before


def test_a_record_of_a_user_takes_no_more_memory_than_it_has_bytes(tmp_path: Path) -> None:
    path = tmp_path / "record"
    path.write_bytes(b"x" * 1000)
    path.chmod(0o600)
    kind = Kind("record", 1 << 30)
    tracemalloc.start()
    try:
        assert read_own(path, kind) == b"x" * 1000
        assert tracemalloc.get_traced_memory()[1] < 1 << 20
    finally:
        tracemalloc.stop()
    with pytest.raises(OSError, match="it is larger than"):
        read_own(path, Kind("record", 10))
