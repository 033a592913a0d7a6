"""Reads gzip-compressed text line by line with size limits. The caller interprets the lines."""

from __future__ import annotations

import errno
import gzip
import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from robosmi import inputs

MOST_BYTES = 1024 * 1024 * 1024
"""Unpacked bytes of a text; the facts about all public libraries have 200 MB."""
LONGEST_LINE = 16 * 1024 * 1024
"""Characters of a line, which is held in memory."""


@contextmanager
def packed_lines(path: Path) -> Iterator[Iterator[str]]:
    """The lines of a text in UTF-8 that is packed with gzip.

    Args:
        path: the file, closed at the end of the `with` block.

    Raises:
        InputRefusedError: it is no ordinary file, unpacks to more than `MOST_BYTES`, or has a line of over `LONGEST_LINE`.
        OSError, EOFError: it cannot be read, or is damaged.
        UnicodeDecodeError: it is not UTF-8.
    """
    with inputs.open_file(path) as stream, gzip.GzipFile(fileobj=stream) as packed:
        yield _bounded(path, io.TextIOWrapper(packed, encoding="utf-8"))


def _bounded(path: Path, text: io.TextIOWrapper) -> Iterator[str]:
    read = 0
    while line := text.readline(LONGEST_LINE + 1):
        read += len(line)
        if len(line) > LONGEST_LINE or read > MOST_BYTES:
            what = "a line in it" if len(line) > LONGEST_LINE else "its text"
            most = (LONGEST_LINE if len(line) > LONGEST_LINE else MOST_BYTES) // 1024 // 1024
            raise inputs.InputRejectedError(errno.EFBIG, f"{what} is longer than {most} MB", path, "make the file again")
        yield line
