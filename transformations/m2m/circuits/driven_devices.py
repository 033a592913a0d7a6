"""What the plan needs to know of the devices that the board drives: channels of motor drivers, levels at rest, pulses of
servos.

`motor_channels` says what each channel that is wired to the board lacks to drive a motor. Which connectors are the inputs of a
channel is data of the motor driver (`parts/motor_drivers.toml` of the platform repository, whose head explains the keys).
Adapters of servo functions drive a motor through a complete channel; the variants for that are chosen by `drawn_kinds`.

The level of an output before the program sets it is data of the device's kind; the pulses of a servo that the user has measured
are in robosmi.toml. Both are set on the plan's connections; the target's text is generated elsewhere (`m2t`).
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path

from msgspec import Struct

from robosmi import resources
from robosmi.base.data_tables import DataTable
from robosmi.errors import SourceError, did_you_mean
from robosmi.metamodels import hardware, migration, platform
from robosmi.project import ServoTrim, read_data
from robosmi.transformations.knowledge.wildcards import Wildcards

_PWM = "pwm"
Pins = Mapping[str, platform.Pin]
"""Plain name of a connector -> the pin of the board there."""

_FILE = "parts/motor_drivers.toml"
_MOTOR_DRIVER = "motor driver"
"""The kind of these parts, as `parts/electrical.toml` calls it."""
_BLANKS = re.compile(r"[\s_-]+")


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
    kinds = {str(device.kind) for device in devices if device is not None} - {_MOTOR_DRIVER}
    if any(not channel.missing for channel in channels):
        kinds.add(_MOTOR_DRIVER)
    return frozenset(kind.replace(" ", "-") for kind in kinds)


def _is_driver(component: hardware.Component) -> bool:
    return component.device is not None and component.device.kind == _MOTOR_DRIVER


def _channels(driver: hardware.Component, connections: Sequence[migration.Connection]) -> list[migration.MotorChannel]:
    known = _driver_inputs(str(connector.name) for connector in driver.connectors)
    pins = {_plain_name(str(end.name)): c.pin for c in connections if c.pin is not None for end in c.connectors}
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
    return [connector for connector in driver.connectors if _plain_name(str(connector.name)) in names]


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


class DriverChannel(Struct, frozen=True):
    """The inputs of one motor: the names of the connectors for PWM and for the two directions."""

    pwm: Wildcards
    first: Wildcards
    second: Wildcards
    needs_pwm: bool


class DriverInputs(Struct, frozen=True):
    """The inputs of one kind of motor driver.

    Attributes:
        channels: one for each motor.
        jumper: whether the PWM input may be held high on the part itself.
        awake: names of the inputs that are high while the driver works.
        sleeps: whether it sleeps while such an input is connected to nothing.
        only: a part of this kind has a connector with one of these names; empty if any part with these channels is of this kind.
    """

    channels: tuple[DriverChannel, ...]
    jumper: bool
    awake: Wildcards
    sleeps: bool
    only: Wildcards


def _driver_inputs(connectors: Iterable[str]) -> DriverInputs | None:
    """The inputs of a motor driver with connectors of these names; None if it is of no known kind.

    Raises:
        PlatformDataError: the table is damaged.
    """
    path = resources.find("platform_repo", _FILE)
    words = {_plain_name(name) for name in connectors}
    return next((known for known in _known(path, path.stat().st_mtime_ns) if _is_of(known, words)), None)


def _plain_name(connector: str) -> str:
    """The name of a connector as the table writes it: in lower case, without blanks, underscores and hyphens."""
    return _BLANKS.sub("", connector.lower())


def _is_of(known: DriverInputs, words: set[str]) -> bool:
    marked = known.only == _ANY or any(word in known.only for word in words)
    return marked and any(any(w in c.first for w in words) or any(w in c.second for w in words) for c in known.channels)


_ANY = Wildcards.of(())


@lru_cache(maxsize=2)
def _known(path: Path, _: int) -> tuple[DriverInputs, ...]:
    return tuple(
        DriverInputs(
            tuple(
                DriverChannel(
                    Wildcards.of(channel.texts("pwm", ())),
                    Wildcards.of(channel.texts("first")),
                    Wildcards.of(channel.texts("second")),
                    bool(channel.texts("pwm", ())),
                )
                for channel in driver.tables("channels")
            ),
            driver.flag("jumper", False),
            Wildcards.of(driver.texts("awake", ())),
            driver.flag("sleeps", False),
            Wildcards.of(driver.texts("only", ())),
        )
        for driver in DataTable(path, read_data(path)).tables("driver")
    )


def set_rest_levels(connections: Sequence[migration.Connection]) -> None:
    """Set the level at which the driven device is inactive, for each output connection whose kind of device has one.

    Args:
        connections: the connections of the target board, with their circuit described.
    """
    for connection in connections:
        device = connection.component.device if connection.component is not None else None
        can = connection.pin is not None and "digital" in connection.pin.abilities
        if device is not None and can and connection.signal is migration.Signal.write:
            connection.restLevel = device.rest


def set_servo_trims(
    connections: Sequence[migration.Connection], bindings: Sequence[migration.PortBinding], servos: Mapping[str, ServoTrim]
) -> None:
    """Set the measured neutral pulses and speeds (in microseconds) on the connections of servos.

    Args:
        connections: of the target board.
        bindings: of the program's ports.
        servos: title of a component, `#model_index`, role or name of a port, or name of a connection -> what was measured.

    Raises:
        SourceError: a name means no servo, one of several, or one that another name means, too.
    """
    told: dict[int, str] = {}
    for name, trim in servos.items():
        found = _named(name, connections, bindings)
        if len({id(c.component) for c in found}) > 1:
            titles = ", ".join(f"#{c.component.elementId}" for c in found if c.component is not None)
            raise SourceError(f"[servos] '{name}' is ambiguous: {titles}", location=trim.place, fix="use one of these")
        driven = [c for c in found if c.signal is not migration.Signal.read]
        if not driven:
            known = [c.component.title for c in connections if c.component is not None and c.signal is migration.Signal.write]
            known += [str(b.name) for b in bindings]
            what = "has no pin that drives it" if found else f"is not a component, role or port{did_you_mean(name, known)}"
            offered = ", ".join(f"'{each}'" for each in dict.fromkeys(known)) or "none is driven"
            raise SourceError(f"[servos] '{name}' {what}", location=trim.place, fix=f"use one of: {offered}")
        if other := next((told[id(c)] for c in driven if id(c) in told), ""):
            what = f"[servos] '{name}' and '{other}' are the same servo"
            raise SourceError(what, location=trim.place, fix="give the values of each servo once")
        told |= {id(connection): name for connection in driven}
        for connection in driven:
            connection.neutralMicroseconds = trim.neutral
            connection.speeds.clear()
            connection.speeds.extend(migration.ServoSpeed(speed=speed, microseconds=pulse) for speed, pulse in trim.speeds)


def _named(
    name: str, connections: Sequence[migration.Connection], bindings: Sequence[migration.PortBinding]
) -> list[migration.Connection]:
    """The connections that a name refers to: by their ports if any has that name, else by component or connection."""
    bound = [b.connection for b in bindings if b.connection is not None and name in (b.name, *b.names)]
    drawn = [
        c
        for c in connections
        if c.component is not None and name in (c.component.title, f"#{c.component.elementId}", str(c.name))
    ]
    return bound or drawn
