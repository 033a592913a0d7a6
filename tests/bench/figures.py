"""Measured figures with their bounds, and the table in which `python -m tests.bench` shows them."""

from __future__ import annotations

import traceback
from collections.abc import Iterable
from importlib import import_module

from msgspec import Struct

from robosmi.errors import MissingToolError


class Figure(Struct, frozen=True):
    """A measured figure.

    Attributes:
        name: what was measured.
        measured: its value; None if it could not be measured here.
        unit: its unit, such as `ms`; `x` for a ratio.
        bound: the greatest allowed value; None if there is none.
        at_least: whether the bound is the least allowed value instead.
        note: how it was measured, or why it could not be.
    """

    name: str
    measured: float | None
    unit: str = ""
    bound: float | None = None
    at_least: bool = False
    note: str = ""

    @property
    def ok(self) -> bool:
        """Whether the figure keeps its bound; one that could not be measured breaks none."""
        if self.measured is None or self.bound is None:
            return True
        return self.measured >= self.bound if self.at_least else self.measured <= self.bound


def not_measured(name: str, reason: str) -> Figure:
    """A figure that cannot be measured on this machine.

    Args:
        name: what would have been measured.
        reason: what is missing, and how to get it.
    """
    return Figure(name, None, note=reason)


def table(figures: Iterable[Figure]) -> str:
    """The figures as a table: name, measured value, bound, whether it is kept, note."""
    rows = [("figure", "measured", "bound", "ok", "note")]
    for figure in figures:
        sign = "" if figure.bound is None else ">= " if figure.at_least else "<= "
        state = "-" if figure.measured is None or figure.bound is None else "ok" if figure.ok else "NO"
        rows.append(
            (figure.name, _value(figure.measured, figure.unit), sign + _value(figure.bound, figure.unit), state, figure.note)
        )
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    lines = [
        f"{name:{widths[0]}}  {measured:>{widths[1]}}  {bound:>{widths[2]}}  {ok:{widths[3]}}  {note}".rstrip()
        for name, measured, bound, ok, note in rows
    ]
    return "\n".join([lines[0], "-" * max(map(len, lines)), *lines[1:]])


def _value(value: float | None, unit: str) -> str:
    if value is None:
        return ""
    text = f"{value:,.0f}" if value == int(value) or abs(value) >= 100 else f"{value:.2f}" if abs(value) < 10 else f"{value:.1f}"
    return f"{text} {unit}".rstrip()


def measured(name: str) -> tuple[list[Figure], str]:
    """The figures of a module, and the error that ended measuring, empty if there was none."""
    found: list[Figure] = []
    try:
        for figure in import_module(f"tests.bench.{name}").figures():
            found.append(figure)
            print(f"  {table([figure]).splitlines()[-1]}", flush=True)
    except MissingToolError as error:
        found.append(not_measured(name, " ".join(str(error).split())))
    except Exception:
        return found, traceback.format_exc()
    return found, ""
