"""Converts the boards of `board_models` to the form that the compile check uses (`robosmi.verify.toolchains.boards`).

What a board's file says about its pins becomes claims, which `robosmi.verify.toolchains.board_check` checks against a core's
headers. The kinds of claims, and the expressions to evaluate, are data of the platform's toolchain (`[[board_check.claims]]`);
here they are instantiated for the pins of a board.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

from robosmi.base.data_tables import DataTable, find_files
from robosmi.errors import PlatformDataError
from robosmi.metamodels import platform
from robosmi.transformations.knowledge.board_models import (
    board_file,
    load_board,
    load_mapping,
    mapped_boards,
    mapping_file,
    table_of,
    variant_folder,
    written_by_label,
)
from robosmi.verify.toolchains.boards import Board, BootLoader, Claim


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
            "core_version": str(mapping.coreVersion),
        },
        extra_flags=(*own, *mapping.extraFlags),
        flash_bytes=int(mapping.flashBytes),
        ram_bytes=int(mapping.ramBytes),
        folders=(variant,) if variant is not None else (),
        boot_loader=_boot_loader(board.bootLoader, chip, mapping),
        signature=str(chip.signature),
        file=mapping_file(platform_name, str(board.name), project),
        claims=board_claims(platform_name, board, mapping, project),
        architecture=str(chip.architecture),
    )  # fmt: skip


def _boot_loader(
    found: platform.BootLoader | None, chip: platform.Microcontroller, mapping: platform.BoardMapping
) -> BootLoader | None:
    if found is None:
        return None
    takes = int(mapping.flashBytes) if found.tool else int(chip.flashBytes) - int(found.bytes)
    bauds = tuple(int(baud) for baud in found.bauds)
    return BootLoader(str(found.programmer), bauds, takes, int(found.touchBaud), str(found.tool))


# ---- claims about pins

_PORT = re.compile(r"P([A-L])([0-7])")
_CONVERTER = re.compile(r"ADC\d+")
_INPUT = re.compile(r"A(\d+)")


def board_claims(
    platform_name: str, board: platform.Board, mapping: platform.BoardMapping, project: Path | None = None
) -> Callable[[], tuple[Claim, ...]]:
    """Make a function that returns the claims of a board; it is called when a program is compiled for the board.

    There are no claims if the platform's toolchain does not check boards.

    Args:
        platform_name: the platform's folder in the repository.
        board: the board.
        mapping: how the platform calls it and its pins.
        project: the project folder; the current folder if None.

    Raises:
        PlatformDataError: the toolchain's data is damaged.
    """
    path = next(find_files(f"{platform_name}/toolchain.toml", project), None)
    if path is None or "board_check" not in table_of(path).values or not mapping.variant:
        return tuple
    return partial(_claims, table_of(path), platform_name, board, mapping, project)


def _claims(
    toolchain: DataTable, platform_name: str, board: platform.Board, mapping: platform.BoardMapping, project: Path | None
) -> tuple[Claim, ...]:
    """The claims of a board, from its file with the pins and its file with the names that the platform gives them.

    A number in the file is what programs write, so it is compared with what they would write without it.
    """
    pins, names = board_file(str(board.name), project), mapping_file(platform_name, str(board.name), project)
    by_label = {str(pin.label): written_by_label(pin, platform_name, project) for pin in board.pins}
    entries = toolchain.table("board_check").tables("claims")
    table = table_of(names) if names is not None else None
    numbers = table.table("numbers", needed=False).values if table is not None else {}
    core_names = {**by_label, **(table.texts_by_name("literals") if table is not None else {})}
    found = []
    for name in mapping.pinNames:
        if (pin := name.pin) is None:
            continue
        label = str(pin.label)
        facts = _facts(name, pin) | {"number": str(numbers.get(label, "")), "name": core_names[label]}
        is_led = mapping.board is not None and pin.label == mapping.board.led
        abilities = {*pin.abilities, "any", *(["led"] if is_led else [])}
        for entry in entries:
            if entry.text("of") not in abilities:
                continue
            own = facts | {"timer_channel": facts["timer_channel"] or entry.text("none", "")}
            if any(not own[key] for key in re.findall(r"\{(\w+)\}", entry.text("ask") + entry.text("answer"))):
                continue
            of_mapping, key = entry.flag("of_platform", False), entry.text("key")
            beside = f"{key} =" if of_mapping or key == "led" else f'label = "{pin.label}"'
            found.append(_claim(entry, own, names if of_mapping else pins, beside))
    return tuple(found)


def _facts(name: platform.PinName, pin: platform.Pin) -> dict[str, str]:
    port = _PORT.fullmatch(str(pin.port))
    inputs = (_INPUT.fullmatch(str(text)) for text in (pin.label, *pin.aliases))
    return {
        "label": str(pin.label),
        "literal": str(name.literal),
        "letter": port[1] if port is not None else "",
        "bit": port[2] if port is not None else "",
        "timer_channel": f"{str(pin.timer).upper()}{pin.channel}" if pin.timer else "",
        "interrupt": str(name.interrupt),
        "input": next((found[1] for found in inputs if found is not None), ""),
    }


def _claim(entry: DataTable, facts: dict[str, str], file: Path | None, beside: str) -> Claim:
    says, ask, answer = (_filled(entry.text(key), facts) for key in ("says", "ask", "answer"))
    return Claim(says, ask, answer, entry.texts("choices"), entry.text("key"), file, beside, facts["label"])


def _filled(text: str, facts: dict[str, str]) -> str:
    return re.sub(r"\{(\w+)\}", lambda found: facts[found[1]], text)
