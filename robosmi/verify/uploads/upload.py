"""Uploads a compiled program to its board.

`upload_sketch` is the entry point: it checks the kept program (`compiled_program`) against the sketch, makes the board wait for
a program, and lets the tool of `uploader` send the program. Nothing is compiled here.

Some boards take programs by a drive: it is found where it is mounted, and a file is copied to it. What a drive looks like is
data (`uploaders/NAME.toml` of kind `copy`). A board restarts as soon as it has the file, so that its drive vanishes; an error
of the system after the last byte is none of the upload's then.
"""

from __future__ import annotations

import hashlib
import os
import re
import shlex
import string
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from glob import glob
from pathlib import Path
from typing import Any, NamedTuple

from filelock import FileLock, Timeout
from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.base.trust import acting
from robosmi.base.user_folders import cache_dir
from robosmi.diagnostics import Finding, Location
from robosmi.errors import PlatformDataError, SourceError, UploadError, UsageError
from robosmi.plugins import content
from robosmi.verify.toolchains.boards import Board, BootLoader, find_board, load_boards
from robosmi.verify.toolchains.build_record import BuildRecord
from robosmi.verify.toolchains.compiled_program import compiled_file, digests, folder_of, outside, read_record
from robosmi.verify.toolchains.sketch import Sketch, find_sketch
from robosmi.verify.toolchains.toolchain_data import Toolchain
from robosmi.verify.uploads import serial_ports
from robosmi.verify.uploads.uploader import COPY, Uploader, find_uploader, uploader_data

_POLL_S = 0.1


class UploadReport(Struct, frozen=True):
    """A program that was put on a board, or would be.

    Attributes:
        tool: the tool that did it, with its version.
        command: its program and arguments.
        bytes: how long the program is.
        board: name of the board.
        port: the port that it was sent to; a board that starts anew may have another one than was named.
        sent: whether it was sent.
        seconds: how long it took.
        note: what the user has to know of this way of sending; empty for nothing.
    """

    tool: str
    command: tuple[str, ...]
    bytes: int
    board: str
    port: str
    sent: bool
    seconds: float
    note: str = ""

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "tool": self.tool,
            "command": shlex.join(self.command),
            "arguments": list(self.command[1:]),
            "bytes": self.bytes,
            "board": self.board,
            "port": self.port,
            "sent": self.sent,
            "seconds": round(self.seconds, 3),
            **({"note": self.note} if self.note else {}),
        }


@inputs.read_once()
def upload_sketch(
    folder_or_sketch: str | Path,
    port: str | None = None,
    *,
    kept_in: Path | None = None,
    baud: int | None = None,
    unfinished: bool = False,
    dry_run: bool = False,
    project: Path | None = None,
) -> UploadReport:
    """Put the compiled program of a sketch on the board at a port.

    The tool of the board is data. One that knows signatures reads that of the microcontroller first, and sends nothing to another
    one; so does one that copies files to the board's drive, by what the drive says of the board.

    Args:
        folder_or_sketch: the generated folder, the sketch's folder in it, or its main file.
        port: the serial port, as the system calls it, or the folder of the board's drive; None where the tool finds the board.
        kept_in: the folder that the program was compiled into; the one that `compile` takes by itself if None.
        baud: the boot loader's baud rate; those of the board's data, one after the other, if None.
        unfinished: send a program with bodies that are still to be written, too.
        dry_run: send nothing; say what would be done.
        project: the project folder (see `robosmi.resources`); the current folder if None.

    Raises:
        SourceError: there is no sketch, it is not compiled or was changed since, it was compiled against stand-ins, has bodies
            to be written, is too big, or a finding says that the board may be damaged and nobody has accepted it.
        UsageError: the port's name is empty, or the baud rate is none.
        MissingToolError: the tool is not installed.
        UploadError: the board did not take the program.
        PlatformDataError: the repository's data is damaged, or says nothing about uploads to the board.
    """
    if port is not None and (not port.strip() or "\0" in port):
        raise UsageError("the port's name is empty", fix="give --port PORT")
    if baud is not None and baud <= 0:
        raise UsageError(f"{baud} is not a baud rate", fix="omit it, or give the boot loader's baud rate")
    started = time.perf_counter()
    with acting(project):
        named = Path(folder_or_sketch)
        sketch, toolchain = find_sketch(named, project)
        folder = kept_in if kept_in is not None else folder_of(named, sketch)
        _harmless(sketch)
        record = _record(sketch, folder, named)
        board = _board(record, toolchain, project, folder)
        loader = _loader(board)
        data = uploader_data(toolchain, project, loader.tool)
        file = compiled_file(folder, sketch, data.texts("files", (".hex",)))
        program = _kept(record, file, sketch, folder, named)
        length = _program_bytes(program, file)
        _sendable(sketch, toolchain, record, board, loader, length, unfinished)
        tool = find_uploader(toolchain, project, loader.tool)
        sending = _Sending(tool, board, loader, file, program, length, load_boards(toolchain.platform, project))
        actual, command = sending.send(_absolute(port) if port is not None else None, baud, dry_run=dry_run)
        seconds = time.perf_counter() - started
        note = data.text("note", "")
        return UploadReport(tool.title, tuple(command), length, board.name, actual, not dry_run, seconds, note)


