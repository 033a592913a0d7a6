"""Names and colours of a circuit's nets in a picture; no two nets have the same.

A rail has the name that the drawing gives to its net, else that of its supply; further nets of that name get a number.
"""

from __future__ import annotations

import colorsys
from collections.abc import Iterable, Iterator

from robosmi.metamodels import hardware

_KNOWN = {"GND": "#333333", "5V": "#c0392b", "3.3V": "#d35400"}
_LETTERS = 18
_TURN = 137.508  # degrees; colours that follow one another are far apart


def rail_names(rails: Iterable[hardware.Net]) -> dict[int, str]:
    """`id` of each rail -> its unique name; rails of a board are named first, and so without a number.

    Args:
        rails: the rails in the circuit's order.
    """
    names: dict[int, str] = {}
    taken: set[str] = set()
    for net in sorted(rails, key=lambda net: not _of_a_board(net)):
        wanted = " ".join((net.title or net.voltage or "supply").split())[:_LETTERS]
        name, number = wanted, 1
        while name in taken:
            number += 1
            name = f"{wanted} {number}"
        taken.add(name)
        names[id(net)] = name
    return names


def net_colours(nets: Iterable[hardware.Net], names: dict[int, str]) -> dict[int, str]:
    """`id` of each net -> its unique colour.

    Args:
        nets: the nets that are drawn.
        names: the names of those that are rails.
    """
    colours = _colours()
    found: dict[int, str] = {}
    used = {*_KNOWN.values()}
    for net in nets:
        known = _KNOWN.get(names.get(id(net), "").lstrip("+").replace("3V3", "3.3V"))
        if known is None or known in found.values():
            known = next(colour for colour in colours if colour not in used)
        used.add(known)
        found[id(net)] = known
    return found


def _of_a_board(net: hardware.Net) -> bool:
    return any(c.component is not None and c.component.role is hardware.Role.Board for c in net.connectors)


def _colours() -> Iterator[str]:
    """An endless sequence of colours with contrast to white; after some thousands they repeat in a lighter shade."""
    number = 0
    while True:
        level = 0.30 + 0.04 * (number // 40 % 4) + 0.001 * (number // 160 % 50)
        red, green, blue = colorsys.hls_to_rgb((number * _TURN % 360) / 360, level, 0.75)
        yield f"#{round(red * 255):02x}{round(green * 255):02x}{round(blue * 255):02x}"
        number += 1
