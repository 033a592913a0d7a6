"""Finds the channels of the motor drivers that are wired to the board, and says what each lacks to drive a motor.

Which connectors are the inputs of a channel is data of the motor driver (`knowledge.motor_drivers`). Adapters of servo functions
drive a motor through a complete channel; the variants for that are chosen by `drawn_kinds`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from robosmi.metamodels import hardware, migration, platform
from robosmi.transformations.knowledge.motor_drivers import (
    MOTOR_DRIVER,
    DriverChannel,
    DriverInputs,
    driver_inputs,
    plain_name,
)
from robosmi.transformations.knowledge.wildcards import Wildcards

_PWM = "pwm"
Pins = Mapping[str, platform.Pin]
"""Plain name of a connector -> the pin of the board there."""


def motor_channels(connections: Sequence[migration.Connection]) -> list[migration.MotorChannel]:
    """The channels of which a pin of the board is at an input, in the order of the drawing.

    Args:
        connections: the connections of the target board, with their circuit described.
    """
    drivers = list(dict.fromkeys(c.component for c in connections if c.component is not None and _is_driver(c.component)))
    return [channel for driver in drivers for channel in _channels(driver, [c for c in connections if c.component is driver])]


def drawn_kinds(connections: Iterable[migration.Connection], channels: Iterable[migration.MotorChannel]) -> frozenset[str]:
    """The kinds of the parts on the board's pins, as the marker `drawn` of adapter files writes them (`motor-driver`).

    A motor driver counts only if it has a complete channel.

    Args:
        connections: the connections of the target board, with their circuit described.
        channels: the channels of its motor drivers.
    """
    devices = (c.component.device for c in connections if c.component is not None and c.pin is not None)
    kinds = {str(device.kind) for device in devices if device is not None} - {MOTOR_DRIVER}
    if any(not channel.missing for channel in channels):
        kinds.add(MOTOR_DRIVER)
    return frozenset(kind.replace(" ", "-") for kind in kinds)


def _is_driver(component: hardware.Component) -> bool:
    return component.device is not None and component.device.kind == MOTOR_DRIVER


def _channels(driver: hardware.Component, connections: Sequence[migration.Connection]) -> list[migration.MotorChannel]:
    known = driver_inputs(str(connector.name) for connector in driver.connectors)
    pins = {plain_name(str(end.name)): c.pin for c in connections if c.pin is not None for end in c.connectors}
    if known is None:
        return []
    every = (_channel(driver, known, channel, pins) for channel in known.channels)
    return [channel for channel in every if channel is not None]


def _channel(
    driver: hardware.Component, known: DriverInputs, channel: DriverChannel, pins: Pins
) -> migration.MotorChannel | None:
    """One channel of a motor driver; None if no input of it is on a pin of the board."""
    enable, first, second = (_pin(pins, names) for names in (channel.pwm, channel.first, channel.second))
    if enable is first is second is None:
        return None
    named = {what: _name(driver, names) for what, names in (("first", channel.first), ("second", channel.second))}
    missing = [
        f"{named[what] or f'its {what} direction input'} is on no pin of the board"
        for what, pin in (("first", first), ("second", second))
        if pin is None
    ]
    by_inputs = not channel.needs_pwm or (enable is None and (known.jumper or _is_powered(driver, channel.pwm)))
    if enable is None and not by_inputs:
        missing.append(f"{_name(driver, channel.pwm) or 'its PWM input'} is on no pin of the board")
    missing += [
        f"{pin.label} has no PWM"
        for pin in ((first, second) if by_inputs else (enable,))
        if pin is not None and _PWM not in pin.abilities
    ]
    if (asleep := _asleep(driver, known, pins)) is not None:
        missing.append(f"{asleep} is connected to nothing, so the driver sleeps")
    return migration.MotorChannel(
        component=driver, enable=enable, first=first, second=second, awake=_pin(pins, known.awake), missing=missing
    )


def _pin(pins: Pins, names: Wildcards) -> platform.Pin | None:
    return next((pin for name, pin in pins.items() if name in names), None)


def _connectors(driver: hardware.Component, names: Wildcards) -> list[hardware.Connector]:
    return [connector for connector in driver.connectors if plain_name(str(connector.name)) in names]


def _name(driver: hardware.Component, names: Wildcards) -> str:
    return next((str(connector.name) for connector in _connectors(driver, names)), "")


def _is_powered(driver: hardware.Component, names: Wildcards) -> bool:
    """Whether a connector with one of these names is wired to a supply."""
    return any(
        c.net is not None and c.net.rail and c.kind is not hardware.ConnectorKind.ground for c in _connectors(driver, names)
    )


def _asleep(driver: hardware.Component, known: DriverInputs, pins: Pins) -> str | None:
    """The name of a standby or sleep input that is drawn without a wire, if the driver sleeps then."""
    if not known.sleeps or _pin(pins, known.awake) is not None:
        return None
    return next((str(c.name) for c in _connectors(driver, known.awake) if c.net is None), None)
