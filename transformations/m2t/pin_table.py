"""Connections as a pin table (CSV or TOML), which `t2m/pin_table` reads: a drawing's wiring for people and for other tools.

One row for each connection; the rows of a component are in the order of its connectors, so that it gets the same names again.
Where nothing is wired, the table says which board it is.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence
from pathlib import Path

from robosmi.errors import UsageError, did_you_mean
from robosmi.metamodels import migration
from robosmi.quoting import csv_cell, toml
from robosmi.transformations.queries.circuits.circuit import pin_label
from robosmi.transformations.queries.circuits.connector_names import displayed_name

_ENDINGS = (".csv", ".toml")
_COLUMNS = ("pin", "part", "role", "title", "connector", "driver", "through", "volts", "rest", "board")
_ASKED_FOR = ("volts", "rest")
"""Columns that a table has only if a row has something there."""


def pin_table(
    connections: Sequence[migration.Connection],
    board: str,
    target: Path,
    rests: Mapping[str, str],
    volts: Mapping[str, float],
) -> str:
    """The text of the table.

    Args:
        connections: of one board.
        board: short name of the board, or empty where the platform repository does not know it.
        target: the file it is for, whose ending says which form it has.
        rests: identity of a component -> the level at which it does nothing, where its name alone tells another.
        volts: identity of a component -> the voltage that feeds it, where it is known.

    Raises:
        UsageError: the ending is neither `.csv` nor `.toml`.
    """
    ending = target.suffix.lower()
    if ending not in _ENDINGS:
        raise UsageError(
            f"a pin table cannot be a '{target.suffix or target.name}' file{did_you_mean(ending, _ENDINGS)}",
            fix=f"use one of the endings: {', '.join(_ENDINGS)}",
        )
    rows = [_row(connection, rests, volts) for connection in sorted(connections, key=_place)]
    return _csv(rows, board) if ending == ".csv" else _toml(rows, board)


def _place(connection: migration.Connection) -> tuple[int, int]:
    component = connection.component
    if component is None or component.circuit is None:
        return 0, 0
    order = {connector: number for number, connector in enumerate(component.connectors)}
    numbers = [order[c] for c in connection.connectors if c in order]
    return list(component.circuit.components).index(component), min(numbers, default=0)


def _row(connection: migration.Connection, rests: Mapping[str, str], volts: Mapping[str, float]) -> dict[str, str]:
    component = connection.component
    fed = volts.get(str(component.elementId)) if component else None
    return {
        "pin": pin_label(connection),
        "part": (component.partTitle or component.title or component.partId) if component else "",
        "role": component.role.name if component else "",
        "title": (component.title or f"#{component.elementId}") if component else "",
        "connector": " ".join(displayed_name(connection.connectors[0]).split()) if connection.connectors else "",
        "driver": "true" if component and component.driver else "",
        "through": "; ".join((part.title or part.partTitle).replace(";", ",") for part in connection.via),
        "volts": f"{fed:g}" if fed is not None else "",
        "rest": rests.get(component.elementId, "") if component else "",
    }


def _csv(rows: Sequence[dict[str, str]], board: str) -> str:
    stream = io.StringIO()
    columns = [column for column in _COLUMNS if column not in _ASKED_FOR or any(row[column] for row in rows)]
    writer = csv.DictWriter(stream, columns, lineterminator="\n")
    writer.writeheader()
    if board and not rows:
        rows = [dict.fromkeys(columns, "")]
    writer.writerows(
        {key: csv_cell(" ".join(value.split())) for key, value in (row | {"board": board}).items() if key in columns}
        for row in rows
    )
    return stream.getvalue()


def _toml(rows: Sequence[dict[str, str]], board: str) -> str:
    lines = [f"board = {toml(board)}"] if board else []
    if not rows:
        lines.append("pin = []")
    for row in rows:
        lines += ["", "[[pin]]"]
        lines += [f"{key} = {'true' if key == 'driver' else toml(value)}" for key, value in row.items() if value]
    return "\n".join(lines).lstrip("\n") + "\n"
