"""The wiring of a plan as a Wokwi diagram: how parts are drawn, which pins are wired, and which parts Wokwi lacks.

A net is drawn as wires from one pin, the board's if it has one; breadboards are left out. A passive part that Wokwi lacks and
that carries a signal is replaced by a wire and listed; any other such part is listed and not drawn. The file is written by
`m2t/sketch_project`.

`parts/wokwi_types.toml` maps components of any drawing to Wokwi's types, and their connectors to the type's pins. A component
without a matching type, or a connector that is no pin of the type, is left to the caller to list. Wokwi's own parts and pins are
in the parts catalogue.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path

from msgspec import Struct

from robosmi.base.data_tables import DataTable
from robosmi.diagnostics import Location
from robosmi.errors import SourceError
from robosmi.metamodels import hardware, migration
from robosmi.resources import folders
from robosmi.transformations.knowledge.board_models import drawing_files, table_of, text_of
from robosmi.transformations.knowledge.described_circuit import joins_by_bus_only
from robosmi.transformations.knowledge.drawn_boards import PIN_TABLE
from robosmi.transformations.knowledge.part import Part
from robosmi.transformations.knowledge.part_names import Phrases
from robosmi.transformations.knowledge.parts_catalogue import Catalogue
from robosmi.transformations.knowledge.wildcards import fits
from robosmi.transformations.knowledge.wokwi_diagram import DrawnPart, NotDrawn, WokwiWiring
from robosmi.transformations.queries.circuits.connector_names import displayed_name

_GROUND, _SUPPLY = "GND", "5V"
WITH_DRAWING = "run migrate with --hardware SKETCH"
"""The advice where a plan has no drawing."""


def no_drawing() -> SourceError:
    """The error of a plan without a drawing."""
    return SourceError("the plan has no drawing and thus no wiring", fix=WITH_DRAWING)


def wokwi_wiring(plan: migration.MigrationPlan, project: Path | None = None) -> WokwiWiring:
    """The wiring of a plan.

    Args:
        plan: a plan with a circuit and a board.
        project: the project folder, whose own data goes first; the current folder if None.

    Raises:
        SourceError: the plan has no drawing, or Wokwi does not draw its board.
    """
    circuit, component, board = plan.circuit, plan.boardComponent, plan.board
    if circuit is None or component is None or board is None:
        raise no_drawing()
    drawn = wokwi_board(board.name, project)
    if drawn is None:
        known = ", ".join(boards_of_wokwi(project))
        raise SourceError(
            f"Wokwi has no board '{board.title}'", location=Location(circuit.path), fix=f"it has: {known}; use another form"
        )
    return _Wiring(plan, circuit, component, drawn, project).made()


class _Wiring:
    """Builds the wiring of one plan."""

    def __init__(
        self,
        plan: migration.MigrationPlan,
        circuit: hardware.Circuit,
        board: hardware.Component,
        drawn: WokwiBoard,
        project: Path | None,
    ) -> None:
        self.plan, self.circuit, self.board, self.drawn, self.project = plan, circuit, board, drawn, project
        self.result = WokwiWiring()
        self.names: dict[hardware.Component, str] = {}
        self.parts: dict[hardware.Component, WokwiPart] = {}
        self.same: dict[int, int] = {}
        """Nets by their identity -> the one that stands for them: those that a wire in place of a part joins."""

    def made(self) -> WokwiWiring:
        self._name(self.board)
        self.result.parts.append(DrawnPart(self.names[self.board], self.drawn.kind, {}))
        for component in self.circuit.components:
            if component is not self.board:
                self._draw(component)
        self._wire()
        if self.circuit.tool == PIN_TABLE:
            self._supply()
        return self.result

    # ---- parts

    def _draw(self, component: hardware.Component) -> None:
        connected = [c for c in component.connectors if c.net is not None]
        joins = component.role is hardware.Role.Passive and joins_by_bus_only(component)
        if component.role is hardware.Role.Decoration or not connected or joins:
            return
        if component.role is hardware.Role.Board:
            self._list(component, "it is another board")
            return
        part = wokwi_part(component, connected, self.project)
        if part is None:
            self._list(component, "Wokwi has no such part")
            return
        mapped = {c.connectorId: c for n in self.plan.connections if n.component is component for c in n.connectors}
        if lost := [displayed_name(c) or c.connectorId for identity, c in mapped.items() if identity not in part.pins]:
            self._list(component, f"its {', '.join(lost)} is not a pin of {part.kind}")
            return
        self._name(component)
        self.parts[component] = part
        self.result.parts.append(DrawnPart(self.names[component], part.kind, dict(part.attributes)))

    def _name(self, component: hardware.Component) -> None:
        wanted = (component.title or component.partTitle or f"part{component.elementId}").replace(":", "_").lstrip("$") or "part"
        name, number = wanted, 1
        while name in self.names.values():
            number += 1
            name = f"{wanted} ({number})"
        self.names[component] = name

    def _list(self, component: hardware.Component, why: str) -> None:
        pins = [_label(n) for n in self.plan.connections if n.component is component or component in n.via]
        bridged = component.role is hardware.Role.Passive and any(component in n.via for n in self.plan.connections)
        if bridged:
            nets = list(dict.fromkeys(id(c.net) for c in component.connectors if c.net is not None and not c.net.rail))
            for other in nets[1:]:
                self.same[self._root(other)] = self._root(nets[0])
            why += "; a wire replaces it"
        title = component.title or component.partTitle or f"#{component.elementId}"
        part = component.partTitle or component.partId
        self.result.not_drawn.append(NotDrawn(title, component.elementId, part, tuple(dict.fromkeys(pins)), why))

    # ---- wires

    def _wire(self) -> None:
        groups: dict[int, list[hardware.Net]] = {}
        for net in self.circuit.nets:
            groups.setdefault(self._root(id(net)), []).append(net)
        for nets in groups.values():
            ends = list(dict.fromkeys(end for net in nets for c in net.connectors if (end := self._end(c)) is not None))
            if (tied := self._tied(nets)) is not None and tied not in ends:
                ends.append(tied)
            ends.sort(key=lambda end: not end.startswith(f"{self.names[self.board]}:"))
            carried = next((net.voltage or "supply" for net in nets if net.rail), "")
            self.result.wires += [(ends[0], other, carried) for other in ends[1:]]

    def _tied(self, nets: list[hardware.Net]) -> str | None:
        """The board's supply pin for a supply net that one of its pins is tied to; the drawing's supply symbol is not drawn."""
        rail = next((net for net in nets if net.rail), None)
        if rail is None or not any(c.component is self.board and c.pin for net in nets for c in net.connectors):
            return None
        pin = self.drawn.supplies.get(rail.voltage) or self.drawn.supplies.get(_SUPPLY)
        return f"{self.names[self.board]}:{pin}" if pin else None

    def _root(self, net: int) -> int:
        while net in self.same:
            net = self.same[net]
        return net

    def _end(self, connector: hardware.Connector) -> str | None:
        component = connector.component
        if component is None or component not in self.names:
            return None
        pin = self._board_pin(connector) if component is self.board else self.parts[component].pins.get(connector.connectorId)
        return f"{self.names[component]}:{pin}" if pin else None

    def _board_pin(self, connector: hardware.Connector) -> str | None:
        if connector.pin:
            return self.drawn.pins.get(connector.pin)
        if connector.kind is hardware.ConnectorKind.ground:
            return self.drawn.supplies.get(_GROUND)
        name = connector.name.upper().replace("3V3", "3.3V").lstrip("+")
        return self.drawn.supplies.get(name) if connector.kind is hardware.ConnectorKind.supply else None

    def _supply(self) -> None:
        """Add wires from the parts' supply and ground pins to the board, which a pin table does not mention."""
        used = {end for wire in self.result.wires for end in wire[:2]}
        board = self.names[self.board]
        for component, part in self.parts.items():
            name = self.names[component]
            rest = {pin: _GROUND if kind == "ground" else _SUPPLY for pin, kind in part.supplies.items()}
            if all(f"{name}:{pin}" in used for pin in part.returns):
                rest |= dict.fromkeys(part.feeds, _SUPPLY)
            for pin, carried in (rest | dict(part.returns)).items():
                end, own = f"{name}:{pin}", self.drawn.supplies.get(carried)
                if end not in used and own is not None:
                    self.result.wires.append((f"{board}:{own}", end, carried))
                    self.result.added += 1
        ends = Counter(end.rpartition(":")[0] for wire in self.result.wires for end in wire[:2])
        self.result.loose = [name for component in self.parts if ends[name := self.names[component]] == 1]


