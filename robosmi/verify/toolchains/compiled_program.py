"""What `compile` leaves behind: the program, a record of what it was made from, and how each file was compiled.

The folder `build` beside a sketch holds `<name>.elf` and `<name>.hex`, `<name>.build.json` (the record: board, libraries,
digests of the sketch's files and of the program) and `compile_commands.json` (a compilation database as Clang defines it).
All are written, or none. The record's form is `build_record`'s, building is done by `toolchain`, putting a program on a board by
`robosmi.verify.uploads`.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from robosmi import inputs
from robosmi.base.data_text import as_list, as_table, json_of, json_written
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, StoppedError
from robosmi.files.commit import update
from robosmi.generate.manifest import NAME as MANIFEST
from robosmi.verify.toolchains.build_record import FOLDER, BuildRecord, record_at
from robosmi.verify.toolchains.compile_report import CompileReport
from robosmi.verify.toolchains.libraries import STAND_IN
from robosmi.verify.toolchains.sketch import Sketch, check_inside, find_sketch
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.toolchain import compile_sketch

DATABASE = "compile_commands.json"
_QUOTED = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
_NO_SOURCE = (".md", ".orig")
"""Endings of files in a sketch's folder that no compiler reads."""


def folder_of(named: Path, sketch: Sketch) -> Path:
    """Where the program of a sketch is kept unless another folder is named: `build` in the output folder.

    Args:
        named: what the person named: the output folder, the sketch's folder in it, or its main file.
        sketch: the sketch that was found there.

    Raises:
        SourceError: a link leads out of the output folder.
    """
    above = sketch.folder.resolve().parent
    beside = named.resolve() == above or (above / MANIFEST).is_file()
    folder = (sketch.folder.parent if beside else sketch.folder) / FOLDER
    check_inside(folder)
    return folder


@inputs.read_once()
def compile_into(
    folder_or_sketch: Path, board: str | None = None, *, into: Path | None = None, project: Path | None = None
) -> CompileReport:
    """Compile a sketch and leave the program, its record and the compilation database in a folder, all or none.

    What does not compile leaves the compilation database alone; an older program stays, which its record tells from the sketch.

    Args:
        folder_or_sketch: as for `compile_sketch`.
        board: as for `compile_sketch`.
        into: the folder, made when missing; `folder_of` if None.
        project: as for `compile_sketch`.

    Returns:
        The report; its `elf` and `hex` are the files that were left.

    Raises:
        SourceError: the folder cannot be written, or a link leads out of the output folder; and as `compile_sketch`.
        StoppedError: another run is writing there, or a file there is read-only.
    """
    sketch, _ = find_sketch(Path(folder_or_sketch), project)
    folder = into if into is not None else folder_of(Path(folder_or_sketch), sketch)
    sources = digests(sketch, folder)
    with temporary_folder("kept") as kept:
        report = compile_sketch(folder_or_sketch, board, keep=Path(kept), project=project)
        contents = {DATABASE: _json(report.commands)}
        if report.ok:  # what is too big for the board has sizes, too, and no program
            program = inputs.read_bytes(report.hex, inputs.OUTPUT) if report.hex is not None else b""
            stand_ins = tuple(library.name for library in report.libraries if library.source == STAND_IN)
            limits = {"flash_limit": report.flash_limit, "ram_limit": report.ram_limit}
            sizes = {
                "flash_bytes": report.flash_bytes or 0, "ram_bytes": report.ram_bytes or 0,
                **{key: limit for key, limit in limits.items() if limit is not None},
                **({"stack_bytes": report.stack.bytes} if report.stack is not None and report.stack.certain else {}),
            }  # fmt: skip
            beyond = outside(_named_outside(sketch, sources))
            made = hashlib.sha256(program).hexdigest()
            record = BuildRecord(report.board, bool(report.fits), stand_ins, sources, made, sizes, beyond, report.stand_in_core)
            contents[_record_name(sketch)] = record.to_bytes()
        if report.elf is not None:
            contents[report.elf.name] = inputs.read_bytes(report.elf, inputs.OUTPUT)
            report = replace(report, elf=folder / report.elf.name)
        if report.hex is not None:
            contents[report.hex.name] = program
            report = replace(report, hex=folder / report.hex.name)
    _refuse_others(folder, sketch, contents)
    if into is None:
        check_inside(folder)  # it may have become a link meanwhile
    update(folder, contents)
    return replace(report, database=folder / DATABASE)


