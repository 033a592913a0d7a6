"""Boards of Arduino cores, for the compile check: of installed ones, else of those that ship as stand-ins."""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.errors import MissingToolError
from robosmi.transformations.knowledge.cores.core_folders import ArduinoCore, BoardName, find_core, how_to_install, lacking
from robosmi.transformations.knowledge.cores.core_recipes import CoreRecipes
from robosmi.verify.toolchains.boards import Board, load_boards
from robosmi.verify.toolchains.recipes import InstalledBoard
from robosmi.verify.toolchains.toolchain_data import Toolchain

GENERIC = "generic"
"""The board of a stand-in that takes the place of those which have data here and which it does not know."""


def installed_board(names: Sequence[str], toolchain: Toolchain) -> InstalledBoard | None:
    """The board of a core; the registry's query of that name.

    Args:
        names: full names of one board, as the user, a project file or the board's data has them. The first whose core is
            installed counts, else the first whose core has a stand-in.
        toolchain: the toolchain of the sketch; its `[core]` says whether installed cores serve it (`installed_boards`).

    Returns:
        The board, or None if these are no full names of a board or the toolchain has no such boards.

    Raises:
        UsageError: the core has no such board, menu or option.
        MissingToolError: no such core is installed, or its compiler is not.
        SourceError, PlatformDataError: the core is damaged.
    """
    full_names = [name for name in names if name.count(":") >= 2]
    if not full_names or not toolchain.core.flag("installed_boards", False):
        return None
    full, core = _first_installed([BoardName.parse(name) for name in full_names])
    if core.stand_in and full.board not in core.board_names and _has_data(full, toolchain):
        full = full._replace(board=GENERIC)
    recipes = CoreRecipes(core, full, toolchain)
    flash, ram = recipes.limits
    board = Board(str(full), recipes.board_title, (str(full),), {}, (), flash, ram, architecture=full.architecture)
    if not core.stand_in:
        return InstalledBoard(board, recipes, full.architecture, version=core.version)
    stand_in, why = f"{full.vendor}:{full.architecture}", ", ".join(filter(None, lacking(full)))
    return InstalledBoard(board, recipes, full.architecture, stand_in, how_to_install(full), why)


def core_properties(full_name: str) -> dict[str, str]:
    """What a board's core says of it with its options of menus; the registry's query of that name. Nothing without the core.

    Raises:
        UsageError: this is no full name of a board, or the core has no such board, menu or option.
        SourceError: the core is damaged.
    """
    name = BoardName.parse(full_name)
    try:
        return find_core(name).board(name)
    except MissingToolError:
        return {}


def _first_installed(names: Sequence[BoardName]) -> tuple[BoardName, ArduinoCore]:
    """A name whose core is there, and the core.

    Raises:
        MissingToolError: there is none of them; of the first name.
    """
    found: list[tuple[BoardName, ArduinoCore]] = []
    missing: list[MissingToolError] = []
    for name in names:
        try:
            found.append((name, find_core(name)))
        except MissingToolError as error:
            missing.append(error)
    if not found:
        raise missing[0]
    return min(found, key=lambda each: each[1].stand_in)


def _has_data(name: BoardName, toolchain: Toolchain) -> bool:
    plain = str(name._replace(options=()))
    return any(plain in board.full_names for board in load_boards(toolchain.platform))
