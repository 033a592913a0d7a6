"""Driver for rows: a CSV file, or a folder of them, as a model; a file is a type, a row an element, a column a feature.

The first line names the columns. Every value is text unless a type is given for its column; a cell that is not there is refused.
A column whose name is no Python name is also reached with `_` in the place of what does not fit (`Part Title`: `row.Part_Title`).
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

from robosmi import inputs
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import ModelError, SourceError, did_you_mean
from robosmi.model.elements.driver import Model, ModelElement, name_of
from robosmi.model.elements.strict import FeatureValueError, UnknownFeatureError

_DELIMITERS = ",;\t|"


class Row(ModelElement):
    """A row; its features are the columns of its table."""

    __slots__ = ("_table", "_values")
    _table: Table | None
    _values: list[Any]

    def __init__(self, table: Table, values: list[Any]) -> None:
        object.__setattr__(self, "_table", table)
        object.__setattr__(self, "_values", values)

    def eContainer(self) -> None:
        """Rows are in no container."""

    def _contents(self) -> list[Any]:
        return []

    def _features(self) -> list[str]:
        return list(self.__class__._columns)  # type: ignore[attr-defined]

    def __getattr__(self, name: str) -> Any:
        place = self.__class__._places.get(name)  # type: ignore[attr-defined]
        if place is None:
            raise _unknown(type(self).__name__, name, self._features())
        return self._values[place]

    def __setattr__(self, name: str, value: Any) -> None:
        place = self.__class__._places.get(name)  # type: ignore[attr-defined]
        if place is None:
            raise _unknown(type(self).__name__, name, self._features())
        self._values[place] = self.__class__._check(name, value)  # type: ignore[attr-defined]

    def __repr__(self) -> str:
        shown = ", ".join(f"{c}={v!r}" for c, v in list(zip(self._features(), self._values, strict=True))[:3])
        return f"<{type(self).__name__} {shown}>"


class Table:
    """One CSV file: its columns, its rows, and how it is written."""

    def __init__(self, name: str, columns: list[str], types: Mapping[str, Callable[[str], Any]], path: Path | None) -> None:
        self.name, self.path, self.columns = name, path, columns
        self.types = [types.get(column, str) for column in columns]
        self.rows: list[Row] = []
        self.delimiter, self.end = ",", "\n"
        self.announced = ""  # the line before the columns with which Excel says the delimiter
        places = {re.sub(r"\W|^(?=\d)", "_", column): i for i, column in enumerate(columns)}
        places.update({column: i for i, column in enumerate(columns)})
        described = {
            "__slots__": (), "__doc__": f"A row of {name}.", "_columns": columns, "_places": places,
            "_check": staticmethod(lambda column, value: _fitting(value, self.types[places[column]], f"{name}.{column}")),
        }  # fmt: skip
        self.kind: type[Row] = type(name, (Row,), described)


class TableModel(Model):
    """Tables of rows.

    Args:
        tables: in the order in which their rows come.
        name: what `M!parts` calls it.
        path: the file or folder.
    """

    def __init__(self, tables: list[Table], name: str = "M", path: Path | None = None) -> None:
        super().__init__(name, path)
        self._tables = {table.name: table for table in tables}

    @classmethod
    def load(
        cls, path: str | Path, name: str | None = None, types: Mapping[str, Callable[[str], Any]] | None = None
    ) -> TableModel:
        """Read a CSV file, or all in a folder.

        Args:
            path: the file (UTF-8; comma, semicolon, tab or bar between the cells), or the folder.
            name: the model's name; that of the file or folder if None.
            types: column -> int, float or another function of the text, for columns that are no texts.

        Raises:
            SourceError: a file cannot be read or is no table; all rows of the wrong length in one message.
        """
        place = Path(path)
        files = sorted(f for f in place.iterdir() if f.suffix.lower() in (".csv", ".tsv")) if place.is_dir() else [place]
        if not files:
            models = sorted(str(model) for pattern in ("*.xmi", "*/*.xmi") for model in place.glob(pattern))
            fix = f"give one of its models: {', '.join(models[:4])}" if models else "give another folder"
            raise SourceError("the folder holds no CSV file", location=Location(str(place)), fix=fix)
        return cls([_read(file, types or {}) for file in files], name or place.stem, place)

    def save(self, path: str | Path | None = None) -> None:
        """Write the tables: to the file or files they were read from, or to another file (of one table) or folder."""
        from robosmi.files.files import write_atomic

        target = self._target(path)
        single = len(self._tables) == 1 and not target.is_dir()
        if not single and target.exists() and not target.is_dir():
            raise ModelError(f"the model {self.name} has {len(self._tables)} tables", fix="give a folder to save it to")
        for table in self._tables.values():
            ending = table.path.name if table.path is not None else f"{table.name}.csv"
            write_atomic(target if single else target / ending, _written(table))

    def types(self) -> Iterator[tuple[str, Any]]:
        """One type for each table."""
        return ((name, table.kind) for name, table in self._tables.items())

    def all_contents(self) -> Iterator[Any]:
        """All rows, table by table."""
        return (row for table in list(self._tables.values()) for row in list(table.rows))

    def all_of_kind(self, kind: Any) -> list[Any]:
        """The rows of a table."""
        wanted = self._class_of(kind)
        return [row for table in self._tables.values() if issubclass(table.kind, wanted) for row in table.rows]

    def element(self, identity: str) -> Any:
        """The row with an id such as `parts/12`, or None."""
        name, _, number = identity.rpartition("/")
        table = self._tables.get(name)
        return table.rows[int(number) - 1] if table and number.isdecimal() and 0 < int(number) <= len(table.rows) else None

    def id_of(self, element: Any) -> str:
        """The table and the number of a row in it, from 1."""
        self._check_owned(element)
        table = element._table
        return f"{table.name}/{next(i for i, row in enumerate(table.rows, 1) if row is element)}"

    def owns(self, element: Any) -> bool:
        """Whether the row is in one of the tables."""
        return isinstance(element, Row) and element._table is not None and self._tables.get(element._table.name) is element._table

    def create(self, kind: Any, /, **features: Any) -> Any:
        """A new row at the end of its table; columns that are not given are empty. See `Model.create`."""
        wanted = self.type_named(kind) if isinstance(kind, str) else self._class_of(kind)
        table = next((t for t in self._tables.values() if t.kind is wanted), None)
        if table is None:
            raise ModelError(f"{name_of(wanted)} is no table of the model {self.name}", fix="name one of its tables")
        row = table.kind(table, ["" if kind is str else None for kind in table.types])
        for name, value in features.items():
            setattr(row, name, value)
        table.rows.append(row)
        return row

    def delete(self, element: Any) -> None:
        """Take a row out of its table. See `Model.delete`."""
        self._check_owned(element)
        table = element._table
        table.rows = [row for row in table.rows if row is not element]
        object.__setattr__(element, "_table", None)


def _unknown(what: str, name: str, known: list[str]) -> UnknownFeatureError:
    return UnknownFeatureError(
        f"{what} has no feature '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}"
    )


def _fitting(value: Any, kind: Callable[[str], Any], what: str) -> Any:
    if kind is str:
        return "" if value is None else str(value)
    if isinstance(kind, type) and value is not None and not isinstance(value, (kind, int) if kind is float else kind):
        raise FeatureValueError(f"{what} does not take {value!r}", fix=f"give a value of type {kind.__name__}")
    return value


_ANNOUNCED = re.compile('(?i:"?sep=(.)"?)\\r?\\n')


def _read(path: Path, types: Mapping[str, Callable[[str], Any]]) -> Table:
    from robosmi.files.files import read_input

    data = read_input(path, "table", inputs.TABLE)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise SourceError("the table is no UTF-8", location=Location(str(path), line), fix="store it as UTF-8") from error
    announced = _ANNOUNCED.match(text)
    text = text[announced.end() :] if announced is not None else text
    first = text.partition("\n")[0]
    delimiter = (
        announced[1] if announced is not None else "\t" if path.suffix.lower() == ".tsv" else max(_DELIMITERS, key=first.count)
    )
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    problems: list[str] = []
    table: Table | None = None
    skipped = int(announced is not None)
    where = 1 + skipped
    try:
        for cells in reader:
            if table is None:
                table = _table(path, cells, types)
            elif cells and len(cells) != len(table.columns):
                problems.append(f"line {where} has {quantity(len(cells), 'cell')} instead of {len(table.columns)}")
            elif cells:
                table.rows.append(table.kind(table, _values(table, cells, where, problems)))
            where = reader.line_num + 1 + skipped
    except csv.Error as error:
        raise SourceError(f"this is no CSV: {error}", location=Location(str(path), where), fix="repair the line") from error
    if table is None:
        raise SourceError("the table has no line with the names of its columns", location=Location(str(path)), fix="add one")
    if problems:
        more = f" ... and {len(problems) - 20} more" if len(problems) > 20 else ""
        raise SourceError("; ".join(problems[:20]) + more, location=Location(str(path)), fix="repair these lines")
    table.delimiter, table.end = delimiter, "\r\n" if first.endswith("\r") else "\n"
    table.announced = announced[0] if announced is not None else ""
    return table


def _table(path: Path, columns: list[str], types: Mapping[str, Callable[[str], Any]]) -> Table:
    names = [column.strip() for column in columns]
    if "" in names or len(set(names)) < len(names) or not all(name.isprintable() for name in names):
        raise SourceError("a column has no name, or that of another", location=Location(str(path), 1), fix="name each column")
    return Table(path.stem, names, types, path)


def _values(table: Table, cells: list[str], line: int, problems: list[str]) -> list[Any]:
    values: list[Any] = []
    for cell, kind, column in zip(cells, table.types, table.columns, strict=True):
        try:
            values.append(cell if kind is str else kind(cell) if cell else None)
        except ValueError:
            problems.append(f"line {line}: '{cell}' does not fit the column {column}")
    return values


def _written(table: Table) -> bytes:
    out = io.StringIO(newline="")
    out.write(table.announced)
    writer = csv.writer(out, delimiter=table.delimiter, lineterminator=table.end)
    writer.writerow(table.columns)
    writer.writerows([["" if value is None else value for value in row._values] for row in table.rows])
    return out.getvalue().encode()


def open_rows(path: Path, name: str | None = None) -> TableModel:
    """Open a CSV file or a folder of them; see `TableModel.load`."""
    return TableModel.load(path, name)
