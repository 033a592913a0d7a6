"""History of earlier choices: which library the user took for which part, and how often (paper, section 3.3, phase two).

The key of a part is its identifier in the catalogue and its title, together and letter for letter; version of the library,
target and the component's name are kept beside it. Reading never makes a file; every write is one transaction, so that
several runs may write at once. How counts change a ranking is in `ranking` and `device_ranker`.

The history is kept in one SQLite file through Python's own module, or in any database by an SQLAlchemy URL. Both are seen as
`Database`: `read` for one question, `writing` for one transaction. A file is opened anew for each call, so that it may be
shared, moved or deleted between calls; it is made only by writing. Whoever finds it locked waits as long as others write into
it. SQLite's write-ahead log is not used, since it needs memory that processes share, which not every file system has.
SQLAlchemy is an extra (`robosmi[database]`) and imported only when a URL is given.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, closing, contextmanager
from datetime import date
from decimal import Decimal
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs, resources
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, RobosmiError, SourceError, UsageError
from robosmi.recommend.ranking import Choices
from robosmi.recommend.tokens import models

if TYPE_CHECKING:
    import sqlite3

_KEY = "part_id = :part_id AND title = :title AND library = :library AND version = :version AND target = :target"
_LATER = "last_used = CASE WHEN last_used < :last_used THEN :last_used ELSE last_used END"
_INSERT = "INSERT INTO {table} VALUES (:part_id, :title, :library, :version, :target, :component, :count, :last_used)"
_TRIES = 20
_SHOWN = 40  # characters of a value that does not belong where it is
_Row = tuple[Sequence[str], int]

_Values = Mapping[str, str | int]
_Result = TypeVar("_Result")

_FORMAT = 2
"""Number of the table's form: `PRAGMA user_version` of a file."""

_APPLICATION = 0x5253_4849  # "RSHI"
_WAIT_S = 5.0
_PAUSES_S = (0.001, 0.02)  # drawn anew each time: SQLite's own pauses grow, so that of many writers some wait for ever
_COLUMNS = "part_id, title, library, version, target, component, count, last_used"
_TABLE = """CREATE TABLE IF NOT EXISTS {name}(part_id TEXT NOT NULL, title TEXT NOT NULL, library TEXT NOT NULL,
  version TEXT NOT NULL, target TEXT NOT NULL, component TEXT NOT NULL, count INTEGER NOT NULL CHECK (count > 0),
  last_used TEXT NOT NULL, PRIMARY KEY (part_id, title, library, version, target))"""
_OLD = "(SELECT part_id, title, library, '' AS version, '' AS target, '' AS component, count, last_used FROM {name}) AS old"
_SHARED = "robosmi_choice"  # in a database that others use, too


class HistoryEntry(Struct, frozen=True, order=True):
    """How often one library was chosen for one part.

    Attributes:
        part_id: identifier of the part in its catalogue; may be empty.
        title: title of the part.
        library: name of the library.
        count: how often, >= 1.
        last_used: day of the last choice, ISO 8601 (`2026-11-21`).
        version: version of the library, or empty.
        target: the target board, or empty.
        component: what the drawing called the component last, or empty.
    """

    part_id: str
    title: str
    library: str
    count: int
    last_used: str
    version: str = ""
    target: str = ""
    component: str = ""


class Targets(Struct, frozen=True):
    """The targets whose earlier choices count for one: those for itself; where there are none, those for its like.

    Attributes:
        name: the target.
        alike: whether a target takes the same libraries; a choice that names no target always counts.
    """

    name: str
    alike: Callable[[str], bool]


