"""The transformation itself: a KiCad schematic or netlist in, a `hardware.Circuit` and findings out.

Parts have KiCad's own ids as identities, and their references as titles, with the names of their sheets where several parts
have one reference. The format of a file is recognised by its first bytes. Each format of schematics is read by a module of its
own; a netlist (`.net` with `(export ...)`), in which KiCad has already computed which pins are joined, is read here. `schematic`
decides what symbols stand for.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, TooLargeError
from robosmi.metamodels import hardware
from robosmi.transformations.queries.circuits.former_titles import title_on_sheet
from robosmi.transformations.t2m.companions import DrawingFolder
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, free_identity
from robosmi.transformations.t2m.drawing_file import drawing_bytes
from robosmi.transformations.t2m.kicad.expressions import FIX, Expression, Expressions, Listed, child, children, text_of, word
from robosmi.transformations.t2m.kicad.hierarchy import Hierarchy
from robosmi.transformations.t2m.kicad.legacy import HEAD, library_of, read_legacy
from robosmi.transformations.t2m.kicad.modern import read_modern
from robosmi.transformations.t2m.kicad.sheet import Sheet, net_name, of_library
from robosmi.transformations.t2m.schematic import Schematic, SchematicNet, SchematicPart, circuit_of, with_unique_titles

TOOL = "KiCad"
_OTHERS = {
    "gEDA": re.compile(r"v [0-9]{8} [0-9]"),
    "xschem": re.compile(r"v \{xschem version="),
    "Qucs": re.compile(r"<Qucs(?:-S)? Schematic "),
    "LTspice": re.compile(r"Version 4\r?\nSHEET "),
    "Altium": re.compile(r"\|HEADER=Protel for Windows"),
    "TinyCAD": re.compile(r"(?:<\?xml[^>]*>\s*)?<TinyCAD"),
    "Xilinx ISE": re.compile(r"VERSION [0-9]\s*\r?\nBEGIN SCHEMATIC"),
}
"""Tools that call their schematics .sch, too -> how such a file begins."""
_MODERN = re.compile(r"\(\s*kicad_sch\b")
_NETLIST = re.compile(r"\(\s*export\b")
_OLD_NETLIST = re.compile(r"(?:#|\( \{) *EESchema Netlist", re.IGNORECASE)

_MOST_PARTS = 50_000
"""Parts of a netlist."""


def recognises(head: bytes) -> bool:
    """Whether a file that begins so is a schematic or a netlist of KiCad.

    Also True for files with that ending that are refused with advice: old netlists, schematics of other tools.
    """
    text = head.decode("utf-8-sig", "replace").lstrip()
    return text.startswith(HEAD) or any(
        form.match(text) is not None for form in (_MODERN, _NETLIST, _OLD_NETLIST, *_OTHERS.values())
    )


def read_circuit(
    path: str | Path, project: Path | None = None, roles: Mapping[str, str] | None = None, board: str | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read a KiCad schematic with the sheets below it, or a netlist.

    Args:
        path: a `.kicad_sch`, an EESchema `.sch`, or a `.net`.
        project: the project folder, whose own data on parts and boards takes precedence; the current folder if None.
        roles: roles that the user gives to components, by their title or `#id`; they take precedence.
        board: the board where a file does not say which; a schematic always does.

    Returns:
        The circuit, and what was unknown, odd or left out (rules RS203 to RS219).

    Raises:
        SourceError: the file or a sheet of it is damaged, or no schematic; or a sheet has itself in it.
        PlatformDataError: an entry of the catalogue is damaged.
        UsageError: a role or a component in `roles` does not exist, or the title is not unique.
    """
    data = drawing_bytes(Path(path), "schematic", "the .kicad_sch file in it", FIX)
    text = decoded(data, str(path))
    builder = CircuitBuilder(str(path), TOOL.lower(), project)
    folder = DrawingFolder(path)
    made = Schematic(str(path), hashlib.sha256(data).hexdigest(), TOOL, companions=folder.companions)
    begins = text.lstrip()
    if _NETLIST.match(begins) is not None:
        _fill_from_netlist(text, made, builder)
    elif _MODERN.match(begins) is not None or begins.startswith(HEAD):
        sheets = _Sheets(folder, builder)
        root = sheets.root(text, str(path))
        made.version = root.version
        Hierarchy(root, sheets.read, builder).fill(made)
    else:
        for tool, form in _OTHERS.items():
            if form.match(begins) is not None:
                fix = "draw it in KiCad or EAGLE, or write a pin table (docs/reference/pin-tables.md)"
                raise SourceError(f"it is a schematic of {tool}, which is not read", location=Location(str(path), 1), fix=fix)
        old = _OLD_NETLIST.match(begins) is not None
        cause = "netlists of KiCad 3 and before are not supported" if old else "it is neither a schematic nor a netlist of KiCad"
        raise SourceError(cause, location=Location(str(path), 1), fix=FIX)
    former = {part.identity: title_on_sheet(part.sheet, part.title) for part in made.parts if part.sheet}
    builder.give_roles(roles or {}, {part.identity: part.title for part in made.parts}, former)
    return circuit_of(made, builder), builder.findings


class _Sheets:
    """Reads the sheets of a drawing, each file once; symbols of the older format are looked up in the libraries beside it."""

    def __init__(self, folder: DrawingFolder, builder: CircuitBuilder) -> None:
        self.folder, self.builder = folder, builder
        self._found: dict[str, Sheet] = {}

    def root(self, text: str, path: str) -> Sheet:
        """The sheet of the file that was given."""
        return self._sheet(text, path)

    def read(self, named: str, beside: str) -> Sheet | None:
        """The sheet of a file that another one names; None where there is no such file."""
        own = beside.removeprefix(f"{self.folder.path.parent}/") if beside else ""
        data = self.folder.read(named, own)
        name = self.folder.name(named, own)
        if data is None or name is None:
            return None
        if name not in self._found:
            path = str(self.folder.path) if name == self.folder.path.name else str(self.folder.path.parent / name)
            self._found[name] = self._sheet(decoded(data, path), path)
        return self._found[name]

    def _sheet(self, text: str, path: str) -> Sheet:
        if not text.lstrip().startswith(HEAD):
            return read_modern(text, path)
        sheet = read_legacy(text.lstrip(), path)
        sheet.library = library_of(self.folder, (symbol.identity for symbol in sheet.symbols))
        missing = sorted({symbol.identity for symbol in sheet.symbols} - sheet.library.keys())
        if missing:
            shown = ", ".join(missing[:5]) + (", ..." if len(missing) > 5 else "")
            self.builder.report(
                "RS214", Severity.warning,
                f"no library next to the schematic has {shown}, so their pins are unknown and not wired",
                None, f"put {self.folder.path.stem}-cache.lib next to it, or open it in KiCad 6 or newer and save it",
            )  # fmt: skip
        return sheet


def decoded(data: bytes, path: str) -> str:
    """The text of a file of KiCad's.

    Raises:
        SourceError: it is not UTF-8.
    """
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise SourceError(f"it is not UTF-8: {error.reason}", location=Location(path), fix=FIX) from error


def _fill_from_netlist(text: str, made: Schematic, builder: CircuitBuilder) -> None:
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
        if len(components) > _MOST_PARTS:
            place = Location(self.made.path, self.listed.line(components[_MOST_PARTS].start))
            fix = "check that it is the drawing you meant"
            raise TooLargeError(f"it has more than {_MOST_PARTS:,} parts", location=place, fix=fix)
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
