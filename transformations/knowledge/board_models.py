"""Boards and microcontrollers of the platform repository as elements of `platform.ecore`.

A board is hardware: `boards/<name>.toml` has its pins, `mcus/<name>.toml` the microcontroller. How a platform calls a board and
its pins is a mapping, `<platform>/boards/<name>.toml`; a mapping that has pins of its own is hardware and mapping in one file.
The ports that a file gives its pins must exist on the microcontroller (key `ports` of its file). How drawing tools draw a board
is read in `drawn_boards`; targets are put together in `target_platform`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from robosmi import inputs
from robosmi.base.data_tables import DataTable
from robosmi.base.data_text import line_of_value
from robosmi.diagnostics import Location
from robosmi.errors import PlatformDataError, UsageError, did_you_mean
from robosmi.metamodels import platform
from robosmi.project import read_data
from robosmi.resources import folders
from robosmi.transformations.knowledge.data_keys import (
    OF_CORES,
    OF_MICROCONTROLLERS,
    TAKES,
    check_complete,
    check_core,
    check_numbers,
)

KIND = "platform_repo"
_HAS_PINS = re.compile(r"^\s*(?:pins\b|\[\[pins\]\])", re.MULTILINE)
_IS_DRAWN = re.compile(r"^\s*\[\[drawn_as\]\]", re.MULTILINE)
ABILITIES = ("digital", "pwm", "analog_in", "interrupt", "uart", "i2c", "spi")
"""What a pin may be able to do, as boards' files say it."""
CHANNELS = ("A", "B", "C", "D")  # compare outputs of a timer
_PIN_KEYS = (
    "label", "port", "aliases", "abilities", "timer", "channel", "reserved", "bears_volts", "interrupt_line", "driven_by_core",
)  # fmt: skip
_USERS = {"functions": platform.UserKind.function, "libraries": platform.UserKind.library, "parts": platform.UserKind.part}
"""What takes resources of a microcontroller, by the key that names it."""
SIGNALS = {"spi": ("MOSI", "MISO", "SCK", "SS"), "i2c": ("SDA", "SCL"), "uart": ("RX", "TX")}
"""The buses of `[buses]` and their signals."""
_MOST_VOLTS = 6.0
"""No pin of a microcontroller gives or bears more."""
_BOARD_KEYS = (
    "name",
    "title",
    "mcu",
    "f_cpu",
    "volts",
    "led",
    "boot_loader",
    "pins",
    "buses",
    "not_simulated",
    "drawn_as",
    "drawn_chips",
    "drawn_symbols",
)
_DRAWN_KEYS = {
    "drawn_as": ("tool", "modules", "connectors", "names"),
    "drawn_chips": ("chips", "least_pins", "most_pins"),
    "drawn_symbols": ("called", "not"),
}
_BOOT_LOADER_KEYS = ("programmer", "bauds", "bytes", "touch_baud", "tool")
_MAPPING_KEYS = (
    "fqbn", "fqbn_also", "platformio", "variant", "define", "extra_flags", "flash_bytes", "ram_bytes", "core", "numbers",
    "interrupts", "literals",
)  # fmt: skip


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
        raise UsageError(f"unknown board '{name}'{did_you_mean(name, known)}", fix=f"use one of: {', '.join(known)}")
    table = table_of(path)
    check_keys(table, (*_BOARD_KEYS, *_MAPPING_KEYS))
    chip = load_microcontroller(table.text("mcu"), project, table)
    timers = [str(timer.name) for timer in chip.timers]
    chip_file = _chip_file(str(chip.name), project)
    shared = chip_file is not None and table_of(chip_file).flag("shared_channels", False)
    pins = [_pin(entry, timers, shared) for entry in table.tables("pins")]
    if chip_file is not None:
        check_ports(pins, text_of(path), table, table_of(chip_file))
    check_names(pins, table, shared)
    if "buses" in table.values:  # the core may have them at other pins than those of the microcontroller's file
        chip.buses.clear()
        chip.buses.extend(_buses(table, [str(pin.port) for pin in pins]))
    labels = [pin.label for pin in pins]
    if (led := table.text("led", "")) and led not in labels:
        raise table.error("led", f"is '{led}', which is not a pin of this board{did_you_mean(led, labels)}")
    return platform.Board(
        name=path.stem,
        title=table.text("title", path.stem),
        microcontroller=chip,
        clockHertz=table.positive("f_cpu"),
        volts=_volts(table, "volts"),
        led=led,
        bootLoader=_boot_loader(table.table("boot_loader")) if "boot_loader" in table.values else None,
        pins=pins,
    )