def default_place() -> Path | str:
    """Where the history is: the file or URL that ROBOSMI_HISTORY names, else `history.sqlite` in the user's data folder."""
    own = os.environ.get("ROBOSMI_HISTORY")
    if own:
        return own if "://" in own else Path(own)
    return resources.user_data() / "history.sqlite"


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
    """The choices at one place.

    All methods raise SourceError if the place is damaged, is not a history, is locked for over 5 s by somebody who does not
    write, or cannot be written.

    Args:
        place: a file, which need not exist, or an SQLAlchemy URL; None for `default_place()`.

    Raises:
        MissingToolError: a URL is given and SQLAlchemy or the driver is not installed.
    """

    def __init__(self, place: Path | str | None = None) -> None:
        self._database: Database = _database(default_place() if place is None else place)

    @property
    def place(self) -> str:
        """The file, or the URL without its password."""
        return self._database.place

    def choices(self, part_id: str, title: str, among: Targets | None = None) -> dict[str, int]:
        """How often each library was chosen for that very part; most often first, then by name.

        Args:
            part_id: identifier of the part.
            title: its title.
            among: the targets whose choices count; all if None.
        """
        sql = (
            "SELECT library, target, SUM(count) FROM {table} WHERE part_id = :part_id AND title = :title GROUP BY library, target"
        )
        return _counted(self._read(sql, {"part_id": part_id, "title": title}), among)

    def choices_for_model(self, model: str, among: Targets | None = None) -> dict[str, int]:
        """How often each library was chosen for parts whose title has this model number; most often first, then by name.

        Args:
            model: the model number, lower case, letters and digits.
            among: the targets whose choices count; all if None.
        """
        rows = self._read("SELECT title, library, target, SUM(count) FROM {table} GROUP BY title, library, target", {})
        return _counted([(texts, count) for (title, *texts), count in rows if model in models(title)], among)

    def entries(self) -> list[HistoryEntry]:
        """All choices, by part identifier, title and library."""
        rows = self._read("SELECT part_id, title, library, last_used, version, target, component, count FROM {table}", {})
        return sorted(HistoryEntry(part_id, title, library, count, *more) for (part_id, title, library, *more), count in rows)

    def _read(self, sql: str, values: _Values) -> list[_Row]:
        """The rows of a question whose last column is a count and whose others are texts.

        Raises:
            SourceError: a value is of another kind. SQLite keeps any in any column, whatever the table says.
        """
        found: list[_Row] = []
        for *texts, count in self._database.read(sql, values):
            if odd := [value for value in texts if not isinstance(value, str)]:
                raise _unusable(self.place, f"a row of it has {str(odd[0])[:_SHOWN]} where a text belongs")
            if not isinstance(count, (int, Decimal)) or count < 1:  # some databases add whole numbers up to a Decimal
                raise _unusable(self.place, f"a row of it has {str(count)[:_SHOWN]} where a count belongs")
            found.append((texts, int(count)))
        return found

    def record(
        self,
        part_id: str,
        title: str,
        library: str,
        *,
        version: str = "",
        target: str = "",
        component: str = "",
        day: date | None = None,
    ) -> None:
        """Count one more choice of a library for a part. The place is made if need be.

        Args:
            part_id: identifier of the part; may be empty.
            title: title of the part.
            library: name of the chosen library.
            version: its version.
            target: the target board.
            component: what the drawing calls the component.
            day: when; today if None.

        Raises:
            UsageError: no library is named, or neither identifier nor title of a part.
        """
        self.record_all([HistoryEntry(part_id, title, library, 1, (day or date.today()).isoformat(), version, target, component)])

    def record_all(self, entries: Iterable[HistoryEntry]) -> None:
        """Count one more choice for each entry, all or nothing. The place is made if need be; without entries nothing is done.

        Args:
            entries: what was chosen; their counts say nothing here.

        Raises:
            UsageError: an entry names no library, or neither identifier nor title of a part.
        """
        listed = [replace(entry, count=1) for entry in entries]
        if any(not entry.library or not (entry.part_id or entry.title) for entry in listed):
            raise UsageError("a choice needs a part and a library", fix="give both")

        def count(statements: Statements) -> int:
            more = f"UPDATE {{table}} SET count = count + 1, component = :component, {_LATER} WHERE {_KEY}"
            return sum(
                statements.run(more, _key(entry, "component", "last_used"))
                or statements.run(_INSERT, _key(entry, "component", "count", "last_used"))
                for entry in listed
            )

        if listed:
            self._write(count)

    def take_over(self, entries: Iterable[HistoryEntry]) -> int:
        """Take over choices kept elsewhere, all or nothing. Returns how many entries are new or changed.

        Where an entry is there already, the higher count and the later day are kept: a second time changes nothing.
        """
        listed = list(entries)

        def merge(statements: Statements) -> int:
            changed = 0
            for entry in listed:
                there = statements.run(f"UPDATE {{table}} SET count = count WHERE {_KEY}", _key(entry))
                higher = f"UPDATE {{table}} SET count = :count WHERE {_KEY} AND count < :count"
                later = f"UPDATE {{table}} SET {_LATER} WHERE {_KEY} AND last_used < :last_used"
                if there:
                    changed += bool(
                        statements.run(higher, _key(entry, "count")) + statements.run(later, _key(entry, "last_used"))
                    )
                else:
                    changed += statements.run(_INSERT, _key(entry, "component", "count", "last_used"))
            return changed

        return self._write(merge)

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
            raise UsageError("nothing to forget is given", fix="give a part or a library, or everything")
        if not self._database.read("SELECT 1 FROM {table} LIMIT 1", {}):
            return 0
        condition = " AND ".join(f"{name} = :{name}" for name in wanted) or "1 = 1"
        return self._write(lambda statements: statements.run(f"DELETE FROM {{table}} WHERE {condition}", wanted))

    def _write(self, change: Callable[[Statements], int]) -> int:
        """Run a change in one transaction; again where another run wrote the same at that moment."""
        for _ in range(_TRIES - 1):
            try:
                with self._database.writing() as statements:
                    return change(statements)
            except Collision:
                continue
        with self._database.writing() as statements:
            return change(statements)


