"""How programs name and number the pins of the board that they run on today.

The numbers of pins, of channels of the converter and of interrupts are three number spaces: `analogRead(0)` is A0, and
`attachInterrupt(0, ...)` the pin of interrupt 0.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping

from msgspec import Struct

from robosmi.metamodels import platform

CHANNEL, INTERRUPT = "channel", "interrupt"
"""Numberings of a parameter besides that of pins, as `pins.json` names them."""


_COUNTED = re.compile(r"([A-Z]+)(\d+)\Z")


def pins_by_name(board: platform.Board) -> dict[str, platform.Pin]:
    """What a user may call each pin: label, aliases, and where all labels have one prefix (`GP9`) the number (`9`, `D9`)."""
    pins = {str(pin.label): pin for pin in board.pins}
    counted = [_COUNTED.match(label) for label in pins]
    numbered = len({each[1] if each is not None else "" for each in counted}) == 1
    found: dict[str, platform.Pin] = {}
    for own, (label, pin) in zip(counted, pins.items(), strict=True):
        numbers = (own[2], f"D{own[2]}") if numbered and own is not None else ()
        for name in (label, *map(str, pin.aliases), *numbers):
            found.setdefault(name, pin)
    return found


class BoardPins(Struct, frozen=True):
    """The pins of one board.

    Attributes:
        board: its name.
        labels: number -> label.
        names: every name of a pin, also its number as a text -> number.
        channels: channel of the converter -> number of its pin.
        interrupts: number of an interrupt -> number of its pin.
        ports: name of a pin on the microcontroller (`PB5`) -> number of the pin.
        clock_hz: the clock of its microcontroller; 0 if it is not known.
    """

    board: str
    labels: Mapping[int, str]
    names: Mapping[str, int]
    channels: Mapping[int, int]
    interrupts: Mapping[int, int]
    ports: Mapping[str, int] = {}
    clock_hz: int = 0

    @property
    def count(self) -> int:
        """One more than the highest number of a pin."""
        return max(self.labels, default=-1) + 1

    def numbers(self, numbering: str) -> Mapping[int, int]:
        """Number in a numbering -> number of the pin; a number of a channel may be that of a pin, too."""
        if numbering == CHANNEL:
            return {**{number: number for number in self.labels}, **self.channels}
        return self.interrupts if numbering == INTERRUPT else {number: number for number in self.labels}


def board_pins(mappings: Iterable[platform.BoardMapping]) -> BoardPins | None:
    """The pins of the first board of a platform's mappings; None if there is none."""
    mapping = next((each for each in mappings if each.board is not None), None)
    if mapping is None or mapping.board is None:
        return None
    numbers: dict[str, int] = {}
    for name in mapping.pinNames:
        if name.pin is not None:
            literals = (str(name.literal), *(str(alias)[1:] for alias in name.pin.aliases if str(alias).startswith("D")))
            number = next((int(text) for text in literals if text.isdecimal()), name.number if name.number >= 0 else None)
            if number is not None:
                numbers[str(name.pin.label)] = number
    pins = [pin for pin in mapping.board.pins if pin.label in numbers]
    names = {str(alias): numbers[pin.label] for pin in pins for alias in (pin.label, *pin.aliases)}
    names |= {str(number): number for number in numbers.values()}
    analog = [pin for pin in pins if str(pin.label)[:1] == "A" and str(pin.label)[1:].isdecimal()]
    return BoardPins(
        str(mapping.board.name),
        {number: label for label, number in numbers.items()},
        names,
        {int(str(pin.label)[1:]): numbers[pin.label] for pin in analog},
        {
            int(name.interrupt): numbers[name.pin.label]
            for name in mapping.pinNames
            if name.pin is not None and name.interrupt >= 0 and name.pin.label in numbers
        },
        {str(pin.port): numbers[pin.label] for pin in pins if pin.port},
        int(mapping.board.clockHertz),
    )
