"""Reads an EAGLE schematic: a file in, a `hardware.Circuit` and findings out.

Parts have the names that EAGLE gives them, which are also their identities. A pin on an unknown part, an unknown pin, or a name
that stands twice, is left out and reported. `schematic` decides what symbols stand for.

The file is first read into records: parts with their devices, nets with the pins on them over all sheets and module instances.
Nets of one name are one net, whatever sheet they are on. Parts and nets of a module instance are prefixed with its name
(`M1:R1`); a net of the instance that has the name of one of the module's ports is joined with that port's net outside. Supply
pins of gates that are not drawn are on the net of their name, as in EAGLE.

EAGLE copies into each schematic what it uses of its libraries: device sets with their gates, symbols and pins. A pin is
identified by gate and name; if several gates have a pin of one name, the gate is part of the connector's identity
(`connectors_of`).
"""

from __future__ import annotations

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from html import unescape
from pathlib import Path

from lxml import etree
from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError, TooLargeError, did_you_mean
from robosmi.metamodels import hardware
from robosmi.transformations.t2m.connectivity import Joined
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, free_identity
from robosmi.transformations.t2m.drawing_file import drawing_bytes
from robosmi.transformations.t2m.guarded_xml import line_of, parse_xml
from robosmi.transformations.t2m.schematic import Schematic, SchematicNet, SchematicPart, circuit_of

TOOL = "EAGLE"

_TAG = re.compile(r"<[^<>]*>")
_COUNTER = re.compile(r"@[^@]*$")
_OVERLINE = "!"
_LONGEST = 200


def read_circuit(
    path: str | Path, project: Path | None = None, roles: Mapping[str, str] | None = None, board: str | None = None
) -> tuple[hardware.Circuit, list[Finding]]:
    """Read an EAGLE schematic.

    Args:
        path: a `.sch` of EAGLE 6 or newer.
        project: the project folder, whose own data on parts and boards takes precedence; the current folder if None.
        roles: roles that the user gives to components, by their name or `#name`; they take precedence.
        board: the board where a file does not say which; a schematic always does.

    Returns:
        The circuit, and what was unknown, odd or left out (rules RS203 to RS219).

    Raises:
        SourceError: the file is missing, damaged, or no schematic.
        PlatformDataError: an entry of the catalogue is damaged.
        UsageError: a role or a component in `roles` does not exist, or the title is not unique.
    """
    document = read_schematic(Path(path))
    builder = CircuitBuilder(document.path, TOOL.lower(), project)
    drawn = _Drawn(document, builder).schematic()
    builder.give_roles(roles or {}, {part.identity: part.title for part in drawn.parts})
    return circuit_of(drawn, builder), builder.findings


class _Drawn:
    """The records of an EAGLE file converted to those that all schematic tools share."""

    def __init__(self, document: EagleSchematic, builder: CircuitBuilder) -> None:
        self.document, self.report = document, builder.report
        self.twice = {name for name, count in Counter(part.name for part in document.parts).items() if count > 1}
        self.parts = self._identified()
        wired: dict[str, list[tuple[str, str]]] = {}
        for pin in (each for pins in document.nets.values() for each in pins):
            wired.setdefault(pin.part, []).append((pin.gate, pin.pin))
        self.wired = {part: connectors_of(pins) for part, pins in wired.items()}

    def _identified(self) -> dict[str, EaglePart]:
        found: dict[str, EaglePart] = {}
        for part in self.document.parts:
            identity = free_identity(part.name, part.line, found)
            if identity != part.name:
                why = f"the name '{part.name}' occurs twice" if part.name else "a part has no name"
                self.report(
                    "RS206", Severity.warning, f"{why}: this '{part.deviceset}' becomes {identity}, without its wires",
                    part.line, "give each part a unique name in EAGLE",
                )  # fmt: skip
                self.twice.add(part.name)
            found[identity] = part
        return found

    def schematic(self) -> Schematic:
        """The parts and the nets."""
        for module, line in self.document.missing:
            self.report("RS214", Severity.warning, f"unknown module '{module}': it was left out", line, "add it in EAGLE")
        for identity, part in self.parts.items():
            if part.found is None:
                self.report(
                    "RS214", Severity.warning,
                    f"the drawing has no symbol for '{identity}' ('{part.deviceset}' of '{part.library}'), only its wired pins",
                    part.line, "update the library in EAGLE and save the schematic again",
                )  # fmt: skip
        made = Schematic(self.document.path, self.document.digest, TOOL, self.document.version)
        made.parts = [_part(identity, part, self.wired.get(identity, {})) for identity, part in self.parts.items()]
        joined = Joined()
        for one, other in self.document.joined:
            joined.union((one, ""), (other, ""))
        nets: dict[str, SchematicNet] = {}
        taken: set[End] = set()
        for name, pins in self.document.nets.items():
            net = nets.setdefault(joined.find((name, ""))[0], SchematicNet(name))
            for pin in pins:
                end = self._end(pin)
                if end is None:
                    continue
                if end in taken and end not in net.ends:
                    self.report(
                        "RS208", Severity.warning, f"'{pin.pin}' of '{pin.part}' is on two nets; it was left out of '{name}'",
                        pin.line, "correct the net in EAGLE",
                    )  # fmt: skip
                elif end not in taken:
                    taken.add(end)
                    net.ends.append(end)
        made.nets = [net for net in nets.values() if net.ends]
        return made

    def _end(self, pin: PinRef) -> End | None:
        left_out = "; it was left out"
        if pin.part in self.twice:
            cause = f"'{pin.part}' on a net is ambiguous: the name occurs twice{left_out}"
            self.report("RS206", Severity.warning, cause, pin.line, "give each part a unique name in EAGLE")
            return None
        part = self.parts.get(pin.part)
        if part is None:
            cause = f"a net has a pin of '{pin.part}', but no part has this name{did_you_mean(pin.part, self.parts)}{left_out}"
            self.report("RS207", Severity.warning, cause, pin.line, "correct the net, or add the part")
            return None
        if part.found is None:  # its wired pins alone show what its gates are
            return End(pin.part, self.wired[pin.part][pin.gate, pin.pin])
        found = part.found.pins.get((pin.gate, pin.pin))
        if found is None:
            names = [known.written for known in part.found.pins.values()]
            guess = did_you_mean(pin.pin, names)
            cause = f"'{pin.part}' ({part.deviceset}) has no pin '{pin.pin}' in gate '{pin.gate}'{guess}{left_out}"
            self.report("RS208", Severity.warning, cause, pin.line, "update the part from its library in EAGLE")
            return None
        return End(pin.part, found.connector)