class ForgivingHistory:
    """A history that may be unusable: it then has no choices, and says once why. Implements `ranking.Choices`.

    Args:
        place: see `History`.
        among: the targets whose choices count; all if None.

    Attributes:
        trouble: why it cannot be used, or None.
    """

    def __init__(self, place: Path | str | None = None, among: Targets | None = None) -> None:
        self._among = among
        self.trouble: RobosmiError | None = None
        self._history: History | None = None
        try:
            self._history = History(place)
            self._history.choices("", "")
        except RobosmiError as error:
            self.trouble, self._history = error, None

    def choices(self, part_id: str, title: str) -> dict[str, int]:
        """See `ranking.Choices`."""
        try:
            return self._history.choices(part_id, title, self._among) if self._history is not None else {}
        except RobosmiError as error:
            self.trouble, self._history = error, None
            return {}

    def choices_for_model(self, model: str) -> dict[str, int]:
        """See `ranking.Choices`."""
        try:
            return self._history.choices_for_model(model, self._among) if self._history is not None else {}
        except RobosmiError as error:
            self.trouble, self._history = error, None
            return {}


def _key(entry: HistoryEntry, *more: str) -> _Values:
    return {name: getattr(entry, name) for name in ("part_id", "title", "library", "version", "target", *more)}


def _counted(rows: Sequence[_Row], among: Targets | None) -> dict[str, int]:
    """Counts of libraries and targets, added up for the targets that count."""
    listed = [(library, target, count) for (library, target), count in rows]
    if among is not None:
        own = [row for row in listed if row[1] == among.name]
        listed = own or [row for row in listed if not row[1] or among.alike(row[1])]
    counts: dict[str, int] = {}
    for library, _, count in listed:
        counts[library] = counts.get(library, 0) + count
    return dict(sorted(counts.items(), key=lambda pair: (-pair[1], pair[0])))


class Statements(Protocol):
    """An open transaction."""

    def run(self, sql: str, values: _Values) -> int:
        """Run one statement with `:name` parameters; {table} stands for the table. Returns how many rows it touched."""


class Database(Protocol):
    """A store of choices. All methods raise SourceError if it is damaged, foreign, locked, unreachable or read-only."""

    @property
    def place(self) -> str:
        """The file or the URL without its password, for messages."""

    def read(self, sql: str, values: _Values) -> list[tuple[Any, ...]]:
        """The rows of a question ({table} stands for the table); none if there is no such place yet."""

    def writing(self) -> AbstractContextManager[Statements]:
        """One transaction: all of it or nothing is written. The place and its table are made if need be."""


