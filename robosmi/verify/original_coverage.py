"""The coverage of the original by runs: lines and branches of the user's files, as the compiler counts them.

A run leaves its coverage counters. `reached` compares runs with each other, which is cheap; `coverage` asks the compiler's
coverage tool which lines and branches the counters stand for.

The notes of an object name its functions; a file has the counters of runs. Their form is described in gcov-io.h of gcc. The
original leaves its counters through the pipe; what the coverage tool reads is written here, so that no code of the program
touches a file.
"""

from __future__ import annotations

import struct
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import as_table, json_of
from robosmi.errors import InternalError, MissingToolError, VerificationError
from robosmi.verify.joined_objects import Counters
from robosmi.verify.original import SourceCoverage
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.toolchains.temporary import temporary_folder
from robosmi.verify.toolchains.tools import run

_COUNTER_BYTES = 8

_NOTES, _DATA = 0x67636E6F, 0x67636461
_FUNCTION, _COUNTERS, _SUMMARY = 0x01000000, 0x01A10000, 0xA1000000
_WORD = struct.Struct("<I")
_BYTES = 8
_LEAST_VERSION = 9


def reached(program: OriginalProgram, counts: bytes) -> frozenset[int]:
    """The edges of the program's flow that a run has taken, as numbers that mean the same in each run of one program.

    Args:
        program: what ran.
        counts: what the run left (`OriginalRun.counts`).
    """
    places = (at for each in program.counters for at in range(each.begin, each.begin + each.size, _COUNTER_BYTES))
    return frozenset(at for at in places if any(counts[at : at + _COUNTER_BYTES]))


def coverage(program: OriginalProgram, runs: Iterable[bytes]) -> SourceCoverage:
    """Lines and branches that runs have reached together.

    Args:
        program: what ran; the folder that it was built in must still be there.
        runs: what each run left (`OriginalRun.counts`); runs that left nothing count for nothing.

    Raises:
        MissingToolError: the coverage tool is not installed.
    """
    _write_counters(program, [counts for counts in runs if counts])
    folder = program.binary.parent
    lines: dict[tuple[str, int], int] = {}
    branches: dict[tuple[str, int, int], int] = {}
    functions: dict[tuple[str, int], str] = {}
    for data in sorted(folder.glob("*.gcda")):
        for file in _ask(program, data)["files"]:
            name = str((Path(_ask_folder(program)) / file["file"]).resolve())
            for line in file["lines"]:
                place = name, int(line["line_number"])
                lines[place] = lines.get(place, 0) + int(line["count"])
                functions[place] = str(line.get("function_name", ""))
                for number, branch in enumerate(line["branches"]):
                    branches[*place, number] = branches.get((*place, number), 0) + int(branch["count"])
    return SourceCoverage(lines, branches, functions)


def _ask_folder(program: OriginalProgram) -> Path:
    return program.binary.parent


def _write_counters(program: OriginalProgram, runs: Sequence[bytes]) -> None:
    """Write the coverage tool's file for each object, with the counters of all runs."""
    of_object: dict[Path, list[Counters]] = {}
    for each in program.counters:
        of_object.setdefault(each.notes, []).append(each)
    for path, counters in of_object.items():
        notes = _read_notes(path)
        functions = {function.name: function for function in notes.functions}
        counts = [(functions[each.function], _summed(each, runs)) for each in counters if each.function in functions]
        path.with_suffix(".gcda").write_bytes(_counters_file(notes, counts, len(runs)))