def _part(identity: str, part: EaglePart, wired: Mapping[tuple[str, str], str]) -> SchematicPart:
    """The part in the form that all schematic tools share; its id is the library's name and the device set.

    Args:
        identity: the part's identity.
        part: as it was read.
        wired: its pins that are on nets, all that is known of a part without its library: gate and name -> connector.
    """
    found = part.found
    known = found.pins.values() if found is not None else ()
    pins = {pin.connector: pin.name for pin in known} or {pin: _spoken(name) for (_, name), pin in wired.items()}
    title = (found.title if found is not None else part.deviceset + part.device).replace("*", part.technology)
    power = found is not None and bool(found.pins) and all(pin.direction == "sup" for pin in found.pins.values())
    return SchematicPart(
        identity=identity, title=part.name, symbol=title, listed_as=f"{part.library}:{part.deviceset}", family=part.library,
        value=part.value if part.value != title else "", description=found.description if found is not None else "", pins=pins,
        count=found.pads if found is not None else 0, properties=part.attributes, line=part.line, power=power,
        defined=found is not None,
    )  # fmt: skip


# ---- the file as records

MOST_PARTS = 20_000
"""Parts of a schematic, those of module instances counted with each; the largest public one has a few thousand."""

MOST_INSTANCES, MOST_ELEMENTS = 1_000, 500_000
"""Module instances of a schematic, and XML elements in their modules, those inside of others counted with each."""

MOST_LEVELS = 20
"""Module instances inside module instances."""

_FIX = "open it in EAGLE 6 or newer and save it again"
_OTHER = "export it to KiCad, or write a pin table (docs/reference/pin-tables.md)"
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
        cause = "binary files of EAGLE 5 and before are not supported"
        raise SourceError(cause, location=Location(str(path)), fix=_FIX)
    if not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<"):
        raise SourceError("it is not a schematic of a supported tool", location=Location(str(path), 1), fix=_OTHER)
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
        cause = f"it is {kind} of EAGLE, not a schematic" if kind else "it is an EAGLE file without a schematic"
        fix = "give the .sch file of the schematic"
        if root.tag != "eagle":
            cause, fix = f"it is not a schematic of a supported tool: its root is <{root.tag}>", _OTHER
        raise SourceError(cause, location=Location(str(path), line_of(root)), fix=fix)
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
            raise TooLargeError(cause, location=place, fix="check that it is the drawing you meant")

    def _instances(self, owner: etree._Element, prefix: str, inside: tuple[str, ...]) -> Iterator[tuple[str, set[str]]]:
        """Collect the contents of the module instances; yields the name of each instance with the names of its ports."""
        for element in owner.iterfind("sheets/sheet/moduleinsts/moduleinst"):
            name, kind = element.get("name", ""), element.get("module", "")
            module = self.modules.get(kind)
            if kind in inside or len(inside) >= MOST_LEVELS:
                place = Location(self.made.path, line_of(element))
                raise SourceError(f"the module '{kind}' contains itself", location=place, fix="remove the inner one in EAGLE")
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


