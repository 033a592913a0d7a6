"""History of earlier choices: which library a person took for which part, and how often (paper, section 3.3, phase two).

One table in one SQLite file of the user's own. The key of a part is its identifier in the catalogue and its title,
together and letter for letter. Reading never makes a file; a file that is not there is an empty history. Every write
is one transaction, so that several runs may write at once. How counts change a ranking is in `ranking`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import closing, contextmanager
from dataclasses import asdict, dataclass
from datetime import date
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, UsageError
from robosmi.recommend.ranking import Choices

if TYPE_CHECKING:
    import sqlite3

SCHEMA = "robosmi/history/1"
"""Names the JSON form of `History.export_json`."""

_FORMAT = 1
_APPLICATION = 0x5253_4849  # "RSHI"
_WAIT_S = 5.0
_TABLE = """CREATE TABLE IF NOT EXISTS choice(part_id TEXT NOT NULL, title TEXT NOT NULL, library TEXT NOT NULL,
  count INTEGER NOT NULL CHECK (count > 0), last_used TEXT NOT NULL, PRIMARY KEY (part_id, title, library)) WITHOUT ROWID"""


@dataclass(frozen=True, order=True)
class Entry:
    """How often one library was chosen for one part.

    Attributes:
        part_id: identifier of the part in its catalogue; may be empty.
        title: title of the part.
        library: name of the library.
        count: how often, >= 1.
        last_used: day of the last choice, ISO 8601 (`2026-11-21`).
    """

    part_id: str
    title: str
    library: str
    count: int
    last_used: str


def default_path() -> Path:
    """Where the history is: the file that ROBOSMI_HISTORY names, else `history.sqlite` in the user's data folder."""
    own = os.environ.get("ROBOSMI_HISTORY")
    return Path(own) if own else resources.user_data() / "history.sqlite"


def chosen_from_history(part_id: str, title: str, history: Choices) -> str | None:
    """The library that history alone chooses for a part: the one chosen most often. A tie is no choice, nor is nothing.

    Raises:
        SourceError: the history is damaged.
    """
    counts = history.choices(part_id, title)
    most = max(counts.values(), default=0)
    first = [library for library, count in counts.items() if count == most]
    return first[0] if len(first) == 1 else None


