"""One source file as bytes: reading it, its encoding, slices of its text, lines and columns.

Offsets are always those of the file's own bytes. The parser gets a copy of the same length in which bytes that are no
UTF-8 are question marks, so that its offsets are the file's. What cannot be a source file at all is refused here; what
is not C is noticed after parsing (`checks`).
"""

from __future__ import annotations

import codecs
import hashlib
import os
import re
from bisect import bisect_right
from typing import TypedDict

from msgspec import Struct

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.knowledge.lexer import Token, tokens

_LINE_END = re.compile(rb"\n")
MOST_TOKENS = 2_000_000
_TEXTS = frozenset(["comment", "string", "char"])  # they may hold any byte; elsewhere compilers read NUL as a blank
_STRAY = re.compile(rb"[\x01-\x08\x0e-\x1f\x7f]")
CPLUSPLUS = (".cpp", ".cc", ".cxx", ".hpp", ".hh", ".ino", ".pde", ".C")
_SPLIT = "give the program's own source files, without generated data"


class TextRange(TypedDict):
    """The features of `Located`: a range of offsets with its lines and columns, both counted from 1."""

    startOffset: int
    endOffset: int
    line: int
    column: int
    endLine: int
    endColumn: int


class ReadSource(Struct):
    """The text of one file.

    Attributes:
        path: as given.
        data: the bytes that offsets count.
        parsed: bytes of the same length that the parser reads.
        encoding: name of the encoding of the file.
        digest: SHA-256 of the file, hexadecimal.
        size: length of the file in bytes.
        tokens: tokens, comments and directives in text order; but for names, one character is one byte.
        cplusplus: whether a header whose name fits both languages is of C++.
    """

    path: str
    data: bytes
    parsed: bytes
    encoding: str
    digest: str
    size: int
    tokens: list[Token] = []
    _lines: list[int] = []
    _codec: str = "utf-8"
    cplusplus: bool = False

    @property
    def language(self) -> str:
        """`C` or `C++`, by the file's name, of a header also by the program that includes it."""
        return "C++" if is_cplusplus(self.path) or (self.cplusplus and self.path.endswith(".h")) else "C"

    def text(self, start: int, end: int) -> str:
        """The text between two offsets."""
        return self.data[start:end].decode(self._codec, "replace")

    def line(self, offset: int) -> int:
        """The line of an offset, from 1."""
        return bisect_right(self._lines, offset)

    def place(self, start: int, end: int) -> TextRange:
        """The features of `Located` for a range of offsets."""
        lines = self._lines
        line = bisect_right(lines, start)
        last = bisect_right(lines, end - 1) if end > start else line
        return {
            "startOffset": start,
            "endOffset": end,
            "line": line,
            "column": start - lines[line - 1] + 1,
            "endLine": last,
            "endColumn": end - lines[last - 1] + 1,
        }

    def location(self, start: int, end: int | None = None) -> Location:
        """The place of a range for findings."""
        place = self.place(start, start if end is None else end)
        if end is None:
            return Location(self.path, place["line"], place["column"])
        return Location(self.path, place["line"], place["column"], place["endLine"], place["endColumn"])


def is_cplusplus(path: str) -> bool:
    """Whether a file is C++ by its name."""
    return path.endswith(CPLUSPLUS)


def read_source(path: str | os.PathLike[str], cplusplus: bool = False) -> ReadSource:
    """Read and tokenise a file.

    Args:
        path: the file.
        cplusplus: whether it belongs to a program without C sources, so that a header is C++.

    Raises:
        SourceError: it does not exist, cannot be read, is a folder, is no text or is too large.
    """
    name = os.fspath(path)
    raw = _bytes(name)
    place = Location(name)
    data, encoding, codec = _decode(raw)
    source = ReadSource(name, data, data, encoding, hashlib.sha256(raw).hexdigest(), len(raw), _codec=codec, cplusplus=cplusplus)
    if codec != "utf-8":
        mark = codecs.BOM_UTF8 if data.startswith(codecs.BOM_UTF8) else b""  # an editor's, before bytes of another encoding
        source.parsed = mark + bytes(byte if byte < 128 else 63 for byte in data[len(mark) :])
    if b"\0" in data:
        source.parsed = source.parsed.replace(b"\0", b"?")
    source._lines = [0, *(match.end() for match in _LINE_END.finditer(data))]
    source.tokens = tokens(source.parsed, MOST_TOKENS)
    if b"\0" in data:
        _zeros_as_blanks(source)
    if not source.parsed.isascii():
        source.tokens = [_spelt(token, source) for token in source.tokens]
    if len(source.tokens) > MOST_TOKENS:
        raise TooLargeError(f"the file has more than {MOST_TOKENS:,} tokens", location=place, fix=_SPLIT)
    return source


