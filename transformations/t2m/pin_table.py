"""Reads pin tables: a CSV or TOML file that says which part is on which pin, for users without a drawing.

A row has a pin and a part; it may have a role, a title, a connector, `driver`, and the passive parts that the signal goes
through. Rows with one title are one component with several connectors, in the order of the rows; a row without a title is a
component by itself. The result is a circuit like that of a drawing, so that all later steps are the same.
docs/reference/pin-tables.md lists the columns; `m2t/pin_table` writes such files.
"""

from __future__ import annotations

import csv
import hashlib
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import line_of_error, toml_of
from robosmi.base.quantities import quantity
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, TooLargeError, did_you_mean
from robosmi.metamodels import hardware, platform
from robosmi.model.elements.strict import enum_literal
from robosmi.project import default_text, project_of
from robosmi.quoting import csv_text
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.drawn_boards import PIN_TABLE, normalised_label
from robosmi.transformations.knowledge.electrical_facts import REST
from robosmi.transformations.knowledge.part import GIVEN, ROLES, Part
from robosmi.transformations.knowledge.part_names import PartNames, connector_kind, names, passive_named
from robosmi.transformations.knowledge.part_roles import classify
from robosmi.transformations.knowledge.platforms.board_pins import pins_by_name
from robosmi.transformations.knowledge.platforms.target_platform import target_facts
from robosmi.transformations.t2m.given_roles import given_roles

COLUMNS = ("pin", "part", "role", "title", "connector", "driver", "through", "volts", "rest", "board")
"""The columns; the first two must be there."""

MOST_THROUGH = 100
"""Passive parts that a signal may go through one after another; drawings have one or two."""

MOST_PARTS = 2_000
"""Parts that a table may have: each is looked up in tables of parts, and by some commands in the index of libraries."""

_FIX = "see docs/reference/pin-tables.md for the columns"
_NO_PIN = "pin = []"
"""The first line of a TOML table that has no rows."""
_SILENT = ("Board", "Power", "Passive", "Decoration")
"""Roles of parts that no program uses; a part on a pin never gets one of them by its name alone."""
_SUPPLY = "VIN"
"""Name of the connector that a table feeds: whether the part has a regulator behind it, a table does not say."""
_VOLTS = re.compile(r"[0-9]{1,2}(?:\.[0-9]{1,2})?")
_TRUE, _FALSE = ("true", "yes", "1", "x"), ("", "false", "no", "0")


class _Row(Struct, frozen=True):
    line: int
    cells: Mapping[str, str]

    def __getitem__(self, column: str) -> str:
        return self.cells.get(column, "")


def recognises(head: bytes) -> bool:
    """Whether a file that begins so is a pin table: a head with the columns `pin` and `part`, or `[[pin]]` in TOML.

    Args:
        head: the first bytes of the file.
    """
    lines = [
        line.strip() for line in head.decode("utf-8-sig", "replace").splitlines() if line.strip() and not line.startswith("#")
    ]
    if "[[pin]]" in lines or _NO_PIN in lines:
        return True
    if lines and lines[0].lower().lstrip('"').startswith("sep="):
        lines = lines[1:]
    return bool(lines) and {*COLUMNS[:2]} <= {cell.strip().lower() for cell in re.split("[,;\t]", lines[0])}