def _unusable(place: str, cause: str) -> SourceError:
    """The error for a history that cannot be read or written."""
    return SourceError(
        f"the history of choices cannot be used: {cause}",
        location=Location(place),
        fix="move the file away to start a new history, or set another place in ROBOSMI_HISTORY",
    )


class SqliteFile:
    """A history in a file of its own.

    Args:
        path: the file, which need not exist.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    @property
    def place(self) -> str:
        """The file."""
        return str(self.path)

    def read(self, sql: str, values: _Values) -> list[tuple[Any, ...]]:
        """See `Database`."""
        if not self.exists():
            return []
        import sqlite3  # 5 ms, wanted only where there is a history

        try:
            try:
                return self._patiently(lambda: self._rows("ro", sql, values))
            except sqlite3.OperationalError as error:
                if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_READONLY:
                    raise
                return self._patiently(lambda: self._rows("rw", sql, values))  # undoes what a killed writer had begun
        except sqlite3.Error as error:
            raise _unusable(self.place, str(error)) from error

    def _rows(self, mode: str, sql: str, values: _Values) -> list[tuple[Any, ...]]:
        import sqlite3

        with closing(sqlite3.connect(f"{self.path.absolute().as_uri()}?mode={mode}", uri=True, timeout=0)) as db:
            table = self._table(db)
            return db.execute(sql.format(table=table), dict(values)).fetchall() if table else []

    @contextmanager
    def writing(self) -> Iterator[Statements]:
        """See `Database`."""
        import sqlite3

        self.exists()
        try:
            self.path.parent.mkdir(parents=True, exist_ok=True)
            with closing(sqlite3.connect(self.path, timeout=0, isolation_level=None)) as db:
                self._patiently(lambda: db.execute("BEGIN IMMEDIATE"))  # what is not committed is rolled back by closing
                if self._table(db) != "choice":
                    self._make(db)
                yield _SqliteStatements(db)
                self._patiently(lambda: db.execute("COMMIT"))  # readers may be at work
        except (OSError, sqlite3.Error, UnicodeEncodeError) as error:
            raise _unusable(self.place, str(error)) from error

    def _patiently(self, step: Callable[[], _Result]) -> _Result:
        """Retry a step while the file is locked, until nobody has written to it for `_WAIT_S` seconds."""
        import sqlite3

        seen, since = self._stamp(), time.monotonic()
        while True:
            try:
                return step()
            except sqlite3.OperationalError as error:
                if error.sqlite_errorcode & 0xFF != sqlite3.SQLITE_BUSY:
                    raise
                now = self._stamp()
                if now != seen:
                    seen, since = now, time.monotonic()
                elif time.monotonic() - since > _WAIT_S:
                    raise
            import random  # slow to load, and wanted only where others hold the database

            time.sleep(random.uniform(*_PAUSES_S))

    def _stamp(self) -> tuple[int, int]:
        """Modification time and size of the file, which change when somebody writes to it."""
        try:
            found = self.path.stat()
        except OSError:
            return (0, 0)
        return found.st_mtime_ns, found.st_size

    def exists(self) -> bool:
        """Whether the file exists; SourceError if it is not an ordinary one, since SQLite would open a pipe or device, too."""
        try:
            inputs.check_ordinary(self.path)
        except (FileNotFoundError, NotADirectoryError):
            return False
        except OSError as error:
            raise _unusable(self.place, error.strerror or str(error)) from error
        return True

    def _table(self, db: sqlite3.Connection) -> str:
        """The SQL for the table: its name, a subquery for a file of format 1, or an empty text for an empty file."""
        kind, version = db.execute("PRAGMA application_id").fetchone()[0], db.execute("PRAGMA user_version").fetchone()[0]
        if kind == _APPLICATION and version == _FORMAT:
            return "choice"
        if kind == _APPLICATION and version == 1:
            return _OLD.format(name="choice")
        if (kind, version) == (0, 0) and not db.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            return ""
        newer = kind == _APPLICATION and version > _FORMAT
        raise _unusable(self.place, "a newer robosmi wrote it" if newer else "it is another kind of database")

    def _make(self, db: sqlite3.Connection) -> None:
        """Create the table in an empty file, or convert a file of format 1 with its content."""
        old = self._table(db)
        if old:
            db.execute("ALTER TABLE choice RENAME TO choice_1")
        db.execute(_TABLE.format(name="choice"))
        if old:
            db.execute(f"INSERT INTO choice SELECT {_COLUMNS} FROM {_OLD.format(name='choice_1')}")
            db.execute("DROP TABLE choice_1")
        db.execute(f"PRAGMA application_id={_APPLICATION}")
        db.execute(f"PRAGMA user_version={_FORMAT}")


class _SqliteStatements:
    def __init__(self, db: sqlite3.Connection) -> None:
        self._db = db

    def run(self, sql: str, values: _Values) -> int:
        return self._db.execute(sql.format(table="choice"), dict(values)).rowcount


class SharedDatabase:
    """A history in a database that SQLAlchemy knows, such as PostgreSQL for a team.

    Args:
        url: its SQLAlchemy URL.

    Raises:
        MissingToolError: SQLAlchemy or the database's driver is not installed.
        SourceError: the URL is none.
    """

    def __init__(self, url: str) -> None:
        try:
            from sqlalchemy import create_engine
            from sqlalchemy.engine import make_url
            from sqlalchemy.exc import ArgumentError
            from sqlalchemy.pool import NullPool
        except ImportError as error:
            raise MissingToolError("a history by URL needs SQLAlchemy", fix="pip install 'robosmi[database]'") from error
        try:
            self._engine = create_engine(url, isolation_level="SERIALIZABLE", poolclass=NullPool)  # nothing stays open
            self.place = make_url(url).render_as_string(hide_password=True)
        except ImportError as error:
            raise MissingToolError(f"the driver of the database is missing: {error}", fix="install it with pip") from error
        except ArgumentError as error:
            raise SourceError(
                f"this is not the URL of a database: {error}", fix="write postgresql+psycopg://USER@HOST/NAME"
            ) from error
        self._made = False

    def read(self, sql: str, values: _Values) -> list[tuple[Any, ...]]:
        """See `Database`."""
        from sqlalchemy import inspect, text
        from sqlalchemy.exc import SQLAlchemyError

        try:
            with self._engine.connect() as db:
                if not inspect(db).has_table(_SHARED):
                    return []
                return [tuple(row) for row in db.execute(text(sql.format(table=_SHARED)), dict(values))]
        except SQLAlchemyError as error:
            raise _unusable(self.place, _short(error)) from error

    @contextmanager
    def writing(self) -> Iterator[Statements]:
        """See `Database`. Of two that write the same at once, one fails; whoever calls tries again."""
        from sqlalchemy import text
        from sqlalchemy.exc import DBAPIError, SQLAlchemyError

        try:
            if not self._made:
                with self._engine.begin() as db:
                    db.execute(text(_TABLE.format(name=_SHARED)))
                self._made = True
            with self._engine.begin() as db:
                yield _SharedStatements(db)
        except DBAPIError as error:
            found = _unusable(self.place, _short(error))
            kind = Collision if _is_collision(error) else SourceError
            raise kind(found.message, location=found.location, fix=found.fix) from error
        except SQLAlchemyError as error:
            raise _unusable(self.place, _short(error)) from error


class _SharedStatements:
    def __init__(self, db: Any) -> None:
        self._db = db

    def run(self, sql: str, values: _Values) -> int:
        from sqlalchemy import text

        return int(self._db.execute(text(sql.format(table=_SHARED)), dict(values)).rowcount)


class Collision(SourceError):
    """Two transactions conflicted; the change should be tried again."""


def _is_collision(error: Any) -> bool:
    return getattr(error.orig, "sqlstate", None) in ("40001", "40P01", "23505") or "UNIQUE" in str(error.orig).upper()


def _short(error: Exception) -> str:
    return str(getattr(error, "orig", None) or error).strip().splitlines()[0]


def _database(place: Path | str) -> Database:
    """The database behind a path or an SQLAlchemy URL (what has `://` in it)."""
    text = str(place)
    if isinstance(place, str) and "://" in text:
        return SharedDatabase(text)
    return SqliteFile(Path(place))
