"""The devices of a scenario: which are connected to either board, and what each of them shows.

`port_devices` says which device is at a port. A signal may have only values that its device can show, as
`platform_repo/simulation` lists them: the models of the two boards might play an impossible value differently. Nothing is run
here.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

from msgspec import Struct

from robosmi.diagnostics import Location
from robosmi.errors import UsageError, did_you_mean
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort, at_rest
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.verify.bench import device_class
from robosmi.verify.scenario import POINTS, Points, Scenario
from robosmi.verify.simulation import DeviceUse

CONSOLE, TYPING = "console", "typing"
"""Name of the console in scenarios, and kind of the device that types there."""
_STORED_BYTES = "stored_bytes"
"""Kind of the device that fills the board's memory before the program starts."""


class PlayedDevice(Struct, frozen=True):
    """A device at one or several ports.

    Attributes:
        kind: kind of the device.
        ports: the indices of its ports among those of the program.
        pins: the device's name of a pin -> label of the board's pin.
        settings: the settings that the program's calls give.
    """

    kind: str
    ports: tuple[int, ...]
    pins: Mapping[str, str]
    settings: Mapping[str, Any]


def devices_at(ports: Sequence[BoundPort], target: bool) -> list[PlayedDevice]:
    """The devices at the pins of one of the boards, in the order in which they are connected.

    A device is left out if a pin that it needs is not wired there.
    """
    groups: dict[str, list[int]] = {}
    for number, port in enumerate(ports):
        if port.device:
            groups.setdefault(port.group or port.source or port.name, []).append(number)
    found = []
    for numbers in groups.values():
        first = ports[numbers[0]]
        at = [(ports[n].pin.split(), ports[n].target if target else ports[n].source) for n in numbers]
        places = {called: place for names, place in at for called in names}
        wired = {called: place for called, place in places.items() if place}
        on_bus = not first.pin
        split = device_facts().get(first.device, {}).get("split") if target and first.split else None
        if split is not None:
            places = dict(zip(split["pins"], first.split, strict=True))
            found.append(PlayedDevice(split["kind"], tuple(numbers), places, first.settings))
            continue
        motor = next((ports[n].motor for n in numbers if ports[n].motor), None) if target else None
        if motor is not None:
            places = {**{called: place for called, place in wired.items() if called != "servo"}, **motor}
            found.append(PlayedDevice(device_facts()[first.device]["motor"], tuple(numbers), places, first.settings))
            continue
        if (wired or on_bus) and set(device_class(first.device).pin_names) <= wired.keys():
            found.append(PlayedDevice(first.device, tuple(numbers), wired, first.settings))
    return found


def played(ports: Iterable[BoundPort], scenario: Scenario | None, target: bool) -> list[DeviceUse]:
    """The devices of a scenario at the pins of one of the boards; an input without a signal shows its value at rest.

    Args:
        ports: the ports.
        scenario: the scenario; None if nothing happens.
        target: whether the pins are those of the target.

    Raises:
        UsageError: a signal is of no component, port or pin of the program.
    """
    ports = list(ports)
    signals = signals_of(ports, scenario)
    made: list[DeviceUse] = []
    for device in devices_at(ports, target):
        given = next((signals[n] for n in device.ports if n in signals), {})
        kinds = frozenset().union(*(ports[n].kinds for n in device.ports))
        settings: dict[str, Any] = {name: [[0.0, value]] for name, value in at_rest(ports[device.ports[0]].device, kinds).items()}
        for name, points in given.items():
            before = settings.get(name, []) if points[0][0] > 0 else []  # at rest until its first point
            settings[name] = [*before, *(list(point) for point in points)]
        known = device_class(device.kind).setting_names
        if not settings and known.get(POINTS, None) is ...:
            settings = {POINTS: []}  # a device that does nothing at rest
        fixed = device_facts().get(device.kind, {}).get("fixed", {})
        made.append(DeviceUse(device.kind, device.pins, {**fixed, **device.settings, **settings}))
    if CONSOLE in (scenario.signals if scenario is not None else {}):
        assert scenario is not None
        made.append(DeviceUse(TYPING, {}, {POINTS: [list(point) for point in scenario.signals[CONSOLE][POINTS]]}))
    if scenario is not None and scenario.stored:
        made.append(DeviceUse(_STORED_BYTES, {}, {"bytes": {str(row[0]): list(row[1:]) for row in scenario.stored}}))
    return made


def brief_pins(ports: Iterable[BoundPort], target: bool) -> list[str]:
    """The pins at which all that a program does is for a device: no channel shows it, so that each change need not be recorded.

    Args:
        ports: the ports.
        target: whether the pins are those of the target.
    """
    seen: dict[str, bool] = {}
    for port in ports:
        facts = device_facts().get(port.device, {})
        shows = not port.device or port.shown or port.pulsed or facts.get("driven", facts.get("driven_as_output", False))
        place = port.target if target else port.source
        seen[place] = shows or seen.get(place, False)
    return sorted(place for place, shows in seen.items() if place and not shows)


