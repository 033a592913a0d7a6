"""Boards as data: what a board file says, and finding the board that a name means.

A board file is `<platform>/boards/<name>.toml` of the repository. This module reads it; who uses which entry is another
matter: the compile check takes chip, flags and limits, pin mapping takes the pins, a drawing reader the connectors.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from robosmi.errors import UsageError, did_you_mean
from robosmi.verify.tables import Table, find_files


@dataclass(frozen=True)
class Pin:
    """A pin of a board.

    Attributes:
        label: the normalised name, `D9` or `A0`.
        number: what a program calls it.
        aliases: its other names.
        abilities: digital, pwm, analog_in, interrupt, uart, i2c, spi.
        timer: the timer that makes its PWM, or an empty text.
        channel: the timer's output, or an empty text.
        interrupt: number of its external interrupt, or None.
        reserved: why it is better left free, or an empty text.
    """

    label: str
    number: int
    aliases: tuple[str, ...]
    abilities: tuple[str, ...]
    timer: str
    channel: str
    interrupt: int | None
    reserved: str


@dataclass(frozen=True)
class DrawnAs:
    """How a drawing tool's parts library names a board.

    Attributes:
        tool: the drawing tool.
        modules: ids of the parts that share these connectors.
        connectors: connector id -> pin label.
    """

    tool: str
    modules: tuple[str, ...]
    connectors: dict[str, str]


@dataclass(frozen=True)
class Board:
    """A board. Sizes in bytes, `f_cpu` in Hz.

    Attributes:
        fqbn: the board's full name in project files.
        fqbn_also: the same with options that change nothing here.
        define: what identifies the board to the preprocessor.
        extra_flags: further arguments for every compile.
        flash_bytes: what a program may take.
        led: label of the pin with the built-in LED, or an empty text.
    """

    name: str
    title: str
    fqbn: str
    fqbn_also: tuple[str, ...]
    mcu: str
    f_cpu: int
    variant: str
    define: str
    extra_flags: tuple[str, ...]
    flash_bytes: int
    ram_bytes: int
    volts: float
    led: str
    pins: tuple[Pin, ...]
    drawn_as: tuple[DrawnAs, ...]
    path: Path

    def fill(self) -> dict[str, str]:
        """The values that texts of a toolchain file may refer to in braces."""
        return {"mcu": self.mcu, "f_cpu": str(self.f_cpu), "variant": self.variant, "define": self.define}


def load_board(path: Path) -> Board:
    """The board that a file describes.

    Raises:
        PlatformDataError: an entry is missing, of the wrong kind, or names a pin that the file does not have.
    """
    table = Table.read(path)
    pins = tuple(_pin(entry) for entry in table.tables("pins"))
    labels = [pin.label for pin in pins]
    if twice := {label for label in labels if labels.count(label) > 1}:
        raise table.error("pins", f"has {', '.join(sorted(twice))} twice")
    return Board(
        name=table.text("name"),
        title=table.text("title"),
        fqbn=table.text("fqbn"),
        fqbn_also=table.texts("fqbn_also", ()),
        mcu=table.text("mcu"),
        f_cpu=table.number("f_cpu"),
        variant=table.text("variant"),
        define=table.text("define"),
        extra_flags=table.texts("extra_flags", ()),
        flash_bytes=table.number("flash_bytes"),
        ram_bytes=table.number("ram_bytes"),
        volts=table.decimal("volts"),
        led=table.text("led", ""),
        pins=pins,
        drawn_as=tuple(_drawn_as(entry, labels) for entry in table.tables("drawn_as", needed=False)),
        path=path,
    )


def _pin(entry: Table) -> Pin:
    return Pin(
        label=entry.text("label"),
        number=entry.number("number"),
        aliases=entry.texts("aliases", ()),
        abilities=entry.texts("abilities"),
        timer=entry.text("timer", ""),
        channel=entry.text("channel", ""),
        interrupt=entry.optional_number("interrupt"),
        reserved=entry.text("reserved", ""),
    )


def _drawn_as(entry: Table, labels: list[str]) -> DrawnAs:
    table = entry.table("connectors")
    connectors: dict[str, str] = {}
    for label in table.values:
        if label not in labels:
            raise table.error(label, f"is no pin of this board{did_you_mean(label, labels)}")
        for connector in table.texts(label):
            if connector in connectors:
                raise table.error(label, f"has {connector}, which is {connectors[connector]} already")
            connectors[connector] = label
    return DrawnAs(entry.text("tool"), entry.texts("modules"), connectors)


def load_boards(platform: str, project: Path | None = None) -> list[Board]:
    """All boards of a platform, smallest flash first.

    Args:
        platform: the platform's folder in the repository.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a board file is damaged.
    """
    found = [load_board(path) for path in find_files(f"{platform}/boards/*.toml", project)]
    return sorted(found, key=lambda board: (board.flash_bytes, board.ram_bytes, board.name))


def find_board(name: str, boards: list[Board]) -> Board:
    """The board of that name, or of that full name (fqbn).

    Raises:
        UsageError: there is none.
    """
    for board in boards:
        if name in (board.name, board.fqbn, *board.fqbn_also):
            return board
    known = [board.name for board in boards] + [board.fqbn for board in boards]
    raise UsageError(
        f"no board is called '{name}'{did_you_mean(name, known)}",
        fix=f"use one of: {', '.join(board.fqbn if ':' in name else board.name for board in boards) or 'none is known'}",
    )
