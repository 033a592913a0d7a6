"""The store of a corpus: the tables of `schema` in `OUT/corpus.sqlite`, or in any database that SQLAlchemy reaches by a URL.

Each result of a program replaces the rows that it had, in one transaction. SQLite keeps a write-ahead log, so that what is
committed survives a killed process, and readers do not wait. Questions of users are read-only.
"""

from __future__ import annotations

import os
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from msgspec import Struct
from sqlalchemy import Connection, CursorResult, Engine, create_engine, delete, event, func, insert, inspect, select, update
from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError, DBAPIError, SQLAlchemyError
from sqlalchemy.pool import NullPool

import robosmi
from robosmi.base.data_text import json_written
from robosmi.corpus.digests import digest_of_files
from robosmi.corpus.jobs import ProgramResult
from robosmi.corpus.schema import CALLS, CORPUS, DETAILS, FILES, FINDINGS, PINS, PROGRAMS, STEPS, TABLES, VERSION
from robosmi.corpus.states import DONE, SKIPPED
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, SourceError, UsageError

FILE = "corpus.sqlite"
_WAIT_S = 30.0
_SELECTS = frozenset(
    getattr(sqlite3, name) for name in ("SQLITE_SELECT", "SQLITE_READ", "SQLITE_FUNCTION", "SQLITE_RECURSIVE")
)  # fmt: skip


class StoredResult(Struct, frozen=True):
    """What the store has of a program, as far as a run asks for it before it runs the program again.

    Attributes:
        state, digest, settings, limits, tool, listed: the columns of `programs`.
        files: path -> digest of its files.
    """

    state: str
    digest: str
    settings: str
    limits: str
    tool: str
    listed: bool
    files: dict[str, str]


class SqlAnswer(Struct, frozen=True):
    """The answer to a question: the names of its columns, and its rows."""

    columns: tuple[str, ...]
    rows: list[tuple[Any, ...]]


