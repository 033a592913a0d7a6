"""Headers and other connectors of a schematic: what the user plugs in, and what only leads pins of the board out.

A symbol that is a header says nothing of the device on its other side. Its value or its reference may name one. Without such a
name it is still the part at a pin, of a role that nobody knows, unless it

- is the plug of a programmer: nothing is on it but RESET and the lines of SPI of the board that runs the program,
- leads pins of the board out: it is called like the port of all of them (`PORTB`), or most of its nets, buses apart, are named
  like the pins that they are on, or it has RESET, AREF or VIN of the board beside its pins, as the sockets of a shield have, or
- lies beside drawn devices: each of its signals goes to one, and it has no supply for a device of its own.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec import Struct

_LEAST_LED_OUT = 4
"""Minimum number of the board's pins on a header that leads them out; a servo, a sensor or a bus has fewer."""
_LEAST_OF_SPI = 2
PROGRAMMER = "a programmer is plugged in there"
"""Why the plug of a programmer is no part."""
_SPI = frozenset({"MOSI", "MISO", "SCK", "SCLK", "COPI", "CIPO"})
_RESET = re.compile(r"N?RE?SE?T[0-9]?|DTR|RES")
OF_THE_BOARD = frozenset({"RESET", "AREF", "VIN", "IOREF", "RAW"})
"""Words of the names of a board's connectors that the sockets of a shield lead out."""
_PORT_NAME = re.compile(r"P(?:ORT)?[ _-]?([A-L])")
_WORDS = re.compile(r"[^A-Z0-9]+")


class HeaderPin(Struct, frozen=True):
    """A connected pin of a header.

    Attributes:
        pins: labels of the pins of boards on its net.
        named: whether the net is named like one of them (`D3`, `IO3`, `AD3`, `PB5`).
        bus: whether the net is named like a line of a bus (`MOSI`, `SDA`), which says nothing of the pin.
        words: in capitals, the words of the net's name and of the names of the board's connectors on it.
        led_out: whether a connector of the board that is no pin of a program is on the net: RESET, AREF, VIN.
        supply: whether the net is a supply or a ground.
        device: whether a drawn device is on the net, too.
    """

    pins: Sequence[str] = ()
    named: bool = False
    bus: bool = False
    words: frozenset[str] = frozenset()
    led_out: bool = False
    supply: bool = False
    device: bool = False


def words_of(*names: str) -> frozenset[str]:
    """The words of names, in capitals.

    >>> sorted(words_of("PC6(/RESET)", "D11/MOSI"))
    ['D11', 'MOSI', 'PC6', 'RESET']
    """
    return frozenset(word for name in names for word in _WORDS.split(name.upper()) if word)


def why_no_part(pins: Sequence[HeaderPin], title: str = "") -> str:
    """The reason why a header without a drawn device is no part that the program uses; empty if it is one.

    Args:
        pins: its connected pins.
        title: its reference, which may be the name of a port.
    """
    signals = [pin for pin in pins if not pin.supply]
    on_board = [pin for pin in signals if pin.pins]
    if not on_board:
        return ""
    reset = [pin for pin in signals if any(_RESET.fullmatch(word) for word in pin.words)]
    spi = [pin for pin in on_board if pin.words & _SPI]
    if reset and len(spi) >= _LEAST_OF_SPI and all(pin in reset or pin in spi for pin in signals):
        return PROGRAMMER
    named = sum(pin.named for pin in on_board)
    if len(on_board) >= _LEAST_LED_OUT and (
        _names_port(title, on_board)
        or 2 * named > sum(pin.named or not pin.bus for pin in signals)
        or (not named and any(pin.led_out for pin in pins))
    ):
        return "it leads pins of the board out"
    if all(pin.device for pin in on_board) and not any(pin.supply for pin in pins):
        return "each of its signals goes to a drawn part"
    return ""


def _names_port(title: str, pins: Sequence[HeaderPin]) -> bool:
    """Whether a header is called like a port (`PF`, `PORTB`) and has pins of this port alone."""
    found = _PORT_NAME.fullmatch(title.upper())
    own = re.compile(f"P{found[1]}[0-7]") if found is not None else None
    return own is not None and all(any(own.fullmatch(word) for word in pin.words) for pin in pins)
