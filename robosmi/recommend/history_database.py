"""Where the history of choices is kept: one SQLite file through Python's own module, or any database by an SQLAlchemy URL.

Both are seen as `Database`: `read` for one question, `writing` for one transaction. What is asked and written is in
`history`. A file is opened anew for each call, so that it may be shared, moved or deleted between calls; it is made only by
writing. Whoever finds it locked waits as long as others write into it. SQLite's write-ahead log is not used, since it needs
memory that processes share, which not every file system has. SQLAlchemy is an extra (`robosmi[database]`) and imported only
when a URL is given.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager, closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, SourceError

if TYPE_CHECKING:
    import sqlite3

Values = Mapping[str, str | int]
_Result = TypeVar("_Result")

FORMAT = 2
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


class Statements(Protocol):
    """An open transaction."""

    def run(self, sql: str, values: Values) -> int:
        """Run one statement with `:name` parameters; {table} stands for the table. Returns how many rows it touched."""


class Database(Protocol):
    """A store of choices. All methods raise SourceError if it is damaged, foreign, locked, unreachable or read-only."""

    @property
    def place(self) -> str:
        """The file or the URL without its password, for messages."""

    def read(self, sql: str, values: Values) -> list[tuple[Any, ...]]:
        """The rows of a question ({table} stands for the table); none if there is no such place yet."""

    def writing(self) -> AbstractContextManager[Statements]:
        """One transaction: all of it or nothing is written. The place and its table are made if need be."""


def unusable(place: str, cause: str) -> SourceError:
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

    def read(self, sql: str, values: Values) -> list[tuple[Any, ...]]:
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
            raise unusable(self.place, str(error)) from error

    def _rows(self, mode: str, sql: str, values: Values) -> list[tuple[Any, ...]]:
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
            raise unusable(self.place, str(error)) from error

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
            raise unusable(self.place, error.strerror or str(error)) from error
        return True

    def _table(self, db: sqlite3.Connection) -> str:
        """The SQL for the table: its name, a subquery for a file of format 1, or an empty text for an empty file."""
        kind, version = db.execute("PRAGMA application_id").fetchone()[0], db.execute("PRAGMA user_version").fetchone()[0]
        if kind == _APPLICATION and version == FORMAT:
            return "choice"
        if kind == _APPLICATION and version == 1:
            return _OLD.format(name="choice")
        if (kind, version) == (0, 0) and not db.execute("SELECT count(*) FROM sqlite_master").fetchone()[0]:
            return ""
        newer = kind == _APPLICATION and version > FORMAT
        raise unusable(self.place, "a newer robosmi wrote it" if newer else "it is another kind of database")

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
        db.execute(f"PRAGMA user_version={FORMAT}")


class _SqliteStatements:
    def __init__(self, db: sqlite3.Connection) -> None:
        self._db = db

    def run(self, sql: str, values: Values) -> int:
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

    def read(self, sql: str, values: Values) -> list[tuple[Any, ...]]:
        """See `Database`."""
        from sqlalchemy import inspect, text
        from sqlalchemy.exc import SQLAlchemyError

        try:
            with self._engine.connect() as db:
                if not inspect(db).has_table(_SHARED):
                    return []
                return [tuple(row) for row in db.execute(text(sql.format(table=_SHARED)), dict(values))]
        except SQLAlchemyError as error:
            raise unusable(self.place, _short(error)) from error

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
            found = unusable(self.place, _short(error))
            kind = Collision if _is_collision(error) else SourceError
            raise kind(found.message, location=found.location, fix=found.fix) from error
        except SQLAlchemyError as error:
            raise unusable(self.place, _short(error)) from error


class _SharedStatements:
    def __init__(self, db: Any) -> None:
        self._db = db

    def run(self, sql: str, values: Values) -> int:
        from sqlalchemy import text

        return int(self._db.execute(text(sql.format(table=_SHARED)), dict(values)).rowcount)


class Collision(SourceError):
    """Two transactions conflicted; the change should be tried again."""


def _is_collision(error: Any) -> bool:
    return getattr(error.orig, "sqlstate", None) in ("40001", "40P01", "23505") or "UNIQUE" in str(error.orig).upper()


def _short(error: Exception) -> str:
    return str(getattr(error, "orig", None) or error).strip().splitlines()[0]


def database(place: Path | str) -> Database:
    """The database behind a path or an SQLAlchemy URL (what has `://` in it)."""
    text = str(place)
    if isinstance(place, str) and "://" in text:
        return SharedDatabase(text)
    return SqliteFile(Path(place))
