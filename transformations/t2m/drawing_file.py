"""The bytes of a drawing that is one file, as its readers open it: bounded in size, refused with place and what to do."""

from __future__ import annotations

from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import SourceError


def drawing_bytes(path: Path, kind: str, give: str, fix: str) -> bytes:
    """The bytes of a drawing.

    Args:
        path: the file, as the user gave it.
        kind: what it should be, for messages (`diagram`, `schematic`).
        give: what to give in place of a folder (`the .sch file in it`).
        fix: what to do where it is empty.

    Raises:
        SourceError: it is missing, a folder, not readable, too large, empty, or in UTF-16 or UTF-32, which no tool writes.
    """
    place = Location(str(path))
    try:
        data = inputs.read_bytes(path, inputs.DRAWING)
    except IsADirectoryError as error:
        raise SourceError(f"it is a folder, not a {kind}", location=place, fix=f"give {give}") from error
    except OSError as error:
        advice = inputs.fix_of(error, "check the name and the permissions of the file")
        raise SourceError(f"it cannot be read: {error.strerror or error}", location=place, fix=advice) from error
    if not data.strip():
        raise SourceError("the file is empty", location=place, fix=fix)
    if (encoding := _wide_encoding(data)) is not None:
        raise SourceError(f"its encoding is {encoding}, not UTF-8", location=place, fix="save it as UTF-8")
    return data


def _wide_encoding(data: bytes) -> str | None:
    """The wide encoding (UTF-16, UTF-32) of a text, recognised by its first bytes; None for UTF-8."""
    if data.startswith((b"\xff\xfe\0\0", b"\0\0\xfe\xff")) or data[1:4] == b"\0\0\0" or data[:3] == b"\0\0\0":
        return "UTF-32"
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return "UTF-16"
    first = data[:2].replace(b"\0", b"")  # of a binary file the other byte is no letter
    return "UTF-16" if len(first) == 1 and len(data) > 1 and (first >= b" " or first in b"\t\r\n") else None
