"""The sheets of a KiCad schematic as one drawing: files read from the drawing's folder, symbols as parts, pins as nets.

A sheet file that is used twice gives two sheets with parts of their own, told apart by KiCad's ids. Units with one reference
are one part; each symbol without a number (`U?`) is a part by itself. The reader of each format reads the files.

Pins are one net by position, by wires and junctions, by labels, by buses, across sheets. The rules are those of KiCad's own
netlist. A wire joins what is at its ends; a junction or a label joins the wires that pass its position; pins at one position
are joined. Labels of a sheet join by their text on that sheet; global labels and power symbols join everywhere, and include
what bears their name on the same sheet. A pin of a sheet symbol is joined with the label of its name inside the sheet.

A bus is named by the labels on its lines: a vector (`D[0..7]`), a group (`{SCL SDA}`, `USB{DP DM}` with the member `USB.DP`),
or one of these with an alias for several members (`bus_alias`). Nets join a bus by the names of its members. Where a bus has
two names, members of equal names are joined, and members of different names by position.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.diagnostics import Location, Severity
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.t2m.connectivity import Joined, Node
from robosmi.transformations.t2m.drawing import CircuitBuilder, End
from robosmi.transformations.t2m.kicad.sheet import (
    GLOBAL,
    MOST_SYMBOLS,
    Label,
    LibrarySymbol,
    Point,
    Sheet,
    SheetSymbol,
    SubSheet,
    Wire,
    net_name,
    of_library,
    placed_at,
)
from robosmi.transformations.t2m.schematic import Schematic, SchematicNet, SchematicPart, with_unique_titles

MOST_SHEETS = 1_000
"""Sheets of a drawing, counted once for each use of a sheet file."""

SheetReader = Callable[[str, str], Sheet | None]
"""Reads a sheet file, given its path and that of the file that names it, both relative to the folder; else None."""


class _Part(Struct):
    """A part whose units are being collected."""

    identity: str
    title: str
    sheet: str
    symbol: SheetSymbol
    library: LibrarySymbol | None
    nodes: list[tuple[str, Node]] = []
    units: set[int] = set()


class Hierarchy:
    """Collects the parts and nets of all sheets of a drawing.

    Args:
        root: the sheet of the file that was given.
        read: the function that reads a further sheet.
        builder: the builder that collects the findings.
    """

    def __init__(self, root: Sheet, read: SheetReader, builder: CircuitBuilder) -> None:
        self.root, self.read, self.report = root, read, builder.report
        self.joined = Joined()
        self.parts: dict[str, _Part] = {}
        self.aliases: dict[str, list[str]] = {}
        self._by_reference: dict[tuple[str, str, str], _Part] = {}
        self._sheets = self._symbols = 0
        self._walk(root, "", f"/{root.uuid}" if root.uuid else "", (), ())

    def fill(self, made: Schematic) -> None:
        """Add the parts and nets to a schematic."""
        made.parts = with_unique_titles([self._part(part) for part in self.parts.values()])
        ends: dict[Node, dict[End, None]] = {}
        for part in self.parts.values():
            for connector, node in part.nodes:
                ends.setdefault(self.joined.find(node), {})[End(part.identity, connector)] = None
        names: dict[Node, str] = {}
        for node in sorted(self.joined.parent):  # names of the whole drawing have no sheet, so they come first
            if node[1].startswith("name "):
                names.setdefault(self.joined.find(node), node[1].removeprefix("name "))
        wired = {root: found for root, found in ends.items() if len(found) > 1 or root in names}
        unclear = self._on_several(wired.values())
        for root, found in wired.items():
            if left := [end for end in found if end not in unclear]:
                made.nets.append(SchematicNet(net_name(names.get(root, "")), left))

    def _on_several(self, nets: Iterable[Iterable[End]]) -> set[End]:
        """The connectors on more than one net, with a finding for each: several pins have its number."""
        counts = Counter(end for net in nets for end in net)
        found = {end for end, count in counts.items() if count > 1}
        for part in self.parts.values():
            numbers = [end.connector for end in sorted(found) if end.component == part.identity] if found else []
            if numbers:
                told = ", ".join(numbers)
                cause = f"the number {told} of '{part.title}' belongs to pins on several nets: they were left out"
                line = part.symbol.line if part.symbol in self.root.symbols else None
                self.report("RS208", Severity.warning, cause, line, "give each pin of the symbol a unique number in KiCad")
        return found

    def _walk(self, sheet: Sheet, file: str, path: str, names: tuple[str, ...], inside: tuple[str, ...]) -> SheetNets:
        self._sheets += 1
        if self._sheets > MOST_SHEETS:
            raise self._error(f"it has more than {MOST_SHEETS:,} sheets", 1)
        self.aliases.update(sheet.aliases)
        nets = SheetNets(self.joined, path, sheet, self.aliases)
        for symbol in sheet.symbols:
            self._take(sheet, symbol, path, names, nets)
        for below in sheet.sheets:
            self._below(sheet, below, file, path, names, inside, nets)
        nets.close()
        return nets

    def _below(
        self,
        sheet: Sheet,
        below: SubSheet,
        file: str,
        path: str,
        names: tuple[str, ...],
        inside: tuple[str, ...],
        nets: SheetNets,
    ) -> None:
        found = self.read(below.file, file)
        if found is None:
            cause = f"the sheet '{below.name}' has no file '{below.file}' in the drawing's folder, so its parts are unknown"
            line = below.line if sheet is self.root else None
            self.report("RS214", Severity.warning, cause, line, "put the file next to the drawing")
            return
        if found.file == self.root.file or found.file in inside:
            cause = f"the sheet '{below.name}' ({below.file}) contains itself"
            raise SourceError(cause, location=Location(sheet.file, below.line), fix="remove the inner one in KiCad")
        inner = self._walk(found, found.file, f"{path}/{below.uuid}", (*names, below.name), (*inside, found.file))
        for pin in below.pins:
            nets.sheet_pin(pin, inner)
        inner.close()

    def _take(self, sheet: Sheet, symbol: SheetSymbol, path: str, names: tuple[str, ...], nets: SheetNets) -> None:
        self._symbols += 1
        if self._symbols > MOST_SYMBOLS:
            raise self._error(f"it has more than {MOST_SYMBOLS:,} symbols", symbol.line)
        library = sheet.library.get(symbol.library)
        reference, unit = self._named(symbol, path)
        part = self._of_reference(symbol, library, reference, unit, path, names, sheet)
        for connector, pin in library.connectors(symbol.style) if library is not None else ():
            if unit and pin.unit not in (0, unit):  # unit 0 shows all
                continue
            node = nets.at(placed_at(symbol, pin))
            part.nodes.append((connector, node))
            self.joined.find(node)
            if library is not None and pin.kind == "power_in" and (library.power or pin.hidden):
                name = symbol.properties.get("Value", "") if library.power and sheet.by_value else pin.name
                if name:
                    self.joined.union(node, nets.name(name) if library.power and library.local else nets.everywhere(name))

    def _of_reference(
        self, symbol: SheetSymbol, library: LibrarySymbol | None, reference: str, unit: int, path: str, names: tuple[str, ...],
        sheet: Sheet,
    ) -> _Part:  # fmt: skip
        """The part that a symbol is a unit of, created if it is the first."""
        identity = f"{path}/{symbol.uuid}".removeprefix(f"/{self.root.uuid}/").strip("/") or f"line{symbol.line}"
        numbered = bool(reference) and not reference.endswith("?") and not (library is not None and library.power)
        key = (reference, symbol.identity, "" if numbered else identity)
        part = self._by_reference.get(key)
        if part is not None and unit not in part.units:
            part.units.add(unit)
            return part
        if part is not None:
            line = symbol.line if sheet is self.root else None
            cause = f"the reference '{reference}' occurs twice: this '{symbol.identity}' becomes a separate part"
            self.report("RS206", Severity.warning, cause, line, "annotate the schematic again in KiCad")
        number = 1
        while identity in self.parts:
            number += 1
            identity = f"{identity.partition(' ')[0]} {number}"
        made = _Part(identity, reference, "/".join(names), symbol, library, units={unit})
        self.parts[identity] = made
        self._by_reference.setdefault(key, made)
        return made

    def _named(self, symbol: SheetSymbol, path: str) -> tuple[str, int]:
        """The reference and the unit of a symbol on the sheet with this path."""
        kept = self.root.instances.get(f"{path}/{symbol.uuid}".removeprefix(f"/{self.root.uuid}"))
        if kept is not None:
            return kept
        reference = symbol.references.get(path) or symbol.properties.get("Reference", "")
        return reference, symbol.units.get(path, symbol.unit)

    def _part(self, part: _Part) -> SchematicPart:
        symbol, library = part.symbol, part.library
        family, _, name = symbol.identity.rpartition(":")
        family, name = of_library(family, name)
        pins = {pin: found.name or pin for pin, found in library.connectors(symbol.style)} if library else {}
        power = library is not None and library.power
        value = symbol.properties.get("Value", "")
        kept = {key: text for key, text in symbol.properties.items() if text not in ("", "~") and key not in _OWN}
        return SchematicPart(
            identity=part.identity, title=part.title, symbol=name or symbol.identity,
            listed_as=f"{family}:{name}" if family else name,
            family=family, value="" if value in (name, "~") else value, description=library.description if library else "",
            tags=tuple(library.keywords.split()) if library else (), pins=pins, properties=kept,
            line=symbol.line if symbol in self.root.symbols else None, power=power, defined=library is not None,
            sheet=part.sheet,
        )  # fmt: skip

    def _error(self, cause: str, line: int) -> TooLargeError:
        return TooLargeError(cause, location=Location(self.root.file, line), fix="check that it is the drawing you meant")


_OWN = ("Reference", "Value", "Datasheet", "Description", "ki_description", "ki_keywords", "ki_fp_filters", "ki_locked")


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

    def __init__(self, joined: Joined, path: str, sheet: Sheet, aliases: _Aliases) -> None:
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
        return _members_of(text, self._aliases)

    def sheet_pin(self, pin: Label, below: SheetNets) -> None:
        """Join a pin of a sheet symbol with the label of its name inside that sheet."""
        inside = below.members(pin.text) or self.members(pin.text)
        if not inside:
            self.joined.union(self.at(pin.at), below.name(pin.text))
            return
        for outer, inner in _pairs(self._on_bus(pin.at, inside), inside):
            self.joined.union(self.name(outer), below.name(inner))

    def _named(self, label: Label) -> None:
        found = self.members(label.text)
        if found:
            for one, other in _pairs(self._on_bus(label.at, found), found):
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

_Aliases = Mapping[str, Sequence[str]]
"""Alias of several members of a bus -> their names."""


def _members_of(text: str, aliases: _Aliases | None = None) -> list[str]:
    """The names of a bus's members, a thousand at most; none for a name that is no bus.

    >>> [_members_of(text) for text in ("D[0..2]", "USB{DP DM}", "{OE A[0..1]}", "I{slash}O", "${NET}")]
    [['D0', 'D1', 'D2'], ['USB.DP', 'USB.DM'], ['OE', 'A0', 'A1'], [], []]
    """
    return [name for name, _ in zip(_members(text, aliases or {}, _DEEPEST), range(_MOST_MEMBERS), strict=False)]


def _members(text: str, aliases: _Aliases, depth: int) -> Iterator[str]:
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


def _pairs(one: Sequence[str], other: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The pairs of members that two names of one bus join: those of equal name, else those at equal positions."""
    shared = {*one} & {*other}
    if shared:
        yield from ((name, name) for name in one if name in shared)
    else:
        yield from zip(one, other, strict=False)
