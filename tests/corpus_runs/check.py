"""A small corpus run through the steps that need no simulator, and compared with the results that are kept (make
corpus-check).

`python -m tests.corpus_runs.check` exits with 1 if a program has become worse. `--write` keeps the results of now instead.
The CSV files in `expected` have the columns that `robosmi corpus compare` reads.
"""

from __future__ import annotations

import csv
import sqlite3
import sys
import tempfile
from contextlib import closing
from pathlib import Path

from robosmi.cli.main import main
from robosmi.corpus.store import TABLES, Store

HERE = Path(__file__).parent
EXPECTED = HERE / "expected"
KEPT = {
    "programs": ("id", "state", "listed"),
    "plans": (
        "program",
        "target",
        "retain",
        "adapt",
        "drop",
        "hoist",
        "rewrite",
        "unsupported",
        "call_sites",
        "with_body",
        "tasks",
    ),
    "calls": ("program", "function", "header", "line", "disposition", "has_body"),
    "findings": ("program", "step", "rule", "severity", "line"),
}
"""Table -> the columns that are kept."""


def keep(store: Path) -> None:
    """Write the results of a run as those that are expected."""
    EXPECTED.mkdir(exist_ok=True)
    with closing(sqlite3.connect(store)) as db:
        for table, columns in KEPT.items():
            listed = ", ".join(f'"{column}"' for column in columns)
            with (EXPECTED / f"{table}.csv").open("w", encoding="utf-8", newline="") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(columns)
                writer.writerows(db.execute(f"SELECT {listed} FROM {table} ORDER BY {listed}"))


def expected(folder: Path) -> Path:
    """A store with the results that are kept."""
    path = folder / "corpus.sqlite"
    Store(path, write=True).close()
    with closing(sqlite3.connect(path)) as db:
        for table in KEPT:
            with (EXPECTED / f"{table}.csv").open(encoding="utf-8", newline="") as file:
                rows = csv.reader(file)
                columns = next(rows)
                numbers = [TABLES.tables[table].c[column].type.python_type in (int, bool) for column in columns]
                values = [
                    [int(cell) if number and cell else cell or None for cell, number in zip(row, numbers, strict=True)]
                    for row in rows
                ]
                names, marks = ", ".join(f'"{column}"' for column in columns), ", ".join("?" * len(columns))
                db.executemany(f"INSERT INTO {table} ({names}) VALUES ({marks})", values)
        db.commit()
    return folder


def check(*, write: bool = False) -> int:
    """Run the corpus and compare; the exit code of `robosmi corpus compare`."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        main(["corpus", "run", str(HERE / "corpus.toml"), "-o", str(folder / "now"), "--steps", "analyse,migrate"])
        if write:
            keep(folder / "now" / "corpus.sqlite")
            return 0
        (folder / "kept").mkdir()
        return main(["corpus", "compare", str(expected(folder / "kept")), str(folder / "now")])


if __name__ == "__main__":
    sys.exit(check(write="--write" in sys.argv))
