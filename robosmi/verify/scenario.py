"""Scenarios: what happens to the inputs of a robot over time, as readable TOML files.

    name = "a checkpoint after half a second"
    horizon_ms = 4000

    [signals]
    "QTI left" = [[0, 300], [500, 1700]]                  # [milliseconds, value], by component, port or pin
    DHT22 = { humidity = [[0, 40]], celsius = [[0, 21.5]] }
    console = [[100, "go\\n"]]

`stored = [[32768, 3, 0, 0, 0]]` beside `horizon_ms` has bytes that an earlier run has stored in the board's memory: rows of an
address and the bytes from there on.

The device that plays a value defines what it means. Which components there are, and which device stands for each, is content;
nothing here knows a device.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi import inputs
from robosmi.base.data_text import line_of_error, toml_of
from robosmi.diagnostics import Location
from robosmi.errors import SourceError, did_you_mean
from robosmi.quoting import toml

Points = tuple[tuple[float, Any], ...]
"""A signal over time: pairs of milliseconds and a value that holds from then on."""
LONGEST_MS = 600_000.0
"""The longest scenario: ten minutes of simulated time."""
POINTS = "points"
"""The setting of a device that a signal without further names is."""
LARGEST = 1e12
"""The largest number that a signal takes; infinite ones and those that are none are larger than any."""
KEYS = ("name", "horizon_ms", "stored", "signals")
"""The keys of a scenario."""
_LAST_ADDRESS = 0xFFFF


class Scenario(Struct, frozen=True):
    """What happens to the inputs of a robot.

    Attributes:
        name: what it is called in reports.
        horizon_ms: how long it lasts, in milliseconds of simulated time.
        signals: component, port or pin -> setting of its device (`points` where a signal has no name of its own) -> the signal.
        stored: what the board's memory keeps from an earlier run: rows of an address and the bytes from there on.
        origin: `given` by the user, `stored` with the models, or `generated`.
        path: the file that it was read from, or None.
    """

    name: str
    horizon_ms: float
    signals: Mapping[str, Mapping[str, Points]] = {}
    origin: str = "given"
    path: Path | None = None
    stored: tuple[tuple[int, ...], ...] = ()

    def text(self) -> str:
        """The scenario as the TOML text that `read_scenario` reads."""
        lines = [f"name = {toml(self.name)}", f"horizon_ms = {_plain(self.horizon_ms)}"]
        lines += [f"stored = {[list(row) for row in self.stored]}"] * bool(self.stored)
        lines += ["", "[signals]"]
        for name, settings in self.signals.items():
            told = {setting: "[" + ", ".join(_point(p) for p in points) + "]" for setting, points in settings.items()}
            value = told[POINTS] if [*told] == [POINTS] else "{ " + ", ".join(f"{k} = {v}" for k, v in told.items()) + " }"
            lines.append(f"{toml(name)} = {value}")
        return "\n".join(lines) + "\n"


def read_scenario(path: Path, origin: str = "given") -> Scenario:
    """A scenario's file.

    Args:
        path: the file.
        origin: as `Scenario.origin`.

    Raises:
        SourceError: it cannot be read, or says what means nothing.
    """
    text = ""
    try:
        text = inputs.read_text(path, inputs.SETTINGS)
        data = toml_of(text)
    except (OSError, ValueError) as error:
        why = error.strerror if isinstance(error, OSError) and error.strerror else error
        fix = "give a readable file" if isinstance(error, OSError) else "correct it (TOML 1.0)"
        place = Location(str(path), line_of_error(error, text))
        raise SourceError(f"the scenario cannot be read: {why}", location=place, fix=fix) from error
    for key in data:
        if key not in KEYS:
            raise _wrong(path, f"'{key}' is not a key of a scenario{did_you_mean(key, KEYS)}", f"use: {', '.join(KEYS)}")
    horizon: Any = data.get("horizon_ms")
    if not _is_number(horizon) or not 0 < horizon <= LONGEST_MS:
        told = "horizon_ms, the scenario's duration, is missing" if horizon is None else f"horizon_ms is {horizon!r}"
        raise _wrong(path, told, f"write horizon_ms = 4000: milliseconds, more than 0 and at most {LONGEST_MS:,.0f}")
    name, signals = data.get("name", path.stem), data.get("signals", {})
    if not isinstance(name, str) or not isinstance(signals, dict):
        raise _wrong(path, "'name' must be a text, and 'signals' a table", 'write name = "..." and [signals]')
    read = {
        component: {
            setting: _points(path, f"{component}.{setting}" if isinstance(told, dict) else component, points, horizon)
            for setting, points in (told if isinstance(told, dict) else {POINTS: told}).items()
        }
        for component, told in signals.items()
    }
    return Scenario(name, float(horizon), read, origin, path, _stored(path, data.get("stored", [])))


def _stored(path: Path, rows: Any) -> tuple[tuple[int, ...], ...]:
    def fits(row: Any) -> bool:
        whole = (
            isinstance(row, list) and len(row) > 1 and all(isinstance(each, int) and not isinstance(each, bool) for each in row)
        )
        return whole and 0 <= row[0] <= _LAST_ADDRESS - len(row) + 2 and all(byte in range(256) for byte in row[1:])

    if not isinstance(rows, list) or not all(fits(row) for row in rows):
        raise _wrong(
            path, "'stored' is no list of addresses with bytes", "write rows of an address and bytes: [[32768, 3, 0, 0, 0]]"
        )
    return tuple(tuple(row) for row in rows)


def _points(path: Path, name: str, told: Any, horizon_ms: float) -> Points:
    fix = "write pairs of milliseconds and a value: [[0, 300], [500, 1700]]"
    if not isinstance(told, Sequence) or isinstance(told, str) or not told:
        raise _wrong(path, f"the signal '{name}' is not a list of points", fix)
    points: list[tuple[float, Any]] = []
    for pair in told:
        if not isinstance(pair, list) or len(pair) != 2 or not _is_number(pair[0]) or pair[0] < 0:
            raise _wrong(path, f"the signal '{name}' has {pair!r}, which is not a point", fix)
        if points and pair[0] < points[-1][0]:
            message = f"the signal '{name}' goes back in time, from {points[-1][0]:g} to {pair[0]:g} ms"
            raise _wrong(path, message, "sort its points by time")
        if pair[0] > LONGEST_MS or not _is_possible(pair[1]):
            raise _wrong(path, f"the signal '{name}' has {pair!r}, which is out of range", fix)
        if pair[0] > horizon_ms:
            message = f"the signal '{name}' has {pair!r} after the scenario's end at {horizon_ms:g} ms"
            raise _wrong(path, message, "increase horizon_ms, or remove the point")
        points.append((float(pair[0]), _value(pair[1])))
    return tuple(points)


def _is_possible(value: Any) -> bool:
    """Whether a value is a text, a list, or a number that can be measured."""
    return not isinstance(value, bool) and (not isinstance(value, (int, float)) or abs(value) <= LARGEST)


def _value(told: Any) -> Any:
    """The value of a point; TOML has no null, so the text `none` stands for an absent value."""
    return None if told == "none" else told


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def _point(point: tuple[float, Any]) -> str:
    return f"[{_plain(point[0])}, {_shown(point[1])}]"


def _shown(value: Any) -> str:
    if value is None:
        return '"none"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_shown(each) for each in value) + "]"
    return _plain(value) if _is_number(value) else toml(str(value))


def _plain(number: float) -> str:
    return f"{number:.6f}".rstrip("0").rstrip(".") if isinstance(number, float) else str(number)


def _wrong(path: Path, message: str, fix: str) -> SourceError:
    return SourceError(message, location=Location(str(path)), fix=fix)
