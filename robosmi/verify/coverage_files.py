"""The files of gcc's coverage: which functions the notes of an object name, and a file with the counters of runs.

Their form is described in gcov-io.h of gcc. The original leaves its counters through the pipe; what the coverage tool reads is
written here, so that no code of the program touches a file.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path

from msgspec import Struct

from robosmi import inputs
from robosmi.errors import VerificationError

_NOTES, _DATA = 0x67636E6F, 0x67636461
_FUNCTION, _COUNTERS, _SUMMARY = 0x01000000, 0x01A10000, 0xA1000000
_WORD = struct.Struct("<I")
_COUNTER_BYTES = 8
_LEAST_VERSION = 9


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


def read_notes(path: Path) -> CoverageNotes:
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


def counters_file(notes: CoverageNotes, counts: Sequence[tuple[CoveredFunction, Sequence[int]]], runs: int) -> bytes:
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
        made.append(struct.pack("<II", _COUNTERS, len(each) * _COUNTER_BYTES // notes.unit))
        made.append(struct.pack(f"<{len(each)}Q", *(count & 0xFFFFFFFFFFFFFFFF for count in each)))
    return b"".join((*made, _WORD.pack(0)))