def _summed(counters: Counters, runs: Sequence[bytes]) -> list[int]:
    """The counters of a function, summed over runs."""
    layout = struct.Struct(f"<{counters.size // _COUNTER_BYTES}Q")
    found = [layout.unpack_from(counts, counters.begin) for counts in runs if len(counts) >= counters.begin + layout.size]
    return [sum(each) for each in zip(*found, strict=True)] or [0] * (counters.size // _COUNTER_BYTES)


def _ask(program: OriginalProgram, data: Path) -> dict[str, Any]:
    tool = program.model.tools()["coverage"]
    with temporary_folder("coverage") as place:
        command = [tool, "--json-format", "--stdout", "--branch-probabilities", str(data)]
        try:
            done = run(command, Path(place))
        except MissingToolError as error:
            raise MissingToolError(error.message, fix=program.model.install) from error
    try:
        answer: dict[str, Any] = as_table(json_of(done.stdout))
    except ValueError:
        raise InternalError(f"'{tool}' printed no coverage data: {done.stderr.strip()[-300:]}") from None
    return answer


class CoveredFunction(Struct, frozen=True):
    """A function of an object: its name, and the number and two checksums by which the coverage tool knows it."""

    name: str
    marks: tuple[int, int, int]


class CoverageNotes(Struct, frozen=True):
    """What the compiler notes of an object.

    Attributes:
        version: of the format, as the file has it.
        stamp: tells one compilation from another.
        functions: the functions.
    """

    version: int
    stamp: int
    functions: tuple[CoveredFunction, ...]

    @property
    def compiler(self) -> int:
        """The compiler's major version."""
        first, second = self.version >> 24 & 0xFF, self.version >> 16 & 0xFF
        return (first - ord("A")) * 10 + second - ord("0") if first >= ord("A") else first - ord("0")

    @property
    def unit(self) -> int:
        """The number of bytes in which lengths are counted."""
        return 1 if self.compiler >= 12 else 4


def _read_notes(path: Path) -> CoverageNotes:
    """Read an object's notes.

    Raises:
        VerificationError: they cannot be read.
    """
    data = inputs.read_bytes(path, inputs.OUTPUT)
    try:
        magic, version, stamp = struct.unpack_from("<III", data)
        notes = CoverageNotes(version, stamp, ())
        if magic != _NOTES or notes.compiler < _LEAST_VERSION:
            raise ValueError
        return CoverageNotes(version, stamp, tuple(_functions(data, notes)))
    except (struct.error, ValueError):
        raise VerificationError("the compiler's coverage notes cannot be read", fix="use gcc 9 or newer") from None


def _functions(data: bytes, notes: CoverageNotes) -> list[CoveredFunction]:
    at = 16 if notes.unit == 1 else 12
    at += 4 + _WORD.unpack_from(data, at)[0] * notes.unit + 4  # the folder, and whether there are blocks that never run
    found = []
    while at + 8 <= len(data):
        tag, length = struct.unpack_from("<II", data, at)
        at += 8
        if tag == _FUNCTION:
            *marks, size = struct.unpack_from("<IIII", data, at)
            name = data[at + 16 : at + 16 + size * notes.unit].rstrip(b"\0").decode("utf-8", "surrogateescape")
            found.append(CoveredFunction(name.lstrip("*"), (marks[0], marks[1], marks[2])))
        at += length * notes.unit
    return found


def _counters_file(notes: CoverageNotes, counts: Sequence[tuple[CoveredFunction, Sequence[int]]], runs: int) -> bytes:
    """The content of a file with counters, as the program's own coverage runtime would write it.

    Args:
        notes: the object's notes.
        counts: functions of the object with the counters of each, summed over all runs.
        runs: the number of runs.
    """
    first = (_DATA, notes.version, notes.stamp) if notes.unit == 4 else (_DATA, notes.version, notes.stamp, 0)
    most = max((count for _, each in counts for count in each), default=0)
    made = [struct.pack(f"<{len(first)}I", *first), struct.pack("<IIII", _SUMMARY, 8 // notes.unit, runs, min(most, 0xFFFFFFFF))]
    for function, each in counts:
        made.append(struct.pack("<II3I", _FUNCTION, 12 // notes.unit, *function.marks))
        made.append(struct.pack("<II", _COUNTERS, len(each) * _BYTES // notes.unit))
        made.append(struct.pack(f"<{len(each)}Q", *(count & 0xFFFFFFFFFFFFFFFF for count in each)))
    return b"".join((*made, _WORD.pack(0)))
