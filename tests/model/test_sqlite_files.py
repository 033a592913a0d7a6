"""SQLite files: a disk that is full, and pipes and devices in the place of a file."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from robosmi.errors import RobosmiError
from robosmi.recommend.history import History
from robosmi.recommend.index import LibraryIndex
from robosmi.transformations.knowledge.parts_store import PartsFile

FULL = """
import resource, signal, sys
from pathlib import Path
from robosmi.errors import SourceError
from robosmi.files.sqlite_files import writing
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))
try:
    with writing(Path(sys.argv[1]), "CREATE TABLE t(x);", 1, 1) as db:
        db.executemany("INSERT INTO t VALUES (?)", (("x" * 100,) for _ in range(1000)))
except SourceError as error:
    print(error.message)
"""

READERS: dict[str, Callable[[Path], object]] = {
    "index": LibraryIndex,
    "parts": PartsFile,
    "history that is read": lambda path: History(path).entries(),
    "history that is written": lambda path: History(path).record("p", "t", "A"),
}


@pytest.mark.skipif(os.name != "posix", reason="Windows has no limit of a file's size")
def test_a_disk_that_is_full_is_said_and_nothing_is_left(tmp_path: Path) -> None:
    path = tmp_path / "x.sqlite"
    path.write_bytes(b"old")
    done = subprocess.run([sys.executable, "-c", FULL, path], capture_output=True, text=True, check=True)
    assert "cannot write here" in done.stdout
    assert path.read_bytes() == b"old"
    assert [file.name for file in tmp_path.iterdir()] == ["x.sqlite"]


@pytest.mark.skipif(os.name != "posix", reason="Windows has no named pipes among files")
@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize("kind", ["a named pipe", "a device"])
def test_what_is_no_ordinary_file_is_not_opened(kind: str, reader: str, tmp_path: Path) -> None:
    path = tmp_path / "x.sqlite"
    if kind == "a device":
        path.symlink_to("/dev/zero")
    else:
        os.mkfifo(path)
    with pytest.raises(RobosmiError, match=kind):
        READERS[reader](path)