class EaglePin(Struct, frozen=True):
    """A pin of a device set: its connector's identity, gate, name as written, name as read, direction (`pwr`, `sup`, `io`)."""

    connector: str
    gate: str
    written: str
    name: str
    direction: str


class EagleDevice(Struct, frozen=True):
    """A device of a device set.

    Attributes:
        title: name of the device set, followed by the device's if it has one.
        description: the library's sentence about it.
        pins: by gate and name as written.
        pads: how many pads its package has wired.
        addlevels: EAGLE's add level of each gate (`request` gates of supplies need not be drawn).
    """

    title: str
    description: str
    pins: dict[tuple[str, str], EaglePin] = {}
    pads: int = 0
    addlevels: dict[str, str] = {}


class EagleLibraries:
    """The libraries of one schematic."""

    def __init__(self, schematic: etree._Element) -> None:
        self._libraries: dict[str, etree._Element] = {}
        for library in schematic.iterfind("libraries/library"):
            name, urn = library.get("name", ""), library.get("urn", "")
            self._libraries.setdefault(urn or name, library)
            self._libraries.setdefault(name, library)
        self._found: dict[tuple[str, str, str, str], EagleDevice | None] = {}

    def device(self, library: str, urn: str, deviceset: str, device: str) -> EagleDevice | None:
        """The device of a part, or None where the schematic does not carry it."""
        key = (library, urn, deviceset, device)
        if key not in self._found:
            self._found[key] = self._read(*key)
        return self._found[key]

    def _read(self, library: str, urn: str, deviceset: str, device: str) -> EagleDevice | None:
        found = self._libraries.get(urn) if urn else None
        found = found if found is not None else self._libraries.get(library)
        if found is None:
            return None
        chosen = next((entry for entry in found.iterfind("devicesets/deviceset") if entry.get("name") == deviceset), None)
        if chosen is None:
            return None
        symbols = {symbol.get("name", ""): symbol for symbol in found.iterfind("symbols/symbol")}
        gates = [(gate.get("name", ""), symbols.get(gate.get("symbol", "")), gate) for gate in chosen.iterfind("gates/gate")]
        listed = [
            (name, pin.get("name", ""), pin.get("direction", "io"))
            for name, symbol, _ in gates
            if symbol is not None
            for pin in symbol.iterfind("pin")
        ]
        connectors = connectors_of([(gate, written) for gate, written, _ in listed])
        pins = {
            (gate, written): EaglePin(connectors[gate, written], gate, written, _spoken(written), direction)
            for gate, written, direction in listed
        }
        shape = next((entry for entry in chosen.iterfind("devices/device") if entry.get("name", "") == device), None)
        pads = 0 if shape is None else sum(len(c.get("pad", "").split()) for c in shape.iterfind("connects/connect"))
        levels = {name: gate.get("addlevel", "next") for name, _, gate in gates}
        return EagleDevice(_title(deviceset, device), _described(chosen.findtext("description") or ""), pins, pads, levels)


def connectors_of(pins: Iterable[tuple[str, str]]) -> dict[tuple[str, str], str]:
    """The identity of the connector that each pin is, by gate and name as written: no two pins have the same one.

    A pin is called by its name where no other gate has that name, else by gate and name (`A.OUT`). Names may have dots in them,
    so that this may be the text of another pin: it is then called `OUT of A`.

    >>> connectors_of([("A", "OUT"), ("B", "OUT"), ("B", "EN"), ("C", "B.OUT")])
    {('A', 'OUT'): 'A.OUT', ('B', 'OUT'): 'OUT of B', ('B', 'EN'): 'EN', ('C', 'B.OUT'): 'B.OUT'}
    """
    listed = list(dict.fromkeys(pins))
    counts = Counter(written for _, written in listed)
    wanted = {pin: pin[1] if counts[pin[1]] == 1 else ".".join(pin) for pin in listed}
    clashes = Counter(wanted.values())
    found: dict[tuple[str, str], str] = {}
    taken = {text for (_, written), text in wanted.items() if text == written}
    for (gate, written), text in wanted.items():
        if text != written:
            plain = text if clashes[text] == 1 else f"{written} of {gate}"
            text = free_identity(plain, 0, taken)
            taken.add(text)
        found[gate, written] = text
    return found


def _spoken(written: str) -> str:
    """The name of a pin without its counter (`GND@1`) and without overline marks (`!RESET!`)."""
    return _COUNTER.sub("", written).replace(_OVERLINE, "") or written


def _title(deviceset: str, device: str) -> str:
    if "?" in deviceset:
        return deviceset.replace("?", device)
    return deviceset + device


def _described(text: str) -> str:
    """The first sentence of a description, which is HTML."""
    said = unescape(_TAG.sub(" ", unescape(text.split("<p>", 1)[0].split("<br", 1)[0])))
    return " ".join(said.split())[:_LONGEST]
