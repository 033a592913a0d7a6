"""SQLite files that are written once and then only read; their bytes depend on the content alone.

The modules that write and read them (`recommend.index`, the catalogue of parts) define their content.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from robosmi.diagnostics import Location
from robosmi.errors import SourceError

if TYPE_CHECKING:
    import sqlite3

_PAGE = 4096  # the smallest file of the sizes tried


@contextmanager
def writing(target: Path, schema: str, application: int, number: int) -> Iterator[sqlite3.Connection]:
    """An empty database to be filled. A file that is there is replaced when all is done; if it is not, it stays.

    Args:
        target: the file. Its folder must exist.
        schema: SQL that makes the tables.
        application: what marks such a file (`PRAGMA application_id`).
        number: number of its format (`PRAGMA user_version`).

    Raises:
        SourceError: it cannot be written: the folder is not there or may not be written, or the disk is full.
    """
    import sqlite3  # 5 ms, wanted only by who writes

    part = target.with_name(f"{target.name}.part-{os.getpid()}")
    try:
        part.unlink(missing_ok=True)
        db = sqlite3.connect(part, isolation_level=None)
        try:
            db.executescript(f"PRAGMA page_size={_PAGE}; PRAGMA journal_mode=OFF; PRAGMA encoding='UTF-8'; BEGIN; {schema}")
            yield db
            for last in ("COMMIT", f"PRAGMA application_id={application}", f"PRAGMA user_version={number}", "VACUUM"):
                db.execute(last)
        finally:
            db.close()
        _forget_the_writer(part)
        part.replace(target)
    except (sqlite3.OperationalError, OSError) as error:
        raise SourceError(
            f"cannot write here: {(isinstance(error, OSError) and error.strerror) or error}",
            location=Location(str(target)),
            fix="check the folder's permissions and the space on the disk",
        ) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def _forget_the_writer(path: Path) -> None:
    """Reset what depends on the writing program instead of the content: change counters and SQLite's own version."""
    with path.open("r+b") as file:
        file.seek(24)
        file.write(struct.pack(">I", 1))  # SQLite file format, section 1.3: file change counter
        file.seek(92)
        file.write(struct.pack(">II", 1, 3_040_000))  # version-valid-for (equals the counter), version number
