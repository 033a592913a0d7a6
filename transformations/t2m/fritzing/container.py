"""Fritzing files as bytes: a plain `.fz`, or the ZIP of a `.fzz` with its sketch and its embedded part definitions.

Everything is read in memory and within limits, names inside an archive are never used as paths, nothing is extracted. What
the bytes mean is told by `document` and `part_file`. Every way in which a file can be no sketch at all ends here or there in
a `SourceError`.
"""

from __future__ import annotations

import hashlib
import io
import stat
import zipfile
import zlib
from dataclasses import dataclass, field
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError

MAX_ENTRIES = 2_000
"""Entries in an archive; the largest public sketch has under a hundred."""
MAX_BYTES = 64 * 1024 * 1024
"""Bytes of a file, of a sketch in an archive, and of all embedded definitions together; the largest public `.fz` has 1.7 MB."""

_FIX = "open it in Fritzing and save it again"


@dataclass(slots=True)
class Container:
    """What a file held.

    Attributes:
        path: as given.
        digest: SHA-256 of the file's bytes, hexadecimal.
        sketch_name: name of the `.fz`, for messages.
        sketch: its bytes.
        parts: name and bytes of each embedded part definition, in the archive's order.
        findings: what was left out.
    """

    path: str
    digest: str
    sketch_name: str
    sketch: bytes
    parts: list[tuple[str, bytes]] = field(default_factory=list)
    findings: list[Finding] = field(default_factory=list)


def read_container(path: Path) -> Container:
    """The content of a `.fz` or `.fzz` file; which of the two it is is told by its bytes.

    Raises:
        SourceError: the file is missing, not readable, empty, too big, a damaged or encrypted archive, or has no sketch in it.
    """
    data = _bytes_of(path)
    digest = hashlib.sha256(data).hexdigest()
    if data[:2] == b"PK":
        return _archive(str(path), digest, data)
    if path.suffix.lower() == ".fzz" and not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        raise _error(path, "it is no ZIP archive, as a .fzz has to be", _FIX)
    return Container(str(path), digest, path.name, data)


def _error(path: Path | str, cause: str, fix: str, line: int | None = None) -> SourceError:
    return SourceError(cause, location=Location(str(path), line), fix=fix)


def _bytes_of(path: Path) -> bytes:
    try:
        if path.is_dir():
            raise _error(path, "it is a folder, not a Fritzing sketch", "give the .fz or .fzz file in it")
        if not path.exists():
            raise _error(path, "there is no such file", "check the name of the sketch")
        if not path.is_file():
            raise _error(path, "it is no ordinary file", "give a .fz or .fzz file")
        with path.open("rb") as stream:
            data = stream.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise _error(path, f"it cannot be read: {reason}", "check the name and the permissions of the file") from error
    if not data.strip():
        raise _error(path, "the file is empty", _FIX)
    if len(data) > MAX_BYTES:
        raise _error(path, f"the file has more than {MAX_BYTES // 1024 // 1024} MB", "check that it is a Fritzing sketch")
    return data


def _archive(path: str, digest: str, data: bytes) -> Container:
    listed = data.count(b"PK\x01\x02")  # before the list is read, which takes memory for each entry
    if listed > MAX_ENTRIES:
        raise _error(path, f"the archive has {listed} entries, more than {MAX_ENTRIES}", "check that it is a Fritzing sketch")
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            return _entries(path, digest, archive)
    except (zipfile.BadZipFile, zlib.error, EOFError, ValueError, NotImplementedError, OSError) as error:
        raise _error(path, f"the archive is damaged: {error}", _FIX) from error


def _entries(path: str, digest: str, archive: zipfile.ZipFile) -> Container:
    entries = archive.infolist()
    odd = [e.filename for e in entries if "/" in e.filename or "\\" in e.filename or ".." in e.filename]
    links = [e.filename for e in entries if stat.S_ISLNK(e.external_attr >> 16)]
    flat = [e for e in entries if e.filename not in {*odd, *links}]
    sketches = [e for e in flat if e.filename.lower().endswith(".fz")]
    if not sketches:
        raise _error(path, "there is no .fz sketch in the archive", _FIX)
    sketch = read_entry(path, archive, sketches[0], MAX_BYTES)
    result = Container(path, digest, sketches[0].filename, sketch)
    room = MAX_BYTES
    for entry in flat:
        if not entry.filename.lower().endswith(".fzp"):
            continue
        try:
            content = read_entry(path, archive, entry, room)
        except (zipfile.BadZipFile, zlib.error, EOFError) as error:  # the sketch itself is sound
            result.findings.append(_left_out(path, [entry.filename], f"is damaged: {error}"))
            continue
        room -= len(content)
        result.parts.append((entry.filename, content))
    if len(sketches) > 1:
        result.findings.append(
            _left_out(
                path,
                [e.filename for e in sketches[1:]],
                f"is a further sketch; '{result.sketch_name}' was read, as Fritzing does",
            )
        )
    if links:
        result.findings.append(_left_out(path, links, "is a link, which Fritzing does not write"))
    if odd:
        result.findings.append(_left_out(path, odd, "has a folder in its name, which Fritzing does not write"))
    return result


def _left_out(path: str, names: list[str], why: str) -> Finding:
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return Finding(
        "RS209",
        Severity.warning,
        f"'{names[0]}'{more} in the archive was left out: it {why}",
        Location(path),
        evidence={"entries": names[:20]},
    )


def read_entry(path: str, archive: zipfile.ZipFile, entry: zipfile.ZipInfo, limit: int) -> bytes:
    """The bytes of an entry of the archive at `path`, of which there may be `limit`.

    Raises:
        SourceError: it is encrypted, or has more.
        BadZipFile, zlib.error, EOFError: it is damaged.
    """
    if entry.flag_bits & 0x1:
        raise _error(path, f"'{entry.filename}' in the archive is encrypted", "save it without a password")
    with archive.open(entry) as stream:
        data = stream.read(limit + 1)  # the size in the header may lie
    if len(data) > limit:
        raise _error(
            path,
            f"'{entry.filename}' in the archive has more than {limit // 1024 // 1024} MB",
            "check that it is a Fritzing sketch",
        )
    return data
