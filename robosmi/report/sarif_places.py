"""Places of findings as SARIF has them: addresses relative to a base, regions counted in characters, the text that stands there.

Findings count columns in bytes, as compilers do. A column of a file that cannot be read, or that is no text, is left out rather
than told wrong. What is in a file that is no text, such as an archive, has the whole file for its region, in bytes, and so has
what is about a whole text, in lines.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any
from urllib.parse import quote

from robosmi import inputs
from robosmi.diagnostics import Location

ROOT_ID = "SRCROOT"
"""The conventional name of the folder that sources are relative to (3.14.14)."""
OTHER_ID = "OTHERROOT"
"""The folder above all files that are not below that one."""
_LONGEST = 400  # characters of a line that are shown


class SarifPlaces:
    """Turns places of findings into those of SARIF.

    Args:
        base: the folder that paths are relative to; None for the root of the repository that the current folder is in, else that
            folder.
    """

    def __init__(self, base: Path | None = None) -> None:
        self.root = Path(os.path.abspath(base)) if base is not None else _repository(Path.cwd())
        self._lines: dict[str, list[bytes] | None] = {}
        self._others: set[Path] = set()

    def bases(self) -> dict[str, Any]:
        """The folders that addresses are relative to (3.14.14)."""
        bases = {ROOT_ID: {"uri": f"{self.root.as_uri().rstrip('/')}/"}}
        if self._others:
            bases[OTHER_ID] = {"uri": Path("/").resolve().as_uri()}
        return bases

    def artifact(self, path: str) -> dict[str, Any]:
        """The address of a file (3.4), relative to the root, or to the root of all files if it is not below that."""
        whole = Path(os.path.abspath(path))
        if whole.is_relative_to(self.root):
            return {"uri": _quoted(whole.relative_to(self.root)), "uriBaseId": ROOT_ID}
        self._others.add(whole)
        return {"uri": _quoted(whole.relative_to(whole.anchor)), "uriBaseId": OTHER_ID}

    def physical(self, location: Location, *, snippet: bool = True) -> dict[str, Any]:
        """A physical location (3.29).

        Args:
            location: as a finding has it.
            snippet: whether the text of the region and the line around it are shown.
        """
        return self.physical_at(
            location.path, location.line, location.column, location.end_line, location.end_column, snippet=snippet
        )

    def physical_at(
        self,
        path: str,
        line: int | None,
        column: int | None,
        end_line: int | None,
        end_column: int | None,
        *,
        snippet: bool = True,
    ) -> dict[str, Any]:
        """A physical location of a line and a column, both counted from 1, the columns in bytes."""
        place: dict[str, Any] = {"artifactLocation": self.artifact(path)}
        lines = self._read(path)
        if lines is None:
            place["region"] = {"byteOffset": 0, "byteLength": _size(path)}
            return place
        if line is None or not 1 <= line <= len(lines):
            place["region"] = {"startLine": 1, "endLine": len(lines)}
            return place
        region: dict[str, int | dict[str, str]] = {"startLine": line}
        place["region"] = region
        start, end = self._column(lines, line, column), self._column(lines, end_line or line, end_column)
        if start is not None:
            region["startColumn"] = start
            if end is not None and ((end_line or line), end) >= (line, start):
                region |= {"endLine": end_line or line, "endColumn": end}
        shown = _shown(lines[line - 1])
        if snippet and shown.strip() and len(shown) <= _LONGEST:
            if region.get("endLine") == line and isinstance(end, int) and isinstance(start, int) and end > start:
                region["snippet"] = {"text": shown[start - 1 : end - 1]}
            first, last = max(1, line - 1), min(len(lines), max(line, end_line or line) + 1)
            around = [_shown(text) for text in lines[first - 1 : last]]
            if last - first < 12 and all(len(text) <= _LONGEST for text in around) and "snippet" in region:
                place["contextRegion"] = {"startLine": first, "endLine": last, "snippet": {"text": "\n".join(around)}}
        return place

    def named(self, location: Location) -> tuple[str, str]:
        """A file's address below its base, and the text of the line; an empty text if unknown."""
        lines = self._read(location.path)
        known = lines is not None and location.line is not None and 1 <= location.line <= len(lines)
        return self.artifact(location.path)["uri"], _shown(lines[location.line - 1]) if known else ""  # type: ignore[index, operator]

    def _column(self, lines: list[bytes], line: int, column: int | None) -> int | None:
        """A column in characters of one that is given in bytes; None where the line has no such place."""
        if column is None or column < 1 or line > len(lines) or column > len(lines[line - 1]) + 1:
            return None
        whole = lines[line - 1]
        before = whole[: column - 1]
        return len(before.decode("utf-8", errors="ignore") if _is_utf8(whole) else before) + 1

    def _read(self, path: str) -> list[bytes] | None:
        """The lines of a text file; None if it is not text, does not exist, or may not be read."""
        if path not in self._lines:
            try:
                data = inputs.read_bytes(path, inputs.DRAWING)
            except (OSError, ValueError):
                data = b"\0"
            self._lines[path] = None if b"\0" in data[:8192] else data.replace(b"\r\n", b"\n").split(b"\n")
        return self._lines[path]


def _shown(line: bytes) -> str:
    """A line as text; a byte that is no UTF-8 is one character."""
    return line.decode("utf-8" if _is_utf8(line) else "latin-1")


def _is_utf8(line: bytes) -> bool:
    try:
        line.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def _size(path: str) -> int:
    """The size of a file in bytes; 0 if there is no such file."""
    try:
        return os.path.getsize(path) if os.path.isfile(path) else 0
    except (OSError, ValueError):
        return 0


def _quoted(path: Path) -> str:
    """A relative path as a relative reference (RFC 3986); a first part with a colon is no scheme."""
    text = quote(os.fsencode(path.as_posix()), safe="/!$&'()*+,;=@-._~")
    return text.replace("%2F", "/") if text != "." else "./"


def _repository(folder: Path) -> Path:
    """The folder of the repository that a folder is in; that folder itself if it is in none."""
    return next((each for each in (folder, *folder.parents) if (each / ".git").exists()), folder)
