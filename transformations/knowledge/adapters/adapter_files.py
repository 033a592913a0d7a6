"""Adapter files: C or C++ with marker comments, one file for each header of the source platform, as pieces with declared needs.

A piece begins with a line `//# KIND NAME` and goes on with lines `//#   KEY: VALUE`; behind them stands its text, up to the
next piece. Kinds and keys are described in docs/reference/adapter-files.md. Here they are read and checked one by one; whether
what they declare is what the text uses, and which of them a program needs, is found elsewhere (`queries.plans.adapter_needs`, the
tests).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.transformations.knowledge.adapters.adapter_ranges import argument_range
from robosmi.transformations.knowledge.adapters.adapter_records import (
    AdapterFile,
    AdapterPiece,
    AdapterPin,
    ArgumentRange,
    ConventionalPort,
    InterruptStack,
    PortTable,
)

MARK = "//#"
NOT_SERVED = "unsupported"
"""A line `//# unsupported REASON` after the header's line: the target cannot support this header."""
TASK = "task"
"""A line `//# task NAME REASON` after the header's line: no adapter is possible for the function; the user has to replace it."""
KINDS = ("adapter", "constant", "register", "variable", "type", "helper")
"""The kinds of pieces: for a function, constant, register, variable or type of the source, or a helper used only by adapters."""
RELATIONS = ("oneToOne", "oneToMany", "manyToOne", "semantic")
"""How calls correspond (paper 5.3): one to one, one to several, several to one, or by another mechanism with the same effect."""
CAPABILITIES = ("digital", "pwm", "interrupt", "analog")
DIRECTIONS = ("in", "out", "both")
HAL = "hal"
"""The hardware layer: what its files have in the place of a header, and the folder that they are in."""
ARCHITECTURE = "architecture"
"""A line `//# architecture NAME...` after the header's line: all pieces of the file are for these; also a key of a piece."""
_LISTS = (
    "needs",
    "include",
    "timer",
    "vector",
    "taken",
    "mcu",
    ARCHITECTURE,
    "members",
    "beside",
    "drawn",
    "library",
    "symmetric",
)
_ATTRIBUTES = {
    "include": "includes", "timer": "timers", "vector": "vectors", "mcu": "mcus", ARCHITECTURE: "architectures",
    "library": "libraries",
}  # fmt: skip
_TEXTS = (
    "for",
    "kind",
    "role",
    "setup",
    "fidelity",
    "limit",
    "pin",
    "port",
    "name",
    "table",
    "stack",
    "interrupt",
    "ram",
    "servos",
    "range",
)
_CONDITIONAL = ("setup", "fidelity", "limit", "range", "include")
OTHERS = "other"
"""In the place of an architecture: those that no line of the piece's head names."""
_PIN = re.compile(r"(\w+) (\w+) (\w+)( signed)?( split)?(?: ([\w-]+))?")
_STACK = re.compile(r"(\d+)(?: (\d+))?")
_INTERRUPT = re.compile(r"(\w+_vect) (\d+)(?: (\d+))?")
_TABLE = re.compile(r"(\w+) (\d+)")
_PORT = re.compile(r"(\w+) = (\w+\.\w+) (\d+) (\w+) (\w+)(?: ([\w-]+))?")


def read_adapter_file(path: Path) -> list[AdapterPiece]:
    """Read the pieces of an adapter file, in order; raises the errors of `adapter_file`."""
    try:
        text = inputs.read_text(path, inputs.DATA)
    except (OSError, ValueError) as error:
        raise PlatformDataError(f"the adapter file cannot be read: {error}", location=Location(str(path))) from error
    return adapter_file(path, text).pieces


def adapter_file(path: Path, text: str) -> AdapterFile:
    """What the text of an adapter file says.

    Raises:
        PlatformDataError: a marker is wrong: an unknown kind or key, a value that is none of those allowed, text before the first
            piece, a second header, a piece without text or named twice for one microcontroller; or a text is not what its markers
            say (`adapter_checks`).
    """
    made = AdapterFile()
    pieces = made.pieces
    pieces += _pieces(path, text.removeprefix("\ufeff").split("\n"), made)  # some editors write a mark
    if not made.header:
        raise _wrong(Location(str(path)), "the source platform's header is missing", f"begin with `{MARK} header NAME`")
    seen: set[tuple[str, str, str]] = set()
    for piece in pieces:
        conditions = (sorted(piece.members), sorted(piece.beside), sorted(piece.drawn), sorted(piece.architectures))
        condition = " beside ".join(" ".join(names) for names in conditions)
        for mcu in piece.mcus or [""]:
            if (piece.name, mcu, condition) in seen:
                where = f" for {mcu}" if mcu else ""
                raise _wrong(piece.location, f"'{piece.name}' occurs twice{where}", "remove one, or give them `mcu`")
            seen.add((piece.name, mcu, condition))
    return made


