"""Replacements of parts of a file."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass


@dataclass(frozen=True)
class Edit:
    """The replacement of a part of a file."""

    begin: int
    end: int
    text: str


Edits = Iterator[tuple[Edit, ...]]
