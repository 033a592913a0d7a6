"""The model of the Arduino API as a core: a sketch becomes a program of this computer, for a board that no simulator has.

The core is `platform_repo/arduino/api_model`; its comments say how a program is isolated from this computer. What differs from
board to board are properties of the build.
"""

from __future__ import annotations

from collections.abc import Mapping

from robosmi.resources import built_in
from robosmi.transformations.knowledge.cores.core_folders import ArduinoCore, BoardName
from robosmi.transformations.knowledge.cores.core_recipes import CoreRecipes
from robosmi.verify.toolchains.boards import Board
from robosmi.verify.toolchains.recipes import InstalledBoard
from robosmi.verify.toolchains.toolchain_data import Toolchain

_TEXTS = "stand_ins/hardware/rp2040/rp2040/cores/rp2040"
"""The folder with what its texts and streams consist of."""
_NAME = BoardName("robosmi", "api", "board")


def api_board(board: Board, properties: Mapping[str, str], toolchain: Toolchain) -> InstalledBoard:
    """A board as the model of the Arduino API builds its programs.

    Args:
        board: the board.
        properties: what its programs have to know of it: `api.flags` and `api.defines`, arguments of the compiler.
        toolchain: the toolchain of the sketch.

    Raises:
        MissingToolError: the compiler is not installed.
    """
    core = ArduinoCore(built_in("platform_repo") / "arduino" / "api_model", _NAME.vendor, _NAME.architecture, None)
    recipes = CoreRecipes(core, _NAME, toolchain, properties)
    recipes.board_folders = [core.folder / "chip", core.folder.parent / _TEXTS]
    own = Board(board.name, board.title, board.full_names, {}, (), None, None, architecture=board.architecture)
    return InstalledBoard(own, recipes, board.architecture)
