"""Constraints on buses: I2C and SPI on the right pins, pull-up resistors, unique addresses.

A device is on a bus if its connectors have the bus's names (SDA, SCL; MOSI, MISO, SCK); addresses are data.
"""

from __future__ import annotations

from functools import partial

from robosmi.metamodels import hardware
from robosmi.transformations.constraints.electrical_supply import wiring_of
from robosmi.transformations.constraints.finding_locations import drawing, fault
from robosmi.transformations.queries.circuits.electrical import Kind, Role, Wiring, listed, who
from robosmi.validate import EVL, Fail

buses = EVL()
"""The constraints on buses; evaluate them on a hardware model."""

devices = buses.context(
    hardware.Component, guard=lambda c: c.circuit is not None and c.role in (Role.Input, Role.Output, Role.Both)
)
_Address = tuple[int, tuple[str, ...]]
_I2C, _SPI = ("sda", "scl"), ("mosi", "miso", "sck")


def lines(w: Wiring, component: hardware.Component, names: tuple[str, ...]) -> dict[str, list[hardware.Net]]:
    """The nets at a component's connectors with the given names; empty unless it has the first two of them.

    A connector of both buses (SDI/SDA) counts for the one that its name mentions first.
    """
    has = {line: [c for c in component.connectors if w.means(c, line)] for line in names}
    if not has[names[0]] or not has[names[1]]:
        return {}
    return {line: [net for c, net in w.nets(component) if c in connectors] for line, connectors in has.items()}


def _astray(c: hardware.Component, names: tuple[str, ...]) -> list[str]:
    """Bus lines on pins without that bus function, although the board has it on other pins."""
    w = wiring_of(c)
    found = []
    for line, nets in lines(w, c, names).items():
        alias = line.upper()
        pins = [(board, label) for net in nets if not net.rail for board, label in w.pins_at(net)]
        right = [alias in (label, *_aliases(w, board, label)) for board, label in pins]
        if pins and not any(right) and any(_has(w, board, alias) for board, _ in pins):
            found.append(f"{alias} on {pins[0][1]}")
    return found


def _aliases(w: Wiring, board: hardware.Component, label: str) -> list[str]:
    pin = w.pin_model(board, label)
    return list(pin.aliases) if pin is not None else []


def _has(w: Wiring, board: hardware.Component, alias: str) -> bool:
    model = w.board_model(board)
    return model is not None and any(alias in pin.aliases for pin in model.pins)


@devices.critique(id="RS246", location=drawing, advice="use the pins SDA and SCL of the board")
def IsOnTheI2CPins(c: hardware.Component) -> bool | Fail:
    """A device on the I2C bus is on the pins SDA and SCL."""
    wrong = _astray(c, _I2C)
    return not wrong or fault(c, f"'{who(c)}' has {listed(wrong)}, but the board has no I2C there")


@devices.critique(id="RS247", location=drawing, advice="add a resistor of 4.7 kilo-ohms from SDA and from SCL to the supply")
def BusIsPulledUp(c: hardware.Component) -> bool | Fail:
    """An I2C bus has pull-up resistors, its own or those of a module on it."""
    w = wiring_of(c)
    if w.facts(c).pull_ups is not False:
        return True
    bare = []
    for line, nets in lines(w, c, _I2C).items():
        for net in nets:
            is_bare: bool = w.once(f"bare {line}", net, partial(_is_bare, w, net, line))
            if is_bare and w.pins_at(net):
                bare.append(line.upper())
    return not bare or fault(c, f"no pull-up resistor is on {listed(bare)} of '{who(c)}'")


def _is_bare(w: Wiring, net: hardware.Net, line: str) -> bool:
    """Whether a bus line has no pull-up, neither a resistor nor a device with one."""
    devices_on = (o for o, connector in w.on(net) if o.role is not Role.Board and w.means(connector, line))
    return all(w.facts(o).pull_ups is False for o in devices_on) and not _pulled_up(w, net)


def _pulled_up(w: Wiring, net: hardware.Net) -> bool:
    return any(other.rail and not w.is_ground(other) for other in w.beyond(net))


@devices.critique(id="RS248", location=drawing, advice="change the address of one, with its address pins if it has them")
def AddressIsItsOwn(c: hardware.Component) -> bool | Fail:
    """No two devices on one I2C bus have the same address."""
    w = wiring_of(c)
    own = _address(w, c)
    if own is None:
        return True
    for net in lines(w, c, _I2C).get("sda", ()):
        first = w.once("addresses", net, partial(_addresses, w, net)).get(own, c) if not net.rail else c
        if first is not c:
            return fault(c, f"'{who(first)}' and '{who(c)}' have the same address 0x{own[0]:02X} on one bus")
    return True


def _addresses(w: Wiring, net: hardware.Net) -> dict[_Address | None, hardware.Component]:
    """For each address on a bus, the first device in the drawing that has it."""
    found: dict[_Address | None, hardware.Component] = {}
    for owner, connector in w.on(net):
        if owner.role is not Role.Board and w.means(connector, "sda"):
            found.setdefault(_address(w, owner), owner)
    return found


def _address(w: Wiring, component: hardware.Component) -> _Address | None:
    """A device's default I2C address with its high address pins; None if it is unknown or a board pin sets an address pin."""
    known = w.facts(component).i2c
    if not known:
        return None
    levels = {c.name.lower(): "high" for c, n in w.nets(component) if _chooses(w, c) and n.rail and not w.is_ground(n)}
    if levels and len(known) == 1:
        levels = {}
    wired = [c for c, n in w.nets(component) if _chooses(w, c) and not n.rail and w.is_wired(component, n)]
    return None if wired else (known[0], tuple(sorted(levels)))


def _chooses(w: Wiring, connector: hardware.Connector) -> bool:
    return connector.kind is not Kind.supply and w.means(connector, "address")


@devices.critique(id="RS249", location=drawing, advice="use the pins MOSI, MISO and SCK of the board, or a software SPI")
def IsOnTheSpiPins(c: hardware.Component) -> bool | Fail:
    """A device on the SPI bus is on the pins MOSI, MISO and SCK."""
    wrong = _astray(c, _SPI)
    return not wrong or fault(c, f"'{who(c)}' has {listed(wrong)}, but the board has no SPI there")
