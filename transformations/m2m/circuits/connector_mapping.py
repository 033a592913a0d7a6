"""Maps each pin of a board to the components it reaches: Algorithm 1 of the paper on the nets of a circuit (paper 3.2).

`map_connectors` is the algorithm with the open points of the printed version decided: supply nets are cut, breadboards conduct
row by row, paths continue only through two-terminal passive parts, and drivers and unknown parts end a path.
`algorithm_1_as_printed` is the printed version, kept for comparison. docs/method/connector-mapping.md gives the reasons and the
figures. Nets are computed by the readers; nothing here knows a drawing tool.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Mapping
from itertools import islice

from msgspec import Struct

from robosmi import quoting
from robosmi.base.data_text import Json
from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import TooLargeError
from robosmi.metamodels import hardware, migration, platform
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.part_names import PartNames, name_direction, names
from robosmi.transformations.queries.circuits.circuit_walk import (
    ReachedComponent,
    either_side,
    natural_key,
    pins_of,
    tied_inside,
    walk,
)
from robosmi.transformations.queries.circuits.connector_names import displayed_name

Role = hardware.Role

MAX_MAPPINGS = 20_000
"""Limit on the connections of pins to components in one drawing; the largest public drawing has under 100."""

_NAMED = 3
"""How many pins of other boards a finding names; without a limit, n boards on one net would each name all others."""
_SILENT = (Role.Board, Role.Power, Role.Decoration)
_BY_ROLE = {"Input": "read", "Output": "write", "Both": "bus", "Unknown": "read"}
_SUPPLIES = (hardware.ConnectorKind.supply, hardware.ConnectorKind.ground)
_SUFFIX = {"read": "ReadP", "write": "WriteP", "bus": "BusP"}
_SIGNALS = {name: enum_literal(migration.Signal, name) for name in ("read", "write", "bus")}


class _Mapped(Struct):
    """A connection of a board pin to a component before it is given a name."""

    board: hardware.Component
    label: str
    order: int
    pin: platform.Pin | None
    board_connectors: list[hardware.Connector]
    reached: ReachedComponent
    signal: str = ""


class _State(Struct):
    known: PartNames
    path: str
    findings: list[Finding] = []
    on_boards: dict[int, list[hardware.Connector]] = {}
    """Cache by `id()` of a net: the connectors of boards on that net."""

    def report(self, rule: str, severity: Severity, message: str, fix: str | None = None, **evidence: Json) -> None:
        self.findings.append(Finding(rule, severity, message, Location(self.path), fix=fix, evidence=evidence))


def map_connectors(
    circuit: hardware.Circuit, boards: Mapping[str, platform.Board] | None = None, known: PartNames | None = None
) -> tuple[list[migration.Connection], list[Finding]]:
    """The connections of every board of a circuit: one for each pin and component that it reaches, in the order of pins.

    Args:
        circuit: the circuit.
        boards: the platform's board for a board component, by its `elementId`; pins of others stay without a `platform.Pin`.
        known: rules on families and names; those of the platform repository if None.

    Returns:
        The connections with their names, and what was odd (rules RS220 to RS228). A circuit without a board has none.

    Raises:
        SourceError: there are more connections than any circuit has.
    """
    state = _State(known or names(), circuit.path)
    mapped: list[_Mapped] = []
    for board in circuit.components:
        if board.role is Role.Board:
            for one in _map_board(board, (boards or {}).get(board.elementId), state):
                mapped.append(one)
                if len(mapped) > MAX_MAPPINGS:
                    raise TooLargeError(
                        f"more than {MAX_MAPPINGS:,} connections of pins to components",
                        location=Location(circuit.path),
                        fix="check the wiring of the pins; one net cannot connect everything",
                    )
    called = _names(mapped, state)
    wired = {id(end) for wire in circuit.wires for end in wire.ends}
    connections = [
        migration.Connection(
            name=name,
            signal=_SIGNALS[one.signal],
            pin=one.pin,
            boardConnectors=one.board_connectors,
            component=one.reached.component,
            connectors=_contacts(one.reached, wired),
            via=one.reached.via,
        )
        for one, name in zip(mapped, called, strict=True)
    ]
    return connections, state.findings


def algorithm_1_as_printed(board: hardware.Component) -> list[tuple[hardware.Connector, hardware.Connector]]:
    """Algorithm 1 word by word: every connector of the board with every connector of a component that it leads to.

    One line is added, without which it does not end: the connector that is looked at leaves S. Breadboards are parts like
    any other here, with all their connectors, and supplies conduct.
    """
    from robosmi.transformations.queries.circuits.circuit import circuit_graph  # it draws in networkx, which is wanted only here

    circuit = board.circuit
    if circuit is None:
        return []
    graph = circuit_graph(circuit)
    mappings: list[tuple[hardware.Connector, hardware.Connector]] = []
    for c in board.connectors:
        pending = [c]
        visited: set[hardware.Connector] = set()
        while pending:
            d = pending.pop()
            if d in visited:
                continue
            visited.add(d)
            parent = d.component
            if parent is None:
                continue
            if parent.role in (Role.Input, Role.Output):
                mappings.append((c, d))
                continue
            if d.net is not None:
                pending.extend(other for other in graph.neighbors(d.net) if isinstance(other, hardware.Connector))
            if parent.role is not Role.Board:
                pending.extend(parent.connectors)
    return mappings


def identifier(title: str) -> str:
    """Turn a component's title into the beginning of an identifier; empty if no usable character is left.

    A leading digit gets `_` before it, and no reserved word results. Followed by `ReadP1` or the like the result can be neither
    a keyword nor an Arduino macro: none of these ends in `P` and a number.
    """
    return quoting.identifier(title, begins=True)


def _map_board(board: hardware.Component, target: platform.Board | None, state: _State) -> Iterator[_Mapped]:
    pins = pins_of(board)
    signal_nets = {c.net for connectors in pins.values() for c in connectors if c.net is not None}
    known_pins = {pin.label: (place, pin) for place, pin in enumerate(target.pins)} if target is not None else {}
    if target is not None:
        pins = dict(sorted(pins.items(), key=lambda item: known_pins.get(item[0], (len(known_pins), None))[0]))
    _report_joined(board, pins, state)
    for place, (label, connectors) in enumerate(pins.items()):
        nets = list(dict.fromkeys(c.net for c in connectors if c.net is not None))
        for net in nets:
            _report_net(board, label, net, state)
        pin = known_pins[label][1] if label in known_pins else None
        reached = [one for one in walk(nets, signal_nets.__contains__, board) if not _supplies_beyond(one)]
        if reached and target is not None and pin is None:
            state.report(
                "RS223",
                Severity.warning,
                f"'{_title(reached[0].component)}' is wired to {label}, but {target.title} has no such pin",
            )
        drawn = [c for c in connectors if c.net is not None]
        for one in sorted(reached, key=lambda r: natural_key(r.component.elementId)):
            yield _Mapped(board, label, place, pin, drawn, one, _signal(one, label, state.known))
            if one.component.role is Role.Unknown:
                state.report(
                    "RS220",
                    Severity.warning,
                    f"the role of '{_title(one.component)}' on {label} is unknown; RoboSMi treats it as an input device",
                    "give its role in robosmi.toml under [roles]",
                    model_index=one.component.elementId,
                )


def _supplies_beyond(reached: ReachedComponent) -> bool:
    """Whether a path through resistors ends at the supply of a part with signals of its own: a divider measures that supply."""
    others = (c for c in reached.component.connectors if c not in reached.connectors)
    return (
        bool(reached.via)
        and all(connector.kind in _SUPPLIES for connector in reached.connectors)
        and any(connector.net is not None and connector.kind not in _SUPPLIES for connector in others)
    )


def _report_joined(board: hardware.Component, pins: Mapping[str, list[hardware.Connector]], state: _State) -> None:
    sharing: dict[int, list[str]] = {}
    for label, connectors in pins.items():
        for net in {id(c.net) for c in connectors if c.net is not None and not c.net.rail}:
            sharing.setdefault(net, []).append(label)
    for labels in sharing.values():
        if len(labels) > 1:
            state.report(
                "RS224",
                Severity.warning,
                f"the pins {', '.join(labels)} of '{_title(board)}' are joined",
                "check the wires between them; two outputs that are joined can damage the board",
                pins=labels,
            )


def _report_net(board: hardware.Component, label: str, net: hardware.Net, state: _State) -> None:
    if net.rail:
        state.report(
            "RS221",
            Severity.info,
            f"{label} of '{_title(board)}' is tied to a supply and has no mapping: {net.railEvidence}",
            net=net.name,
        )
        own = [c for c in net.connectors if c.component is board and c.pin == label]
        if (tied := tied_inside(own, net)) is not None:
            component, joined = tied
            contact = " and ".join(joined)
            state.report(
                "RS228",
                Severity.warning,
                f"'{_title(component)}' connects {label} of '{_title(board)}' to the supply for good: {contact} are one contact",
                "wire one of them to the other contact",
                model_index=component.elementId,
            )
        return
    if id(net) not in state.on_boards:
        state.on_boards[id(net)] = [c for c in net.connectors if c.component is not None and c.component.role is Role.Board]
    others = (c for c in state.on_boards[id(net)] if c.component is not board)
    named = [f"{c.pin or displayed_name(c)} of the board '{_title(c.component)}'" for c in islice(others, _NAMED + 1)]  # type: ignore[arg-type]
    if len(named) > _NAMED:
        named[_NAMED:] = ["more"]
    if named:
        said = " and ".join(filter(None, [", ".join(named[:-1]), named[-1]]))
        state.report("RS226", Severity.info, f"{label} of '{_title(board)}' is wired to {said}")


def _contacts(reached: ReachedComponent, wired: Container[int]) -> list[hardware.Connector]:
    """The connectors that a path met, one of each group that the part joins inside: the first that has a wire.

    The others of the group are the same contact of a switch, or hand an input on to the next part of a chain. All count where
    the drawing does not say which is wired, as on a breadboard; so do those of one name, which are one pin on two headers.
    """
    left = list(reached.connectors)
    for bus in reached.component.buses:
        group = [connector for connector in left if connector in bus.connectors]
        if (first := next((c for c in group if id(c) in wired), None)) is not None:
            left = [each for each in left if each not in group or displayed_name(each) == displayed_name(first)]
    return left


def _signal(reached: ReachedComponent, label: str, known: PartNames) -> str:
    """The direction of a connection (read, write or bus): from the connector's kind or name, else the part's role and place."""
    component = reached.component
    analog = label[0] == "A" and label[1:].isdecimal()  # not any pin that can: on some boards D4 can, and is used as D4
    if not analog and all(connector.kind in _SUPPLIES for connector in reached.connectors):
        return "write"  # the pin supplies the part: as an input it would leave it without power
    ways = [name_direction(connector.name, known, component.driver) for connector in reached.connectors]
    told = next((way for way in ("bus", "write", "read") if way in ways), None)
    default = _BY_ROLE[component.role.name]
    if told == "bus":
        return told
    if component.driver:
        return told if told is not None and component.role is not Role.Both else _driver_signal(component, default)
    about = f"{component.family} / {component.partTitle}"
    if default == "write" and analog and about in known.read_on_analog and about not in known.not_read_on_analog:
        return "read"
    if told == "read":
        return told  # also of a part that is driven: a servo tells where it stands, and a pin that drives that wire destroys it
    return told if told is not None and default != "write" else default


def _driver_signal(component: hardware.Component, default: str) -> str:
    """The direction for a driver chip that may face the board with either side: read if it only senses, write if it only
    drives.
    """
    drives, senses = either_side(component)
    if bool(drives) != bool(senses):
        return "write" if drives else "read"
    return default


def _names(mapped: list[_Mapped], state: _State) -> list[str]:
    """The names of the connections, in the order given."""
    by_component: dict[hardware.Component, list[int]] = {}
    for place, one in enumerate(mapped):
        by_component.setdefault(one.reached.component, []).append(place)
    result = [""] * len(mapped)
    taken: dict[str, hardware.Component] = {}
    for component in sorted(by_component, key=lambda c: natural_key(c.elementId)):
        wanted = identifier(component.title) or identifier(component.partTitle) or "Component"
        base = wanted
        while base in taken:
            base = f"{base.rstrip('_')}_{identifier(component.elementId).lstrip('_') or 'Other'}"
        if base != wanted:
            state.report(
                "RS227",
                Severity.info,
                f"'{_title(component)}' is called {base} in the program, because '{_title(taken[wanted])}' has the same name",
                "give the parts different titles in the drawing",
            )
        taken[base] = component
        order = {connector: number for number, connector in enumerate(component.connectors)}
        places = sorted(by_component[component], key=lambda p: (min(order[c] for c in mapped[p].reached.connectors), p))
        for number, place in enumerate(places, 1):
            result[place] = f"{base}{_SUFFIX[mapped[place].signal]}{number}"
    return result


def rename_clashes(
    connections: Iterable[migration.Connection], words: Container[str], location: Location | None
) -> list[Finding]:
    """Rename those connections whose names the program already declares.

    Args:
        connections: the connections of a drawing; their names differ from each other.
        words: the names that the program declares.
        location: the drawing, for the findings.
    """
    listed = list(connections)
    taken = {connection.name for connection in listed}
    findings = []
    for connection in listed:
        old, number = connection.name, 2
        while connection.name in words:
            if (name := f"{old}_{number}") not in taken:
                connection.name = name
            number += 1
        if connection.name != old:
            message = f"the program already uses the name '{old}', so the pin is called {connection.name}"
            findings.append(Finding("RS227", Severity.info, message, location))
            taken.add(connection.name)
    return findings


def _title(component: hardware.Component) -> str:
    return component.title or component.partTitle or f"#{component.elementId}"
