"""The transformation itself: a KiCad schematic or netlist in, a `hardware.Circuit` and findings out.

Parts have KiCad's own ids as identities, and their references as titles, with the names of their sheets where several parts
have one reference. The format
of a file is recognised by its first bytes; each format is read by a module of its own, and `schematic` decides what symbols
stand for.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.metamodels import hardware
from robosmi.transformations.queries.circuits.former_titles import title_on_sheet
from robosmi.transformations.t2m.companions import DrawingFolder
from robosmi.transformations.t2m.drawing import CircuitBuilder
from robosmi.transformations.t2m.drawing_file import drawing_bytes
from robosmi.transformations.t2m.kicad.expressions import FIX
from robosmi.transformations.t2m.kicad.hierarchy import Hierarchy
from robosmi.transformations.t2m.kicad.legacy import HEAD, read_legacy
from robosmi.transformations.t2m.kicad.modern import read_modern
from robosmi.transformations.t2m.kicad.netlist import fill_from_netlist
from robosmi.transformations.t2m.kicad.sheet import Sheet
from robosmi.transformations.t2m.kicad.symbol_library import library_of
from robosmi.transformations.t2m.schematic import Schematic, circuit_of

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
        fill_from_netlist(text, made, builder)
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