def _label(connection: migration.Connection) -> str:
    if connection.pin is not None:
        return str(connection.pin.label)
    return str(connection.boardConnectors[0].pin) if connection.boardConnectors else ""


# ---- types and pins of parts

TOOL = "wokwi"
_OWN = "chip-"
_DIGITS = re.compile(r"\[(\d)-(\d)\]")
_VALUED = re.compile(r"(\d{1,9}(?:[.,]\d{1,6})?)\s*+([kKMR]?)(\d{0,3})\s*+(?:ohms?|Ohms?|[\u03a9\u2126])?")
_POWERED = ("supply", "ground")


class WokwiPart(Struct, frozen=True):
    """How Wokwi draws a component.

    Attributes:
        kind: the Wokwi part type (`wokwi-led`).
        attributes: the type's attributes.
        pins: id of a connector -> pin of the type; without connectors that are no pin of it.
        supplies: the type's supply and ground pins, with their kind.
        returns: pins that are wired to ground if the drawing says nothing about them (pin -> `GND`).
        feeds: pins that are wired to the supply if the drawing says nothing about them and wires all of `returns`.
    """

    kind: str
    attributes: Mapping[str, str]
    pins: Mapping[str, str]
    supplies: Mapping[str, str]
    returns: Mapping[str, str] = {}
    feeds: tuple[str, ...] = ()


