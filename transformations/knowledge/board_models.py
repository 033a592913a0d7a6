"""Boards and microcontrollers of the platform repository as elements of `platform.ecore`.

A board is hardware: `boards/<name>.toml` has its pins, `mcus/<name>.toml` the microcontroller. How a platform calls a board and
its pins is a mapping, `<platform>/boards/<name>.toml`; a mapping that has pins of its own is hardware and mapping in one file.
How drawing tools draw a board is read in `boards`; targets are put together in `target_platform`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

from robosmi import inputs
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.metamodels import platform
from robosmi.project import read_data
from robosmi.resources import folders
from robosmi.verify.tables import DataTable

KIND = "platform_repo"
_HAS_PINS = re.compile(r"^pins\b", re.MULTILINE)


def board_names(project: Path | None = None) -> list[str]:
    """The short names of all boards, sorted."""
    return sorted({path.stem for path in hardware_files(project)})


def board_file(name: str, project: Path | None = None) -> Path | None:
    """The file of a board's hardware, the first in search order, or None."""
    return next((path for path in hardware_files(project) if path.stem == name), None)


def load_board(name: str, project: Path | None = None) -> platform.Board:
    """A new model of a board with its pins, in the order of their numbers, and its microcontroller.

    Args:
        name: short name (`uno`).
        project: the project folder; the current folder if None.

    Raises:
        UsageError: no board has that name.
        PlatformDataError: the entry, or that of its microcontroller, is damaged.
    """
    path = board_file(name, project)
    if path is None:
        known = board_names(project)
        raise UsageError(f"no board is called '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}")
    table = table_of(path)
    pins = [_pin(entry) for entry in table.tables("pins")]
    labels = [pin.label for pin in pins]
    if twice := {label for label in labels if labels.count(label) > 1}:
        raise table.error("pins", f"has {', '.join(sorted(twice))} twice")
    if (led := table.text("led", "")) and led not in labels:
        raise table.error("led", f"is '{led}', which is no pin of this board{did_you_mean(led, labels)}")
    return platform.Board(
        name=path.stem,
        title=table.text("title", path.stem),
        microcontroller=load_microcontroller(table.text("mcu"), project, table),
        clockHertz=table.number("f_cpu"),
        volts=table.decimal("volts"),
        led=led,
        pins=pins,
    )


def _pin(entry: DataTable) -> platform.Pin:
    return platform.Pin(
        label=entry.text("label"),
        port=entry.text("port", ""),
        aliases=list(entry.texts("aliases", ())),
        abilities=list(entry.texts("abilities", ())),
        timer=entry.text("timer", ""),
        channel=entry.text("channel", ""),
        reserved=entry.text("reserved", ""),
    )


def load_microcontroller(name: str, project: Path | None = None, named_in: DataTable | None = None) -> platform.Microcontroller:
    """A new model of a microcontroller.

    Args:
        name: as the compiler takes it (`atmega328p`).
        project: the project folder; the current folder if None.
        named_in: the table that names it under `mcu`, for the error.

    Raises:
        PlatformDataError: nothing is known of it, or its entry is damaged.
    """
    path = next((file for folder in folders(KIND, project) if (file := folder / "mcus" / f"{name}.toml").is_file()), None)
    if path is None:
        known = sorted({file.stem for folder in folders(KIND, project) for file in (folder / "mcus").glob("*.toml")})
        problem = f"is '{name}', a microcontroller of which nothing is known{did_you_mean(name, known)}"
        raise named_in.error("mcu", problem) if named_in is not None else PlatformDataError(f"'mcu' {problem}")
    table = table_of(path)
    buses = table.table("buses") if "buses" in table.values else DataTable(path, {})
    uses = []
    for entry in table.tables("takes", needed=False):
        for kind, key in ((platform.UserKind.function, "functions"), (platform.UserKind.library, "libraries")):
            uses += [
                platform.ResourceUse(
                    name=user,
                    userKind=kind,
                    timers=list(entry.texts("timers", ())),
                    pins=list(entry.texts("pins", ())),
                    buses=list(entry.texts("buses", ())),
                    condition=entry.text("when", ""),
                )
                for user in entry.texts(key, ())
            ]
    return platform.Microcontroller(
        name=name,
        title=table.text("title", name),
        architecture=table.text("architecture"),
        flashBytes=table.number("flash_bytes"),
        ramBytes=table.number("ram_bytes"),
        pinMilliamperes=table.optional_number("pin_ma") or 0,
        totalMilliamperes=table.optional_number("total_ma") or 0,
        timers=[platform.Timer(name=t.text("name"), bits=t.number("bits")) for t in table.tables("timers")],
        buses=[
            platform.PinBus(name=bus, signals=list(lines.values), ports=[lines.text(signal) for signal in lines.values])
            for bus in buses.values
            if (lines := buses.table(bus))
        ],
        uses=uses,
    )


def mapping_file(platform_name: str, board: str, project: Path | None = None) -> Path | None:
    """The file with a platform's mapping of a board, the first in search order, or None."""
    places = (folder / platform_name / "boards" / f"{board}.toml" for folder in folders(KIND, project))
    return next((path for path in places if path.is_file()), None)


