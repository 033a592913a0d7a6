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
        SourceError: it is missing, a folder, not readable, too large, or empty.
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
    return data
