"""Opens a platform's folder of the repository as a model of `platform.ecore`, all of it: what queries and constraints ask.

A migration takes the few elements that its program needs (`platform_model`); here is every header, function, board and name. The
model cannot be stored over the folder: its data stays the files.
"""

from __future__ import annotations

import os
from pathlib import Path

from robosmi import resources
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.metamodels import platform
from robosmi.model import EmfModel
from robosmi.transformations.knowledge.board_models import KIND, load_board, load_mapping, mapped_boards
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.knowledge.platforms.platform_folder import facts_of
from robosmi.transformations.knowledge.platforms.platform_model import platform_part
from robosmi.transformations.knowledge.platforms.target_platform import target_platform

SETTINGS, API = "platform.toml", "api.json"


def open_platform(path: Path, name: str | None = None) -> EmfModel:
    """A platform as a model: one `PlatformRepository` with the platform, its boards and their microcontrollers.

    Args:
        path: the platform's folder, or its `platform.toml`.
        name: what queries call the model; the folder's name if None.

    Raises:
        SourceError: it is no folder of a platform, or another one of that name comes first in the search order.
        PlatformDataError: its data is damaged.
    """
    folder = Path(os.path.realpath(path if path.is_dir() else path.parent))
    if not (folder / SETTINGS).is_file():
        raise SourceError(f"it has no {SETTINGS}", location=Location(str(path)), fix="give the folder of a platform")
    repository = platform.PlatformRepository()
    source = _source(folder) if (folder / API).is_file() else None
    if source is None or mapped_boards(folder.name):
        _add_target(folder, repository, source)
    else:
        repository.platforms.append(source)
    return EmfModel(repository, name=name or folder.name)


def _source(folder: Path) -> platform.Platform:
    facts = facts_of(str(folder))
    headers = tuple(facts.headers)
    return platform_part(ApiIndex(facts), facts.entries, headers, units=[headers])


def _add_target(folder: Path, repository: platform.PlatformRepository, source: platform.Platform | None) -> None:
    """Add the platform that programs are moved to, with its boards; of one that they are moved from, too, what it declares."""
    first = Path(os.path.realpath(resources.find(KIND, f"{folder.name}/{SETTINGS}"))).parent
    if first != folder:
        raise SourceError(
            f"another platform '{folder.name}' comes first: {first}", location=Location(str(folder)),
            fix="add its parent folder to ROBOSMI_PATH",
        )  # fmt: skip
    made = target_platform(folder.name)
    if source is not None:
        made.headers.extend([*source.headers])
        made.attributeMacros = [*source.attributeMacros]
        made.portCount, made.portPrefix = source.portCount, source.portPrefix
    repository.platforms.append(made)
    chips: dict[str, platform.Microcontroller] = {}
    for short in mapped_boards(folder.name):
        board = load_board(short)
        if board.microcontroller is not None:
            board.microcontroller = chips.setdefault(board.microcontroller.name, board.microcontroller)
        repository.boards.append(board)
        made.boardMappings.append(load_mapping(folder.name, board))
    repository.microcontrollers.extend(chips.values())