class _Sending(NamedTuple):
    """A program on its way to a board.

    Attributes:
        tool: what sends it.
        board, loader: the board and its boot loader.
        file, program, length: the file with the program, its bytes, and how many of these are the program's.
        boards: all known ones.
    """

    tool: Uploader
    board: Board
    loader: BootLoader
    file: Path
    program: bytes
    length: int
    boards: Sequence[Board]

    def send(self, port: str | None, baud: int | None, *, dry_run: bool) -> tuple[str, list[str]]:
        """Send the program: the port that it was sent to, and the command.

        Raises:
            UploadError: the board did not take it.
            UsageError: the tool needs a port.
        """
        if self.tool.data.text("kind", "") == COPY:
            return self._copy(port, dry_run=dry_run)
        if port is None and self.tool.data.flag("port", True):
            raise UsageError("no port is given", fix=f"name the board's port: --port PORT; {self.tool.ports()}")
        with nullcontext() if dry_run or port is None else _alone(port):
            actual = port or ""
            if port is not None and not dry_run:
                actual = _awake(port, self.loader, self.tool, self.board, self.boards)
            for rate in (baud,) if baud is not None else self.loader.bauds or (0,):
                command = self.tool.command(self.board, self.loader, actual, rate, self.file)
                said = None if dry_run else self.tool.send(command, self.file.parent)
                if said is None:
                    return actual, command
                error, again = self.tool.upload_error(said, self.board, actual, self.boards, command)
                if not again:
                    break
            raise error

    def _copy(self, port: str | None, *, dry_run: bool) -> tuple[str, list[str]]:
        data = self.tool.data
        if port is None or _is_drive(port):
            drive = _find_drive(data, self.board, self.loader, Path(port) if port is not None else None)
        elif dry_run or not self.loader.touch_baud:
            raise UploadError(f"'{port}' is no folder of a drive", fix=f"{data.text('no_drive')}; name its folder with --port")
        else:
            with _alone(port):
                try:
                    serial_ports.touch(port, self.loader.touch_baud)
                except OSError as error:
                    fix = f"{data.text('no_drive')}; {self.tool.ports()}"
                    raise UploadError(f"{port}: {error.strerror or error}", fix=fix) from error
                drive = _wait_for_drive(data, self.board, self.loader, data.decimal("touch_returns_s"))
        if not dry_run:
            with _alone(str(drive)):
                _copy_to(drive, self.file.name, self.program, self.board)
        return str(drive), ["copy", str(self.file), str(drive)]


# ---- what may be sent


def _record(sketch: Sketch, folder: Path, named: Path) -> BuildRecord:
    """The record of the kept program.

    Raises:
        SourceError: there is none, or the program has a stand-in for the core in it.
    """
    record = read_record(folder, sketch)
    if record is not None and record.stand_in_core:
        raise SourceError(
            f"the program was compiled with a stand-in for the core '{record.stand_in_core}', which is only for checks",
            location=Location(str(folder)), fix="install that core (robosmi compile says how), then compile again",
        )  # fmt: skip
    if record is None:
        raise _not_compiled(folder, named)
    return record


def _not_compiled(folder: Path, named: Path) -> SourceError:
    fix = f"{_compile(named)} (after compile -o DIR, give --build DIR)"
    return SourceError("this sketch is not compiled yet", location=Location(str(folder)), fix=fix)


def _compile(named: Path) -> str:
    return f"compile it: robosmi compile {shlex.quote(str(named))}"


