"""Converts the boards of `board_models` to the form that the compile check uses (`robosmi.verify.boards`)."""

from __future__ import annotations

from pathlib import Path

from robosmi.errors import PlatformDataError
from robosmi.metamodels import platform
from robosmi.transformations.knowledge.board_claims import board_claims
from robosmi.transformations.knowledge.board_models import load_board, load_mapping, mapped_boards, mapping_file, variant_folder
from robosmi.verify.boards import Board, BootLoader


def boards_to_compile_for(platform_name: str, project: Path | None = None) -> list[Board]:
    """The boards that a platform maps; the registry's query of that name.

    Args:
        platform_name: the platform's folder in the repository.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: the data of a board is damaged.
    """
    return [_board(platform_name, load_board(name, project), project) for name in mapped_boards(platform_name, project)]


def _board(platform_name: str, board: platform.Board, project: Path | None) -> Board:
    mapping, chip = load_mapping(platform_name, board, project), board.microcontroller
    if chip is None:
        raise PlatformDataError(f"the board '{board.name}' has no microcontroller", fix="add 'mcu' to its file")
    variant = variant_folder(platform_name, str(mapping.variant), project)
    own = (f"-I{variant}",) if variant is not None else ()  # before the core's folders
    return Board(
        name=str(board.name),
        title=str(board.title),
        full_names=tuple(filter(None, (mapping.boardId, *mapping.otherIds))),
        values={
            "mcu": str(chip.name), "f_cpu": str(board.clockHertz), "variant": str(mapping.variant), "define": str(mapping.define),
        },
        extra_flags=(*own, *mapping.extraFlags),
        flash_bytes=int(mapping.flashBytes),
        ram_bytes=int(mapping.ramBytes),
        folders=(variant,) if variant is not None else (),
        boot_loader=_boot_loader(board.bootLoader, chip),
        signature=str(chip.signature),
        file=mapping_file(platform_name, str(board.name), project),
        claims=board_claims(platform_name, board, mapping, project),
    )  # fmt: skip


def _boot_loader(found: platform.BootLoader | None, chip: platform.Microcontroller) -> BootLoader | None:
    if found is None:
        return None
    return BootLoader(
        str(found.programmer),
        tuple(int(baud) for baud in found.bauds),
        int(chip.flashBytes) - int(found.bytes),
        int(found.touchBaud),
    )
