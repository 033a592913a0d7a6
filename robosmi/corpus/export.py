"""Writes the tables of a corpus as files: CSV (RFC 4180, UTF-8), or Parquet where pyarrow is installed."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

from sqlalchemy import Boolean, Column, Float, Integer, Table

from robosmi.corpus.schema import TABLES
from robosmi.corpus.store import SqlAnswer, Store
from robosmi.diagnostics import Location
from robosmi.errors import MissingToolError, SourceError

_ROWS = 10_000
"""Rows in memory at once."""


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
