"""Which pins of a KiCad schematic are one net: by position, by wires and junctions, by labels, by buses, across sheets.

The rules are those of KiCad's own netlist. A wire joins what is at its ends; a junction or a label joins the wires that pass
its position; pins at one position are joined. Labels of a sheet join by their text on that sheet; global labels and power
symbols join everywhere, and include what bears their name on the same sheet. A pin of a sheet symbol is joined with the label
of its name inside the sheet.

A bus is named by the labels on its lines: a vector (`D[0..7]`), a group (`{SCL SDA}`, `USB{DP DM}` with the member `USB.DP`),
or one of these with an alias for several members (`bus_alias`). Nets join a bus by the names of its members. Where a bus has
two names, members of equal names are joined, and members of different names by position.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence

from robosmi.transformations.t2m.connectivity import Joined, Node
from robosmi.transformations.t2m.kicad.sheet import GLOBAL, Label, Point, Sheet, Wire


class _Lines:
    """The wires or the bus lines of a sheet, each of which joins what is at its ends."""

    def __init__(self, joined: Joined, path: str, kind: str, lines: Iterable[Wire], junctions: Iterable[Point]) -> None:
        self.joined, self.path, self.kind = joined, path, kind
        self._flat: dict[int, list[Wire]] = {}
        self._upright: dict[int, list[Wire]] = {}
        self._slanted: list[Wire] = []
        for line in lines:
            joined.union(self.at(line.start), self.at(line.end))
            if line.start.y == line.end.y:
                self._flat.setdefault(line.start.y, []).append(line)
            elif line.start.x == line.end.x:
                self._upright.setdefault(line.start.x, []).append(line)
            else:
                self._slanted.append(line)
        for place in junctions:
            self.join_passing(place)

    def at(self, place: Point) -> Node:
        """The node of a position."""
        return self.path, f"{self.kind}{place.x} {place.y}"

    def join_passing(self, place: Point) -> bool:
        """Join a position with the lines that pass through it; False if there are none."""
        here, found = self.at(place), False
        for line in self._passing(place):
            self.joined.union(here, self.at(line.start))
            found = True
        return found

    def _passing(self, place: Point) -> Iterable[Wire]:
        for line in self._flat.get(place.y, ()):
            if min(line.start.x, line.end.x) <= place.x <= max(line.start.x, line.end.x):
                yield line
        for line in self._upright.get(place.x, ()):
            if min(line.start.y, line.end.y) <= place.y <= max(line.start.y, line.end.y):
                yield line
        for line in self._slanted:
            if _passes(line, place):
                yield line


class SheetNets:
    """Joins the pins and labels of one sheet of a hierarchy.

    Args:
        joined: the disjoint sets of the whole drawing.
        path: identity of the sheet in the hierarchy.
        sheet: its records.
        aliases: aliases of bus members, including those of the sheets above.
    """

    def __init__(self, joined: Joined, path: str, sheet: Sheet, aliases: Aliases) -> None:
        self.joined, self.path, self._aliases = joined, path, aliases
        self._local: set[str] = set()
        self._global: set[str] = set()
        self._wires = _Lines(joined, path, "", sheet.wires, sheet.junctions)
        self._buses = _Lines(joined, path, "bus ", sheet.buses, sheet.junctions)
        self._named_buses: dict[Node, list[str]] = {}
        for label in sheet.labels:
            self._named(label)
        labelled = {label.at for label in sheet.labels}
        for one, other in sheet.entries:
            for end, wire in ((one, other), (other, one)):
                if end in labelled and self._buses.join_passing(end):  # a label at the bus's end of an entry is that of its wire
                    joined.union(self.at(end), self.at(wire))

    def at(self, place: Point) -> Node:
        """The node of a position."""
        return self._wires.at(place)

    def name(self, text: str) -> Node:
        """The node of a name that is local to this sheet."""
        self._local.add(text)
        return self.path, f"name {text}"

    def everywhere(self, text: str) -> Node:
        """The node of a name that is global to the drawing."""
        self._global.add(text)
        return "", f"name {text}"

    def close(self) -> None:
        """Join each local name of the sheet with the global name of the same text, if that is used on this sheet."""
        for text in self._local & self._global:
            self.joined.union(self.name(text), self.everywhere(text))

    def members(self, text: str) -> list[str]:
        """The names of a bus's members; empty for a name that is no bus."""
        return members(text, self._aliases)

    def sheet_pin(self, pin: Label, below: SheetNets) -> None:
        """Join a pin of a sheet symbol with the label of its name inside that sheet."""
        inside = below.members(pin.text) or self.members(pin.text)
        if not inside:
            self.joined.union(self.at(pin.at), below.name(pin.text))
            return
        for outer, inner in pairs(self._on_bus(pin.at, inside), inside):
            self.joined.union(self.name(outer), below.name(inner))

    def _named(self, label: Label) -> None:
        found = self.members(label.text)
        if found:
            for one, other in pairs(self._on_bus(label.at, found), found):
                self.joined.union(self.name(one), self.name(other))
            for member in found if label.kind == GLOBAL else ():
                self.joined.union(self.name(member), self.everywhere(member))
            return
        self._wires.join_passing(label.at)
        self.joined.union(self.at(label.at), self.everywhere(label.text) if label.kind == GLOBAL else self.name(label.text))

    def _on_bus(self, place: Point, names: list[str]) -> Sequence[str]:
        """The members of the bus at a position, named as its first label or pin did; `names` if it has none yet."""
        if not self._buses.join_passing(place):
            return names
        return self._named_buses.setdefault(self.joined.find(self._buses.at(place)), names)