def _refuse_others(folder: Path, sketch: Sketch, contents: Iterable[str]) -> None:
    """Raise a StoppedError where a file in the folder bears a name of ours and no compile of this sketch has left it."""
    with suppress(SourceError):  # a damaged record is one of ours
        if read_record(folder, sketch) is None:
            for name in contents:
                path = folder / name
                if path.exists() and not (name == DATABASE and _is_database(path, sketch)):
                    raise StoppedError(
                        "a file here is not from compiling this sketch", location=Location(str(path)),
                        fix="give another folder with -o, or move the file",
                    )  # fmt: skip


def _is_database(path: Path, sketch: Sketch) -> bool:
    """Whether a file is the compilation database that an earlier run left, which had nothing else to leave."""
    try:
        entries = [as_table(entry) for entry in as_list(json_of(inputs.read_bytes(path, inputs.OUTPUT).decode()))]
        places = [(Path(str(each["directory"])) / str(each["file"])).resolve() for each in entries]
        return any(place.is_relative_to(sketch.folder.resolve()) for place in places)
    except (OSError, ValueError, KeyError, TypeError):
        return False


def _named_outside(sketch: Sketch, files: Iterable[str]) -> set[str]:
    """The files outside of the sketch's folder that its own files include by a path, `"../shared.h"` for example."""
    own = sketch.folder.resolve()
    named: set[Path] = set()
    for path in (own / name for name in files):
        text = inputs.read_text(path, inputs.OUTPUT, "utf-8", "replace")
        named |= {(path.parent / header).resolve() for header in _QUOTED.findall(text)}
    return {str(path) for path in named if not path.is_relative_to(own) and path.is_file()}


def outside(paths: Iterable[str]) -> dict[str, str]:
    """The files outside of a sketch's folder that can be read: path -> SHA-256."""
    found = {}
    for name in paths:
        with suppress(OSError):
            found[name] = hashlib.sha256(inputs.read_bytes(Path(name), inputs.OUTPUT)).hexdigest()
    return found


def digests(sketch: Sketch, kept_in: Path) -> dict[str, str]:
    """The files of a sketch's folder that may be part of its program: relative path -> SHA-256.

    Args:
        sketch: the sketch.
        kept_in: the folder for programs, which is not part of it where it lies inside.

    Raises:
        SourceError: a file cannot be read.
    """
    found: dict[str, str] = {}
    for path in sorted(sketch.folder.rglob("*")):
        name = path.relative_to(sketch.folder)
        hidden = any(part.startswith(".") for part in name.parts)
        if hidden or path.suffix in _NO_SOURCE or not path.is_file() or path.is_relative_to(kept_in):
            continue
        try:
            found[name.as_posix()] = hashlib.sha256(inputs.read_bytes(path, inputs.OUTPUT)).hexdigest()
        except OSError as error:
            fix = inputs.fix_of(error, "check its permissions")
            raise SourceError(f"the file cannot be read: {error.strerror}", location=Location(str(path)), fix=fix) from error
    return found


def compiled_file(folder: Path, sketch: Sketch, endings: Sequence[str] = (".hex",)) -> Path:
    """Where the program of a sketch lies in a folder that `compile_into` has written.

    Args:
        folder: the folder.
        sketch: the sketch.
        endings: of the files that its board takes; the core decides which it makes. The last one where none of them is there.
    """
    every = [
        path for ending in endings for path in (folder / f"{sketch.main.stem}{ending}", folder / f"{sketch.main.name}{ending}")
    ]
    return next((path for path in every if path.is_file()), folder / f"{sketch.main.stem}{endings[-1]}")


def read_record(folder: Path, sketch: Sketch) -> BuildRecord | None:
    """The record of a kept program, or None if there is none.

    Raises:
        SourceError: it is damaged.
    """
    return record_at(folder / _record_name(sketch))


def _record_name(sketch: Sketch) -> str:
    return f"{sketch.main.stem}.build.json"


def _json(value: Any) -> bytes:
    return (json_written(value, indent=1) + "\n").encode()