def _boot_loader(entry: DataTable) -> platform.BootLoader:
    check_keys(entry, _BOOT_LOADER_KEYS)
    tool = entry.text("tool", "")
    bauds = list(entry.numbers("bauds", () if tool else None))
    if (not bauds and not tool) or min(bauds, default=1) <= 0:
        raise entry.error("bauds", "must have one baud rate or more")
    return platform.BootLoader(
        programmer=entry.text("programmer"),
        bauds=bauds,
        bytes=entry.number("bytes") if "bytes" in entry.values or not tool else 0,
        touchBaud=entry.optional_number("touch_baud") or 0,
        tool=tool,
    )


def check_drawn(table: DataTable) -> None:
    """Refuse an unknown table or key of a board's file (PlatformDataError), which would be ignored silently."""
    check_keys(table, (*_BOARD_KEYS, *_MAPPING_KEYS))
    for name, known in _DRAWN_KEYS.items():
        for entry in table.tables(name, needed=False):
            check_keys(entry, known)


def check_keys(table: DataTable, known: Collection[str]) -> None:
    """Refuse an unknown key (PlatformDataError), which would be ignored silently."""
    for key in table.values:
        if key not in known:
            raise table.error(key, f"is not a key of it{did_you_mean(key, known)}")


def _pin(entry: DataTable, timers: Sequence[str], shared_channels: bool) -> platform.Pin:
    """A pin, whose abilities and timer exist; without a channel, its core gives it an output of the timer when it is used.

    Raises:
        PlatformDataError: one of them does not.
    """
    check_keys(entry, _PIN_KEYS)
    for ability in entry.texts("abilities", ()):
        if ability not in ABILITIES:
            raise entry.error("abilities", f"has '{ability}', which is none of: {', '.join(ABILITIES)}")
    if (timer := entry.text("timer", "")) and timer not in timers:
        raise entry.error("timer", f"is '{timer}', which is not a timer of the microcontroller: {', '.join(timers)}")
    none = ("",) if shared_channels or not timer else ()
    if (channel := entry.text("channel", "")) not in ((*CHANNELS, *none) if timer else none):
        known = f"which is none of: {', '.join(CHANNELS)}" if timer else "but the pin has no timer"
        raise entry.error("channel", f"is '{channel}', {known}")
    return platform.Pin(
        label=entry.text("label"),
        port=entry.text("port", ""),
        aliases=list(entry.texts("aliases", ())),
        abilities=list(entry.texts("abilities", ())),
        timer=timer,
        channel=channel,
        reserved=entry.text("reserved", ""),
        drivenByCore=entry.flag("driven_by_core", False),
        bearsVolts=_volts(entry, "bears_volts") if "bears_volts" in entry.values else 0.0,
        interruptLine=entry.text("interrupt_line", ""),
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
    if (path := _chip_file(name, project)) is None:
        known = sorted({file.stem for folder in folders(KIND, project) for file in (folder / "mcus").glob("*.toml")})
        problem = f"is '{name}', an unknown microcontroller{did_you_mean(name, known)}"
        error = named_in.error("mcu", problem) if named_in is not None else PlatformDataError(f"'mcu' {problem}")
        error.fix = (
            f"use one of: {', '.join(known)}; or describe it in platform_repo/mcus/{name}.toml (docs/how-to/add-a-board.md)"
        )
        raise error
    table = table_of(path)
    check_keys(table, OF_MICROCONTROLLERS)
    uses = []
    for entry in table.tables("takes", needed=False):
        check_keys(entry, TAKES)
        for key, kind in _USERS.items():
            uses += [
                platform.ResourceUse(
                    name=user,
                    userKind=kind,
                    timers=list(entry.texts("timers", ())),
                    pins=list(entry.texts("pins", ())),
                    buses=list(entry.texts("buses", ())),
                    condition=entry.text("when", ""),
                    ramBytes=entry.optional_number("ram_bytes") or 0,
                )
                for user in entry.texts(key, ())
            ]
    return platform.Microcontroller(
        name=name,
        title=table.text("title", name),
        architecture=table.text("architecture"),
        flashBytes=table.positive("flash_bytes"),
        ramBytes=table.positive("ram_bytes"),
        signature=_signature(table),
        pinMilliamperes=table.optional_number("pin_ma") or 0,
        totalMilliamperes=table.optional_number("total_ma") or 0,
        pinVolts=_volts(table, "pin_volts") if "pin_volts" in table.values else 0.0,
        timers=[platform.Timer(name=t.text("name"), bits=t.number("bits")) for t in table.tables("timers")],
        buses=_buses(table),
        uses=uses,
    )


def _volts(table: DataTable, key: str) -> float:
    """A voltage of a pin.

    Raises:
        PlatformDataError: it is none that a pin has.
    """
    if not 0 < (volts := table.decimal(key)) <= _MOST_VOLTS:
        raise table.error(key, f"must be above 0 and at most {_MOST_VOLTS:g} V, it is {volts:g}")
    return volts


def _buses(table: DataTable, ports: Sequence[str] | None = None) -> list[platform.PinBus]:
    """The buses of a file; of a board, at its own pins.

    Raises:
        PlatformDataError: there is no such bus or signal, or a signal is at a port that none of the board's pins has.
    """
    found, said = [], table.table("buses", needed=False)
    check_keys(said, SIGNALS)
    for bus in said.values:
        lines = said.table(bus)
        check_keys(lines, SIGNALS[bus])
        for signal in lines.values:
            if ports is not None and lines.text(signal) not in ports:
                raise lines.error(
                    signal, f"is '{lines.text(signal)}', which no pin of this board has{did_you_mean(lines.text(signal), ports)}"
                )
        found.append(platform.PinBus(name=bus, signals=list(lines.values), ports=[lines.text(signal) for signal in lines.values]))
    return found


def _chip_file(name: str, project: Path | None) -> Path | None:
    return next((file for folder in folders(KIND, project) if (file := folder / "mcus" / f"{name}.toml").is_file()), None)


def not_simulated(name: str, project: Path | None = None) -> str:
    """What of a board no simulator has, as half a sentence; empty if its file names nothing."""
    path = board_file(name, project)
    return table_of(path).text("not_simulated", "") if path is not None else ""


def architecture_of(mcu: str, project: Path | None = None) -> str:
    """The architecture of a microcontroller; empty if nothing is known of it."""
    path = _chip_file(mcu, project)
    return table_of(path).text("architecture") if path is not None else ""


def _signature(table: DataTable) -> str:
    signature = table.text("signature", "").lower()
    if signature and not re.fullmatch("[0-9a-f]{6}", signature):
        raise table.error("signature", f"must be six hexadecimal digits, but is '{signature}'")
    return signature


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
    if table is not None:
        _check_mapping(table, platform_name, board.name, project)
    literals = table.texts_by_name("literals") if table is not None else {}
    interrupts = table.numbers_by_name("interrupts") if table is not None else {}
    numbers = table.numbers_by_name("numbers") if table is not None else {}
    labels = [pin.label for pin in board.pins]
    for key, named in (("literals", list(literals)), ("interrupts", list(interrupts)), ("numbers", list(numbers))):
        for label in named:
            if table is not None and label not in labels:
                raise table.error(f"{key}.{label}", f"is not a pin of this board{did_you_mean(label, labels)}")
    rules = _literal_rules(platform_name, project)
    core = _core(table.text("fqbn", "") if table is not None else "", platform_name, project)
    written = [literals.get(pin.label) or _numbered(pin, rules, numbers) for pin in board.pins]
    if table is not None:
        usual = check_core(table, _settings(platform_name, project), str(chip.architecture) if chip is not None else "")
        if numbers or (not usual and any(map(str.isdecimal, written))):
            check_complete(table, [label for label in labels if label not in numbers and label not in literals])
        by_port = core.pattern("numbers_by_port") if "numbers_by_port" in core.values else None
        check_numbers(table, board.pins, {"numbers": numbers, "interrupts": interrupts}, by_port)
        if len({*written}) < len(written):
            twice = sorted({word for word in written if written.count(word) > 1})
            raise table.error("literals", f"and 'numbers' give two pins one name in programs: {', '.join(twice)}")
    return platform.BoardMapping(
        board=board,
        boardId=table.text("fqbn", "") if table is not None else "",
        otherIds=list(table.texts("fqbn_also", ())) if table is not None else [],
        platformioId=table.text("platformio", "") if table is not None else "",
        platformioPlatform=core.text("platformio", ""),
        platformioSettings=list(core.texts("platformio_settings", ())),
        coreIndex=core.text("index_url", ""),
        variant=table.text("variant", "") if table is not None else "",
        define=table.text("define", "") if table is not None else "",
        coreVersion=table.text("core", "") if table is not None else "",
        extraFlags=list(table.texts("extra_flags", ())) if table is not None else [],
        flashBytes=table.positive("flash_bytes") if table is not None else chip.flashBytes if chip is not None else 0,
        ramBytes=table.positive("ram_bytes") if table is not None else chip.ramBytes if chip is not None else 0,
        pinNames=[
            platform.PinName(
                pin=pin,
                literal=literal,
                interrupt=interrupts.get(pin.label, -1),
                number=-1 if _tells_its_number(pin) else numbers.get(pin.label, -1),
            )
            for pin, literal in zip(board.pins, written, strict=True)
        ],
    )


def _tells_its_number(pin: platform.Pin) -> bool:
    """Whether a name of a pin has its number, such as D14 of A0."""
    return any(re.fullmatch(r"D\d+|\d+", str(name)) for name in (pin.label, *pin.aliases))


def _core(full_name: str, platform_name: str, project: Path | None) -> DataTable:
    """What a platform says of the core of a board (`[cores.NAME]`), a table that may be empty."""
    known = _settings(platform_name, project).table("cores", needed=False)
    name = ":".join(full_name.split(":")[:2])
    own = known.table(name) if name in known.values else DataTable(known.path, {})
    check_keys(own, OF_CORES)
    return own


def _check_mapping(table: DataTable, platform_name: str, board: str, project: Path | None) -> None:
    """Make sure that a mapping says what the platform's tools need, and calls the board as no other is called.

    Raises:
        PlatformDataError: a key is missing or unknown, or another board has the name already.
    """
    check_keys(table, (*_BOARD_KEYS, *_MAPPING_KEYS))
    for key in _settings(platform_name, project).texts("board_keys", ()):
        table.text(key)
    for full_name in (table.text("fqbn", ""), *table.texts("fqbn_also", ())):
        for other in mapped_files(platform_name, project) if full_name else ():
            if other.stem != board and f'"{full_name}"' in text_of(other):
                theirs = table_of(other)
                if full_name in (theirs.text("fqbn", ""), *theirs.texts("fqbn_also", ())):
                    nearer = next(f for f in folders(KIND, project) if table.path.is_relative_to(f) or other.is_relative_to(f))
                    own, far = (table, other) if table.path.is_relative_to(nearer) else (theirs, table.path)
                    raise own.error("fqbn", f"is '{full_name}', which is also the name of the board '{far.stem}' ({far})")


def mapped_files(platform_name: str, project: Path | None = None) -> list[Path]:
    """The files in which a platform maps boards, the first of each name in search order."""
    found: dict[str, Path] = {}
    for folder in folders(KIND, project):
        if (place := folder / platform_name / "boards").is_dir():
            for path in _listed(str(place), place.stat().st_mtime_ns):
                found.setdefault(path.stem, path)
    return list(found.values())


def variant_folder(platform_name: str, variant: str, project: Path | None = None) -> Path | None:
    """The folder of a variant that the repository has itself, beside the platform's boards; None for one of the core's."""
    if not variant:
        return None
    places = (folder / platform_name / "variants" / variant for folder in folders(KIND, project))
    return next((place for place in places if place.is_dir()), None)


def _settings(platform_name: str, project: Path | None) -> DataTable:
    paths = (folder / platform_name / "platform.toml" for folder in folders(KIND, project))
    return next((table_of(path) for path in paths if path.is_file()), DataTable(Path(platform_name), {}))


def _literal_rules(platform_name: str, project: Path | None) -> list[DataTable]:
    return _settings(platform_name, project).tables("pin_literals", needed=False)


def _literal(pin: platform.Pin, rules: list[DataTable]) -> str:
    """How a program writes a pin: by the first rule whose pattern fits its label or its port, else by its label."""
    for rule in rules:
        key, said = ("port", pin.port) if "port" in rule.values else ("label", pin.label)
        if match := re.fullmatch(rule.text(key), str(said)):
            return match.expand(rule.text("literal"))
    return str(pin.label)


def written_by_label(pin: platform.Pin, platform_name: str, project: Path | None = None) -> str:
    """How a program of a platform writes a pin of which a board's file says nothing.

    Args:
        pin: the pin.
        platform_name: the platform's folder in the repository.
        project: the project folder; the current folder if None.
    """
    return _literal(pin, _literal_rules(platform_name, project))


def _numbered(pin: platform.Pin, rules: list[DataTable], numbers: Mapping[str, int]) -> str:
    """How a program writes a pin; the core's number of the pin goes before a number that a rule makes of its label."""
    literal = _literal(pin, rules)
    return str(numbers[pin.label]) if pin.label in numbers and literal.isdecimal() else literal


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
    return (path for path in drawing_files(project) if not only_draws(path))


def only_draws(path: Path) -> bool:
    """Whether a file only says how a tool draws a board that another file has."""
    text = text_of(path)
    return _HAS_PINS.search(text) is None and _IS_DRAWN.search(text) is not None


def drawing_files(project: Path | None = None) -> Iterator[Path]:
    """The files that may say how tools draw boards, in search order: those with pins, and those that `only_draws`."""
    for folder in folders(KIND, project):
        if (place := folder / "boards").is_dir():
            yield from _listed(str(place), place.stat().st_mtime_ns)
        for own in sorted(entry.path for entry in os.scandir(folder) if entry.is_dir()):
            if os.path.isdir(boards := f"{own}/boards"):
                listed = _listed(boards, os.stat(boards).st_mtime_ns)
                yield from (p for p in listed if _HAS_PINS.search(text_of(p)) or _IS_DRAWN.search(text_of(p)))


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
        raise PlatformDataError(f"cannot be read: {error}", location=Location(path), fix="correct or remove the file") from error


def table_of(path: Path) -> DataTable:
    """The table of a file of the repository, read once as long as it does not change.

    Raises:
        PlatformDataError: it is no TOML.
    """
    return _table(str(path), path.stat().st_mtime_ns)


@cache
def _table(path: str, changed: int) -> DataTable:
    return DataTable(Path(path), read_data(Path(path)))


def check_ports(pins: Iterable[platform.Pin], text: str, board: DataTable, chip: DataTable) -> None:
    """Refuse a port that the microcontroller has not; where its file says nothing of ports, none is looked at.

    Args:
        pins: those of the board.
        text: the text of the board's file, for the line.
        board: the table of that file.
        chip: the table of the microcontroller's file, whose `ports` is a regular expression for the name of a port.

    Raises:
        PlatformDataError: a pin has such a port, or the expression is none.
    """
    if "ports" not in chip.values:
        return
    known = chip.pattern("ports")
    for pin in pins:
        if pin.port and known.fullmatch(str(pin.port)) is None:
            raise PlatformDataError(
                f"the port of '{pin.label}' is '{pin.port}', which is not a pin of the microcontroller '{chip.path.stem}'",
                location=Location(str(board.path), line_of_value(text, str(pin.port))),
                fix=f"write a port that matches {known.pattern}, or give the board's microcontroller",
            )


def check_names(pins: Sequence[platform.Pin], board: DataTable, shared_channels: bool = False) -> None:
    """Refuse a label, port or output of a timer that two pins have, and an alias that is another pin's name.

    Args:
        pins: of the board.
        board: the board's file.
        shared_channels: whether an output of a timer may come out at several pins.

    Raises:
        PlatformDataError: two pins have the same.
    """
    labels, ports = [str(pin.label) for pin in pins], [str(pin.port) for pin in pins if pin.port]
    channels = [f"{pin.timer} channel {pin.channel}" for pin in pins if pin.timer and not shared_channels]
    for values in (labels, ports, channels):
        if twice := {value for value in values if values.count(value) > 1}:
            raise board.error("pins", f"has {', '.join(sorted(twice))} twice")
    bearers: dict[str, list[platform.Pin]] = {}
    for pin in pins:
        for name in (str(pin.label), *pin.aliases):
            bearers.setdefault(name, []).append(pin)
    for pin in pins:
        for alias in pin.aliases:
            if (other := next((each for each in bearers[alias] if each is not pin), None)) is not None:
                raise board.error("pins", f"gives '{pin.label}' the alias '{alias}', which is a name of '{other.label}'")
