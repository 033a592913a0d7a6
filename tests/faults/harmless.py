"""Harmless rewritings of migrated programs: changed text with the same behaviour; calling it different is a false alarm.

Each is a file `rewritings/STUDY/NAME.toml`: `kind`, and one `[[change]]` or more with `file`, `old` (which the file contains
once) and `new`.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).parent / "rewritings"


@dataclass(frozen=True)
class Rewriting:
    """A rewriting.

    Attributes:
        name: of its file.
        kind: what was done.
        changes: file, old text and new text of each change.
    """

    name: str
    kind: str
    changes: tuple[tuple[str, str, str], ...]

    def put_into(self, files: Mapping[str, str]) -> dict[str, str]:
        """The files that the rewriting changes, in their new form."""
        changed: dict[str, str] = {}
        for file, old, new in self.changes:
            text = changed.get(file, files[file])
            assert text.count(old) == 1, f"{self.name}: {text.count(old)} times in {file}: {old}"
            changed[file] = text.replace(old, new)
        return changed


def rewritings(study: str) -> list[Rewriting]:
    """The rewritings of a case study, by name."""
    found = []
    for path in sorted((HERE / study).glob("*.toml")):
        told = tomllib.loads(path.read_text())
        changes = tuple((each["file"], each["old"], each["new"]) for each in told["change"])
        found.append(Rewriting(path.stem, told["kind"], changes))
    return found
