"""The record of the texts that were made last, which `keep` merges against: a folder with a copy of each.

A copy counts only while it is what the run wrote: with a damaged one, an edit would look like generated text and be lost. The
digests are in a file beside the folder, or with the caller, who may have a list of his own (`manifest`).
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.files.files import digest, within
from robosmi.generate.text_form import has_digest


class Record:
    """The last texts of one generation.

    Args:
        folder: the output folder.
        place: the record's folder, relative to it; each generation into the folder has one of its own.
        digests: path of a copy, relative to the output folder -> SHA-256 of what the last run wrote there; None for those of the
            file beside the record, `PLACE.sha256`.
    """

    def __init__(self, folder: Path, place: str, digests: Mapping[str, str] | None = None) -> None:
        if not within(place):
            raise SourceError(
                f"the record '{place}' would be outside the output folder",
                location=Location(str(folder)),
                fix="give a path relative to the output folder",
            )
        self.folder = folder
        self.place = place.strip("/")
        self.list = f"{self.place}.sha256"
        self._root = folder / self.place
        self._given = digests

    def path(self, name: str) -> str:
        """Where the text of a file lies, relative to the output folder."""
        return f"{self.place}/{name}"

    def read(self, name: str) -> bytes | None:
        """The stored copy of the previously generated text, None if there is none."""
        try:
            return inputs.read_bytes(f"{self._root}/{name}", inputs.OUTPUT)
        except (FileNotFoundError, NotADirectoryError):
            return None

    def last(self, name: str, there: bytes | None) -> tuple[bytes | None, bool]:
        """The text that was made last, None if there is none, and whether its copy is missing or not what was written.

        Args:
            name: of the file.
            there: what is in the file, None if it is not there. It serves where it is what was made last, without any edit.
        """
        copy, written = self.read(name), self._digests.get(self.path(name))
        if written is None or (copy is not None and has_digest(copy, written)):
            return copy, False
        return (there if there is not None and has_digest(there, written) else None), True

    def names(self) -> list[str]:
        """The files that were made, sorted."""
        found: list[str] = []
        for folder, _, files in os.walk(self._root):
            inner = os.path.relpath(folder, self._root)
            found += [name if inner == "." else f"{inner}/{name}".replace(os.sep, "/") for name in files]
        return sorted(found)

    def is_listed(self, name: str) -> bool:
        """Whether the list says what the last run wrote there."""
        return self.path(name) in self._digests

    @cached_property
    def _digests(self) -> Mapping[str, str]:
        if self._given is not None:
            return self._given
        try:
            lines = inputs.read_text(self.folder / self.list, inputs.RECORD).splitlines()
        except (FileNotFoundError, NotADirectoryError, UnicodeDecodeError):
            return {}
        return {self.path(name): written for written, _, name in (line.partition("  ") for line in lines)}

    def listed(self, changed: Mapping[str, bytes], removed: set[str]) -> bytes:
        """The new text of the file beside the record, in the form of `sha256sum`.

        Args:
            changed: the copies that a run writes, by their paths.
            removed: paths of the copies that it removes.
        """
        known = {self.path(name): digest(self.read(name) or b"") for name in self.names() if self.path(name) not in changed}
        known |= {path: written for path, written in self._digests.items() if path in known}
        known |= {path: digest(data) for path, data in changed.items() if path.startswith(f"{self.place}/")}
        lines = [f"{known[path]}  {path[len(self.place) + 1 :]}\n" for path in sorted(known.keys() - removed)]
        return "".join(lines).encode()


def lost_record(path: str, record: str) -> Finding:
    """The message that a file with edits cannot be merged, since its previously generated text is missing.

    Args:
        path: of the file.
        record: path of the copy of its last text.
    """
    return Finding(
        "RS905", Severity.error,
        f"the copy of the last generated text, {record}, is missing or was changed, so edits cannot be detected",
        Location(path), fix="restore that copy, or move the file away, run again, and insert your text",
    )  # fmt: skip


def restored_copy(path: str, record: str) -> Finding:
    """Says that a copy was missing or changed, and that nothing depended on it."""
    message = f"the copy of the last generated text, {record}, was missing or changed; it is written again"
    return Finding("RS521", Severity.info, message, Location(path))
