"""The store of a corpus: its tables in `OUT/corpus.sqlite`, or in any database that SQLAlchemy reaches by a URL.

Each result of a program replaces the rows that it had, in one transaction. SQLite keeps a write-ahead log, so that what is
committed survives a killed process, and readers do not wait. Questions of users are read-only.

The tables are SQLAlchemy Core tables, which say in words what each has: docs/reference/corpus-schema.md is made from here
(`python -m tests.corpus_schema_page`). A change of a table is a new `VERSION`. `export` writes them as files: CSV (RFC 4180,
UTF-8), or Parquet where pyarrow is installed.
"""

from __future__ import annotations

import csv
import io
import os
import sqlite3
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from datetime import UTC, datetime
from itertools import islice
from pathlib import Path
from typing import Any

from msgspec import Struct
from sqlalchemy import (
    Boolean,
    Column,
    Connection,
    CursorResult,
    Engine,
    Float,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    Table,
    Text,
    create_engine,
    delete,
    event,
    func,
    insert,
    inspect,
    select,
    update,
)
from sqlalchemy.engine import make_url
from sqlalchemy.exc import ArgumentError, DBAPIError, SQLAlchemyError
from sqlalchemy.pool import NullPool

import robosmi
from robosmi.base.data_text import json_written
from robosmi.corpus.digests import digest_of_files
from robosmi.corpus.jobs import ProgramResult
from robosmi.corpus.states import DONE, SKIPPED
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, SourceError, UsageError

FILE = "corpus.sqlite"
_WAIT_S = 30.0
_SELECTS = frozenset(
    getattr(sqlite3, name) for name in ("SQLITE_SELECT", "SQLITE_READ", "SQLITE_FUNCTION", "SQLITE_RECURSIVE")
)  # fmt: skip

_ROWS = 10_000
"""Rows in memory at once."""

VERSION = 1
"""The version of the tables, stored under the key `schema` of the table `corpus`."""

TABLES = MetaData()


def _column(name: str, kind: type, comment: str, *, key: bool = False) -> Column[object]:
    return Column(name, kind, primary_key=key, nullable=not key, comment=comment)


def _program() -> Column[object]:
    return Column("program", Text, ForeignKey("programs.id"), nullable=False, comment="`programs.id`")


