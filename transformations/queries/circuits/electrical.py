"""The wiring of a circuit for electrical checks: what shares a net, the voltage of a net, what a pin can do.

It is computed once per run of queries (`wiring`), since every check needs most of it. Facts about devices are in the circuit
(`knowledge/described_circuit`), those about boards in the plan or else the repository; nothing is judged here.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator
from typing import Any, TypeVar

from msgspec import Struct

from robosmi.metamodels import hardware, platform
from robosmi.query.run import ext
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.knowledge.described_circuit import describe, device_facts, joins_by_bus_only, supply_limit
from robosmi.transformations.knowledge.drawn_boards import drawn_board
from robosmi.transformations.knowledge.electrical_facts import DeviceFacts

T = TypeVar("T")
Role = hardware.Role
Kind = hardware.ConnectorKind
_VOLTS = re.compile(
    r"\+?(?:(?P<units>[1-3])v(?P<tenths>[358])|(?P<whole>\d{1,2})(?:[.,](?P<decimals>\d{1,2}))? ?v\d?)", re.IGNORECASE
)
"""Matches `3V3`, `5V`, `+3.3 V`, `12V1`."""
_GPIO = re.compile(r"[DA]\d+|(?:GPIO|P)\d+")
NOTHING = DeviceFacts("")
"""The empty facts, for a device about which nothing is known."""


class BoardPin(Struct, frozen=True):
    """A pin of a board that a component is connected to.

    Attributes:
        connector: the component's connector.
        net: the net of this connector; between it and the pin there may be a passive part.
        board: the board.
        label: the pin's label on the board.
        pin: the platform's pin with its abilities; None for a board without data.
    """

    connector: hardware.Connector
    net: hardware.Net
    board: hardware.Component
    label: str
    pin: platform.Pin | None


class Wiring:
    """The wiring of one circuit."""

    def __init__(self, circuit: hardware.Circuit) -> None:
        self.circuit = circuit
        describe(circuit)  # one that was stored by an older version lacks it
        self.titles = Counter(c.title or c.partTitle for c in circuit.components)
        self.boards: list[hardware.Component] = []
        self._members: dict[hardware.Net, list[hardware.Connector]] = {}
        self._nets: dict[hardware.Component, list[tuple[hardware.Connector, hardware.Net]]] = {}
        self._owner: dict[hardware.Connector, hardware.Component] = {}
        self._joins: set[hardware.Component] = set()
        self._found: dict[tuple[str, hardware.Net], Any] = {}
        self._facts: dict[hardware.Component, DeviceFacts] = {}
        self._board_models: dict[hardware.Component, platform.Board | None] = {}
        for component in circuit.components:
            role = component.role
            if role is Role.Decoration:
                continue
            if role is Role.Board:
                self.boards.append(component)
            if role is Role.Passive and joins_by_bus_only(component):
                self._joins.add(component)
            drawn = self._nets[component] = []
            for connector in component.connectors:
                self._owner[connector] = component
                net = connector.net
                if net is not None:
                    drawn.append((connector, net))
                    self._members.setdefault(net, []).append(connector)

    def nets(self, component: hardware.Component) -> list[tuple[hardware.Connector, hardware.Net]]:
        """The connectors of a component that are in a net, each with its net."""
        return self._nets.get(component, [])

    def on(self, net: hardware.Net) -> Iterator[tuple[hardware.Component, hardware.Connector]]:
        """The components at a net with their connectors, without parts that only join connectors, such as breadboards."""
        for connector in self._members.get(net, ()):
            owner = self._owner[connector]
            if owner not in self._joins:
                yield owner, connector

    def is_wired(self, component: hardware.Component, net: hardware.Net) -> bool:
        """Whether another component is at a net of a component."""
        return any(owner is not component for owner, _ in self.on(net))

    def facts(self, component: hardware.Component) -> DeviceFacts:
        """The electrical facts about a component, `NOTHING` where none are known."""
        if component not in self._facts:
            self._facts[component] = device_facts(component) or NOTHING
        return self._facts[component]

    def means(self, connector: hardware.Connector, meaning: str) -> bool:
        """Whether a connector's name says something (`sda`, `output`; the keys of `[names]` in the electrical facts)."""
        return meaning in connector.meanings

    def supply_ma(self, volts: float) -> int | None:
        """What a board gives at its supply of that voltage, in mA, or None if nothing is known."""
        return supply_limit(self.circuit, volts)

    def board_model(self, board: hardware.Component) -> platform.Board | None:
        """The platform's board that a component is drawn as, or None."""
        if board not in self._board_models:
            drawn = None if board.boardName else drawn_board(board.partId, self.circuit.tool.lower())
            name = board.boardName or (drawn.name if drawn is not None else "")
            self._board_models[board] = load_board(name) if name else None
        return self._board_models[board]

    def know_board(self, board: hardware.Component, model: platform.Board) -> None:
        """Take a board's model from a plan instead of the repository."""
        self._board_models[board] = model

    def pin_model(self, board: hardware.Component, label: str) -> platform.Pin | None:
        """The platform's pin of that label."""
        model = self.board_model(board)
        return next((p for p in model.pins if p.label == label), None) if model is not None else None

    def once(self, what: str, net: hardware.Net, find: Callable[[], T]) -> T:
        """The result of `find` for a net, computed once for each `what`: many devices ask the same of a net that they share."""
        key = (what, net)
        if key not in self._found:
            self._found[key] = find()
        found: T = self._found[key]
        return found

    def pins_at(self, net: hardware.Net) -> list[tuple[hardware.Component, str]]:
        """The boards at a net, each with the label of its pin there."""
        return self.once(
            "pins", net, lambda: list(dict.fromkeys((o, c.pin) for o, c in self.on(net) if o.role is Role.Board and c.pin))
        )

    def is_gpio(self, board: hardware.Component, label: str) -> bool:
        """Whether a label is that of a pin of the microcontroller, not of a driver chip on the board."""
        return bool(_GPIO.fullmatch(label)) or self.pin_model(board, label) is not None

    def board_pins(self, component: hardware.Component, through: bool = True) -> list[BoardPin]:
        """The pins that a component's connectors are on.

        Args:
            component: the component.
            through: also those with one passive part, such as a resistor, between.
        """
        found: list[BoardPin] = []
        for connector, net in self.nets(component):
            beyond = self.beyond(net) if through and not net.rail else []
            for near in (n for n in (net, *beyond) if not n.rail):
                pins = self.pins_at(near)
                found += [BoardPin(connector, net, board, label, self.pin_model(board, label)) for board, label in pins]
        return found

    def across(self, component: hardware.Component, net: hardware.Net) -> hardware.Net | None:
        """The net on the other side of a passive part with two of them, or None."""
        if component.role is not Role.Passive or component in self._joins:
            return None
        others = {other for _, other in self.nets(component)}
        return next(iter(others - {net})) if len(others) == 2 and net in others else None

    def sources(self, net: hardware.Net) -> list[tuple[hardware.Component, hardware.Connector]]:
        """The supply and ground connectors of boards and supplies at a net."""
        owners, kinds = (Role.Board, Role.Power), (Kind.supply, Kind.ground)
        return self.once("sources", net, lambda: [(o, c) for o, c in self.on(net) if o.role in owners and c.kind in kinds])

    def beyond(self, net: hardware.Net) -> list[hardware.Net]:
        """The nets on the other side of the passive parts at a net, each once."""

        def find() -> list[hardware.Net]:
            others = (self.across(owner, net) for owner, _ in self.on(net))
            return list(dict.fromkeys(other for other in others if other is not None))

        return self.once("beyond", net, find)

    def volts(self, net: hardware.Net) -> float | None:
        """The voltage of a supply net, 0 for ground, None if it is none or unknown."""
        if self.is_ground(net):
            return 0.0
        if net.voltage != "GND":
            return stated_volts(net.voltage) if net.rail else None
        return next((v for o, c in self.sources(net) if (v := stated_volts(c.name)) is not None), None)

    def fed_with(self, component: hardware.Component) -> float:
        """The highest voltage of the supply nets that a component is at, 0 if none is known."""
        return max((volts for _, net in self.nets(component) if (volts := self.volts(net)) is not None), default=0.0)

    def is_ground(self, net: hardware.Net) -> bool:
        """Whether a net is ground: what boards and supplies say takes precedence over the names of other connectors."""
        sources = self.sources(net)
        return any(c.kind is Kind.ground for _, c in sources) if sources else bool(net.rail) and net.voltage == "GND"

    def fed_by_board(self, net: hardware.Net) -> hardware.Component | None:
        """The board that alone feeds a net from its regulated supply, or None."""
        feeding = None
        for owner, connector in self.on(net):
            if owner.role is Role.Power:
                return None
            if owner.role is Role.Board and connector.kind is Kind.supply and stated_volts(connector.name) is not None:
                feeding = feeding or owner
        return feeding

    def terminals(self, component: hardware.Component) -> list[tuple[hardware.Connector, hardware.Net]]:
        """The connectors through which a load is driven, with their nets."""
        wanted = self.facts(component).terminals
        return [(c, n) for c, n in self.nets(component) if not wanted or c.name.strip().lower() in wanted]


