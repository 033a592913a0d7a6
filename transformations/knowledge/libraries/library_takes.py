"""The resources that a library occupies on a board (timers, pins and buses), for hardware checks.

The board's microcontroller (`mcus/<name>.toml`) takes precedence over the target's list for all of them
(`libraries/takes.toml`). A library without an entry has no known resources, which does not mean that it has none. Which pins
lose PWM with a timer is data of the board.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from msgspec import Struct

from robosmi import resources
from robosmi.base.data_text import as_list, as_table, as_texts
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, did_you_mean
from robosmi.metamodels import platform
from robosmi.project import read_data

_KEYS = frozenset(("names", "timers", "pins", "buses", "mcus", "when"))
_LISTS = ("names", "timers", "pins", "buses", "mcus")


class Takes(Struct, frozen=True):
    """The resources that one library occupies.

    Attributes:
        timers: timers of the processor, as the boards' data calls them.
        pins: labels of pins.
        when: under which condition, or empty for always.
    """

    timers: tuple[str, ...] = ()
    pins: tuple[str, ...] = ()
    when: str = ""

    def __str__(self) -> str:
        """The resources as evidence in a plan: one sentence without a full stop."""
        taken = ", ".join((*self.timers, *self.pins))
        return f"uses {taken}{f' when {self.when}' if self.when else ''}"


class _Entry(NamedTuple):
    takes: Takes
    buses: tuple[str, ...]
    mcus: tuple[str, ...]


def library_takes(index: str, board: platform.Board, project: Path | None = None) -> Mapping[str, Takes]:
    """The resources that libraries occupy on a board, by the library's name; empty if none are known.

    Args:
        index: folder in the platform repository of the platform whose index of libraries is used, empty for none.
        board: the board.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: the data are damaged.
    """
    found = taken_of(board, platform.UserKind.library)
    chip = board.microcontroller.name if board.microcontroller is not None else ""
    timers = {timer.name for timer in board.microcontroller.timers} if board.microcontroller is not None else set()
    labels = {pin.label for pin in board.pins}
    for folder in resources.folders("platform_repo", project):
        path = folder / index / "libraries" / "takes.toml"
        if index and path.is_file():
            for name, entries in _read(path, path.stat().st_mtime_ns).items():
                entry = next((e for e in entries if not e.mcus or chip in e.mcus), None)
                if entry is not None and name not in found and timers.issuperset(entry.takes.timers):  # else read elsewhere
                    own = [label for label in entry.takes.pins if label in labels]
                    pins = (*own, *bus_pins(board, entry.buses))
                    found[name] = Takes(entry.takes.timers, pins, entry.takes.when)
            break
    return found


def taken_of(board: platform.Board, kind: platform.UserKind) -> dict[str, Takes]:
    """The resources that functions or libraries occupy on a board, by name, from its microcontroller's data."""
    chip = board.microcontroller
    return {
        use.name: Takes(tuple(use.timers), (*use.pins, *bus_pins(board, use.buses)), use.condition)
        for use in (chip.uses if chip is not None else ())
        if use.userKind is kind
    }


def bus_pins(board: platform.Board, buses: Iterable[str]) -> list[str]:
    """The labels of a board's pins that buses of its microcontroller are on, in the order of the bus's signals."""
    if not (buses := list(buses)):
        return []
    chip = board.microcontroller
    known = {bus.name: list(bus.ports) for bus in (chip.buses if chip is not None else ())}
    labels = {pin.port: pin.label for pin in board.pins}
    return [labels[port] for bus in buses for port in known.get(bus, ()) if port in labels]


@lru_cache(maxsize=4)
def _read(path: Path, mtime_ns: int) -> Mapping[str, list[_Entry]]:
    found: dict[str, list[_Entry]] = {}
    for entry in as_list(read_data(path).get("library", ())):
        try:
            said = as_table(entry)
            lists = {key: tuple(as_texts(said.get(key, ()))) for key in _LISTS}
        except ValueError:
            said, lists = {}, dict.fromkeys(_LISTS, ())
        if not lists["names"] or not set(said) <= _KEYS:
            near = next((told for key in set(said) - _KEYS if (told := did_you_mean(key, _KEYS))), "")
            raise PlatformDataError(
                f"an entry is not a library with its resources: {entry}{near}",
                location=Location(str(path)),
                fix="write names, timers, pins, buses, mcus",
            )
        takes = Takes(lists["timers"], lists["pins"], str(said.get("when", "")))
        for name in lists["names"]:
            found.setdefault(name, []).append(_Entry(takes, lists["buses"], lists["mcus"]))
    return found