def _zeros_as_blanks(source: ReadSource) -> None:
    """Read each NUL outside of comments and literals as a blank, as compilers do.

    Raises:
        SourceError: other bytes are there that no text has: it is a compiled program, or other data.
    """
    outside = bytearray(source.data)
    for kind, start, end, _ in source.tokens:
        if kind in _TEXTS:
            outside[start:end] = b" " * (end - start)
    zeros = [match.start() for match in re.finditer(b"\0", outside)]
    if not zeros:
        return
    for kind, start, end, _ in source.tokens:
        if kind == "directive":  # its comments and literals may hold any byte, too
            outside[start:end] = b" " * (end - start)
    if _STRAY.search(outside) or not (outside.isascii() or source._codec == "utf-8"):
        place = Location(source.path)
        raise SourceError("the file is binary, not text", location=place, fix="give the C source file, not a compiled program")
    parsed = bytearray(source.parsed)
    for offset in zeros:
        parsed[offset] = 32
    source.parsed = bytes(parsed)
    source.tokens = tokens(source.parsed, MOST_TOKENS)


def _spelt(token: Token, source: ReadSource) -> Token:
    """A name token in Unicode; the tokeniser gives one character for each byte."""
    kind, start, end, text = token
    return token if kind != "name" or text.isascii() else (kind, start, end, source.text(start, end))


def _bytes(name: str) -> bytes:
    place = Location(name)
    try:
        return inputs.read_bytes(name, inputs.SOURCE)
    except FileNotFoundError as error:
        raise SourceError("no such file", location=place, fix="check the path") from error
    except IsADirectoryError as error:
        raise SourceError("this is a folder, not a file", location=place, fix="give the C source files in it") from error
    except PermissionError as error:
        if os.path.isdir(name):  # Windows says so of folders
            raise SourceError("this is a folder, not a file", location=place, fix="give the C source files in it") from error
        raise SourceError("no permission to read the file", location=place, fix="change its permissions") from error
    except OSError as error:
        fix = inputs.fix_of(error, "check the path and the disk")
        raise SourceError(f"the file cannot be read: {error.strerror or error}", location=place, fix=fix) from error


def _decode(raw: bytes) -> tuple[bytes, str, str]:
    """The bytes to work on, the encoding's name, and the codec of those bytes."""
    for mark, codec in ((codecs.BOM_UTF16_LE, "utf-16"), (codecs.BOM_UTF16_BE, "utf-16")):
        if raw.startswith(mark):
            try:
                return raw.decode(codec).encode("utf-8"), "UTF-16", "utf-8"
            except UnicodeDecodeError:
                break
    if codec16 := _unmarked_utf16(raw):
        return raw.decode(codec16).encode("utf-8"), "UTF-16", "utf-8"
    try:
        raw.decode("utf-8")
    except UnicodeDecodeError:
        # bytes 80 to 9F are letters and quotes in Windows-1252, control characters in Latin-1
        windows = any(0x80 <= byte <= 0x9F for byte in raw)
        return (raw, "windows-1252", "cp1252") if windows else (raw, "ISO-8859-1", "latin-1")
    return raw, "UTF-8", "utf-8"


def stored_bytes(raw: bytes) -> bytes:
    """The bytes of a source file as a plan stores them: those of UTF-8 for a text in UTF-16, else as they are."""
    return _decode(raw)[0]


def _unmarked_utf16(raw: bytes) -> str | None:
    """The codec of a text in UTF-16 without a mark, as some editors write it: every second byte of Western text is zero."""
    for first, codec in ((1, "utf-16-le"), (0, "utf-16-be")):
        if len(raw) > 8 and len(raw) % 2 == 0 and raw[first::2].count(0) > 0.4 * len(raw) and not raw[1 - first :: 2].count(0):
            try:
                raw.decode(codec)
            except UnicodeDecodeError:
                return None
            return codec
    return None
