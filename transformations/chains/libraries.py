"""The chain `libraries import`: installed libraries into the user's own index, which ranking reads beside the shipped one.

The facts read are kept beside that index (`installed.jsonl.gz`), so that a second import adds to the first; a library that is
read again replaces what was known of it.
"""

from __future__ import annotations

import gzip
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from robosmi.model.files import write_atomic
from robosmi.transformations.m2m.library_ranking import installed_index
from robosmi.transformations.t2m.installed_libraries import read_libraries
from robosmi.transformations.t2m.library_index import build


@dataclass(frozen=True)
class Imported:
    """What an import did.

    Attributes:
        index: the user's own index.
        added: name and version of each library that was read.
        skipped: path -> why it was left out.
        known: how many libraries the user's index has now.
    """

    index: Path
    added: list[tuple[str, str]]
    skipped: dict[str, str]
    known: int


def import_libraries(folder: Path, platform: str) -> Imported:
    """Add the libraries of a folder to the user's index of a platform.

    Raises:
        SourceError: there is no such folder, or the user's own facts are damaged.
        PlatformDataError: more headers than an index holds.
    """
    found = read_libraries(folder)
    index = installed_index(platform)
    facts = index.with_suffix(".jsonl.gz")
    rows = {row["name"]: row for row in _rows(facts)} | {row["name"]: row for row in found.rows}
    if found.rows:
        index.parent.mkdir(parents=True, exist_ok=True)
        lines = "".join(json.dumps(row, sort_keys=True) + "\n" for _, row in sorted(rows.items()))
        write_atomic(facts, gzip.compress(lines.encode(), mtime=0))
        build(facts, index)
    added = sorted((str(row["name"]), str(row["version"])) for row in found.rows)
    return Imported(index, added, found.skipped, len(rows))


def _rows(facts: Path) -> list[dict[str, Any]]:
    """Facts of earlier imports; a file that is damaged is started anew, since importing again makes it."""
    try:
        with gzip.open(facts, "rt", encoding="utf-8") as lines:
            return [row for line in lines if isinstance(row := json.loads(line), dict) and row.get("name")]
    except (OSError, EOFError, ValueError):
        return []
