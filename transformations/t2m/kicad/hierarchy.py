"""The sheets of a KiCad schematic as one drawing: files read from the drawing's folder, symbols as parts, pins as nets.

A sheet file that is used twice gives two sheets with parts of their own, told apart by KiCad's ids. Units with one reference
are one part; each symbol without a number (`U?`) is a part by itself. The reader of each format reads the files.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable

from msgspec import Struct

from robosmi.diagnostics import Location, Severity
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.t2m.connectivity import Joined, Node
from robosmi.transformations.t2m.drawing import CircuitBuilder, End
from robosmi.transformations.t2m.kicad.nets import SheetNets
from robosmi.transformations.t2m.kicad.sheet import (
    MOST_SYMBOLS,
    LibrarySymbol,
    Sheet,
    SheetSymbol,
    SubSheet,
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