class WokwiBoard(Struct, frozen=True):
    """How Wokwi draws a board: its type, the pin of each label, and its supply pins by name (`GND`, `5V`)."""

    kind: str
    pins: Mapping[str, str]
    supplies: Mapping[str, str]


class _Entry(Struct, frozen=True):
    kind: str
    attributes: Mapping[str, str]
    words: Phrases
    forbidden: Phrases
    pins: tuple[tuple[str, str], ...]
    order: tuple[tuple[str, ...], ...]
    returns: tuple[str, ...]
    feeds: tuple[str, ...]
    takes: Mapping[str, tuple[str, ...]] = {}


def wokwi_board(name: str, project: Path | None = None) -> WokwiBoard | None:
    """How Wokwi draws a board, or None if it does not.

    Args:
        name: short name of the board (`uno`).
        project: the project folder, whose own data goes first; the current folder if None.
    """
    for path in drawing_files(project):
        if path.stem != name or f'"{TOOL}"' not in text_of(path):
            continue
        for drawn in table_of(path).tables("drawn_as", needed=False):
            if drawn.text("tool") == TOOL:
                kind = drawn.texts("modules")[0]
                connectors = drawn.table("connectors")
                pins = {label: connectors.texts(label)[0] for label in connectors.values}
                part = Catalogue(project, TOOL).find(kind)
                supplies = {_counted(pin): pin for pin in reversed(_of_kind(part, _POWERED))}
                return WokwiBoard(kind, pins, supplies)
    return None


def boards_of_wokwi(project: Path | None = None) -> list[str]:
    """The short names of the boards that Wokwi draws, sorted."""
    return sorted({path.stem for path in drawing_files(project) if f'tool = "{TOOL}"' in text_of(path)})


def wokwi_part(
    component: hardware.Component, connected: Collection[hardware.Connector], project: Path | None = None
) -> WokwiPart | None:
    """How Wokwi draws a component, or None if none of its types stands for it.

    Args:
        component: the component, of a drawing of any tool.
        connected: its connectors that are to be drawn, of which the pins are wanted.
        project: the project folder, whose own data goes first; the current folder if None.

    Raises:
        PlatformDataError: an entry is damaged.
    """
    catalogue = Catalogue(project, TOOL)
    if component.circuit is not None and component.circuit.tool.lower() == TOOL:
        if component.partId.startswith(_OWN):
            return None
        attributes = {p.name: p.value for p in component.properties}
        powered = {c.connectorId: c.kind.name for c in component.connectors if c.kind.name in _POWERED}
        return WokwiPart(component.partId, attributes, {c.connectorId: c.connectorId for c in component.connectors}, powered)
    for entry in _all(project):
        about = (component.partTitle or component.title, component.family)
        if not any(text in entry.words for text in about if text) or any(text in entry.forbidden for text in about if text):
            continue
        variant = " ".join([entry.kind, *(f"{key}={value}" for key, value in entry.attributes.items())])
        part = catalogue.find(variant) or catalogue.find(entry.kind)
        if part is not None:
            powered = {pin: part.connectors[pin].kind for pin in _of_kind(part, _POWERED)}
            return WokwiPart(
                entry.kind,
                {**entry.attributes, **_taken(component, entry)},
                _pins(component, connected, part, entry),
                powered,
                dict.fromkeys(entry.returns, "GND"),
                entry.feeds,
            )
    return None


def _taken(component: hardware.Component, entry: _Entry) -> dict[str, str]:
    """Attributes whose value is a number of the component, such as the ohms of a resistor."""
    own = {p.name.lower(): p.value for p in component.properties}
    own.setdefault("title", component.title)
    values = {
        key: next((v for name in names if (v := plain_number(own.get(name, "")))), "") for key, names in entry.takes.items()
    }
    return {key: value for key, value in values.items() if value}


def plain_number(text: str) -> str:
    """A value with its prefix and unit as a plain number, or an empty text.

    >>> plain_number("220"), plain_number("4k7"), plain_number("10 kOhm"), plain_number("R1")
    ('220', '4700', '10000', '')
    """
    found = _VALUED.fullmatch(text.strip())
    if found is None:
        return ""
    number = float(f"{found[1].replace(',', '.')}{'.' + found[3] if found[3] and '.' not in found[1] else ''}")
    return f"{number * {'k': 1e3, 'K': 1e3, 'M': 1e6}.get(found[2], 1):.12g}"


