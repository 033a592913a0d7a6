"""Drives by which boards take programs: finding the mounted drive of a board, and copying a file to it.

What a drive looks like is data (`uploaders/NAME.toml` of kind `copy`). A board restarts as soon as it has the file, so that its
drive vanishes; an error of the system after the last byte is none of the upload's then.
"""

from __future__ import annotations

import os
import re
import string
import time
from glob import glob
from pathlib import Path

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.errors import UploadError
from robosmi.verify.toolchains.boards import Board, BootLoader

_POLL_S = 0.1


def find_drive(data: DataTable, board: Board, loader: BootLoader, named: Path | None) -> Path:
    """The mounted drive of a board.

    Args:
        data: what its drive looks like.
        board: the board.
        loader: its boot loader; `programmer` is what the drive says of the board.
        named: the drive that the user names; None to search the places where drives are mounted.

    Raises:
        UploadError: there is none, there are several, or the named one is of another board or of none.
    """
    marker = data.text("marker")
    if named is not None:
        if not (named / marker).is_file():
            found = ", ".join(str(drive) for drive in drives(data))
            raise UploadError(
                f"'{named}' is not the drive of a board: it has no {marker}",
                fix=f"{data.text('no_drive')}; {f'found: {found}' if found else 'no such drive is mounted'}",
            )
        if (other := _another(named, data, loader)) is not None:
            raise UploadError(
                f"'{named}' is the drive of another board than '{board.title}': {other or 'it does not say which'}",
                fix="connect the board that the program was compiled for, or move the program to this one and compile it",
            )
        return named
    every = drives(data)
    mine = [drive for drive in every if _another(drive, data, loader) is None]
    if len(mine) > 1:
        listed = ", ".join(str(drive) for drive in mine)
        raise UploadError(f"{len(mine)} boards wait for a program: {listed}", fix="name one with --port")
    if not mine:
        others = ", ".join(f"{drive} ({_another(drive, data, loader) or 'unknown board'})" for drive in every)
        more = f"; drives of other boards: {others}" if others else ""
        raise UploadError(
            f"no drive of '{board.title}' ({loader.programmer}) is mounted{more}",
            fix=f"{data.text('no_drive')}; or name its folder with --port",
        )
    return mine[0]


def drives(data: DataTable) -> list[Path]:
    """The mounted drives that have the marker of such boards, sorted."""
    places = [path for pattern in data.texts("drives") for path in glob(pattern)]
    if os.name == "nt":
        places += [f"{letter}:\\" for letter in string.ascii_uppercase]
    found = {os.path.realpath(place): Path(place) for place in places if (Path(place) / data.text("marker")).is_file()}
    return sorted(found.values())


def wait_for_drive(data: DataTable, board: Board, loader: BootLoader, seconds: float) -> Path:
    """The drive of a board that was made to start its boot loader.

    Raises:
        UploadError: it does not appear, or there are several.
    """
    end = time.monotonic() + seconds
    while True:
        try:
            return find_drive(data, board, loader, None)
        except UploadError:
            if time.monotonic() >= end:
                raise
        time.sleep(_POLL_S)


def copy_to(drive: Path, name: str, program: bytes, board: Board) -> None:
    """Copy a program to a drive.

    Raises:
        UploadError: the drive did not take all of it.
    """
    place, sent = drive / name, 0
    try:
        handle = os.open(
            place, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | inputs.flags("O_BINARY", "O_NOFOLLOW", "O_CLOEXEC"), 0o644
        )
        try:
            while sent < len(program):
                sent += os.write(handle, program[sent:])
            os.fsync(handle)
        finally:
            os.close(handle)
    except OSError as error:
        if sent == len(program) and not drive.is_dir():
            return  # it has the whole file, and restarts
        raise UploadError(
            f"'{drive}' did not take the program for '{board.title}': {error.strerror or error} after {sent} of "
            f"{len(program)} bytes",
            fix="check that the drive may be written and has room, reset the board into its boot loader, then upload again",
        ) from error


def _another(drive: Path, data: DataTable, loader: BootLoader) -> str | None:
    """What a drive says of its board, where that is another one; None if it is the wanted one."""
    if data.flag("by_name", False):
        name = drive.name
        return None if name and loader.programmer.startswith(name[: len(loader.programmer)]) and len(name) >= _LABEL else name
    try:
        said = inputs.read_text(drive / data.text("marker"), inputs.SETTINGS, "utf-8", "replace")
    except OSError:
        return ""
    found = re.search(data.text("board_id"), said, re.MULTILINE)
    return None if found is not None and found[1] == loader.programmer else found[1] if found is not None else ""


_LABEL = 8
"""Least length of a drive's name that is a board's; the name of a drive has at most eleven characters, so it may be cut."""


def uf2_bytes(data: bytes) -> int | None:
    """How many bytes of program a UF2 file has; None if it is none.

    Args:
        data: the file: blocks of 512 bytes, each with the length of its part at byte 16 (UF2 specification).
    """
    total = 0
    for at in range(0, len(data), 512):
        block = data[at : at + 512]
        if len(block) != 512 or block[:8] != b"UF2\n\x57\x51\x5d\x9e":
            return None
        total += int.from_bytes(block[16:20], "little")
    return total if data else None


def is_drive(port: str) -> bool:
    """Whether what the user names as a port is a folder, and so a drive."""
    return Path(port).is_dir()