def _kept(record: BuildRecord, path: Path, sketch: Sketch, folder: Path, named: Path) -> bytes:
    """The kept program, which is of the sketch as it now stands.

    Raises:
        SourceError: it is not there, or something was changed since.
    """
    fix = _compile(named)
    if not path.is_file():
        raise _not_compiled(folder, named)
    program = inputs.read_bytes(path, inputs.OUTPUT)
    if hashlib.sha256(program).hexdigest() != record.program:
        raise SourceError("the program has changed since it was compiled", location=Location(str(path)), fix=fix)
    now = digests(sketch, folder) | outside(record.outside)
    before = record.sources | record.outside
    changed = sorted(name for name in now.keys() | before.keys() if now.get(name) != before.get(name))
    if changed:
        what = (
            "was changed" if changed[0] in now and changed[0] in before else "was added" if changed[0] in now else "was removed"
        )
        more = f", and {len(changed) - 1} more" if len(changed) > 1 else ""
        place = Location(str(sketch.folder / changed[0]))
        raise SourceError(f"the file {what} since the sketch was compiled{more}", location=place, fix=fix)
    return program


def _board(record: BuildRecord, toolchain: Toolchain, project: Path | None, folder: Path) -> Board:
    try:
        return find_board(record.board, load_boards(toolchain.platform, project))
    except UsageError as error:
        fix = "compile the sketch again for a known board"
        raise SourceError(error.message, location=Location(str(folder)), fix=fix) from error


def _sendable(
    sketch: Sketch, toolchain: Toolchain, record: BuildRecord, board: Board, loader: BootLoader, length: int, unfinished: bool
) -> None:
    """Make sure that a program is complete, without stand-ins for libraries, and that the board can hold it.

    Raises:
        SourceError: it is not, or cannot.
    """
    place = Location(str(sketch.main))
    if record.stand_ins:
        names = ", ".join(f"'{name}'" for name in record.stand_ins)
        raise SourceError(
            f"the program was compiled with stand-ins, which are only for checks: {names}", location=place,
            fix=f"{toolchain.libraries.text('install', 'install {names}').replace('{names}', names)}, then compile again",
        )  # fmt: skip
    if not record.fits or length > loader.takes_bytes:
        raise SourceError(
            f"the program is too big for '{board.name}': {length} bytes, the limit is {loader.takes_bytes}",
            location=place, fix="use a larger board (robosmi compile suggests one), or make the program smaller",
        )  # fmt: skip
    todo = [] if unfinished else _to_write(sketch, toolchain)
    if todo:
        more = f", the first of {len(todo)}" if len(todo) > 1 else ""
        raise SourceError(
            f"a body is still to be written{more}; its calls would do nothing", location=todo[0],
            fix="write it (MIGRATION.md lists all) and compile again, or upload anyway with --unfinished",
        )  # fmt: skip


def _harmless(sketch: Sketch) -> None:
    """Make sure that no finding about the wiring says that the board may be damaged, but those that the user has accepted.

    Raises:
        SourceError: one does.
    """
    refused: Sequence[Finding] = content("query", "upload_refusals")(sketch.folder.parent)
    if refused:
        first, more = refused[0], f", and {len(refused) - 1} more" if len(refused) > 1 else ""
        advice = f"{first.fix}; or " if first.fix else ""
        raise SourceError(
            f"the board may be damaged [{first.rule}]: {first.message}{more}", location=first.location,
            fix=f"{advice}accept it: [[accept]] with rule = \"{first.rule}\", element and reason in robosmi.toml",
        )  # fmt: skip


def _to_write(sketch: Sketch, toolchain: Toolchain) -> list[Location]:
    """The places of bodies that the user still has to write."""
    text = toolchain.sketch.text("unfinished", "")
    found = []
    for path in sorted(
        path for path in sketch.folder.iterdir() if text and path.is_file() and path.suffix not in (".md", ".orig")
    ):
        lines = inputs.read_text(path, inputs.OUTPUT, "utf-8", "replace").splitlines()
        found += [Location(str(path), number) for number, line in enumerate(lines, 1) if re.search(text, line)]
    return found


def _loader(board: Board) -> BootLoader:
    if board.boot_loader is None:
        message = f"no upload method is known for '{board.name}'"
        raise PlatformDataError(message, fix="add 'boot_loader' to the board's file, or upload the .hex with another tool")
    return board.boot_loader


