"""Writes the repository's facts about a circuit's parts into the circuit, and reads them from there.

A drawing is described once, after reading; from then on rules and constraints use the model, so that a stored one gives the
same results whatever happens to the repository. The tables themselves are `electrical_facts` and `part_names`; nothing is
judged here.
"""

from __future__ import annotations

from pathlib import Path

from robosmi.metamodels import hardware
from robosmi.transformations.knowledge.electrical_facts import DeviceFacts, electrical
from robosmi.transformations.knowledge.part_names import PartNames, conducts_by_bus_only, name_direction, names

_PULL_UPS = {None: hardware.PullUps.notKnown, False: hardware.PullUps.absent, True: hardware.PullUps.present}
_KNOWN_PULL_UPS = {literal: value for value, literal in _PULL_UPS.items()}
_DIRECTIONS = {
    "read": hardware.NamedDirection.read,
    "write": hardware.NamedDirection.write,
    "bus": hardware.NamedDirection.bus,
}


def describe(circuit: hardware.Circuit, project: Path | None = None) -> None:
    """Write the known facts about its parts into a circuit, unless it is described already.

    Args:
        circuit: the circuit.
        project: the project folder, whose own data goes first; the current folder if None.

    Raises:
        PlatformDataError: a table is damaged.
    """
    if circuit.described:
        return
    data, known = electrical(project), names(project)
    said: dict[str, tuple[str, ...]] = {}
    for component in circuit.components:
        if (facts := data.facts(component)) is not None:
            component.device = _element(facts)
        component.joinsByBusOnly = conducts_by_bus_only(component.family, known, component.partTitle)
        component.eitherSide = _is_either_side(component, known)
        component.positional = _is_positional(component, known)
        for connector in component.connectors:
            if connector.name not in said:
                said[connector.name] = data.meanings(connector.name)
            if said[connector.name]:
                connector.meanings.extend(said[connector.name])
            if (way := name_direction(connector.name, known, component.driver)) is not None:
                connector.namedDirection = _DIRECTIONS[way]
    circuit.supplyLimits.extend(hardware.SupplyLimit(volts=volts, milliamperes=most) for volts, most in data.supply_limits)
    circuit.described = True


def joins_by_bus_only(component: hardware.Component) -> bool:
    """Whether a component connects its connectors only through its buses (breadboards, headers, terminals)."""
    if _is_described(component):
        return bool(component.joinsByBusOnly)
    return conducts_by_bus_only(component.family, names(), component.partTitle)


def is_either_side(component: hardware.Component) -> bool:
    """Whether a chip is an input or an output depending on its wiring."""
    return bool(component.eitherSide) if _is_described(component) else _is_either_side(component, names())


def device_facts(component: hardware.Component) -> DeviceFacts | None:
    """The known facts about a component of a described circuit, or None."""
    device = component.device
    if device is None:
        return None
    volts = tuple(device.volts)
    return DeviceFacts(
        kind=device.kind,
        volts=(volts[0], volts[1]) if len(volts) == 2 else None,
        signal_volts=device.signalVolts or None,
        peak_ma=device.peakMilliamperes,
        needs_driver=device.needsDriver,
        inductive=device.inductive,
        terminals=tuple(device.terminals),
        switch=device.isSwitch,
        series_resistor=device.seriesResistor,
        limits_current=device.limitsCurrent,
        analog=tuple(device.analog),
        wants=tuple(device.wants),
        output=device.output,
        i2c=tuple(device.addresses),
        pull_ups=_KNOWN_PULL_UPS[device.pullUps],
        isolated=device.isolated,
        tone=device.sounds,
        rest=device.rest,
        bench=device.bench,
    )


def supply_limit(circuit: hardware.Circuit, volts: float) -> int | None:
    """The current in mA that a described circuit's boards supply at a voltage, or None if unknown."""
    return next((limit.milliamperes for limit in circuit.supplyLimits if abs(limit.volts - volts) < 0.3), None)


def _is_described(component: hardware.Component) -> bool:
    return component.circuit is not None and bool(component.circuit.described)


def _is_either_side(component: hardware.Component, known: PartNames) -> bool:
    return bool(component.driver) and f"{component.family} / {component.partTitle}" in known.either


def _is_positional(component: hardware.Component, known: PartNames) -> bool:
    called = f"{component.title} / {component.partTitle} / {component.family}"
    return called in known.positional and called not in known.not_positional


def _element(facts: DeviceFacts) -> hardware.DeviceFacts:
    return hardware.DeviceFacts(
        kind=facts.kind,
        volts=facts.volts or (),
        signalVolts=facts.signal_volts or 0.0,
        peakMilliamperes=facts.peak_ma,
        needsDriver=facts.needs_driver,
        inductive=facts.inductive,
        terminals=facts.terminals,
        isSwitch=facts.switch,
        seriesResistor=facts.series_resistor,
        limitsCurrent=facts.limits_current,
        analog=facts.analog,
        wants=facts.wants,
        output=facts.output,
        addresses=facts.i2c,
        pullUps=_PULL_UPS[facts.pull_ups],
        isolated=facts.isolated,
        sounds=facts.tone,
        rest=facts.rest,
        bench=facts.bench,
    )