def _wrong(location: Location, message: str, fix: str) -> PlatformDataError:
    return PlatformDataError(message, location=location, fix=fix)


def _pieces(path: Path, lines: list[str], made: AdapterFile) -> Iterator[AdapterPiece]:
    """Parse the pieces of a file; statements about the header are stored in `made`."""
    piece, marking = None, False
    text: list[str] = []
    head: _Head = []
    for number, line in enumerate(lines, 1):
        place = Location(str(path), number)
        if not line.startswith(MARK):
            if piece is not None:
                text.append(line)
                marking = False
            elif line.strip() and not line.startswith("//"):
                raise _wrong(place, "the file has text before the first piece", f"begin a piece with `{MARK} KIND NAME`")
            continue
        said = line[len(MARK) :]
        if said.startswith("   "):
            if piece is None or not marking:
                raise _wrong(place, "a marker is outside the head of a piece", "move it up, below `//# KIND NAME`")
            head.append(_marker(said.strip(), place))
            continue
        if piece is not None:
            yield from _variants(piece, text, head)
        words = said.split()
        if len(words) == 2 and words[0] == "header":
            if made.header:
                raise _wrong(place, "the file has a second header", "use one file per header")
            made.header = words[1]
            continue
        if len(words) > 1 and words[0] == ARCHITECTURE and made.header and piece is None:
            made.architectures += words[1:]
            continue
        if len(words) > 1 and words[0] == NOT_SERVED and made.header and piece is None:
            made.unsupported = said.split(maxsplit=1)[1]
            continue
        if len(words) > 2 and words[0] == TASK and made.header and piece is None:
            made.tasks[words[1]] = said.split(maxsplit=2)[2]
            continue
        if len(words) != 2 or words[0] not in KINDS:
            wrong = words[0] if words else ""
            raise _wrong(
                place, f"unknown kind of piece '{wrong}'{did_you_mean(wrong, KINDS)}",
                f"write `{MARK} KIND NAME` with one of: {', '.join(KINDS)}",
            )  # fmt: skip
        if not made.header:
            raise _wrong(place, "the source platform's header is missing", f"begin with `{MARK} header NAME`")
        piece, text, marking, head = AdapterPiece(words[0], words[1], made.header, place), [], True, []
        piece.architectures += made.architectures
    if piece is not None:
        yield from _variants(piece, text, head)


class _Marker(NamedTuple):
    """A marker line of a piece's head: `KEY [ARCHITECTURE...]: VALUE`."""

    key: str
    value: str
    place: Location
    architectures: frozenset[str]


_Head = list[_Marker]


def _marker(said: str, place: Location) -> _Marker:
    """Split a marker line."""
    keys, colon, value = said.partition(":")
    key, *architectures = keys.split() or [""]
    value = value.strip()
    if not colon or key not in (*_LISTS, *_TEXTS) or not value or (architectures and key not in _CONDITIONAL):
        raise _wrong(
            place, f"'{said}' is not a marker{did_you_mean(key, [*_LISTS, *_TEXTS])}",
            f"write KEY: VALUE with one of: {', '.join(sorted((*_LISTS, *_TEXTS)))}",
        )  # fmt: skip
    return _Marker(key, value, place, frozenset(architectures))


def _variants(piece: AdapterPiece, text: list[str], head: _Head) -> Iterator[AdapterPiece]:
    """A piece, once for each architecture that a line of its head names, and once for all others."""
    named = sorted({name for marker in head for name in marker.architectures} - {OTHERS})
    if named and (piece.architectures or any(marker.key == ARCHITECTURE for marker in head)):
        place = next(marker.place for marker in head if marker.architectures)
        raise _wrong(place, f"'{piece.name}' is for one architecture already", f"write the key without '{' '.join(named)}'")
    for name in (*named, ""):
        variant = AdapterPiece(piece.kind, piece.name, piece.header, piece.location)
        variant.architectures = [name] if name else [*piece.architectures]
        own = [marker for marker in head if not marker.architectures or (name or OTHERS) in marker.architectures]
        for marker in own:
            _take(variant, marker)
        yield _finished(variant, text, {(marker.key, marker.value): marker.place.line or 0 for marker in own})


