"""Folders for passing files: removed at the end, and those of processes that were killed by the next one."""

from __future__ import annotations

import fcntl
import os
import subprocess
import sys
from pathlib import Path
from time import time

import pytest

from robosmi.verify.toolchains.temporary import sweep, temporary_folder


def gone() -> int:
    """The number of a process that has ended."""
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


def left(place: Path, name: str, hours: float) -> Path:
    """A folder with a file, as old as that."""
    folder = place / name
    folder.mkdir()
    (folder / "a.o").write_text("x")
    os.utime(folder, (time() - 3600 * hours,) * 2)
    return folder


def test_what_killed_processes_left_is_removed_and_nothing_else(tmp_path: Path) -> None:
    dead = gone()
    theirs = left(tmp_path, f"robosmi-tool-{dead}-abc_12", 2)
    stays = [
        left(tmp_path, f"robosmi-tool-{dead}-young", 0.1),
        left(tmp_path, f"robosmi-tool-{os.getpid()}-abc", 2),
        left(tmp_path, "robosmi-tool-abc", 2),
        left(tmp_path, f"other-tool-{dead}-abc", 2),
    ]
    link = tmp_path / f"robosmi-tool-{dead}-link"
    link.symlink_to(stays[3])
    sweep(tmp_path)
    assert not theirs.exists()
    assert all((each / "a.o").is_file() for each in stays)
    assert link.is_symlink()
    sweep(tmp_path / "not there")


def test_what_was_killed_just_now_is_removed_where_nobody_holds_it(tmp_path: Path) -> None:
    dead = gone()
    theirs, fresh, held, unknown = (
        left(tmp_path, f"robosmi-tool-{dead}-{name}", hours)
        for name, hours in (("held_1", 0.01), ("held_2", 0.0), ("held_3", 0.01), ("4", 0.01))
    )
    lock = os.open(held, os.O_RDONLY)  # as that of a process in another container
    fcntl.flock(lock, fcntl.LOCK_EX)
    sweep(tmp_path)
    assert [each.exists() for each in (theirs, fresh, held, unknown)] == [False, True, True, True]
    os.close(lock)
    sweep(tmp_path)
    assert not held.exists()


KILLED = """
import os, signal
from robosmi.verify.toolchains.temporary import temporary_folder
with temporary_folder("tool") as place:
    print(place, flush=True)
    os.kill(os.getpid(), signal.SIGKILL)
"""


def test_a_killed_process_leaves_no_lock(tmp_path: Path) -> None:
    command = [sys.executable, "-c", KILLED]
    told = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"TMPDIR": str(tmp_path)}, check=False)
    place = Path(told.stdout.strip())
    assert place.is_dir()
    assert place.parent == tmp_path
    os.utime(place, (time() - 60,) * 2)
    sweep(tmp_path)
    assert not place.exists()


def test_a_folder_tells_whose_it_is_and_goes() -> None:
    with temporary_folder("tool") as place:
        assert Path(place).name.startswith(f"robosmi-tool-{os.getpid()}-")
    assert not Path(place).exists()


INTERRUPTED = """
import shutil, sys
from robosmi.verify.toolchains import temporary

whole, where = shutil.rmtree, sys.argv[1]


def interrupted(path, **options):
    if where == "removed":
        raise KeyboardInterrupt
    if where == "written":
        (path / "late.o").write_text("x")
        return
    whole(path, **options)


def made(*_, **__):
    raise KeyboardInterrupt


temporary.shutil.rmtree = interrupted
mkdir = temporary.Path.mkdir
if where == "made":
    temporary.Path.mkdir = lambda path, **options: (mkdir(path, **options), made())
try:
    with temporary.temporary_folder("tool") as place:
        print(place)
except KeyboardInterrupt:
    print("interrupted")
temporary.shutil.rmtree = whole
"""


@pytest.mark.parametrize("where", ["removed", "written", "made"])
def test_an_interruption_while_a_folder_is_made_or_removed_leaves_none(where: str, tmp_path: Path) -> None:
    ran = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, where], env={**os.environ, "TMPDIR": str(tmp_path)}, capture_output=True, text=True,
        check=True,
    )  # fmt: skip
    assert ran.stdout.splitlines()[-1] == "interrupted" or where == "written"
    assert list(tmp_path.iterdir()) == []