def _pins(component: hardware.Component, connected: Collection[hardware.Connector], part: Part, entry: _Entry) -> dict[str, str]:
    """The pins of connectors, matched by name, by what they are wired to, by their order, and the last remaining signal."""
    found: dict[str, str] = {}
    on_pin: dict[str, hardware.Connector] = {}
    for connector in sorted(component.connectors, key=lambda c: c.net is None):
        pin = _named(connector, part, entry)
        if pin is not None and on_pin.setdefault(pin, connector).net is connector.net:  # two gates may have pins of one name
            found[connector.connectorId] = pin
    for connector in component.connectors:
        if connector.connectorId not in found and (pin := _powered(connector, part)) is not None:
            found[connector.connectorId] = pin
    used = {*found.values()}
    free = iter([pins for pins in entry.order if used.isdisjoint(pins)])
    for group in _groups(component, connected):
        if any(c.connectorId in found for c in group):
            continue
        if (pins := next(free, None)) is None:
            break
        found.update({c.connectorId: pins[min(place, len(pins) - 1)] for place, c in enumerate(group)})
    left = [c for c in component.connectors if c in connected and c.connectorId not in found]
    signals = [pin for pin in part.connectors if pin not in {*found.values()} and pin not in _of_kind(part, _POWERED)]
    if len(left) == 1 and len(signals) == 1:
        found[left[0].connectorId] = signals[0]
    return found


def _named(connector: hardware.Connector, part: Part, entry: _Entry) -> str | None:
    name = connector.name.strip().lower()
    if not name:
        return None
    same = next((pin for pin in part.connectors if pin.lower() == name), None)
    return same or next((pin for pin, pattern in entry.pins if fits(name, pattern)), None)


def _powered(connector: hardware.Connector, part: Part) -> str | None:
    kind = connector.kind.name
    if connector.net is not None and connector.net.rail and kind not in _POWERED:
        kind = "ground" if connector.net.voltage == "GND" else "supply"
    return next(iter(_of_kind(part, (kind,))), None) if kind in _POWERED else None


def _groups(component: hardware.Component, connected: Collection[hardware.Connector]) -> Iterator[list[hardware.Connector]]:
    """The connectors to be drawn, in the part's order; connectors that are joined inside the part form one group."""
    seen: set[str] = set()
    for connector in component.connectors:
        if connector.connectorId in seen:
            continue
        bus = next((bus for bus in component.buses if connector in bus.connectors), None)
        group = [*bus.connectors] if bus is not None else [connector]
        seen.update(c.connectorId for c in group)
        if drawn := [c for c in group if c in connected]:
            yield drawn


def _of_kind(part: Part | None, kinds: Sequence[str]) -> list[str]:
    return [c.id for c in part.connectors.values() if c.kind in kinds] if part is not None else []


def _counted(pin: str) -> str:
    """A pin's name without the number that distinguishes pins of the same name (`GND.1`)."""
    return re.sub(r"(?<=[A-Z])\.\d+$", "", pin)


def _all(project: Path | None) -> Iterator[_Entry]:
    for folder in folders("platform_repo", project):
        if (path := folder / "parts" / "wokwi_types.toml").is_file():
            yield from _entries(path, path.stat().st_mtime_ns)


@cache
def _entries(path: Path, changed: int) -> tuple[_Entry, ...]:  # `changed` keys the cache
    return tuple(_entry(table) for table in DataTable.read(path).tables("type"))


def _entry(table: DataTable) -> _Entry:
    pins, takes = table.table("pins", needed=False), table.table("takes", needed=False)
    order = table.values.get("order", [])
    if not isinstance(order, list) or not all(isinstance(pins, list) for pins in order):
        raise table.error("order", "must be a list of lists of pins")
    return _Entry(
        kind=table.text("type"),
        attributes=table.texts_by_name("attrs"),
        words=Phrases((word, 0) for word in table.texts("words")),
        forbidden=Phrases((word, 0) for word in table.texts("not", ())),
        pins=tuple(pair for pin in pins.values for pair in _told(pin, pins.texts(pin))),
        returns=table.texts("returns", ()),
        feeds=table.texts("feeds", ()),
        takes={key: takes.texts(key) for key in takes.values},
        order=tuple(tuple(str(each) for each in pins) for pins in order),
    )


def _told(pin: str, patterns: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The (pin, pattern) pairs of a table entry; a range of digits in both is expanded to equal digits."""
    digits = _DIGITS.search(pin)
    for pattern in patterns:
        if digits is None:
            yield pin, pattern
        else:
            for digit in range(int(digits[1]), int(digits[2]) + 1):
                yield _DIGITS.sub(str(digit), pin), _DIGITS.sub(str(digit), pattern)
