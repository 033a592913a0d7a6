"""An EAGLE schematic as records: parts with their devices, nets with the pins on them over all sheets and module instances.

Nets of one name are one net, whatever sheet they are on. Parts and nets of a module instance are prefixed with its name
(`M1:R1`); a net of the instance that has the name of one of the module's ports is joined with that port's net outside. Supply
pins of gates that are not drawn are on the net of their name, as in EAGLE.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from lxml import etree
from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.transformations.t2m.drawing_file import drawing_bytes
from robosmi.transformations.t2m.eagle.library import EagleDevice, EagleLibraries
from robosmi.transformations.t2m.guarded_xml import line_of, parse_xml

MOST_PARTS = 20_000
"""Parts of a schematic, those of module instances counted with each; the largest public one has a few thousand."""

MOST_INSTANCES, MOST_ELEMENTS = 1_000, 500_000
"""Module instances of a schematic, and XML elements in their modules, those inside of others counted with each."""

MOST_LEVELS = 20
"""Module instances inside module instances."""

_FIX = "open it in EAGLE 6 or newer and save it again"
_BINARY = (b"\x10\x00", b"\x10\x80")


class EaglePart(Struct):
    """A part: its name with those of its module instances, library, device set, device, value, attributes, line; its device."""

    name: str
    library: str
    deviceset: str
    device: str
    technology: str
    value: str
    attributes: dict[str, str]
    line: int
    found: EagleDevice | None
    gates: set[str] = set()


class PinRef(Struct, frozen=True):
    """A pin on a net: name of the part, gate, name of the pin as written, line."""

    part: str
    gate: str
    pin: str
    line: int


class EagleSchematic:
    """What a file held.

    Attributes:
        path: as given.
        digest: SHA-256 of the file's bytes, hexadecimal.
        version: of EAGLE, as the file has it.
        parts: in the file's order; names need not be unique.
        nets: name -> the pins on it.
        joined: pairs of nets that are one: a port of a module instance and the net inside it.
        missing: module instances whose module is not there, with their lines.
    """

    def __init__(self, path: str, digest: str, version: str) -> None:
        self.path = path
        self.digest = digest
        self.version = version
        self.parts: list[EaglePart] = []
        self.nets: dict[str, list[PinRef]] = {}
        self.joined: list[tuple[str, str]] = []
        self.missing: list[tuple[str, int]] = []


def recognises(head: bytes) -> bool:
    """Whether a file that begins so is an EAGLE drawing: XML, or a binary file of EAGLE 5 and before, which is refused."""
    if head.startswith(_BINARY):
        return True
    text = head.decode("utf-8-sig", "replace").lstrip()
    return text.startswith("<") and "<eagle" in text


def read_schematic(path: Path) -> EagleSchematic:
    """The records of a `.sch` of EAGLE 6 and on.

    Raises:
        SourceError: the file is missing, not readable, damaged, of an older EAGLE, no schematic, or too large.
    """
    data = drawing_bytes(path, "schematic", "the .sch file in it", _FIX)
    if data.startswith(_BINARY):
        cause = "it is a binary file of EAGLE 5 or before, which is not read"
        raise SourceError(cause, location=Location(str(path)), fix=_FIX)
    root = parse_xml(data, str(path), path.name, "EAGLE", "eagle")
    drawn = root.find("drawing/schematic")
    if root.tag != "eagle" or drawn is None:
        kind = (
            "a board"
            if root.find("drawing/board") is not None
            else "a library"
            if root.find("drawing/library") is not None
            else ""
        )
        cause = f"it is {kind} of EAGLE, not a schematic" if kind else f"it is no EAGLE schematic: its root is <{root.tag}>"
        raise SourceError(cause, location=Location(str(path), line_of(root)), fix="give the .sch file of the schematic")
    made = EagleSchematic(str(path), hashlib.sha256(data).hexdigest(), root.get("version", ""))
    _Reading(made, drawn).all_of(drawn, "", ())
    return made


class _Reading:
    """Collects the records of one schematic, sheet by sheet."""

    def __init__(self, made: EagleSchematic, drawn: etree._Element) -> None:
        self.made, self.instances, self.elements = made, 0, 0
        self.sizes: dict[str, int] = {}
        self.libraries = EagleLibraries(drawn)
        self.modules = {module.get("name", ""): module for module in drawn.iterfind("modules/module")}

    def all_of(self, owner: etree._Element, prefix: str, inside: tuple[str, ...]) -> None:
        """Collect the parts and nets of the schematic or of a module instance."""
        own: dict[str, EaglePart] = {}
        for element in owner.iterfind("parts/part"):
            part = self._part(element, prefix)
            own[part.name] = part
        for instance in owner.iterfind("sheets/sheet/instances/instance"):
            if (placed := own.get(prefix + instance.get("part", ""))) is not None:
                placed.gates.add(instance.get("gate", ""))
        ports = dict(self._instances(owner, prefix, inside))
        names: dict[str, None] = {}
        for net in owner.iterfind("sheets/sheet/nets/net"):
            names[self._net(net, prefix, ports)] = None
        self._supplies_by_name(own, names, prefix)

    def _part(self, element: etree._Element, prefix: str) -> EaglePart:
        library, deviceset, device = (element.get(key, "") for key in ("library", "deviceset", "device"))
        found = self.libraries.device(library, element.get("library_urn", ""), deviceset, device)
        attributes = {a.get("name", ""): a.get("value", "") for a in element.iterfind("attribute")}
        part = EaglePart(
            prefix + element.get("name", ""), library, deviceset, device, element.get("technology", ""), element.get("value", ""),
            attributes, line_of(element), found,
        )  # fmt: skip
        self.made.parts.append(part)
        self._hold(len(self.made.parts), MOST_PARTS, "parts", element)
        return part

    def _hold(self, count: int, most: int, what: str, element: etree._Element) -> None:
        if count > most:
            cause = f"it has more than {most:,} {what}"
            place = Location(self.made.path, line_of(element))
            raise SourceError(cause, location=place, fix="check that it is the drawing you meant")

    def _instances(self, owner: etree._Element, prefix: str, inside: tuple[str, ...]) -> Iterator[tuple[str, set[str]]]:
        """Collect the contents of the module instances; yields the name of each instance with the names of its ports."""
        for element in owner.iterfind("sheets/sheet/moduleinsts/moduleinst"):
            name, kind = element.get("name", ""), element.get("module", "")
            module = self.modules.get(kind)
            if kind in inside or len(inside) >= MOST_LEVELS:
                place = Location(self.made.path, line_of(element))
                raise SourceError(f"the module '{kind}' has itself in it", location=place, fix="remove the inner one in EAGLE")
            if module is None:
                self.made.missing.append((kind, line_of(element)))
                continue
            self.instances += 1
            self.elements += self._size(kind, module)
            self._hold(self.instances, MOST_INSTANCES, "module instances", element)
            self._hold(self.elements, MOST_ELEMENTS, "elements in its module instances", element)
            self.all_of(module, f"{prefix}{name}:", (*inside, kind))
            yield name, {port.get("name", "") for port in module.iterfind("ports/port")}

    def _size(self, kind: str, module: etree._Element) -> int:
        if kind not in self.sizes:
            self.sizes[kind] = sum(1 for _ in module.iter())
        return self.sizes[kind]

    def _net(self, net: etree._Element, prefix: str, ports: dict[str, set[str]]) -> str:
        name = prefix + net.get("name", "")
        pins = self.made.nets.setdefault(name, [])
        for ref in net.iterfind("segment/pinref"):
            pins.append(PinRef(prefix + ref.get("part", ""), ref.get("gate", ""), ref.get("pin", ""), line_of(ref)))
        for ref in net.iterfind("segment/portref"):
            instance, port = ref.get("moduleinst", ""), ref.get("port", "")
            if port in ports.get(instance, ()):
                inner = f"{prefix}{instance}:{port}"
                self.made.nets.setdefault(inner, [])
                self.made.joined.append((name, inner))
        return name

    def _supplies_by_name(self, own: dict[str, EaglePart], names: Iterable[str], prefix: str) -> None:
        """Put each supply pin without a wire on the net of its name, as EAGLE does.

        That is the net with a supply symbol of this name, else the net called so. Gates that need not be drawn count, too.
        """
        wired: set[tuple[str, str, str]] = set()
        nets: dict[str, str] = {}
        for name in names:
            for ref in self.made.nets[name]:
                part = own.get(ref.part)
                wired.add((ref.part, ref.gate, ref.pin))
                if part is not None and part.found is not None:
                    pin = part.found.pins.get((ref.gate, ref.pin))
                    if pin is not None and pin.direction == "sup":
                        nets.setdefault(pin.name, name)
        for part in own.values():
            if (found := part.found) is None:
                continue
            for pin in found.pins.values():
                there = pin.gate in part.gates or found.addlevels.get(pin.gate) == "request"
                if pin.direction == "pwr" and there and (part.name, pin.gate, pin.written) not in wired:
                    refs = self.made.nets.setdefault(nets.get(pin.name, prefix + pin.name), [])
                    refs.append(PinRef(part.name, pin.gate, pin.written, part.line))