def _finished(piece: AdapterPiece, text: list[str], marks: Mapping[tuple[str, str], int]) -> AdapterPiece:
    """Complete a piece with its text, checked against its markers."""
    piece.text = "\n".join(text).strip("\n")
    if not piece.text.strip():
        raise _wrong(piece.location, f"'{piece.name}' has no text", "write it below its markers, or remove the piece")
    if piece.kind == "adapter" and not piece.signatures:
        message = f"the adapter '{piece.name}' has no function"
        raise _wrong(piece.location, message, f"add `{MARK}   for: ...`")
    if piece.kind == "adapter" and not piece.relation:
        raise _wrong(piece.location, f"the adapter '{piece.name}' has no kind", f"add `{MARK}   kind: ...`")
    from robosmi.transformations.knowledge.adapters.adapter_checks import check_piece  # built data needs no check and no lexer

    before = next(number for number, line in enumerate(text) if line)
    check_piece(piece, marks, max([piece.location.line or 0, *marks.values()]) + 1 + before)
    return piece


def _take(piece: AdapterPiece, marker: _Marker) -> None:
    """Store what a marker line says in its piece."""
    key, value, place, _ = marker
    if key in _LISTS:
        attribute = _ATTRIBUTES.get(key, key)
        known: list[str] = getattr(piece, attribute)
        known += [value] if key == "library" else value.split()
    elif key in ("for", "setup", "limit"):
        {"for": piece.signatures, "setup": piece.setup, "limit": piece.limits}[key].append(value)
    elif key == "kind":
        piece.relation = _one_of(value, RELATIONS, place)
    elif key == "name":
        piece.target_name = value
    elif key == "role":
        piece.role = value
    elif key == "ram":
        if not value.isdecimal():
            raise _wrong(place, f"'{value}' is not a number of bytes", "write: ram: BYTES")
        piece.ram = int(value)
    elif key == "servos":
        if not value.isdecimal() or not int(value):
            raise _wrong(place, f"'{value}' is not a number of servos", "write: servos: MOST")
        piece.servos = int(value)
    elif key == "stack":
        if (sizes := _STACK.fullmatch(value)) is None:
            raise _wrong(
                place, f"'{value}' is not a number of bytes", "write: stack: BYTES [BYTES WHERE IT IS CALLED AT ONE PLACE]"
            )
        piece.stack, piece.stack_once = int(sizes[1]), int(sizes[2] or sizes[1])
    elif key == "interrupt":
        if (one := _INTERRUPT.fullmatch(value)) is None:
            message = f"'{value}' is not an interrupt with its bytes"
            raise _wrong(place, message, "write: interrupt: NAME_vect BYTES [BYTES WHERE IT LETS OTHERS IN]")
        piece.interrupts.append(InterruptStack(one[1], int(one[2]), int(one[3]) if one[3] else -1))
    elif key == "fidelity":
        piece.fidelity = f"{piece.fidelity} {value}".strip()
    elif key == "pin":
        found = _PIN.fullmatch(value)
        if found is None:
            raise _wrong(place, f"'{value}' is not a pin", "write: pin: PARAMETER CAPABILITY DIRECTION [signed] [split] [ROLE]")
        piece.pins.append(
            AdapterPin(
                found[1],
                _one_of(found[2], CAPABILITIES, place),
                _one_of(found[3], DIRECTIONS, place),
                bool(found[4]),
                found[6] or "",
                bool(found[5]),
            )
        )
    elif key == "table":
        table = _TABLE.fullmatch(value)
        if table is None:
            raise _wrong(place, f"'{value}' is not a table", "write: table: NAME COUNT")
        piece.tables.append(PortTable(table[1], int(table[2])))
    elif key == "range":
        piece.ranges.append(_range(piece, value, place))
    elif key == "port":
        port = _PORT.fullmatch(value)
        if port is None:
            raise _wrong(
                place, f"'{value}' is not a port", "write: port: CONSTANT = LIBRARY.NAME NUMBER CAPABILITY DIRECTION [ROLE]"
            )
        piece.ports.append(
            ConventionalPort(
                port[1],
                port[2],
                int(port[3]),
                _one_of(port[4], CAPABILITIES, place),
                _one_of(port[5], DIRECTIONS, place),
                port[6] or "",
            )
        )


def _range(piece: AdapterPiece, value: str, place: Location) -> ArgumentRange:
    """Parse the value of a marker `range`."""
    try:
        return argument_range(piece.name, piece.signatures, value)
    except ValueError as error:
        raise _wrong(place, *(str(each) for each in error.args)) from error


def _one_of(value: str, known: tuple[str, ...], place: Location) -> str:
    if value not in known:
        raise _wrong(place, f"unknown value '{value}'{did_you_mean(value, known)}", f"use one of: {', '.join(known)}")
    return value
