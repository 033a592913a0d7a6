"""The transformation itself: an EAGLE schematic in, a `hardware.Circuit` and findings out.

Parts have the names that EAGLE gives them, which are also their identities. A pin on an unknown part, an unknown pin, or a name
that stands twice, is left out and reported. `document` reads the file, `schematic` decides what symbols stand for.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from pathlib import Path

from robosmi.diagnostics import Finding, Severity
from robosmi.errors import did_you_mean
from robosmi.metamodels import hardware
from robosmi.transformations.t2m.connectivity import Joined
from robosmi.transformations.t2m.drawing import CircuitBuilder, End, free_identity
from robosmi.transformations.t2m.eagle.document import EaglePart, EagleSchematic, PinRef, read_schematic
from robosmi.transformations.t2m.eagle.library import connectors_of, spoken
from robosmi.transformations.t2m.schematic import Schematic, SchematicNet, SchematicPart, circuit_of

TOOL = "EAGLE"


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
                why = f"the name '{part.name}' stands twice" if part.name else "a part has no name"
                self.report(
                    "RS206", Severity.warning, f"{why}: this '{part.deviceset}' is {identity}, wires to the name are left out",
                    part.line, "give each part a name of its own in EAGLE",
                )  # fmt: skip
                self.twice.add(part.name)
            found[identity] = part
        return found

    def schematic(self) -> Schematic:
        """The parts and the nets."""
        for module, line in self.document.missing:
            self.report("RS214", Severity.warning, f"there is no module '{module}': it is left out", line, "add it in EAGLE")
        for identity, part in self.parts.items():
            if part.found is None:
                self.report(
                    "RS214", Severity.warning,
                    f"the drawing has no symbol of '{identity}' ('{part.deviceset}' of '{part.library}'), only its wired pins",
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
                        pin.line, "mend the net in EAGLE",
                    )  # fmt: skip
                elif end not in taken:
                    taken.add(end)
                    net.ends.append(end)
        made.nets = [net for net in nets.values() if net.ends]
        return made

    def _end(self, pin: PinRef) -> End | None:
        left_out = "; it was left out"
        if pin.part in self.twice:
            cause = f"'{pin.part}' on a net is not one part: the name stands twice{left_out}"
            self.report("RS206", Severity.warning, cause, pin.line, "give each part a name of its own in EAGLE")
            return None
        part = self.parts.get(pin.part)
        if part is None:
            cause = f"a net has a pin of '{pin.part}', and no part is called so{did_you_mean(pin.part, self.parts)}{left_out}"
            self.report("RS207", Severity.warning, cause, pin.line, "correct the net, or add the part")
            return None
        if part.found is None:  # what its gates are is told by its wired pins alone
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
    pins = {pin.connector: pin.name for pin in known} or {pin: spoken(name) for (_, name), pin in wired.items()}
    title = (found.title if found is not None else part.deviceset + part.device).replace("*", part.technology)
    power = found is not None and bool(found.pins) and all(pin.direction == "sup" for pin in found.pins.values())
    return SchematicPart(
        identity=identity, title=part.name, symbol=title, listed_as=f"{part.library}:{part.deviceset}", family=part.library,
        value=part.value if part.value != title else "", description=found.description if found is not None else "", pins=pins,
        count=found.pads if found is not None else 0, properties=part.attributes, line=part.line, power=power,
        defined=found is not None,
    )  # fmt: skip
