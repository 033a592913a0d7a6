"""Headers and other connectors of a schematic: what a person plugs in, and what only leads pins of the board out.

A symbol that is a header says nothing of the device on its other side. Its value or its reference may name one. Without such a
name it is still the part at a pin, of a role that nobody knows, unless it

- is the plug of a programmer: nothing is on it but RESET and the lines of SPI of the board that runs the program,
- leads pins of the board out: most of its nets, buses apart, are named like the pins that they are on, or it has RESET, AREF
  or VIN of the board beside its pins, as the sockets of a shield have, or
- lies beside drawn devices: each of its signals goes to one, and it has no supply for a device of its own.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec import Struct

_LEAST_LED_OUT = 4
"""Minimum number of the board's pins on a header that leads them out; a servo, a sensor or a bus has fewer."""
_LEAST_OF_SPI = 2
_SPI = frozenset({"MOSI", "MISO", "SCK", "COPI", "CIPO"})
_RESET = re.compile(r"N?RE?SE?T[0-9]?|DTR|RES")
_OF_THE_BOARD = frozenset({"RESET", "AREF", "VIN", "IOREF", "RAW"})
_WORDS = re.compile(r"[^A-Z0-9]+")


class HeaderPin(Struct, frozen=True):
    """A connected pin of a header.

    Attributes:
        pins: labels of the pins of boards on its net.
        named: whether the net is named like one of them (`D3`, `IO3`, `AD3`, `PB5`).
        bus: whether the net is named like a line of a bus (`MOSI`, `SDA`), which says nothing of the pin.
        words: in capitals, the words of the net's name and of the names of the board's connectors on it.
        supply: whether the net is a supply or a ground.
        device: whether a drawn device is on the net, too.
    """

    pins: Sequence[str] = ()
    named: bool = False
    bus: bool = False
    words: frozenset[str] = frozenset()
    supply: bool = False
    device: bool = False


def words_of(*names: str) -> frozenset[str]:
    """The words of names, in capitals.

    >>> sorted(words_of("PC6(/RESET)", "D11/MOSI"))
    ['D11', 'MOSI', 'PC6', 'RESET']
    """
    return frozenset(word for name in names for word in _WORDS.split(name.upper()) if word)


def why_no_part(pins: Sequence[HeaderPin]) -> str:
    """The reason why a header without a drawn device is no part that the program uses; empty if it is one.

    Args:
        pins: its connected pins.
    """
    signals = [pin for pin in pins if not pin.supply]
    on_board = [pin for pin in signals if pin.pins]
    if not on_board:
        return ""
    reset = [pin for pin in signals if any(_RESET.fullmatch(word) for word in pin.words)]
    spi = [pin for pin in on_board if pin.words & _SPI]
    if reset and len(spi) >= _LEAST_OF_SPI and all(pin in reset or pin in spi for pin in signals):
        return "a programmer is plugged in there"
    named = sum(pin.named for pin in on_board)
    if len(on_board) >= _LEAST_LED_OUT and (
        2 * named > sum(pin.named or not pin.bus for pin in signals)
        or (not named and any(pin.words & _OF_THE_BOARD for pin in pins))
    ):
        return "it leads pins of the board out"
    if all(pin.device for pin in on_board) and not any(pin.supply for pin in pins):
        return "each of its signals goes to a drawn part"
    return ""
