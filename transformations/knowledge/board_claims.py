"""The statements of a board's file about its pins, as claims to check against a core's headers (`robosmi.verify.board_check`).

The kinds of claims, and the expressions to evaluate, are data of the platform's toolchain (`[[board_check.claims]]`); here they
are instantiated for the pins of a board.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from pathlib import Path

from robosmi.metamodels import platform
from robosmi.transformations.knowledge.board_models import board_file, mapping_file, table_of
from robosmi.verify.boards import Claim
from robosmi.verify.tables import DataTable, find_files

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
    file = board_file(str(board.name), project)
    return partial(_claims, table_of(path), mapping, file, mapping_file(platform_name, str(board.name), project))


def _claims(toolchain: DataTable, mapping: platform.BoardMapping, pins: Path | None, names: Path | None) -> tuple[Claim, ...]:
    """The claims of a board, from its file with the pins and its file with the names that the platform gives them."""
    entries = toolchain.table("board_check").tables("claims")
    numbers = table_of(names).table("numbers", needed=False).values if names is not None else {}
    found = []
    for name in mapping.pinNames:
        if (pin := name.pin) is None:
            continue
        facts = _facts(name, pin) | {"number": str(numbers.get(str(pin.label), ""))}
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
    return Claim(says, ask, answer, entry.texts("choices"), entry.text("key"), file, beside)


def _filled(text: str, facts: dict[str, str]) -> str:
    return re.sub(r"\{(\w+)\}", lambda found: facts[found[1]], text)