def _passes(wire: Wire, place: Point) -> bool:
    (x1, y1), (x2, y2) = wire
    if not (min(x1, x2) <= place.x <= max(x1, x2) and min(y1, y2) <= place.y <= max(y1, y2)):
        return False
    return (x2 - x1) * (place.y - y1) == (y2 - y1) * (place.x - x1)


# ---- buses

_VECTOR = re.compile(r"(.*)\[([0-9]{1,4})\.\.([0-9]{1,4})\]((?s:.*))")
_GROUP = re.compile(r"([^{}]*(?<!\$))\{(.*)\}")  # `${NAME}` is a text variable
_ESCAPES = frozenset(("slash", "backslash", "space", "tab", "return", "colon", "brace", "lt", "gt", "quote", "dblquote", "bar"))
_MOST_MEMBERS = 1_000
_DEEPEST = 5

Aliases = Mapping[str, Sequence[str]]
"""Alias of several members of a bus -> their names."""


def members(text: str, aliases: Aliases | None = None) -> list[str]:
    """The names of a bus's members, a thousand at most; none for a name that is no bus.

    >>> members("D[0..2]"), members("USB{DP DM}"), members("{OE A[0..1]}"), members("I{slash}O"), members("${NET}")
    (['D0', 'D1', 'D2'], ['USB.DP', 'USB.DM'], ['OE', 'A0', 'A1'], [], [])
    """
    return [name for name, _ in zip(_members(text, aliases or {}, _DEEPEST), range(_MOST_MEMBERS), strict=False)]


def _members(text: str, aliases: Aliases, depth: int) -> Iterator[str]:
    group = _GROUP.fullmatch(text)
    if group is not None and group[2] not in _ESCAPES and depth:
        prefix = f"{group[1]}." if group[1] else ""
        for member in (listed for word in group[2].split() for listed in aliases.get(word, (word,))):
            inner = [*_members(member, aliases, depth - 1)]
            yield from (f"{prefix}{name}" for name in inner or [member])
        return
    found = _VECTOR.fullmatch(text)
    if found is not None:
        first, last = sorted((int(found[2]), int(found[3])))  # as KiCad counts, whichever way it is written
        for number in range(first, last + 1):
            yield f"{found[1]}{number}{found[4]}"


def pairs(one: Sequence[str], other: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The pairs of members that two names of one bus join: those of equal name, else those at equal positions."""
    shared = {*one} & {*other}
    if shared:
        yield from ((name, name) for name in one if name in shared)
    else:
        yield from zip(one, other, strict=False)