def _program_bytes(program: bytes, file: Path) -> int:
    """How long a program is: the end of its last record (Intel HEX), which is where flash is written last, from where flash
    begins; the parts of a UF2 file; the length of any other file.

    Raises:
        SourceError: it is not of the kind that its name says.
    """
    if file.suffix == ".uf2":
        length = _uf2_bytes(program)
        if length is None:
            raise SourceError("the program is not a UF2 file", location=Location(str(file)), fix="compile the sketch again")
        return length
    if file.suffix != ".hex":
        return len(program)
    end = base = 0
    starts = []
    for line in program.split():
        try:
            record = bytes.fromhex(line[1:].decode("ascii"))
            count, address, kind = record[0], int.from_bytes(record[1:3], "big"), record[3]
        except (ValueError, IndexError) as error:
            raise SourceError(f"the program is not Intel HEX: {error}", fix="compile the sketch again") from error
        if kind == 0:
            end = max(end, base + address + count)
            starts.append(base + address)
        elif kind in (2, 4):
            base = int.from_bytes(record[4:6], "big") << (4 if kind == 2 else 16)
    return end - (min(starts, default=0) & ~_FLASH)


_FLASH = 0xFFFFFF
"""Flash begins at a multiple of the next number: at 0 on small microcontrollers, at 0x60000000 on some with flash outside."""


# ---- the board


def _absolute(port: str) -> str:
    """A port that is a path from here as one from the root: the tool runs in another folder."""
    return str(Path(port).absolute()) if not Path(port).is_absolute() and Path(port).exists() else port


@contextmanager
def _alone(port: str) -> Iterator[None]:
    """Exclude other uploads of this person to a port.

    Raises:
        UploadError: another one is going on there.
    """
    name = hashlib.sha256(str(Path(port).resolve()).encode("utf-8", "surrogateescape")).hexdigest()[:16]
    folder = cache_dir() / "ports"
    folder.mkdir(parents=True, exist_ok=True)
    try:
        with FileLock(folder / f"{name}.lock", timeout=0):
            yield
    except Timeout as error:
        raise UploadError(f"another upload to '{port}' is running", fix="wait for it, or stop it") from error


def _awake(port: str, loader: BootLoader, tool: Uploader, board: Board, boards: Sequence[Board]) -> str:
    """Make the board wait for a program, by opening its port at a certain rate if necessary; returns its port."""
    try:
        if loader.touch_baud:
            serial_ports.touch(port, loader.touch_baud)
        elif loader.programmer in tool.data.texts("probe", ()):
            serial_ports.probe(port)
    except OSError as error:
        raise tool.upload_error(f"{port}: {error.strerror or error}", board, port, boards)[0] from error
    if not loader.touch_baud:
        return port
    leaves, returns = tool.data.decimal("touch_leaves_s"), tool.data.decimal("touch_returns_s")
    found = serial_ports.comes_back(port, tool.data.texts("ports"), leaves, returns)
    if found is None:
        message = f"'{board.title}' reset for the upload, but did not reappear at port '{port}'"
        raise UploadError(message, fix=f"press its reset button twice and upload again; {tool.ports()}")
    return found


def _find_drive(data: DataTable, board: Board, loader: BootLoader, named: Path | None) -> Path:
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
            found = ", ".join(str(drive) for drive in _drives(data))
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
    every = _drives(data)
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


def _drives(data: DataTable) -> list[Path]:
    """The mounted drives that have the marker of such boards, sorted."""
    places = [path for pattern in data.texts("drives") for path in glob(pattern)]
    if os.name == "nt":
        places += [f"{letter}:\\" for letter in string.ascii_uppercase]
    found = {os.path.realpath(place): Path(place) for place in places if (Path(place) / data.text("marker")).is_file()}
    return sorted(found.values())


def _wait_for_drive(data: DataTable, board: Board, loader: BootLoader, seconds: float) -> Path:
    """The drive of a board that was made to start its boot loader.

    Raises:
        UploadError: it does not appear, or there are several.
    """
    end = time.monotonic() + seconds
    while True:
        try:
            return _find_drive(data, board, loader, None)
        except UploadError:
            if time.monotonic() >= end:
                raise
        time.sleep(_POLL_S)


def _copy_to(drive: Path, name: str, program: bytes, board: Board) -> None:
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


def _uf2_bytes(data: bytes) -> int | None:
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


def _is_drive(port: str) -> bool:
    """Whether what the user names as a port is a folder, and so a drive."""
    return Path(port).is_dir()
