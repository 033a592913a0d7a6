"""Constraints on what pins drive: LEDs with a resistor, motors behind a driver, diodes across coils.

Which devices these are is data (`parts/electrical.toml`).
"""

from __future__ import annotations

from functools import partial

from robosmi.metamodels import hardware
from robosmi.transformations.constraints.electrical_supply import of_table, wiring_of
from robosmi.transformations.constraints.finding_locations import drawing, fault
from robosmi.transformations.queries.circuits.electrical import Role, Wiring, listed, who
from robosmi.validate import EVL, Fail

loads = EVL()
"""The constraints on loads; evaluate them on a hardware model."""

devices = loads.context(hardware.Component, guard=lambda c: c.circuit is not None and c.role is not Role.Board)
_DIODES = ("diode", "zener", "schottky", "rectifier")


@devices.critique(
    id="RS234", location=drawing, advice="add a resistor of 220 to 470 ohms in series",
    guard=lambda c: wiring_of(c).facts(c).series_resistor,
)  # fmt: skip
def CurrentIsLimited(c: hardware.Component) -> bool | Fail:
    """An LED has a resistor in series.

    Of a part with several LEDs and a common leg, the common leg or each of the others has one.
    """
    w = wiring_of(c)
    ends = [(connector, net, _gives_current(w, c, net)) for connector, net in w.nets(c)]
    common = [end for end in ends if w.means(end[0], "common")]
    if len({net for _, net, _ in ends}) > 2 or common:
        others = [end for end in ends if end not in common]
        bare = any(stiff for *_, stiff in common) and any(stiff and not net.rail for _, net, stiff in others)
    else:
        bare = len({net for _, net, stiff in ends if stiff}) > 1
    kind = w.facts(c).kind
    return not bare or fault(c, f"no resistor in series limits the current of the {kind} '{who(c)}'")


@devices.critique(
    id="RS273", info=True, location=drawing,
    advice="add a resistor of 220 to 470 ohms in series if there is none, and name it in the table's column 'through'",
    guard=lambda c: of_table(c) and wiring_of(c).facts(c).series_resistor,
)  # fmt: skip
def ResistorIsNamed(c: hardware.Component) -> bool | Fail:
    """A pin table names the resistor of an LED; without it, nobody knows whether there is one."""
    w = wiring_of(c)
    direct = [p.label for p in w.board_pins(c, through=False)]
    if not direct or len(direct) < len(w.nets(c)) or CurrentIsLimited(c) is not True:
        return True
    kind = w.facts(c).kind
    return fault(c, f"the table names no resistor for the {kind} '{who(c)}' on {listed(direct)}", pins=", ".join(direct))


def _gives_current(w: Wiring, component: hardware.Component, net: hardware.Net) -> bool:
    """Whether a net can deliver current without a resistor: from a supply, a board's pin or a driver's output."""

    def find() -> set[hardware.Component]:
        drivers = {o for o, _ in w.on(net) if o.driver and not w.facts(o).limits_current}
        return drivers | {board for board, _ in w.pins_at(net)}

    return bool(net.rail) or bool(w.once("giving", net, find) - {component})


@devices.constraint(
    id="RS251", location=drawing, advice="add a driver or a transistor between them",
    guard=lambda c: wiring_of(c).facts(c).needs_driver,
)  # fmt: skip
def HasADriver(c: hardware.Component) -> bool | Fail:
    """A motor, relay or similar load is not driven directly by a board's pin."""
    w = wiring_of(c)
    pins = [
        label
        for _, net in w.terminals(c)
        for near in (net, *w.beyond(net))
        if not near.rail and (near is net or not _has_driver(w, near))
        for board, label in w.pins_at(near)
        if w.is_gpio(board, label)
    ]
    kind = w.facts(c).kind
    return not pins or fault(
        c, f"the {kind} '{who(c)}' is on {listed(pins)} without a driver; a pin cannot supply its current", pins=", ".join(pins)
    )


def _has_driver(w: Wiring, net: hardware.Net) -> bool:
    return any(owner.driver for owner, _ in w.on(net))


@devices.critique(
    id="RS252", location=drawing, advice="add a diode across it, cathode to the supply",
    guard=lambda c: wiring_of(c).facts(c).inductive,
)  # fmt: skip
def HasADiode(c: hardware.Component) -> bool | Fail:
    """A coil that a transistor switches has a flyback diode across it."""
    w = wiring_of(c)
    ends = [net for _, net in w.terminals(c)]
    switches = [o for net in ends if not net.rail for o in w.once("switches", net, partial(_switches, w, net)) if o is not c]
    if not switches or any(other in ends for net in ends for other in w.once("diodes", net, partial(_diodes, w, net))):
        return True
    kind = w.facts(c).kind
    return fault(c, f"the transistor '{who(switches[0])}' switches the {kind} '{who(c)}', which has no diode across it")


def _switches(w: Wiring, net: hardware.Net) -> list[hardware.Component]:
    return [o for o, _ in w.on(net) if w.facts(o).switch]


def _diodes(w: Wiring, net: hardware.Net) -> set[hardware.Net | None]:
    """The nets at the other ends of the diodes on a net."""
    return {w.across(o, net) for o, _ in w.on(net) if _is_diode(o)} - {None}


def _is_diode(component: hardware.Component) -> bool:
    about = f"{component.family} {component.partTitle}".lower()
    return component.role is Role.Passive and any(word in about for word in _DIODES)