class Store:
    """A store that is open.

    Args:
        place: an SQLAlchemy URL, or the path of an SQLite file.
        write: whether it is made if it is not there, and written.

    Raises:
        SourceError: it is not there, damaged, or of another version; the database is not reached.
        MissingToolError: the driver of the database is not installed.
    """

    def __init__(self, place: str | Path, *, write: bool = False) -> None:
        self._write = write
        self._engine = self._opened(place)
        try:
            self._check()
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Store:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _opened(self, place: str | Path) -> Engine:
        if isinstance(place, str) and "://" in place:
            try:
                url = make_url(place)
                self.place = url.render_as_string(hide_password=True)
                if url.get_backend_name() == "sqlite" and url.database:
                    return self._sqlite(Path(url.database))
                return create_engine(url, pool_pre_ping=True)
            except ImportError as error:
                raise MissingToolError(f"the driver of the database is missing: {error}", fix="install it with pip") from error
            except (ArgumentError, SQLAlchemyError) as error:
                raise SourceError(
                    f"this is not the URL of a database: {error}", fix="write postgresql+psycopg://USER@HOST/NAME"
                ) from error
        self.place = str(place)
        return self._sqlite(Path(place))

    def _sqlite(self, path: Path) -> Engine:
        if not self._write and not path.is_file():
            raise SourceError(
                "there is no corpus here", location=Location(str(path)), fix="run: robosmi corpus run SPEC.toml -o OUT"
            )
        try:
            if self._write:
                path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise SourceError(f"cannot write here: {error.strerror}", location=Location(str(path))) from error
        name = path.absolute().as_uri()

        def connect() -> sqlite3.Connection:
            if self._write:
                return sqlite3.connect(path, timeout=_WAIT_S, check_same_thread=False)
            made = sqlite3.connect(f"{name}?mode=ro", uri=True, timeout=_WAIT_S, check_same_thread=False)
            try:
                made.execute("SELECT count(*) FROM sqlite_master")
            except sqlite3.OperationalError:  # a log that is not there cannot be made on a disk that is read-only
                made.close()
                made = sqlite3.connect(f"{name}?mode=ro&immutable=1", uri=True, timeout=_WAIT_S, check_same_thread=False)
            return made

        engine = create_engine("sqlite://", creator=connect, poolclass=NullPool if not self._write else None)

        @event.listens_for(engine, "connect")
        def _settings(connection: sqlite3.Connection, _: object) -> None:
            if self._write:
                connection.execute("PRAGMA journal_mode=WAL")
                connection.execute("PRAGMA synchronous=NORMAL")
                connection.execute("PRAGMA foreign_keys=OFF")  # the rows of a program are replaced as a whole

        return engine

    @contextmanager
    def _faults(self) -> Iterator[None]:
        """Context manager: what the database refuses is an error with its place and cause."""
        try:
            yield
        except (SQLAlchemyError, sqlite3.Error) as error:
            said = str(getattr(error, "orig", None) or error).strip().splitlines()[0]
            full = "full" in said
            raise SourceError(
                f"the store cannot be used: {said}", location=Location(self.place),
                fix="make room on the disk, and run the same command again: what is stored stays" if full
                else "check the file or the database; a new output folder begins a new store",
            ) from error  # fmt: skip

    def _check(self) -> None:
        """Make the tables if need be, and refuse those of another version."""
        with self._faults():
            names = set(inspect(self._engine).get_table_names())
            if CORPUS.name not in names:
                if names & set(TABLES.tables) or not self._write:
                    place = Location(self.place)
                    raise SourceError("this is no store of a corpus", location=place, fix="give the output folder of a run")
                with self._engine.begin() as db:
                    TABLES.create_all(db)
                    facts = {"schema": str(VERSION), "tool": robosmi.__version__}
                    db.execute(insert(CORPUS), [{"key": key, "value": value} for key, value in facts.items()])
                return
            with self._engine.connect() as db:
                facts = {row.key: row.value for row in db.execute(select(CORPUS.c.key, CORPUS.c.value))}
        if facts.get("schema") != str(VERSION):
            raise SourceError(
                f"the store has tables of version {facts.get('schema')} (made by RoboSMi {facts.get('tool')}), and this RoboSMi "
                f"{robosmi.__version__} reads version {VERSION}",
                location=Location(self.place), fix="run the corpus into a new output folder, or use that version",
            )  # fmt: skip

    def known(self) -> dict[str, StoredResult]:
        """All programs of the store by their ids."""
        with self._faults(), self._engine.connect() as db:
            files: dict[str, dict[str, str]] = {}
            for program, path, digest in db.execute(select(FILES.c.program, FILES.c.path, FILES.c.digest)):
                files.setdefault(program, {})[path] = digest
            columns = (
                PROGRAMS.c.id, PROGRAMS.c.state, PROGRAMS.c.digest, PROGRAMS.c.settings, PROGRAMS.c.limits, PROGRAMS.c.tool,
                PROGRAMS.c.listed,
            )  # fmt: skip
            return {row[0]: StoredResult(*row[1:], files.get(row[0], {})) for row in db.execute(select(*columns))}

    def record(self, result: ProgramResult, facts: Mapping[str, Any]) -> bool:
        """Replace the rows of a program by those of a new result, in one transaction.

        A result that is `skipped`, which is no fault of the program, replaces none that got further: of that, only the state, the
        step and the message change.

        Args:
            result: the result.
            facts: the other columns of `programs`.

        Returns:
            Whether the rows were replaced.
        """
        row = {
            **facts, "id": result.id, "digest": digest_of_files(result.files), "state": result.state, "step": result.step,
            "message": result.message, "seconds": round(result.seconds, 6), "peak_mb": result.peak_mb, "listed": True,
            "finished": datetime.now(UTC).isoformat(timespec="milliseconds"), "labels": json_written(facts["labels"]),
        }  # fmt: skip
        with self._faults(), self._engine.begin() as db:
            if result.state == SKIPPED and _steps_done(db, result.id) > sum(step.state == DONE for step in result.steps):
                now = {key: row[key] for key in ("state", "step", "message", "labels", "listed")}
                db.execute(update(PROGRAMS).where(PROGRAMS.c.id == result.id).values(now))
                return False
            self._remove(db, result.id)
            db.execute(insert(PROGRAMS), row)
            self._add(db, FILES.name, result.id, [{"path": path, "digest": each} for path, each in result.files.items()])
            steps = [
                {"name": step.name, "state": step.state, "seconds": round(step.seconds, 6), "peak_mb": step.peak_mb,
                 "message": step.message} for step in result.steps
            ]  # fmt: skip
            self._add(db, STEPS.name, result.id, steps)
            for table, rows in result.rows().items():
                self._add(db, table, result.id, rows)
        return True

    def move_program(self, program: str, before: str, after: str, revision: str | None, digest: str) -> None:
        """Note that the files of a program now lie in another folder, and are the same.

        Args:
            program: its id.
            before, after: the folders.
            revision: the commit there.
            digest: that of the files with their paths.
        """
        with self._faults(), self._engine.begin() as db:
            for table in (PROGRAMS, FILES, FINDINGS, CALLS, PINS):
                mine = table.c.id if table is PROGRAMS else table.c.program
                columns = [column for column in (table.c.path, table.c.get("message")) if column is not None]
                moved = {column.name: func.replace(column, before + os.sep, after + os.sep) for column in columns}
                db.execute(update(table).where(mine == program).values(**moved))
            db.execute(update(PROGRAMS).where(PROGRAMS.c.id == program).values(revision=revision, digest=digest))

    @staticmethod
    def _remove(db: Connection, program: str) -> None:
        for table in DETAILS:
            db.execute(delete(table).where(table.c.program == program))
        db.execute(delete(PROGRAMS).where(PROGRAMS.c.id == program))

    @staticmethod
    def _add(db: Connection, table: str, program: str, rows: Sequence[Mapping[str, Any]]) -> None:
        if rows:
            db.execute(insert(TABLES.tables[table]), [{**row, "program": program} for row in rows])

    def mark_listed(self, labels: Mapping[str, Mapping[str, str]]) -> None:
        """Note which programs the specification has, these and no others, and their labels.

        Args:
            labels: id of a program -> its labels.
        """
        with self._faults(), self._engine.begin() as db:
            for program, *stored in db.execute(select(PROGRAMS.c.id, PROGRAMS.c.listed, PROGRAMS.c.labels)).all():
                now = [True, json_written(labels[program])] if program in labels else [False, stored[1]]
                if now != stored:
                    db.execute(update(PROGRAMS).where(PROGRAMS.c.id == program).values(listed=now[0], labels=now[1]))

    def counts(self) -> dict[str, int]:
        """State -> the number of programs that the last specification has."""
        return dict(self.query("SELECT state, count(*) FROM programs WHERE listed GROUP BY state").rows)

    def query(self, sql: str) -> SqlAnswer:
        """The answer to a question in SQL, which can change nothing.

        Raises:
            UsageError: it is no question, or the database does not understand it.
        """
        with self.reading(sql) as (columns, rows):
            return SqlAnswer(columns, list(rows))

    @contextmanager
    def reading(self, sql: str) -> Iterator[tuple[tuple[str, ...], Iterator[tuple[Any, ...]]]]:
        """Context manager: the names of the columns and the rows that answer a question in SQL, without loading them all.

        Raises:
            UsageError: it is no question, or the database does not understand it.
        """
        with self._faults(), self._engine.connect() as db:
            raw = db.connection.driver_connection
            own = raw if isinstance(raw, sqlite3.Connection) else None
            if own is not None:
                own.set_authorizer(_authorised)
            elif db.dialect.name in ("postgresql", "mysql", "mariadb", "oracle"):
                db.exec_driver_sql("SET TRANSACTION READ ONLY")
            try:
                options = db.execution_options(no_parameters=True, stream_results=True)
                try:
                    found = options.exec_driver_sql(sql)
                except (DBAPIError, sqlite3.Error, ValueError) as error:
                    raise _refused(error) from error
                if not found.returns_rows:
                    raise UsageError("the statement reads nothing", fix="give a SELECT")
                yield tuple(found.keys()), _rows(found)
            finally:
                if own is not None:
                    own.set_authorizer(None)
                db.rollback()

    def close(self) -> None:
        """Close the connections."""
        self._engine.dispose()


def _steps_done(db: Connection, program: str) -> int:
    """The number of steps that a stored result of a program has done."""
    found = select(func.count()).select_from(STEPS).where(STEPS.c.program == program, STEPS.c.state == DONE)
    return db.execute(found).scalar_one()


def _authorised(action: int, *_: object) -> int:
    """What SQLite may do for a question: read tables and compute (sqlite3_set_authorizer)."""
    return sqlite3.SQLITE_OK if action in _SELECTS else sqlite3.SQLITE_DENY


def _rows(found: CursorResult[Any]) -> Iterator[tuple[Any, ...]]:
    try:
        for row in found:
            yield tuple(row)
    except (DBAPIError, sqlite3.Error) as error:
        raise _refused(error) from error


def _refused(error: Exception) -> UsageError:
    said = str(getattr(error, "orig", None) or error).strip().splitlines()[0]
    fix = "the tables are in docs/reference/corpus-schema.md; a query only reads"
    return UsageError(f"the database refuses the query: {said}", fix=fix)