def load_mapping(platform_name: str, board: platform.Board, project: Path | None = None) -> platform.BoardMapping:
    """How a platform calls a board and its pins.

    A platform without a file for the board calls its pins by `pin_literals` of its `platform.toml`, and the board not at all.

    Args:
        platform_name: folder of the platform in the repository.
        board: the board; the mapping refers to it and to its pins.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a file is damaged.
    """
    path = mapping_file(platform_name, board.name, project)
    table = table_of(path) if path is not None else None
    chip = board.microcontroller
    literals = table.table("literals").values if table is not None and "literals" in table.values else {}
    interrupts = table.table("interrupts").values if table is not None and "interrupts" in table.values else {}
    labels = [pin.label for pin in board.pins]
    for key, values in (("literals", literals), ("interrupts", interrupts)):
        for label in values:
            if table is not None and label not in labels:
                raise table.error(f"{key}.{label}", f"is no pin of this board{did_you_mean(label, labels)}")
    rules = _literal_rules(platform_name, project)
    return platform.BoardMapping(
        board=board,
        boardId=table.text("fqbn", "") if table is not None else "",
        otherIds=list(table.texts("fqbn_also", ())) if table is not None else [],
        variant=table.text("variant", "") if table is not None else "",
        define=table.text("define", "") if table is not None else "",
        extraFlags=list(table.texts("extra_flags", ())) if table is not None else [],
        flashBytes=table.number("flash_bytes") if table is not None else chip.flashBytes if chip is not None else 0,
        ramBytes=table.number("ram_bytes") if table is not None else chip.ramBytes if chip is not None else 0,
        pinNames=[
            platform.PinName(
                pin=pin, literal=str(literals.get(pin.label) or _literal(pin, rules)), interrupt=interrupts.get(pin.label, -1)
            )
            for pin in board.pins
        ],
    )


def _literal_rules(platform_name: str, project: Path | None) -> list[DataTable]:
    for folder in folders(KIND, project):
        if (path := folder / platform_name / "platform.toml").is_file():
            return table_of(path).tables("pin_literals", needed=False)
    return []


def _literal(pin: platform.Pin, rules: list[DataTable]) -> str:
    """How a program writes a pin: by the first rule whose pattern fits its label or its port, else by its label."""
    for rule in rules:
        key = "port" if "port" in rule.values else "label"
        if match := re.fullmatch(rule.text(key), getattr(pin, key)):
            return match.expand(rule.text("literal"))
    return str(pin.label)


def mapped_boards(platform_name: str, project: Path | None = None) -> list[str]:
    """The boards that a platform maps, sorted: those of its folder `boards`, or those of its `architectures` where it names some.

    Raises:
        PlatformDataError: a file is damaged.
    """
    names: set[str] = set()
    architectures: set[str] = set()
    for folder in folders(KIND, project):
        names |= {path.stem for path in (folder / platform_name / "boards").glob("*.toml")}
        if (path := folder / platform_name / "platform.toml").is_file():
            architectures |= set(table_of(path).texts("board_architectures", ()))
    if architectures:
        chips = {
            path.stem
            for folder in folders(KIND, project)
            for path in (folder / "mcus").glob("*.toml")
            if table_of(path).text("architecture") in architectures
        }
        names |= {path.stem for path in hardware_files(project) if table_of(path).text("mcu", "") in chips}
    return sorted(names)


def hardware_files(project: Path | None = None) -> Iterator[Path]:
    """The files of boards with their pins, in search order; a name may come again, the first counts."""
    for folder in folders(KIND, project):
        if (place := folder / "boards").is_dir():
            yield from _listed(str(place), place.stat().st_mtime_ns)
        for own in sorted(entry.path for entry in os.scandir(folder) if entry.is_dir()):
            if os.path.isdir(boards := f"{own}/boards"):
                yield from (p for p in _listed(boards, os.stat(boards).st_mtime_ns) if _HAS_PINS.search(text_of(p)))


@cache
def _listed(folder: str, changed: int) -> tuple[Path, ...]:  # `changed` keys the cache: a file more or less is noticed
    return tuple(sorted(Path(folder).glob("*.toml")))


def text_of(path: Path) -> str:
    """The text of a file of the repository, read once as long as it does not change.

    Raises:
        PlatformDataError: it cannot be read.
    """
    return _text(str(path), path.stat().st_mtime_ns)


@cache
def _text(path: str, changed: int) -> str:
    try:
        return inputs.read_text(path, inputs.SETTINGS)
    except (OSError, UnicodeDecodeError) as error:
        raise PlatformDataError(f"cannot be read: {error}", location=Location(path), fix="mend or remove the file") from error


def table_of(path: Path) -> DataTable:
    """The table of a file of the repository, read once as long as it does not change.

    Raises:
        PlatformDataError: it is no TOML.
    """
    return _table(str(path), path.stat().st_mtime_ns)


@cache
def _table(path: str, changed: int) -> DataTable:
    return DataTable(Path(path), read_data(Path(path)))