_CORPUS = Table(
    "corpus", TABLES,
    _column("key", Text, "`schema` (version of these tables) or `tool` (version of RoboSMi that made the store)", key=True),
    _column("value", Text, "its value"),
    comment="facts about the store itself",
)  # fmt: skip
_PROGRAMS = Table(
    "programs", TABLES,
    _column("id", Text, "path from the specification's folder, absolute outside of it; a list names its own", key=True),
    _column("path", Text, "absolute path of the file or folder that was read"),
    _column("repository", Text, "absolute path of the git repository; null for files of a folder"),
    _column("revision", Text, "commit that was read, 40 digits; null for files of a folder"),
    _column("digest", Text, "SHA-256 over all files that the results depend on, headers included"),
    _column("labels", Text, "JSON object: the labels of the entry and of its row in the list"),
    _column("state", Text, "done, failed, timeout, too-large or skipped (not run to its end: a file or tool is missing)"),
    _column("step", Text, "step at which a program that is not done ended"),
    _column("message", Text, "why a program is not done"),
    _column("seconds", Float, "time of all steps"),
    _column("peak_mb", Float, "most memory that a step added to its worker process, or its limit if that was too little, in MiB"),
    _column("settings", Text, "digest of the steps and options that it was run with"),
    _column("limits", Text, "limits that it was run with"),
    _column("tool", Text, "version of RoboSMi, its plug-ins and the user's own data"),
    _column("finished", Text, "time of its end, UTC, ISO 8601"),
    _column("output", Text, "folder of its migration, relative to OUT; null without one"),
    _column("listed", Boolean, "whether the last run's specification still has it"),
    comment="one row for each program",
)  # fmt: skip
_FILES = Table(
    "files", TABLES, _program(),
    _column("path", Text, "absolute path"),
    _column("digest", Text, "SHA-256 of the content; empty for a path where a file would count and is none"),
    comment="the files that the results of a program depend on",
)  # fmt: skip
_STEPS = Table(
    "steps", TABLES, _program(),
    _column("name", Text, "analyse, migrate, compile or verify"),
    _column("state", Text, "as `programs.state`"),
    _column("seconds", Float, "its time"),
    _column("peak_mb", Float, "most memory that it added to the worker process, as `programs.peak_mb`"),
    _column("message", Text, "why it is not done"),
    comment="the steps of a program that were begun",
)  # fmt: skip
_FINDINGS = Table(
    "findings", TABLES, _program(),
    _column("step", Text, "step that reports it"),
    _column("rule", Text, "id of the rule"),
    _column("severity", Text, "error, warning or info"),
    _column("message", Text, "what was found"),
    _column("path", Text, "file"),
    _column("line", Integer, "line, from 1"),
    _column("column", Integer, "column in bytes, from 1"),
    _column("element", Text, "URI of the model element"),
    _column("fix", Text, "what to do"),
    _column("task", Boolean, "whether it is a task that is left to the user"),
    comment="findings and tasks",
)  # fmt: skip
_CALLS = Table(
    "calls", TABLES, _program(),
    _column("function", Text, "name of the called function"),
    _column("header", Text, "header that declares it; null if no known one does"),
    _column("line", Integer, "line of the call"),
    _column("path", Text, "file of the call"),
    _column("disposition", Text, "adapt, retain or unsupported after a migration; unknown if nothing declares it; else null"),
    _column(
        "has_body", Boolean,
        "whether an adapter with a body replaces it on the target; null if the platform stays, and before a migration if no "
        "adapter of the function is known",
    ),
    comment="calls of the platform's functions, also through macros, and of functions that nothing known declares",
)  # fmt: skip
_PINS = Table(
    "pins", TABLES, _program(),
    _column("pin", Integer, "number on the source; null if known only at run time"),
    _column("expression", Text, "argument as the program writes it"),
    _column("origin", Text, "literal, constant, array, register, runtime or convention"),
    _column("function", Text, "function that is called with it"),
    _column("direction", Text, "in, out, both or unknown"),
    _column("line", Integer, "line of the call"),
    _column("path", Text, "file of the call"),
    comment="uses of pins",
)  # fmt: skip
_PLANS = Table(
    "plans", TABLES, _program(),
    _column("target", Text, "board of the plan"),
    *(_column(name, Integer, "elements of the program with this disposition")
      for name in ("retain", "adapt", "drop", "hoist", "rewrite", "unsupported")),
    _column("call_sites", Integer, "calls of the platform's functions"),
    _column("with_body", Integer, "those of them that an adapter with a body replaces"),
    _column("tasks", Integer, "tasks that are left to the user"),
    _column("open_choices", Integer, "choices that nobody has made"),
    _column("report", Text, "the report of the migration, relative to OUT"),
    comment="migration plans",
)  # fmt: skip
_COMPILES = Table(
    "compiles", TABLES, _program(),
    _column("target", Text, "board that it was compiled for"),
    _column("ok", Boolean, "whether it compiles and links"),
    _column("fits", Boolean, "whether it fits on the board"),
    _column("flash", Integer, "bytes of flash"),
    _column("ram", Integer, "bytes of RAM"),
    _column("messages", Integer, "messages of the compiler; they are in `findings`"),
    comment="compiled programs",
)  # fmt: skip
VERDICTS = Table(
    "verdicts", TABLES, _program(),
    _column("verdict", Text, "no-difference-found, different, not-decidable or not-compiled"),
    _column("partial", Boolean, "whether a wired output was not compared, or a line not reached"),
    _column("outputs", Integer, "outputs that were compared"),
    _column("outputs_of", Integer, "outputs that are wired"),
    _column("lines_pct", Float, "reached lines of the source, in percent"),
    _column("first_difference", Text, "JSON object of the first difference; null without one"),
    comment="comparisons of original and migrated program",
)  # fmt: skip
_MODELS = Table(
    "models", TABLES, _program(),
    _column("kind", Text, "code, hardware, plan or platform"),
    _column("path", Text, "XMI file, relative to OUT"),
    comment="models that were kept",
)  # fmt: skip
_DETAILS = (_FILES, _STEPS, _FINDINGS, _CALLS, _PINS, _PLANS, _COMPILES, VERDICTS, _MODELS)
"""The tables with rows of a program, which a new result of it replaces."""
for _table in _DETAILS:
    Index(f"{_table.name}_of_program", _table.c.program)


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
            if _CORPUS.name not in names:
                if names & set(TABLES.tables) or not self._write:
                    place = Location(self.place)
                    raise SourceError("this is no store of a corpus", location=place, fix="give the output folder of a run")
                with self._engine.begin() as db:
                    TABLES.create_all(db)
                    facts = {"schema": str(VERSION), "tool": robosmi.__version__}
                    db.execute(insert(_CORPUS), [{"key": key, "value": value} for key, value in facts.items()])
                return
            with self._engine.connect() as db:
                facts = {row.key: row.value for row in db.execute(select(_CORPUS.c.key, _CORPUS.c.value))}
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
            for program, path, digest in db.execute(select(_FILES.c.program, _FILES.c.path, _FILES.c.digest)):
                files.setdefault(program, {})[path] = digest
            columns = (
                _PROGRAMS.c.id, _PROGRAMS.c.state, _PROGRAMS.c.digest, _PROGRAMS.c.settings, _PROGRAMS.c.limits, _PROGRAMS.c.tool,
                _PROGRAMS.c.listed,
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
                db.execute(update(_PROGRAMS).where(_PROGRAMS.c.id == result.id).values(now))
                return False
            self._remove(db, result.id)
            db.execute(insert(_PROGRAMS), row)
            self._add(db, _FILES.name, result.id, [{"path": path, "digest": each} for path, each in result.files.items()])
            steps = [
                {"name": step.name, "state": step.state, "seconds": round(step.seconds, 6), "peak_mb": step.peak_mb,
                 "message": step.message} for step in result.steps
            ]  # fmt: skip
            self._add(db, _STEPS.name, result.id, steps)
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
            for table in (_PROGRAMS, _FILES, _FINDINGS, _CALLS, _PINS):
                mine = table.c.id if table is _PROGRAMS else table.c.program
                columns = [column for column in (table.c.path, table.c.get("message")) if column is not None]
                moved = {column.name: func.replace(column, before + os.sep, after + os.sep) for column in columns}
                db.execute(update(table).where(mine == program).values(**moved))
            db.execute(update(_PROGRAMS).where(_PROGRAMS.c.id == program).values(revision=revision, digest=digest))

    @staticmethod
    def _remove(db: Connection, program: str) -> None:
        for table in _DETAILS:
            db.execute(delete(table).where(table.c.program == program))
        db.execute(delete(_PROGRAMS).where(_PROGRAMS.c.id == program))

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
            for program, *stored in db.execute(select(_PROGRAMS.c.id, _PROGRAMS.c.listed, _PROGRAMS.c.labels)).all():
                now = [True, json_written(labels[program])] if program in labels else [False, stored[1]]
                if now != stored:
                    db.execute(update(_PROGRAMS).where(_PROGRAMS.c.id == program).values(listed=now[0], labels=now[1]))

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
    found = select(func.count()).select_from(_STEPS).where(_STEPS.c.program == program, _STEPS.c.state == DONE)
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


def as_csv(answer: SqlAnswer) -> list[str]:
    """The lines of an answer as comma-separated values; a null is an empty field."""
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(answer.columns)
    writer.writerows(answer.rows)
    return text.getvalue().removesuffix("\n").split("\n")


def export(store: Store, folder: Path, form: str) -> list[Path]:
    """Write each table as a file of its name.

    Args:
        store: the store.
        folder: where to; it is made if need be.
        form: `csv` or `parquet`.

    Returns:
        The files written.

    Raises:
        MissingToolError: pyarrow is not installed.
        SourceError: the files cannot be written.
    """
    write = _write_parquet if form == "parquet" else _write_csv
    written = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for table in TABLES.sorted_tables:
            path = folder / f"{table.name}.{form}"
            part = folder / f".{path.name}.part"
            columns = ", ".join(f'"{column.name}"' for column in table.columns)
            with store.reading(f"SELECT {columns} FROM {table.name}") as (_, rows):
                write(table, rows, part)
            part.replace(path)
            written.append(path)
    except OSError as error:
        raise SourceError(
            f"cannot write here: {error.strerror or error}", location=Location(str(folder)), fix="check the folder and the disk"
        ) from error
    return written


def _write_csv(table: Table, rows: Iterator[tuple[Any, ...]], path: Path) -> None:
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([column.name for column in table.columns])
        writer.writerows(rows)


def _write_parquet(table: Table, rows: Iterator[tuple[Any, ...]], path: Path) -> None:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise MissingToolError(
            "Parquet files need the package pyarrow", fix="install it: pip install 'robosmi[parquet]', or export --as csv"
        ) from error
    kinds = {Boolean: pyarrow.bool_(), Integer: pyarrow.int64(), Float: pyarrow.float64()}
    columns: Sequence[Column[Any]] = list(table.columns)
    schema = pyarrow.schema([(column.name, kinds.get(type(column.type), pyarrow.string())) for column in columns])
    truth = [isinstance(column.type, Boolean) for column in columns]
    with parquet.ParquetWriter(path, schema) as writer:
        while some := list(islice(rows, _ROWS)):
            values = [
                [None if value is None else bool(value) for value in column] if is_truth else list(column)
                for column, is_truth in zip(zip(*some, strict=True), truth, strict=True)
            ]
            writer.write_table(pyarrow.table(values, schema=schema))