def signals_of(ports: Sequence[BoundPort], scenario: Scenario | None) -> dict[int, Mapping[str, Points]]:
    """The signals of a scenario by the index of their port, the first port if the device has several."""
    found: dict[int, Mapping[str, Points]] = {}
    named: dict[int, str] = {}
    place = Location(str(scenario.path)) if scenario is not None and scenario.path is not None else None
    for name, settings in (scenario.signals if scenario is not None else {}).items():
        if name == CONSOLE:
            if set(settings) != {POINTS}:
                message = "the console's input must be one list of points"
                raise UsageError(message, location=place, fix='write console = [[100, "text"]]')
            check_signal(name, POINTS, settings[POINTS], device_facts()[TYPING], place)
            continue
        fitting = [n for n, port in enumerate(ports) if name in _names(port)]
        inputs = [n for n in fitting if ports[n].device]
        if not inputs:
            known = sorted({each for port in ports if port.device for each in _names(port)[:2] if each})
            why = (
                "but the program does not read it"
                if fitting
                else f"but there is no such component, port or pin{did_you_mean(name, known)}"
            )
            message, fix = f"the scenario has a signal for '{name}', {why}", f"use one of: {', '.join([*known, CONSOLE])}"
            raise UsageError(message, location=place, fix=fix)
        if len({ports[n].group or n for n in inputs}) > 1:
            raise UsageError(
                f"the scenario has a signal for '{name}', but it has {len(inputs)} ports",
                location=place,
                fix=f"use one of: {', '.join(ports[n].name for n in inputs)}",
            )
        for setting, points in settings.items():
            check_signal(name, setting, points, device_facts().get(ports[inputs[0]].device, {}), place)
        group = ports[inputs[0]].group
        first = next(n for n, port in enumerate(ports) if port.group == group) if group else inputs[0]
        if first in found:
            raise UsageError(
                f"the scenario has a signal for '{named[first]}' and for '{name}', but both are the same device",
                location=place,
                fix="write only one of them, with all points",
            )
        found[first], named[first] = settings, name
    return found


def _names(port: BoundPort) -> tuple[str, ...]:
    return (port.component, port.name, f"#{port.identity}" if port.identity else "", port.source, port.target)


# ---- values of signals


def check_signal(name: str, setting: str, points: Points, facts: Mapping[str, Any], place: Location | None = None) -> None:
    """Check the values of a signal against what its device takes.

    Args:
        name: the component, port or pin, as the scenario has it.
        setting: of the device.
        points: the signal.
        facts: facts of the device: `takes`, the kinds of values by setting, and `limits`, the least and the greatest number.
        place: the place of the scenario, for messages.

    Raises:
        UsageError: a value is of another kind, or beyond the limits.
    """
    kinds = facts.get("takes", {}).get(setting)
    if kinds is None:
        return
    limits = facts.get("limits", {}).get(setting)
    for at_ms, value in points:
        fitting = [kind for kind in kinds if _KINDS[kind][1](value)]
        if not fitting or (limits is not None and value is not None and not _is_within(value, *limits)):
            shown = '"none"' if value is None else repr(value)
            said = f"the signal for '{name}' has {shown} at {at_ms:g} ms"
            raise UsageError(
                f"{said}, outside its device's range" if fitting else f"{said}, not a {_KINDS[kinds[0]][0]}",
                fix=f"write {' or '.join(_KINDS[kind][0] for kind in kinds)}{_told(limits)}",
                location=place,
            )


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _are(count: int, is_one: Callable[[Any], bool]) -> Callable[[Any], bool]:
    return lambda value: isinstance(value, (list, tuple)) and len(value) == count and all(is_one(each) for each in value)


_KINDS: Mapping[str, tuple[str, Callable[[Any], bool]]] = {
    "level": ("level (0 or 1)", lambda value: _is_whole(value) and value in (0, 1)),
    "number": ("number", _is_number),
    "whole number": ("whole number", _is_whole),
    "text": ("text", lambda value: isinstance(value, str)),
    "bytes": (
        "list of bytes",
        lambda value: isinstance(value, (list, tuple)) and all(_is_whole(b) and b in range(256) for b in value),
    ),
    "2 whole numbers": ("list of 2 whole numbers", _are(2, _is_whole)),
    "3 numbers": ("list of 3 numbers", _are(3, _is_number)),
    "4 whole numbers": ("list of 4 whole numbers", _are(4, _is_whole)),
    "none": ('"none"', lambda value: value is None),
}
"""The data's word for a kind of value -> its name for people, and a test whether a value is one."""


def _is_within(value: Any, least: Any, most: Any) -> bool:
    """Whether a number, or each number of a list, is within its limits; other kinds of values have none."""
    if isinstance(value, (list, tuple)):
        if not isinstance(least, (list, tuple)):
            return True
        return all(_is_within(each, *bounds) for each, *bounds in zip(value, least, most, strict=True))
    return not _is_number(value) or least <= value <= most


def _told(limits: Any) -> str:
    if limits is None:
        return ""
    least, most = limits
    return f", from {least} to {most}"