class History:
    """A file of choices. Opened anew for each call, so that it may be shared, moved or deleted between calls.

    All methods raise SourceError if the file is damaged, is not a history, is locked for over 5 s or cannot be written.

    Args:
        path: the file, which need not exist; None for `default_path()`.
    """

    def __init__(self, path: Path | None = None) -> None:
        self.path = default_path() if path is None else path

    def choices(self, part_id: str, title: str) -> dict[str, int]:
        """How often each library was chosen for that very part; most often first, then by name."""
        sql = "SELECT library, count FROM choice WHERE part_id = ? AND title = ? ORDER BY count DESC, library"
        return dict(self._read(sql, part_id, title))

    def entries(self) -> list[Entry]:
        """All choices, by part identifier, title and library."""
        rows = self._read("SELECT part_id, title, library, count, last_used FROM choice ORDER BY part_id, title, library")
        return [Entry(*row) for row in rows]

    def record(self, part_id: str, title: str, library: str, *, day: date | None = None) -> None:
        """Count one more choice of a library for a part. The file and its folder are made if need be.

        Args:
            part_id: identifier of the part; may be empty.
            title: title of the part.
            library: name of the chosen library.
            day: when; today if None.

        Raises:
            UsageError: no library is named, or neither identifier nor title of a part.
        """
        if not library or not (part_id or title):
            raise UsageError("a choice needs a part and a library", fix="name both")
        with self._writing() as db:
            db.execute(
                "INSERT INTO choice VALUES (?, ?, ?, 1, ?) ON CONFLICT DO UPDATE "
                "SET count = count + 1, last_used = max(last_used, excluded.last_used)",
                (part_id, title, library, (day or date.today()).isoformat()),
            )

    def forget(
        self, part_id: str | None = None, title: str | None = None, library: str | None = None, *, everything: bool = False
    ) -> int:
        """Remove the entries that agree with all that is given. Returns how many there were.

        Raises:
            UsageError: nothing is given, and not `everything` either.
        """
        given = {"part_id": part_id, "title": title, "library": library}
        wanted = {name: value for name, value in given.items() if value is not None}
        if not wanted and not everything:
            raise UsageError("it is not said what to forget", fix="name a part or a library, or say everything")
        if not self._is_there():
            return 0
        condition = " AND ".join(f"{name} = ?" for name in wanted) or "1"
        with self._writing() as db:
            return db.execute(f"DELETE FROM choice WHERE {condition}", tuple(wanted.values())).rowcount

    def export_json(self) -> dict[str, Any]:
        """The whole history as JSON values: `{"schema", "entries": [{part_id, title, library, count, last_used}]}`."""
        return {"schema": SCHEMA, "entries": [asdict(entry) for entry in self.entries()]}

    def import_json(self, document: object, *, location: Location | None = None) -> int:
        """Take over what `export_json` gave, here or elsewhere. Returns how many entries are new or changed.

        Where an entry is there already, the higher count and the later day are kept: importing twice changes nothing.
        All or nothing is taken over.

        Args:
            document: JSON values.
            location: where they were read, for messages.

        Raises:
            SourceError: not of that form.
        """
        entries = _entries(document, location)
        changed = 0
        with self._writing() as db:
            for entry in entries:
                changed += db.execute(
                    "INSERT INTO choice VALUES (?, ?, ?, ?, ?) ON CONFLICT DO UPDATE "
                    "SET count = max(count, excluded.count), last_used = max(last_used, excluded.last_used) "
                    "WHERE excluded.count > count OR excluded.last_used > last_used",
                    (entry.part_id, entry.title, entry.library, entry.count, entry.last_used),
                ).rowcount
        return changed

    def _is_there(self) -> bool:
        try:
            return self.path.exists()
        except OSError as error:
            raise self._unusable(str(error)) from error

    def _read(self, sql: str, *values: str) -> list[tuple[Any, ...]]:
        if not self._is_there():
            return []
        import sqlite3  # 5 ms, wanted only where there is a history

        try:
            with closing(sqlite3.connect(f"{self.path.absolute().as_uri()}?mode=ro", uri=True, timeout=_WAIT_S)) as db:
                return db.execute(sql, values).fetchall() if self._has_table(db) else []
        except sqlite3.Error as error:
            raise self._unusable(str(error)) from error

    @contextmanager
    def _writing(self) -> Iterator[sqlite3.Connection]:
        """A transaction that is undone if anything goes wrong inside."""
        import sqlite3

        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with closing(sqlite3.connect(self.path, timeout=_WAIT_S, isolation_level=None)) as db:
                db.execute("BEGIN IMMEDIATE")  # what is not committed is rolled back by closing
                if not self._has_table(db):
                    db.execute(_TABLE)
                    db.execute(f"PRAGMA application_id={_APPLICATION}")
                    db.execute(f"PRAGMA user_version={_FORMAT}")
                yield db
                db.execute("COMMIT")
        except (OSError, sqlite3.Error) as error:
            raise self._unusable(str(error)) from error

    def _has_table(self, db: sqlite3.Connection) -> bool:
        """True for a history, False for an empty file.

        Raises:
            SourceError: the file is something else.
        """
        kind, version = db.execute("PRAGMA application_id").fetchone()[0], db.execute("PRAGMA user_version").fetchone()[0]
        if (kind, version) == (_APPLICATION, _FORMAT):
            return True
        if (kind, version) == (0, 0) and not db.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            return False
        newer = kind == _APPLICATION and version > _FORMAT
        raise self._unusable("a newer robosmi wrote it" if newer else "it is a database of something else")

    def _unusable(self, cause: str) -> SourceError:
        return SourceError(
            f"the history of choices cannot be used: {cause}",
            location=Location(str(self.path)),
            fix="move the file away to start a new history, or name another file in ROBOSMI_HISTORY",
        )


def _entries(document: object, location: Location | None) -> list[Entry]:
    fix = f'take a document that was exported: {{"schema": "{SCHEMA}", "entries": [...]}}'
    if not isinstance(document, dict) or document.get("schema") != SCHEMA or not isinstance(document.get("entries"), list):
        raise SourceError("this is not an exported history", location=location, fix=fix)
    result = []
    for number, item in enumerate(document["entries"], 1):
        if not isinstance(item, dict) or not _is_entry(item):
            raise SourceError(f"entry {number} of the history is damaged", location=location, fix=fix)
        result.append(Entry(item["part_id"], item["title"], item["library"], item["count"], item["last_used"]))
    return result


def _is_entry(item: dict[str, Any]) -> bool:
    if not all(isinstance(item.get(key), str) for key in ("part_id", "title", "library", "last_used")):
        return False
    try:
        day = date.fromisoformat(item["last_used"])
    except ValueError:
        return False
    count = item.get("count")
    whole = isinstance(count, int) and not isinstance(count, bool) and 0 < count < 2**31
    return whole and bool(item["library"]) and bool(item["part_id"] or item["title"]) and item["last_used"] == day.isoformat()
