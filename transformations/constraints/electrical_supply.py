"""Constraints on supplies: no short circuits, ground and supply for every device, matching voltages and currents.

A net is a supply or ground if the reader of the drawing marks it so (`rail`); the limits of devices are data.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import hardware
from robosmi.transformations.constraints.finding_locations import drawing, fault
from robosmi.transformations.knowledge.drawn_boards import PIN_TABLE
from robosmi.transformations.queries.circuits.circuit_walk import beyond_driver
from robosmi.transformations.queries.circuits.connector_names import displayed_name
from robosmi.transformations.queries.circuits.electrical import Kind, Role, Wiring, listed, stated_volts, who, wiring
from robosmi.validate import EVL, Fail

supply = EVL()
"""The constraints on supplies; evaluate them on a hardware model."""

_ACTIVE = (Role.Input, Role.Output, Role.Both)
_SYMBOLS = ("ground symbol", "power symbol")
_SAME = 0.75  # volts between two supplies that count as one: 5 V of USB and four rechargeable cells


def wiring_of(element: hardware.Component | hardware.Net) -> Wiring:
    """The wiring of the circuit that contains an element."""
    assert element.circuit is not None
    return wiring(element.circuit)


def of_table(component: hardware.Component) -> bool:
    """Whether a pin table lists a component: that says what feeds it, and not by which wires and parts."""
    return component.circuit is not None and component.circuit.tool == PIN_TABLE


def takes_part(component: hardware.Component) -> bool:
    """Whether a component is an active device with a wired signal connector."""
    if component.circuit is None or component.role not in _ACTIVE:
        return False
    w = wiring_of(component)
    return any(c.kind not in (Kind.supply, Kind.ground) and w.is_wired(component, net) for c, net in w.nets(component))


nets = supply.context(hardware.Net, guard=lambda n: n.circuit is not None and n.rail)
devices = supply.context(hardware.Component, guard=takes_part)
placed = supply.context(hardware.Component, guard=lambda c: c.circuit is not None and c.role in _ACTIVE)
boards = supply.context(hardware.Component, guard=lambda c: c.circuit is not None and c.role is Role.Board)


@nets.constraint(id="RS230", location=drawing, advice="remove the wire that joins them")
def SupplyIsApartFromGround(n: hardware.Net) -> bool | Fail:
    """A supply is not short-circuited to its ground."""
    sources = wiring_of(n).sources(n)
    minus = {owner: connector for owner, connector in reversed(sources) if connector.kind is Kind.ground}
    fixed = next((owner for owner in reversed(minus) if _is_fixed(owner)), None)
    for positive, p in sources:
        negative = positive if positive in minus else fixed if _is_fixed(positive) else None
        if p.kind is Kind.supply and negative is not None:
            m = minus[negative]
            said = f"{p.name or p.connectorId} of '{who(positive)}' and {m.name or m.connectorId} of '{who(negative)}'"
            return fault(positive, f"short circuit: {said} are joined", net=n.name)
    return True


def _is_fixed(component: hardware.Component) -> bool:
    """Whether a supply is referenced to the circuit's ground, as boards and supply symbols are; cells may be in series."""
    return component.role is Role.Board or component.family.strip().lower() in _SYMBOLS


@nets.constraint(id="RS231", location=drawing, advice="use one of them, or a regulator between them")
def SuppliesOfOneVoltage(n: hardware.Net) -> bool | Fail:
    """Supplies that are connected to each other have the same voltage."""
    stated = [(o, v) for o, c in wiring_of(n).sources(n) if c.kind is Kind.supply and (v := _source_volts(o, c)) is not None]
    low, high = (pick(stated, key=lambda s: s[1], default=None) for pick in (min, max))
    if low is None or high is None or high[1] - low[1] <= _SAME:
        return True
    said = f"{low[1]:g} V of '{who(low[0])}' and {high[1]:g} V of '{who(high[0])}'"
    return fault(high[0], f"supplies of different voltage are joined: {said}", net=n.name)


