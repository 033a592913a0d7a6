"""The boards that a compile can be for, and the look-up of a board by name.

The registry's query `boards_to_compile_for` reads the boards, which are content. A compile does not need pins and drawings.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import NamedTuple

from robosmi.errors import UsageError, did_you_mean
from robosmi.plugins import content


class BootLoader(NamedTuple):
    """The boot loader that receives programs on a board.

    Attributes:
        programmer: the upload tool's name of its protocol.
        bauds: its possible baud rates, the likeliest first.
        takes_bytes: the greatest program size, in bytes, that does not overwrite it.
        touch_baud: the baud rate at which opening and closing the port starts it; 0 if a reset does.
        tool: the uploader that sends programs to it (a file of `uploaders`); empty for the toolchain's.
    """

    programmer: str
    bauds: tuple[int, ...]
    takes_bytes: int
    touch_baud: int = 0
    tool: str = ""


class Claim(NamedTuple):
    """A statement of a board's file that the core's headers can confirm.

    Attributes:
        says: the statement, for people (`D9 is on port B`).
        ask: an expression in the language of the core, or an element of one of its arrays (`ports[9]`).
        answer: the expression that the value must equal.
        choices: further expressions; if the answer is wrong, the one with the right value is suggested.
        key: the key to correct.
        file: the board's file with it.
        beside: a text on the line of the statement.
        label: the pin that it is about.
    """

    says: str
    ask: str
    answer: str
    choices: tuple[str, ...]
    key: str
    file: Path | None
    beside: str
    label: str = ""


class Board(NamedTuple):
    """A board. Sizes are in bytes.

    Attributes:
        name: its short name.
        title: its full name, for people.
        architecture: of its processor, as libraries name it.
        full_names: its names in the platform's tools, the preferred one first.
        values: the values of the braces in a toolchain file's texts.
        extra_flags: further arguments for every compile.
        flash_bytes: the flash available to a program; None if its core does not say.
        ram_bytes: the data memory; None if its core does not say.
        folders: folders with headers of its own, which the flags name.
        boot_loader: its boot loader; None if unknown.
        signature: the signature of its microcontroller, six hexadecimal digits; empty if unknown.
        file: the file with the platform's names for the board; None if there is none.
        claims: makes the board's claims, on demand since usually only one board of many is checked.
    """

    name: str
    title: str
    full_names: tuple[str, ...]
    values: Mapping[str, str]
    extra_flags: tuple[str, ...]
    flash_bytes: int | None
    ram_bytes: int | None
    folders: tuple[Path, ...] = ()
    boot_loader: BootLoader | None = None
    signature: str = ""
    file: Path | None = None
    claims: Callable[[], tuple[Claim, ...]] = tuple
    architecture: str = ""

    def has_more_memory_than(self, other: Board) -> bool:
        """Whether it has more flash or more data memory than another one."""
        pairs = (self.flash_bytes, other.flash_bytes), (self.ram_bytes, other.ram_bytes)
        return any(own is not None and theirs is not None and own > theirs for own, theirs in pairs)

    def fill(self) -> dict[str, str]:
        """A copy of the values."""
        return dict(self.values)


def load_boards(platform: str, project: Path | None = None) -> list[Board]:
    """All boards of a platform, smallest flash first.

    Args:
        platform: the platform's folder in the repository.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: a board file is damaged.
    """
    found: list[Board] = content("query", "boards_to_compile_for")(platform, project)
    return sorted(found, key=lambda board: (board.flash_bytes or 0, board.ram_bytes or 0, board.name))


def find_board(name: str, boards: list[Board]) -> Board:
    """The board of that name, or of that full name.

    Raises:
        UsageError: there is none.
    """
    for board in boards:
        if name in (board.name, *board.full_names):
            return board
    first = [board.full_names[0] if board.full_names else board.name for board in boards]
    known = [board.name for board in boards] + first
    offered = first if ":" in name else [board.name for board in boards]
    listed = ", ".join(offered) or "none is known"
    raise UsageError(f"unknown board '{name}'{did_you_mean(name, known)}", fix=f"use one of: {listed}")
