"""Reads a KiCad netlist (`.net` with `(export ...)`), in which KiCad has already computed which pins are joined."""

from __future__ import annotations

from robosmi.diagnostics import Location, Severity
from robosmi.errors import SourceError, TooLargeError
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, free_identity
from robosmi.transformations.t2m.kicad.expressions import Expression, Expressions, Listed, child, children, text_of, word
from robosmi.transformations.t2m.kicad.sheet import net_name, of_library
from robosmi.transformations.t2m.schematic import Schematic, SchematicNet, SchematicPart, with_unique_titles

MOST_PARTS = 50_000
"""Parts of a netlist."""


def fill_from_netlist(text: str, made: Schematic, builder: CircuitBuilder) -> None:
    """Add the parts and nets of a netlist to a schematic.

    Raises:
        SourceError: it is damaged, or has too many parts.
    """
    _Netlist(Expressions(text, made.path), made, builder).fill()


class _Netlist:
    """Reads one file."""

    def __init__(self, listed: Expressions, made: Schematic, builder: CircuitBuilder) -> None:
        self.listed, self.made, self.report = listed, made, builder.report
        self.by_reference: dict[str, SchematicPart] = {}
        self.twice: set[str] = set()
        self.identities: set[str] = set()

    def fill(self) -> None:
        """Read the sections."""
        sections = {entry.head: entry for entry in self.listed.members(self.listed.root)}
        if "components" not in sections or "nets" not in sections:
            place = Location(self.made.path, 1)
            raise SourceError("the netlist has no components or no nets", location=place, fix="export it again from KiCad")
        self.made.version = self._told(self.listed.root, "version")
        library = self._library(sections.get("libparts"))
        components = [*self.listed.members(sections["components"])]
        if len(components) > MOST_PARTS:
            place = Location(self.made.path, self.listed.line(components[MOST_PARTS].start))
            fix = "check that it is the drawing you meant"
            raise TooLargeError(f"it has more than {MOST_PARTS:,} parts", location=place, fix=fix)
        for entry in components:
            self._component(entry, library)
        self.made.parts = with_unique_titles(self.made.parts)
        self._nets(sections["nets"])

    def _told(self, listed: Expression, name: str) -> str:
        return next(
            (text_of([self.listed.parsed(entry)], name) for entry in self.listed.members(listed) if entry.head == name), ""
        )

    def _library(self, section: Expression | None) -> dict[str, tuple[str, dict[str, str]]]:
        """`LIBRARY:NAME` of each symbol, aliases included -> its description and pins."""
        found: dict[str, tuple[str, dict[str, str]]] = {}
        for entry in self.listed.members(section) if section is not None else ():
            part = self.listed.parsed(entry)
            pins = {_number(pin, "num", "name"): text_of(pin, "name") for pin in children(child(part, "pins") or [], "pin")}
            named = {number: name if name not in ("", "~") else number for number, name in pins.items()}
            aliases = [word(alias[1]) for alias in children(child(part, "aliases") or [], "alias") if len(alias) > 1]
            for name in (text_of(part, "part"), *aliases):
                found[f"{text_of(part, 'lib')}:{name}"] = (text_of(part, "description"), named)
        return found

    def _component(self, entry: Expression, library: dict[str, tuple[str, dict[str, str]]]) -> None:
        part, line = self.listed.parsed(entry), self.listed.line(entry.start)
        reference, value = text_of(part, "ref"), text_of(part, "value")
        source = child(part, "libsource") or []
        family, name = text_of(source, "lib"), text_of(source, "part")
        identity, path = _identity(part)
        known = library.get(f"{family}:{name}")
        family, name = of_library(family, name)
        fields = {text_of(f, "name"): word(f[-1]) for f in children(child(part, "fields") or [], "field") if len(f) > 2}
        if reference in self.by_reference:
            cause = f"the reference '{reference}' occurs twice; its pins are left out"
            self.report("RS206", Severity.warning, cause, line, "annotate the schematic and export it again")
            self.twice.add(reference)
        identity = identity or reference or f"line{line}"
        if identity in self.identities:
            identity = free_identity(f"{identity} {reference or line}", line, self.identities)
        self.identities.add(identity)
        made = SchematicPart(
            identity=identity, title=reference, sheet="/".join(path), symbol=name or value,
            listed_as=f"{family}:{name}" if family else name or value, family=family, value="" if value in (name, "~") else value,
            description=text_of(source, "description") or (known[0] if known is not None else ""),
            pins=known[1] if known is not None else {}, properties=fields, line=line, defined=known is not None,
        )  # fmt: skip
        self.by_reference.setdefault(reference, made)
        self.made.parts.append(made)

    def _nets(self, section: Expression) -> None:
        taken: dict[End, SchematicNet] = {}
        for entry in self.listed.members(section):
            net = self.listed.parsed(entry)
            made = SchematicNet(net_name(text_of(net, "name")))
            for node in children(net, "node"):
                number = _number(node, "pin", "pinfunction")
                end = self._end(text_of(node, "ref"), number, self.listed.line(entry.start))
                if end is None or taken.get(end) is made:
                    continue
                if end in taken:
                    cause = f"'{number}' of '{text_of(node, 'ref')}' is on two nets; it was left out of '{made.name}'"
                    self.report(
                        "RS208", Severity.warning, cause, self.listed.line(entry.start), "export the netlist again from KiCad"
                    )
                    continue
                taken[end] = made
                made.ends.append(end)
            if len(made.ends) > 1:
                self.made.nets.append(made)

    def _end(self, reference: str, pin: str, line: int) -> End | None:
        part = self.by_reference.get(reference)
        if part is None:
            cause = f"a net has a pin of '{reference}', but no component has this reference; it was left out"
            self.report("RS207", Severity.warning, cause, line, "export the netlist again from KiCad")
            return None
        if reference in self.twice:
            return None
        if part.pins and pin not in part.pins:
            cause = f"'{reference}' ({part.symbol}) has no pin '{pin}'; it was left out"
            self.report("RS208", Severity.warning, cause, line, "export the netlist again from KiCad")
            return None
        return End(part.identity, pin)


def _number(pin: Listed, number: str, name: str) -> str:
    """The number of a pin, or its name if it has no number."""
    found = text_of(pin, number)
    return found if found not in ("", "~") else text_of(pin, name)


def _identity(part: Listed) -> tuple[str, tuple[str, ...]]:
    """KiCad's id of a component with those of its sheets, and the names of these sheets."""
    sheets = child(part, "sheetpath") or []
    names = tuple(name for name in text_of(sheets, "names").split("/") if name)
    stamps = text_of(sheets, "tstamps").strip("/")
    own = text_of(part, "tstamps").split(" ")[0] or text_of(part, "tstamp")
    return f"{stamps}/{own}".strip("/") if own else "", names