def _source_volts(component: hardware.Component, connector: hardware.Connector) -> float | None:
    """The voltage at a supply's connector: from a board's pin label, or a battery's or symbol's property; None if unknown."""
    if component.role is Role.Board:
        return stated_volts(connector.name)
    if sum(c.kind is Kind.supply for c in component.connectors) > 1:
        return None  # what goes in and what comes out
    volts = next((p.value for p in component.properties if p.name.lower() == "voltage"), "")
    return stated_volts(volts if volts[-1:].lower() == "v" else f"{volts}V")


@devices.critique(id="RS235", location=drawing, advice="wire its ground")
def HasGround(c: hardware.Component) -> bool | Fail:
    """A component with ground connectors is wired at one of them."""
    return _is_supplied(c, Kind.ground) or fault(c, f"no ground is wired to '{who(c)}'")


@devices.critique(id="RS236", location=drawing, advice="wire its supply")
def HasSupply(c: hardware.Component) -> bool | Fail:
    """A component with supply connectors is wired at one of them."""
    return _is_supplied(c, Kind.supply) or fault(c, f"no supply is wired to '{who(c)}'")


def _is_supplied(component: hardware.Component, kind: hardware.ConnectorKind) -> bool:
    w = wiring_of(component)
    return all(c.kind is not kind for c in component.connectors) or any(
        c.kind is kind and (w.is_wired(component, net) or of_table(component)) for c, net in w.nets(component)
    )


@placed.critique(id="RS237", location=drawing, advice="wire it, or remove it from the drawing")
def IsConnected(c: hardware.Component) -> bool | Fail:
    """A component is connected to something, unless nothing in the circuit is."""
    w = wiring_of(c)
    if not c.connectors or any(w.is_wired(c, net) for _, net in w.nets(c)):
        return True
    return fault(c, f"'{who(c)}' is connected to nothing")


@devices.critique(id="RS238", location=drawing, advice="join the grounds", guard=lambda c: not wiring_of(c).facts(c).isolated)
def GroundsAreJoined(c: hardware.Component) -> bool | Fail:
    """A component shares the ground of the board whose pins it is wired to."""
    w = wiring_of(c)
    own = [net for connector, net in w.nets(c) if connector.kind is Kind.ground and w.is_wired(c, net)]
    for board in dict.fromkeys(p.board for p in w.board_pins(c)) if own else ():
        theirs = {net for connector, net in w.nets(board) if connector.kind is Kind.ground}
        known = any(connector.kind is Kind.ground for connector in board.connectors)
        if known and theirs.isdisjoint(own) and not any(_leads_to(w, net, theirs) or (w.volts(net) or 0) > 0 for net in own):
            return fault(c, f"the ground of '{who(c)}' is not joined to that of '{who(board)}'")
    return True


def _leads_to(w: Wiring, net: hardware.Net, wanted: set[hardware.Net]) -> bool:
    """Whether a component without a supply of its own, such as a switch or transistor, connects a net to one of the wanted
    nets.
    """

    def find() -> set[hardware.Net]:
        plain = [o for o, _ in w.on(net) if all(c.kind not in (Kind.supply, Kind.ground) for c in o.connectors)]
        return {other for owner in plain for _, other in w.nets(owner)}

    return not wanted.isdisjoint(w.once("switched", net, find))


@devices.constraint(id="RS239", location=drawing, advice="swap the two wires, or check the names of the connectors")
def IsTheRightWayRound(c: hardware.Component) -> bool | Fail:
    """Ground and supply of a component are not swapped."""
    w = wiring_of(c)
    supplies = [net for connector, net in w.nets(c) if connector.kind is Kind.supply]
    grounds = [net for connector, net in w.nets(c) if connector.kind is Kind.ground]
    wrong = any((w.volts(net) or 0) > 0 for net in grounds) and not any(w.is_ground(net) for net in grounds)
    if not wrong or (supplies and not any(w.is_ground(net) for net in supplies)):
        return True if not wrong else fault(c, f"the ground of '{who(c)}' is at a supply")
    return fault(c, f"ground and supply of '{who(c)}' are swapped" if supplies else f"the ground of '{who(c)}' is at a supply")