def wiring(circuit: hardware.Circuit) -> Wiring:
    """The wiring of a circuit, made once a run."""
    known = ext(circuit).wiring
    if known is None:
        known = ext(circuit).wiring = Wiring(circuit)
    assert isinstance(known, Wiring)
    return known


def fed_parts(circuit: hardware.Circuit) -> dict[str, float]:
    """Identity of a part -> the voltage that a drawing feeds it with, of parts with a supply connector and of sensors.

    Drivers are left out: they have another supply for what they drive.
    """
    w = wiring(circuit)
    silent = (Role.Board, Role.Power, Role.Passive, Role.Decoration)
    parts = [c for c in circuit.components if c.role not in silent and not c.driver]
    fed = [c for c in parts if c.role is Role.Input or any(k.kind is Kind.supply for k, _ in w.nets(c))]
    return {str(c.elementId): volts for c in fed if (volts := w.fed_with(c)) > 0}


def stated_volts(label: str) -> float | None:
    """The voltage that a label states (`5V`, `+3.3 V`, `3V3`), or None."""
    found = _VOLTS.fullmatch(label.strip())
    if found is None:
        return None
    return float(f"{found['units'] or found['whole']}.{found['tenths'] or found['decimals'] or 0}")


def who(component: hardware.Component) -> str:
    """What messages call a component: its title, with its identity where another one has that title."""
    title = component.title or component.partTitle
    same = wiring(component.circuit).titles[title] if component.circuit is not None else 1
    return title if title and same < 2 else f"{title} #{component.elementId}".lstrip()


def listed(texts: list[str]) -> str:
    """Texts as one: `a`, `a and b`, `a, b and c`; each once."""
    once = list(dict.fromkeys(texts))
    return once[0] if len(once) == 1 else f"{', '.join(once[:-1])} and {once[-1]}"
