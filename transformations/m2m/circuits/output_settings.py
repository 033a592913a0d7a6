"""Sets on the plan's connections the levels that outputs have before the program sets them, and the measured values of servos.

The inactive level of a device is data of its kind; what the user has measured is in robosmi.toml. The target's text is
generated elsewhere (`m2t`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robosmi.errors import SourceError, did_you_mean
from robosmi.metamodels import migration
from robosmi.project import ServoTrim


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
