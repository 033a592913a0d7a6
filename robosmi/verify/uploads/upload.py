"""Uploads a compiled program to its board.

`upload_sketch` is the entry point: it checks the kept program (`compiled_program`) against the sketch, makes the board wait for a
program, and lets the tool of `uploader` send the program. Nothing is compiled here.
"""

from __future__ import annotations

import hashlib
import re
import shlex
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, nullcontext
from pathlib import Path
from typing import Any

from filelock import FileLock, Timeout
from msgspec import Struct

from robosmi import inputs
from robosmi.base.trust import acting
from robosmi.base.user_folders import cache_dir
from robosmi.diagnostics import Finding, Location
from robosmi.errors import PlatformDataError, SourceError, UploadError, UsageError
from robosmi.plugins import content
from robosmi.verify.toolchains.boards import Board, BootLoader, find_board, load_boards
from robosmi.verify.toolchains.build_record import BuildRecord
from robosmi.verify.toolchains.compiled_program import compiled_hex, digests, folder_of, outside, read_record
from robosmi.verify.toolchains.sketch import Sketch, find_sketch
from robosmi.verify.toolchains.toolchain_data import Toolchain
from robosmi.verify.uploads import serial_ports
from robosmi.verify.uploads.uploader import Uploader, find_uploader


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
    """

    tool: str
    command: tuple[str, ...]
    bytes: int
    board: str
    port: str
    sent: bool
    seconds: float

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
        }


@inputs.read_once()
def upload_sketch(
    folder_or_sketch: str | Path,
    port: str,
    *,
    kept_in: Path | None = None,
    baud: int | None = None,
    unfinished: bool = False,
    dry_run: bool = False,
    project: Path | None = None,
) -> UploadReport:
    """Put the compiled program of a sketch on the board at a port.

    The tool reads the signature of the board's microcontroller first, and sends nothing to another one.

    Args:
        folder_or_sketch: the generated folder, the sketch's folder in it, or its main file.
        port: the serial port, as the system calls it.
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
    if not port.strip() or "\0" in port:
        raise UsageError("the port's name is empty", fix="give --port PORT")
    if baud is not None and baud <= 0:
        raise UsageError(f"{baud} is not a baud rate", fix="omit it, or give the boot loader's baud rate")
    started = time.perf_counter()
    with acting(project):
        named = Path(folder_or_sketch)
        sketch, toolchain = find_sketch(named, project)
        folder = kept_in if kept_in is not None else folder_of(named, sketch)
        _harmless(sketch)
        record, program = _kept(sketch, folder, named)
        board = _board(record, toolchain, project, folder)
        loader = _loader(board)
        length = _program_bytes(program)
        _sendable(sketch, toolchain, record, board, loader, length, unfinished)
        tool = find_uploader(toolchain, project)
        boards = load_boards(toolchain.platform, project)
        port = _absolute(port)
        with nullcontext() if dry_run else _alone(port):
            actual = port if dry_run else _awake(port, loader, tool, board, boards)
            for rate in (baud,) if baud is not None else loader.bauds:
                command = tool.command(board, loader, actual, rate, compiled_hex(folder, sketch))
                said = None if dry_run else tool.send(command, folder)
                if said is None:
                    seconds = time.perf_counter() - started
                    return UploadReport(tool.title, tuple(command), length, board.name, actual, not dry_run, seconds)
                error, again = tool.upload_error(said, board, actual, boards, command)
                if not again:
                    break
            raise error


# ---- what may be sent


def _kept(sketch: Sketch, folder: Path, named: Path) -> tuple[BuildRecord, bytes]:
    """The kept program and its record; both are of the sketch as it now stands.

    Raises:
        SourceError: there is none, or something was changed since.
    """
    record, path, fix = (
        read_record(folder, sketch),
        compiled_hex(folder, sketch),
        f"compile it: robosmi compile {shlex.quote(str(named))}",
    )
    if record is not None and record.stand_in_core:
        raise SourceError(
            f"the program was compiled with a stand-in for the core '{record.stand_in_core}', which is only for checks",
            location=Location(str(folder)), fix="install that core (robosmi compile says how), then compile again",
        )  # fmt: skip
    if record is None or not path.is_file():
        what = "this sketch is not compiled yet"
        raise SourceError(what, location=Location(str(folder)), fix=f"{fix} (after compile -o DIR, give --build DIR)")
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
    return record, program


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
    """Make sure that no finding about the wiring says that the board may be damaged, but those that a person has accepted.

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
    """The places of bodies that a person still has to write."""
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


def _program_bytes(text: bytes) -> int:
    """How long a program is: the end of its last record (Intel HEX), which is where flash is written last.

    Raises:
        SourceError: it is no Intel HEX.
    """
    end = base = 0
    for line in text.split():
        try:
            record = bytes.fromhex(line[1:].decode("ascii"))
            count, address, kind = record[0], int.from_bytes(record[1:3], "big"), record[3]
        except (ValueError, IndexError) as error:
            raise SourceError(f"the program is not Intel HEX: {error}", fix="compile the sketch again") from error
        if kind == 0:
            end = max(end, base + address + count)
        elif kind in (2, 4):
            base = int.from_bytes(record[4:6], "big") << (4 if kind == 2 else 16)
    return end


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