def read_circuit(
    path: str | Path, project: Path | None = None, roles: Mapping[str, str] | None = None, board: str | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read a pin table.

    Args:
        path: a `.csv` or `.toml` file.
        project: the project folder, whose own data on parts and boards takes precedence; the current folder if None.
        roles: roles that the user gives to components, by title or `#number`; they take precedence.
        board: short name of the board where the table names none; that of the default target if None.

    Returns:
        The circuit, and a finding for each part whose role nothing tells (RS203), or where the table has no row (RS212).

    Raises:
        SourceError: the file is missing, no table, or a row has no pin or no part (one with a board alone says which it is).
        UsageError: a role, component or board does not exist.
    """
    file = Path(path)
    data = _bytes_of(file)
    name, rows = _rows(file, data)
    model = load_board(name or board or _default_board(file), project)
    table = _Table(str(path), model, names(project), project)
    for row in rows:
        table.add(row)
    if not rows:
        cause = "no pin is wired: the table has no row"
        table.findings.append(
            Finding("RS212", Severity.warning, cause, Location(str(path)), fix="write a row for each wired pin")
        )
    table.given = given_roles(roles or {}, {"1": model.title} | {c: title for c, title, _ in table.components()})
    circuit = table.circuit(file.stem)
    circuit.digest = hashlib.sha256(data).hexdigest()
    return circuit, table.findings


class _Group(Struct, frozen=True):
    """Connectors that are wired together.

    Attributes:
        name: the net's name: the board, the pin and the parts on the way.
        connectors: the connectors.
        beyond: what is wired to the other side of a passive part on the way, by the part's title.
    """

    name: str
    connectors: list[hardware.Connector]
    beyond: dict[str, _Group] = {}


class _Table:
    """Collects the rows of a table and makes the model of them."""

    def __init__(self, path: str, board: platform.Board, known: PartNames, project: Path | None) -> None:
        self.path = path
        self.board = board
        self.names = known
        self.project = project
        self.labels = {pin.label.removeprefix("D").lower(): pin.label for pin in board.pins}
        self.labels |= {name.lower(): pin.label for name, pin in pins_by_name(board).items()}
        self.rows: dict[str, list[_Row]] = {}
        self.numbers: Counter[str] = Counter()
        self.given: dict[str, str] = {}
        self.findings: list[Finding] = []
        self.found: list[_Group] = []
        self.supplies: dict[str, list[hardware.Connector]] = {}

    def add(self, row: _Row) -> None:
        for column in ("pin", "part"):
            if not row[column]:
                raise self._error(row, f"a row has no {column}", f"give each row a {column}")
        if row["role"] and row["role"] not in ROLES:
            raise self._error(row, f"'{row['role']}' is no role{did_you_mean(row['role'], ROLES)}", f"use: {', '.join(ROLES)}")
        if row["rest"] not in ("", "low", "high"):
            raise self._error(row, f"rest is '{row['rest']}'", "write low or high")
        if row["volts"] and not _VOLTS.fullmatch(row["volts"]):
            raise self._error(row, f"volts is '{row['volts']}'", "write the voltage of the part's supply, such as 5 or 3.3")
        if row["driver"].lower() not in (*_TRUE, *_FALSE):
            raise self._error(row, f"driver is '{row['driver']}'", "write true or false")
        title = row["title"] or row["part"]
        if not row["title"]:  # a component by itself, with a title that no other has
            while title in self.rows:
                number = self.numbers[row["part"]] = max(2, self.numbers[row["part"]] + 1)
                title = f"{row['part']} {number}"
        self.rows.setdefault(title, []).append(row)
        self._count(row, len(self.rows))

    def components(self) -> Iterator[tuple[str, str, list[_Row]]]:
        """Identity, title and rows of each component, in the table's order; 1 is the board."""
        yield from ((str(number), title, rows) for number, (title, rows) in enumerate(self.rows.items(), 2))

    def circuit(self, name: str) -> hardware.Circuit:
        groups: dict[str, _Group] = {}
        parts = [self._board(groups)]
        passives: list[hardware.Component] = []
        for identity, title, rows in self.components():
            parts.append(self._component(identity, title, rows, groups, passives))
        parts += passives
        nets = [hardware.Net(name=group.name, connectors=group.connectors) for group in self.found if group.connectors]
        nets += [
            hardware.Net(name=f"{volts}V", rail=True, railEvidence="given in the table", voltage=f"{volts}V", connectors=fed)
            for volts, fed in self.supplies.items()
        ]
        return hardware.Circuit(name=name, path=self.path, tool=PIN_TABLE, view="", components=parts, nets=nets)

    def _board(self, groups: dict[str, _Group]) -> hardware.Component:
        used = {self._label(row): None for rows in self.rows.values() for row in rows}
        connectors = []
        for label in [pin.label for pin in self.board.pins] + [u for u in used if u not in self.labels.values()]:
            connector = hardware.Connector(connectorId=label, name=label, kind=hardware.ConnectorKind.signal, pin=label)
            connectors.append(connector)
            if label in used:
                groups[label] = self._group(f"1.{label}", connector)
        return hardware.Component(
            elementId="1",
            title=self.board.title,
            partId=self.board.name,
            boardName=self.board.name,
            partTitle=self.board.title,
            role=hardware.Role.Board,
            roleEvidence="the table's board",
            connectors=connectors,
        )

    def _component(
        self,
        identity: str,
        title: str,
        rows: Sequence[_Row],
        groups: dict[str, _Group],
        passives: list[hardware.Component],
    ) -> hardware.Component:
        part = self._role(identity, title, rows)
        rest = next((row["rest"] for row in rows if row["rest"]), "")
        connectors = []
        for number, row in enumerate(rows, 1):
            name = row["connector"]
            kind = enum_literal(hardware.ConnectorKind, connector_kind(name, self.names) if name else "signal")
            connector = hardware.Connector(connectorId=str(number), name=name, kind=kind)
            connectors.append(connector)
            self._through(row, groups, passives).connectors.append(connector)
        if volts := next((row["volts"] for row in rows if row["volts"]), ""):
            connectors.append(hardware.Connector(connectorId="supply", name=_SUPPLY, kind=hardware.ConnectorKind.supply))
            self.supplies.setdefault(volts, []).append(connectors[-1])
        return hardware.Component(
            elementId=identity,
            title=title,
            partTitle=part.title,
            role=enum_literal(hardware.Role, part.role),
            roleEvidence=part.evidence,
            driver=part.driver,
            properties=[hardware.Property(name=REST, value=rest)] if rest else [],
            connectors=connectors,
        )

    def _role(self, identity: str, title: str, rows: Sequence[_Row]) -> Part:
        given = self.given.get(identity)
        told = given or next((row["role"] for row in rows if row["role"]), "")
        found = classify(Part("", title=rows[0]["part"]), self.project)
        driver = any(row["driver"].lower() in _TRUE for row in rows)
        if told:
            why = GIVEN if given else "given in the table"
            if not any(row["driver"] for row in rows):
                driver = found.driver and found.role == told
            return Part("", found.title, role=told, evidence=why, driver=driver)
        unclear = f"no rule fits the part '{rows[0]['part']}'"
        if found.role in _SILENT and any(self._label(row) in self.labels.values() for row in rows):
            unclear = f"the part '{rows[0]['part']}' has the role {found.role} by its name, but a pin is wired to it"
            found = Part("", found.title, role="Unknown", evidence=unclear)
        if found.role == "Unknown":
            self.findings.append(
                Finding(
                    "RS203",
                    Severity.warning,
                    f"the role of '{title}' is unknown: {unclear}",
                    Location(self.path, rows[0].line),
                    fix="give its role in the table or in robosmi.toml under [roles]",
                )
            )
        return Part("", found.title, role=found.role, evidence=found.evidence, driver=found.driver or driver)

    def _through(
        self,
        row: _Row,
        groups: dict[str, _Group],
        passives: list[hardware.Component],
    ) -> _Group:
        """Add the passive parts that a row's signal goes through; returns the connectors behind them."""
        group = groups[self._label(row)]
        titles = [title for piece in row["through"].split(";") if (title := piece.strip())]
        if len(titles) > MOST_THROUGH:
            raise self._error(
                row, f"the signal goes through {len(titles)} parts one after another", f"name {MOST_THROUGH} parts at most"
            )
        for title in titles:
            if title not in group.beyond:
                near, far = (hardware.Connector(connectorId=end, kind=hardware.ConnectorKind.unknown) for end in ("1", "2"))
                part = hardware.Component(
                    elementId=str(2 + len(self.rows) + len(passives)),
                    title=title,
                    partTitle=passive_named(title, self.names),
                    role=hardware.Role.Passive,
                    roleEvidence="the signal goes through it, by the table",
                    connectors=[near, far],
                )
                passives.append(part)
                self._count(row, len(self.rows) + len(passives))
                group.connectors.append(near)
                group.beyond[title] = self._group(f"{group.name}.{title}", far)
            group = group.beyond[title]
        return group

    def _group(self, name: str, connector: hardware.Connector) -> _Group:
        self.found.append(group := _Group(name, [connector]))
        return group

    def _count(self, row: _Row, parts: int) -> None:
        if parts > MOST_PARTS:
            raise TooLargeError(
                f"the table has more than {MOST_PARTS:,} parts",
                location=Location(self.path, row.line),
                fix="leave out what the program does not use",
            )

    def _label(self, row: _Row) -> str:
        return self.labels.get(row["pin"].lower()) or normalised_label(row["pin"]) or row["pin"]

    def _error(self, row: _Row, cause: str, fix: str) -> SourceError:
        return SourceError(cause, location=Location(self.path, row.line), fix=fix)


def _default_board(table: Path) -> str:
    return target_facts(project_of(table).target or default_text("migrate", "target")).board


def _bytes_of(path: Path) -> bytes:
    place = Location(str(path))
    try:
        data = inputs.read_bytes(path, inputs.SETTINGS)
    except OSError as error:
        fix = inputs.fix_of(error, "check the name of the table")
        raise SourceError(f"it cannot be read: {error.strerror}", location=place, fix=fix) from error
    if not data.strip():
        raise SourceError("the file is empty", location=place, fix=_FIX)
    return data


def _rows(path: Path, data: bytes) -> tuple[str, list[_Row]]:
    """The board's name, empty if none is given, and the rows."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SourceError("it is not UTF-8", location=Location(str(path)), fix="save it as UTF-8") from error
    return _toml_rows(path, text) if path.suffix.lower() == ".toml" else _csv_rows(path, text)


_ANNOUNCED = re.compile(r"""(?i:\s*"?sep=(.)"?[,;\t]*+)\s*""")
"""Matches the line with which Excel says what separates the cells."""
_CELL = r'(?:"[^"]*+(?:""[^"]*+)*+"(?:[^",;\t][^,;\t]*)?|[^",;\t][^,;\t]*|)'
_CLOSED = re.compile(rf"{_CELL}(?:[,;\t]{_CELL})*")
"""Matches a line at whose end no quoted cell is open."""


def _records(text: str) -> list[tuple[int, str]]:
    """The rows with the number of their first line; a cell between quotation marks may go over several lines."""
    found: list[tuple[int, str]] = []
    parts: list[str] = []
    begun = 0
    for number, line in enumerate(text.splitlines(keepends=True), 1):
        if not parts and (not line.strip() or line.startswith("#")):
            continue
        begun = begun if parts else number
        parts.append(line)
        if not _CLOSED.fullmatch(('"' if len(parts) > 1 else "") + line.rstrip("\r\n")):
            continue
        found.append((begun, "".join(parts).rstrip("\r\n")))
        parts = []
    return [*found, *([(begun, "".join(parts))] if parts else [])]


def _csv_rows(path: Path, text: str) -> tuple[str, list[_Row]]:
    lines = _records(text)
    announced = _ANNOUNCED.fullmatch(lines[0][1]) if lines else None
    lines = lines[1:] if announced is not None else lines
    sample = lines[0][1] if lines else ""
    separator = announced[1] if announced is not None else max(",;\t", key=sample.count)
    header = [cell.strip().lower() for cell in next(csv.reader([sample], delimiter=separator), [])]
    _check_columns(header, Location(str(path), lines[0][0] if lines else 1))
    rows: list[_Row] = []
    for number, line in lines[1:]:
        try:
            cells = next(csv.reader(line.splitlines(keepends=True), delimiter=separator, strict=True))
        except csv.Error as error:
            raise SourceError(f"not valid CSV: {error}", location=Location(str(path), number), fix=_FIX) from error
        if len(cells) > len(header):
            raise SourceError(
                f"a row has {quantity(len(cells), 'cell')}, but the header has {len(header)}",
                location=Location(str(path), number),
                fix="put cells that contain a comma in quotes",
            )
        rows.append(_Row(number, dict(zip(header, (csv_text(cell.strip()) for cell in cells), strict=False))))
    boards = list(dict.fromkeys(row["board"] for row in rows if row["board"]))
    if len(boards) > 1:
        raise SourceError(f"the rows name {len(boards)} boards", location=Location(str(path)), fix="use one table per board")
    return boards[0] if boards else "", [row for row in rows if any(row[column] for column in COLUMNS if column != "board")]


def _toml_rows(path: Path, text: str) -> tuple[str, list[_Row]]:
    try:
        table: dict[str, Any] = toml_of(text)
    except ValueError as error:
        place = Location(str(path), line_of_error(error, text))
        raise SourceError(f"not valid TOML: {error}", location=place, fix=_FIX) from error
    if not {"pin", "board"} & table.keys():
        raise SourceError("the table has no row", location=Location(str(path)), fix=_FIX)
    entries = table.get("pin", [])
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        raise SourceError("'pin' is not a list of tables", location=Location(str(path)), fix="write each row as [[pin]]")
    for entry in entries:
        _check_columns([*entry], Location(str(path)))
    heads = [number for number, line in enumerate(text.splitlines(), 1) if line.strip() == "[[pin]]"]
    places = heads if len(heads) == len(entries) else [1] * len(entries)
    board = table.get("board", "")
    if not isinstance(board, str):
        raise SourceError("'board' is not a text", location=Location(str(path)), fix='write board = "uno"')
    return board, [_Row(place, {k: _cell(v) for k, v in e.items()}) for place, e in zip(places, entries, strict=True)]


def _cell(value: object) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value).strip()


def _check_columns(columns: Sequence[str], place: Location) -> None:
    for column in columns:
        if column not in COLUMNS:
            raise SourceError(f"unknown column '{column}'{did_you_mean(column, COLUMNS)}", location=place, fix=_FIX)
    for column in COLUMNS[:2]:
        if column not in columns:
            raise SourceError(f"the column '{column}' is missing", location=place, fix=_FIX)
