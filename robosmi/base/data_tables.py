"""Typed reading of the repository's TOML files: a value of the wrong kind is an error that names file and key.

`DataTable` is one table of such a file. The modules that read a file know what its keys mean; nothing here
knows a key.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypeVar

from msgspec import Struct

from robosmi import inputs, resources
from robosmi.base.data_text import Json, toml_of
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean

T = TypeVar("T")
KIND = "platform_repo"
"""The kind of data (see `robosmi.resources`) that contains toolchains, boards and stand-ins."""


class DataTable(Struct, frozen=True):
    """One table of a TOML file of the repository.

    Attributes:
        path: the file.
        values: what the table holds.
        prefix: the keys that lead to the table, with a dot at the end; empty for the whole file.
    """

    path: Path
    values: Mapping[str, Json]
    prefix: str = ""

    @staticmethod
    def read(path: Path) -> DataTable:
        """The whole file.

        Raises:
            PlatformDataError: it cannot be read, or is no TOML.
        """
        try:
            return DataTable(path, toml_of(inputs.read_text(path, inputs.SETTINGS)))
        except (OSError, ValueError) as error:
            raise PlatformDataError(f"the file cannot be read: {error}", location=Location(str(path))) from error

    def error(
        self, key: str, problem: str, fix: str = "correct the entry, or remove the file if it is your own"
    ) -> PlatformDataError:
        """An error about a key of this table, to be raised by the caller."""
        return PlatformDataError(f"'{self.prefix}{key}' {problem}", location=Location(str(self.path)), fix=fix)

    def _no_nul(self, key: str, *texts: str) -> None:
        """Refuse the one character that neither the name of a file nor an argument of a program can have."""
        if "\0" in "".join(texts):
            raise self.error(key, "has a NUL character")

    def _get(self, key: str, kind: type[T] | tuple[type[T], ...], called: str) -> T:
        if key not in self.values:
            raise self.error(key, f"is missing{did_you_mean(key, self.values)}")
        value = self.values[key]
        if not isinstance(value, kind) or isinstance(value, bool):
            raise self.error(key, f"must be {called}, it is {value!r}")
        return value

    def text(self, key: str, default: str | None = None) -> str:
        """A text; missing is an error unless there is a default."""
        if default is not None and key not in self.values:
            return default
        text = self._get(key, str, "a text")
        self._no_nul(key, text)
        return text

    def number(self, key: str) -> int:
        """A whole number."""
        return self._get(key, int, "a whole number")

    def positive(self, key: str) -> int:
        """A whole number above zero."""
        if (number := self.number(key)) <= 0:
            raise self.error(key, f"must be above zero, it is {number}")
        return number

    def decimal(self, key: str) -> float:
        """A number with or without a fraction."""
        if isinstance(self.values.get(key), float):
            return self._get(key, float, "a number")
        return float(self._get(key, int, "a number"))

    def optional_number(self, key: str) -> int | None:
        """A whole number, or None if the key is not there."""
        return self.number(key) if key in self.values else None

    def flag(self, key: str, default: bool | None = None) -> bool:
        """True or false; missing is an error unless there is a default."""
        if default is None and key not in self.values:
            raise self.error(key, f"is missing{did_you_mean(key, self.values)}")
        value = self.values.get(key, default)
        if not isinstance(value, bool):
            raise self.error(key, f"must be true or false, it is {value!r}")
        return value

    def texts(self, key: str, default: tuple[str, ...] | None = None) -> tuple[str, ...]:
        """A list of texts; missing is an error unless there is a default."""
        if default is not None and key not in self.values:
            return default
        items = self._get(key, list, "a list of texts")
        if not all(isinstance(item, str) for item in items):
            raise self.error(key, f"must be a list of texts, it is {items!r}")
        self._no_nul(key, *items)
        return tuple(items)

    def lists_of_texts(self, key: str) -> tuple[tuple[str, ...], ...]:
        """A list of lists of texts."""
        items = self._get(key, list, "a list of lists of texts")
        if not all(isinstance(item, list) and all(isinstance(text, str) for text in item) for item in items):
            raise self.error(key, f"must be a list of lists of texts, it is {items!r}")
        self._no_nul(key, *(text for item in items for text in item))
        return tuple(tuple(item) for item in items)

    def numbers(self, key: str, default: tuple[int, ...] | None = None) -> tuple[int, ...]:
        """A list of whole numbers; missing is an error unless there is a default."""
        if default is not None and key not in self.values:
            return default
        items = self._get(key, list, "a list of whole numbers")
        if not all(isinstance(item, int) and not isinstance(item, bool) for item in items):
            raise self.error(key, f"must be a list of whole numbers, it is {items!r}")
        return tuple(items)

    def pattern(self, key: str) -> re.Pattern[str]:
        """A regular expression, compiled so that `^` and `$` match at each line."""
        try:
            return re.compile(self.text(key), re.MULTILINE)
        except re.error as error:
            raise self.error(key, f"is not a regular expression: {error}") from error

    def texts_by_name(self, key: str) -> dict[str, str]:
        """A table inside whose values are all texts; empty if the key is missing."""
        table = self.table(key, needed=False)
        return {name: table.text(name) for name in table.values}

    def numbers_by_name(self, key: str) -> dict[str, int]:
        """A table inside whose values are all whole numbers; empty if the key is missing."""
        table = self.table(key, needed=False)
        return {name: table.number(name) for name in table.values}

    def table(self, key: str, needed: bool = True) -> DataTable:
        """A table inside; empty if the key is missing and not needed."""
        if not needed and key not in self.values:
            return DataTable(self.path, {}, f"{self.prefix}{key}.")
        return DataTable(self.path, self._get(key, dict, "a table"), f"{self.prefix}{key}.")

    def tables(self, key: str, needed: bool = True) -> list[DataTable]:
        """A list of tables inside; empty if the key is missing and not needed."""
        if not needed and key not in self.values:
            return []
        items = self._get(key, list, "a list of tables")
        if not all(isinstance(item, dict) for item in items):
            raise self.error(key, "must be a list of tables")
        return [DataTable(self.path, item, f"{self.prefix}{key}[{index}].") for index, item in enumerate(items)]


def find_files(pattern: str, project: Path | None = None) -> Iterator[Path]:
    """The files or folders of the repository that match, each relative name once: the first in search order wins.

    Args:
        pattern: as in `Path.glob`, relative to a folder of the repository.
        project: the project folder; the current folder if None.
    """
    seen: set[str] = set()
    for folder in resources.folders(KIND, project):
        for path in sorted(folder.glob(pattern)):
            name = path.relative_to(folder).as_posix()
            if name not in seen:
                seen.add(name)
                yield path
