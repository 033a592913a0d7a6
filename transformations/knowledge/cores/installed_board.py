"""Boards of installed cores that have no data here, for the compile check."""

from __future__ import annotations

from robosmi.transformations.knowledge.cores.core_folders import BoardName, find_core
from robosmi.transformations.knowledge.cores.core_recipes import CoreRecipes
from robosmi.verify.toolchains.boards import Board
from robosmi.verify.toolchains.recipes import InstalledBoard
from robosmi.verify.toolchains.toolchain_data import Toolchain


def installed_board(name: str, toolchain: Toolchain) -> InstalledBoard | None:
    """The board of an installed core; the registry's query of that name.

    Args:
        name: as a person or a project file has it.
        toolchain: the toolchain of the sketch; its `[core]` says whether installed cores serve it (`installed_boards`).

    Returns:
        The board, or None if that is no full name of a board or the toolchain has no such boards.

    Raises:
        UsageError: the core has no such board, menu or option.
        MissingToolError: no such core is installed, or its compiler is not.
        SourceError, PlatformDataError: the core is damaged.
    """
    if name.count(":") < 2 or not toolchain.core.flag("installed_boards", False):
        return None
    full = BoardName.parse(name)
    core = find_core(full)
    recipes = CoreRecipes(core, full, toolchain)
    flash, ram = recipes.limits
    return InstalledBoard(Board(str(full), recipes.board_title, (str(full),), {}, (), flash, ram), recipes, full.architecture)
