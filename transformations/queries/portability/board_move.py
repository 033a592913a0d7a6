"""The move of a program from one board to another, as far as the rules of this package ask for it."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

from robosmi.metamodels import platform


class BoardSide(Struct, frozen=True):
    """One of the two boards.

    Attributes:
        title: as people call it.
        chip: name of its microcontroller.
        architecture: of its processor.
        int_bits: width of int.
        numbers: number of a pin in programs -> its label.
        interrupts: number of an interrupt -> label of its pin.
        aliases: every name of a pin -> its label.
        ports: name of a pin on the microcontroller -> its label.
        char_signed: whether plain char is signed.
        timers: label of a pin -> the timer of its PWM.
        led: label of the pin with the board's LED; empty if there is none.
    """

    title: str
    chip: str
    architecture: str
    int_bits: int
    numbers: Mapping[int, str]
    interrupts: Mapping[int, str]
    aliases: Mapping[str, str]
    ports: Mapping[str, str]
    led: str
    char_signed: bool = True
    timers: Mapping[str, str] = {}


class BoardMove(Struct, frozen=True):
    """A move from a source board to a target board."""

    source: BoardSide
    target: BoardSide


def board_side(target: platform.Target) -> BoardSide:
    """What the rules ask of a board.

    Args:
        target: the board with its platform.
    """
    board, own = target.board, target.platform
    assert board is not None
    assert own is not None
    chip = board.microcontroller
    mapping = next((each for each in own.boardMappings if each.board is board), None)
    named = [name for name in mapping.pinNames if name.pin is not None] if mapping is not None else []
    aliases = {alias: str(pin.label) for pin in board.pins for alias in (str(pin.label), *map(str, pin.aliases))}
    labels = {str(name.literal): str(name.pin.label) for name in named if name.pin is not None}
    numbers = {int(literal): label for literal, label in labels.items() if literal.isdigit()}
    numbers |= {int(alias[1:]): label for alias, label in aliases.items() if alias[:1] == "D" and alias[1:].isdigit()}
    return BoardSide(
        str(board.title),
        str(chip.name) if chip is not None else "",
        str(chip.architecture) if chip is not None else str(own.architecture),
        int(own.intBits),
        numbers,
        {int(name.interrupt): str(name.pin.label) for name in named if name.pin is not None and int(name.interrupt) >= 0},
        aliases,
        {str(pin.port): str(pin.label) for pin in board.pins},
        str(board.led or ""),
        bool(own.charSigned),
        {str(pin.label): str(pin.timer) for pin in board.pins if pin.timer},
    )
