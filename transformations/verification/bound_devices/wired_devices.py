"""Devices at several ports of a program, or with settings in its calls: serial lines, keypads, servos with feedback.

Which calls and conventional ports stand for such a device is data of the source platform (`[[wired]]` in `devices.toml`).
`port_devices` finds devices at a single port by the functions that use it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_tables import DataTable
from robosmi.metamodels import ccode
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.pin_uses import pin_number, pin_values
from robosmi.transformations.queries.values import Values


class WiredDevice(Struct, frozen=True):
    """A device as a program says that it is connected.

    Attributes:
        kind: kind of the device.
        pins: the device's name of a pin -> number of the port on the source board; empty for a device on a bus.
        settings: its settings, taken from the call.
        closed_by: functions that control the device in a closed loop on its own signals, so that every microsecond changes
            what the program does at its pins; what the device does is compared instead.
        loop_ms: by how much such a function may end earlier or later, in milliseconds.
        placed_by: functions that drive the device to a position that it reports, however long that takes.
        timed_by: functions that drive it until the program stops it.
        recounts: how far the last goal of such a function has to be from where the device stands for the next goal to be counted
            from there; 0 if it is always counted from the last one.
    """

    kind: str
    pins: Mapping[str, int]
    settings: Mapping[str, Any] = {}
    closed_by: tuple[str, ...] = ()
    loop_ms: float = 0.0
    placed_by: tuple[str, ...] = ()
    timed_by: tuple[str, ...] = ()
    recounts: float = 0.0


def wired_devices(views: Sequence[CodeView], rules: Sequence[DataTable], roles: Mapping[str, int]) -> list[WiredDevice]:
    """The devices of a program, in the order of the rules; no port is at two of them.

    Args:
        views: a view of each of its units.
        rules: the tables `[[wired]]` of its platform.
        roles: name of a conventional port -> its number.
    """
    found: list[WiredDevice] = []
    taken: set[object] = set()
    for rule in rules:
        apart, addresses = set(rule.numbers("apart", ())), rule.numbers("addresses", ())
        if len({tuple(_told(views, place)) for place in rule.texts("same", ())}) > 1:
            continue
        for device in _of_rule(views, rule, roles):
            places: set[object] = set(device.pins.values())
            if rule.flag("bus", False):
                address = device.settings.get("address")
                places = {("bus", address)} if address is not None and address in (addresses or (address,)) else set()
            if places and not places & (taken | apart):
                found.append(
                    replace(
                        device,
                        closed_by=rule.texts("closed_by", ()),
                        loop_ms=rule.optional_number("loop_ms") or 0,
                        placed_by=rule.texts("placed_by", ()),
                        timed_by=rule.texts("timed_by", ()),
                        recounts=rule.optional_number("recounts") or 0,
                    )
                )
                taken |= places
    return found


def _of_rule(views: Sequence[CodeView], rule: DataTable, roles: Mapping[str, int]) -> Iterator[WiredDevice]:
    """The devices that a rule finds: by arguments of several calls, by pairs of calls, or by single calls."""
    if "parts" in rule.values:
        return _of_parts(views, rule.text("kind"), rule.table("parts"), roles)
    if "pair" in rule.values:
        return _of_pairs(views, rule.text("kind"), rule.table("pair"))
    return _of_calls(views, rule)


def _of_calls(views: Sequence[CodeView], rule: DataTable) -> Iterator[WiredDevice]:
    """A device for each call that connects one."""
    pins, said = rule.numbers_by_name("pins"), rule.numbers_by_name("settings")
    for view, call in _calls(views, rule.texts("calls")):
        values = view.values
        connected: dict[str, int] = {}
        for name, position in pins.items():
            numbers = _ports(view, call, position, values)
            if name.endswith("*"):
                connected |= {f"{name[:-1]}{n}": number for n, number in enumerate(numbers) if number >= 0}
            elif len(numbers) == 1 and numbers[0] >= 0:
                connected[name] = numbers[0]
        settings = {name: number for name, position in said.items() if (number := _number(call, position, values)) is not None}
        yield WiredDevice(rule.text("kind"), connected, settings)


def _of_parts(views: Sequence[CodeView], kind: str, parts: DataTable, roles: Mapping[str, int]) -> Iterator[WiredDevice]:
    """The device whose pins are arguments of several calls or conventional ports; the first of these that is known for a pin
    counts.
    """
    pins: dict[str, int] = {}
    for name in parts.values:
        for place in parts.texts(name):
            numbers = [roles[place]] if place in roles else _told(views, place)
            if numbers:
                pins[name] = numbers[0]
                break
    if len(pins) == len(parts.values):
        yield WiredDevice(kind, pins)


def _of_pairs(views: Sequence[CodeView], kind: str, pair: DataTable) -> Iterator[WiredDevice]:
    """A device for each pair of calls in a function of the program: one triggers, and the next one after it measures the
    answer.

    If their ports are parameters of that function, the two ports given at the same call of it belong together.
    """
    asking, answering = pair.values
    for view in views:
        asked = _placed(view, pair.texts(asking))
        for answer, heard in _placed(view, pair.texts(answering)):
            around = _function_of(answer)
            before = [
                (int(call.startOffset), ports)
                for call, ports in asked
                if _function_of(call) is around and len(ports) == len(heard) and not set(ports) & set(heard)
            ]
            for at, ports in sorted(before, reverse=True):
                if at < answer.startOffset:
                    for turn, number in enumerate(heard):
                        yield WiredDevice(kind, {asking: ports[turn], answering: number})
                    break


def _placed(view: CodeView, places: Sequence[str]) -> list[tuple[ccode.Call, list[int]]]:
    """The calls of a unit with one of these arguments (`function position`), each with the ports that the argument can be."""
    values = view.values
    found = []
    for place in places:
        function, _, position = place.partition(" ")
        found += [(call, _ports(view, call, int(position), values)) for _, call in _calls((view,), (function,))]
    return found


def _function_of(call: ccode.Call) -> ccode.Function | None:
    """The function whose body contains a call; None outside of functions."""
    around = call.eContainer()
    while around is not None and not isinstance(around, ccode.Function):
        around = around.eContainer()
    return around


def _told(views: Sequence[CodeView], place: str) -> list[int]:
    """The ports that an argument (`function position`) can be, over all calls; none for a text without a position."""
    function, _, position = place.partition(" ")
    numbers: list[int] = []
    for view, call in _calls(views, (function,)) if position else ():
        numbers += _ports(view, call, int(position), view.values)
    return list(dict.fromkeys(numbers))


def _calls(views: Sequence[CodeView], names: Sequence[str]) -> Iterator[tuple[CodeView, ccode.Call]]:
    for view in views:
        for function in view.functions_of("platform", "posix"):
            if function.name in names:
                yield from ((view, call) for call in function.calls)


def _ports(view: CodeView, call: ccode.Call, position: int, values: Values) -> list[int]:
    """The ports that an argument can be; none if not all of them are constant."""
    arguments = list(call.arguments)
    function = next((f for f in view.called().values() if call in f.calls), None)
    facts = view.api.pins(function.name, function.header) if function is not None else None
    parameter = next((p for p in facts.parameters if p.position == position), None) if facts is not None else None
    if parameter is None or position >= len(arguments):
        return []
    numbers = [value.number for value in pin_values(parameter, arguments, arguments[position], values)]
    return [] if None in numbers else [pin_number(number) for number in numbers if number is not None]


def _number(call: ccode.Call, position: int, values: Values) -> int | None:
    """The constant value of an argument; None if it can have several, or is not constant."""
    arguments = list(call.arguments)
    found = values.of(arguments[position]) if position < len(arguments) else []
    return found[0].number if len(found) == 1 else None
