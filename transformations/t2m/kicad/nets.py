"""Which pins of a KiCad schematic are one net: by place, by wires and junctions, by labels, over sheets.

The rules are those of KiCad's own netlist. A wire joins what is at its ends; a junction or a label joins the wires that pass
its place; pins at one place are joined. Labels of a sheet join by their text on that sheet; labels of the whole drawing and
symbols of supplies join everywhere, and what bears their name on the same sheet is theirs too. A pin of a sheet's symbol is the
label of that name in the sheet. Of a bus (`D[0..7]`) each member is joined by its name.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robosmi.transformations.t2m.connectivity import Joined, Node
from robosmi.transformations.t2m.kicad.sheet import GLOBAL, LOCAL, Label, Point, Sheet, Wire

_VECTOR = re.compile(r"(.*)\[([0-9]{1,4})\.\.([0-9]{1,4})\](.*)")
_MOST_MEMBERS = 1_000


class SheetNets:
    """The joining of what is on one sheet of a hierarchy.

    Args:
        joined: the sets of the whole drawing.
        path: identity of the sheet in the hierarchy.
        sheet: its records.
    """

    def __init__(self, joined: Joined, path: str, sheet: Sheet) -> None:
        self.joined, self.path = joined, path
        self._flat: dict[int, list[Wire]] = {}
        self._upright: dict[int, list[Wire]] = {}
        self._slanted: list[Wire] = []
        self._local: set[str] = set()
        self._global: set[str] = set()
        for wire in sheet.wires:
            joined.union(self.at(wire.start), self.at(wire.end))
            if wire.start.y == wire.end.y:
                self._flat.setdefault(wire.start.y, []).append(wire)
            elif wire.start.x == wire.end.x:
                self._upright.setdefault(wire.start.x, []).append(wire)
            else:
                self._slanted.append(wire)
        for place in sheet.junctions:
            self._join_passing(place)
        for label in sheet.labels:
            self._join_passing(label.at)
            self._named(label)

    def at(self, place: Point) -> Node:
        """The node of a place."""
        return self.path, f"{place.x} {place.y}"

    def name(self, text: str) -> Node:
        """The node of a name that holds on this sheet."""
        self._local.add(text)
        return self.path, f"name {text}"

    def everywhere(self, text: str) -> Node:
        """The node of a name that holds in the whole drawing."""
        self._global.add(text)
        return "", f"name {text}"

    def close(self) -> None:
        """Join names of the sheet to those of the whole drawing that are on it too."""
        for text in self._local & self._global:
            self.joined.union(self.name(text), self.everywhere(text))

    def sheet_pin(self, pin: Label, below: SheetNets) -> None:
        """Join a pin of a sheet's symbol on this sheet to the label of its name in the sheet below."""
        self.joined.union(self.at(pin.at), below.name(pin.text))
        for member in members(pin.text):
            self.joined.union(self.name(member), below.name(member))

    def _named(self, label: Label) -> None:
        node = self.everywhere(label.text) if label.kind == GLOBAL else self.name(label.text)
        self.joined.union(self.at(label.at), node)
        if label.kind != LOCAL:
            for member in members(label.text):
                self.joined.union(self.name(member), self.everywhere(member) if label.kind == GLOBAL else self.name(member))

    def _join_passing(self, place: Point) -> None:
        here = self.at(place)
        for wire in self._flat.get(place.y, ()):
            if min(wire.start.x, wire.end.x) <= place.x <= max(wire.start.x, wire.end.x):
                self.joined.union(here, self.at(wire.start))
        for wire in self._upright.get(place.x, ()):
            if min(wire.start.y, wire.end.y) <= place.y <= max(wire.start.y, wire.end.y):
                self.joined.union(here, self.at(wire.start))
        for wire in self._slanted:
            if _passes(wire, place):
                self.joined.union(here, self.at(wire.start))


def members(text: str) -> Iterator[str]:
    """The names of a bus's members; none for a name that is no bus."""
    found = _VECTOR.fullmatch(text)
    if found is not None:
        first, last = sorted((int(found[2]), int(found[3])))
        for number in range(first, min(last, first + _MOST_MEMBERS) + 1):
            yield f"{found[1]}{number}{found[4]}"


def _passes(wire: Wire, place: Point) -> bool:
    (x1, y1), (x2, y2) = wire
    if not (min(x1, x2) <= place.x <= max(x1, x2) and min(y1, y2) <= place.y <= max(y1, y2)):
        return False
    return (x2 - x1) * (place.y - y1) == (y2 - y1) * (place.x - x1)