@boards.critique(id="RS250", location=drawing, advice="give them their own supply, and join its ground to the board's")
def BoardCanSupplyThem(b: hardware.Component) -> bool | Fail:
    """The devices supplied by a board need no more current than it can deliver."""
    w = wiring_of(b)
    for net in dict.fromkeys(n for connector, n in w.nets(b) if connector.kind is Kind.supply):
        volts = w.volts(net)
        most = w.supply_ma(volts) if volts and w.fed_by_board(net) is b else None
        loads = dict(_loads(w, net)) if most is not None else {}
        if most is not None and sum(loads.values()) > most:
            names = listed([f"'{who(c)}'" for c in loads])
            total = sum(loads.values())
            message = f"{names} may draw {total} mA from the {volts:g} V of '{who(b)}', which supplies about {most} mA"
            return fault(b, message, needed_ma=total, given_ma=most)
    return True


def _loads(w: Wiring, net: hardware.Net) -> Iterator[tuple[hardware.Component, int]]:
    """The loads on a supply net with their peak currents in mA, including those behind a driver without another supply."""
    for owner, connector in w.on(net):
        if owner.role in (Role.Board, Role.Power, Role.Passive):
            continue
        loads = [owner]
        supplies = [n for c, n in w.nets(owner) if c.kind is Kind.supply or w.means(c, "motor_supply")]
        if owner.driver and connector.kind is Kind.supply and all(n is net for n in supplies):
            loads += beyond_driver(owner)[0]
        for load in loads:
            if (peak := w.facts(load).peak_ma) and (load is not owner or _is_fed_there(w, owner, connector)):
                yield load, peak


def _is_fed_there(w: Wiring, component: hardware.Component, connector: hardware.Connector) -> bool:
    """Whether a component draws its current through a connector: its supply pin, or a terminal of a load."""
    return connector.kind is Kind.supply or any(c is connector for c, _ in w.terminals(component))


@placed.constraint(id="RS253", location=drawing, advice="use its rated supply, or a regulator")
def BearsItsSupply(c: hardware.Component) -> bool | Fail:
    """The supply voltage of a component does not exceed its maximum."""
    for connector, volts, _, most in _supplied_with(c):
        if most is not None and volts > most:
            return fault(
                c,
                f"'{who(c)}' gets {volts:g} V at {displayed_name(connector)}; its maximum is {most:g} V",
                volts=volts,
                most=most,
            )
    return True


@placed.critique(id="RS254", location=drawing, advice="use its rated supply")
def SupplyIsEnough(c: hardware.Component) -> bool | Fail:
    """The supply voltage of a component is not below its minimum."""
    for connector, volts, least, _ in _supplied_with(c):
        if least is not None and 0 < volts < least:
            message = f"'{who(c)}' gets {volts:g} V at {displayed_name(connector)}; its minimum is {least:g} V"
            return fault(c, message, volts=volts, least=least)
    return True


def _supplied_with(
    component: hardware.Component,
) -> Iterator[tuple[hardware.Connector, float, float | None, float | None]]:
    """The supply connectors with a known voltage, as (connector, volts, minimum, maximum); a limit is None if unknown."""
    w = wiring_of(component)
    facts = w.facts(component)
    regulated = any(w.means(c, "regulator_out") for c in component.connectors)
    for connector, net in w.nets(component):
        volts = w.volts(net)
        stated = stated_volts(connector.name)
        if volts is None or (connector.kind is not Kind.supply and stated is None):
            continue
        if stated is not None:  # labels above 5 V name the usual supply of a motor, no limit
            yield connector, volts, stated - 0.5 if 4 < stated < 6 else None, stated + _SAME if stated < 6 else None
        elif facts.volts is not None:
            most = None if regulated or w.means(connector, "regulated") else facts.volts[1]
            yield connector, volts, facts.volts[0], most
