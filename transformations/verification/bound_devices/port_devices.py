"""Where the ports of a program are on both boards, and which simulated device is at each: the binding of a verification.

The ports, their pins on the target and the functions that use them are those of a stored plan. Which device a function stands
for is data of the source platform (`devices.toml`), what devices show at rest is data of the simulation. `_wired_devices` finds
devices at several ports, or with settings in the program's calls: serial lines, keypads, servos with feedback (`[[wired]]` in
`devices.toml`). `played_devices` plays the signals of a scenario with all of them. Nothing is run here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi import inputs, resources
from robosmi.base.data_tables import DataTable
from robosmi.base.data_text import Json
from robosmi.metamodels import ccode, migration, platform
from robosmi.project import read_data
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.circuits.component_kinds import kinds_of
from robosmi.transformations.queries.code import CodeView, views
from robosmi.transformations.queries.flows.pin_uses import PinUse, pin_number, pin_uses, pin_values
from robosmi.transformations.queries.own_headers import unit_of
from robosmi.transformations.queries.plans.motors import SERVO, channel_of, servo_pins
from robosmi.transformations.queries.plans.plan_adapters import OwnFunctionPins, rest_levels
from robosmi.transformations.queries.plans.port_pins import CONSOLE, bound_pin
from robosmi.transformations.queries.plans.retained_pins import retains_platform
from robosmi.transformations.queries.ports.port_flows import port_flows
from robosmi.transformations.queries.ports.ports import program_ports
from robosmi.transformations.queries.ports.split_wires import answering_pin, written_pin
from robosmi.transformations.queries.values import Values
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts

ANY_LEVEL = -1
_LEVELS = {"low": 0, "high": 1}
LEVELS_DEVICE, _LEVELS_PIN = "levels", "pin"
"""Kind of the device, and its pin, that plays a port at which the program reads levels."""
_CHANNEL = re.compile(r"AD(\d+)|.*\.channel_(\d+)")


class BoundPort(Struct, frozen=True):
    """A port of the program on both boards.

    Attributes:
        name: constant or variable of the program, the name of a conventional port, or P12.
        source: its pin on the source board (`P12`, `AD0`).
        target: label of its pin on the target, or empty where it is not wired.
        component: title of the component there, or empty.
        identity: of the component in the drawing, or empty.
        functions: the platform's functions that use it.
        called_at: file name and line of each of their calls that uses it, as far as they are known.
        device: kind of the device that is simulated there; empty if none is and what the program itself does is compared.
        line: whether it is a line of a bus or of a serial connection, which is neither simulated nor compared.
        pin: the device's name of the port; several names, separated by spaces, if it is several of its pins.
        group: `source` of the first port of the device if that has several ports; otherwise empty.
        settings: those settings of the device that the program's calls give.
        shown: whether what the program does there is compared although a device is there.
        pulsed: whether one function makes all pulses there, each in one go, so that their widths are exact.
        averaged: whether it represents a voltage, so that only the duty cycle of a wave there is compared.
        kinds: kinds of the component, known by its name (`parts/port_roles.toml`).
        split: labels of the target's pins that trigger the component and receive its answer, if these are two; otherwise empty.
        motor: the wheel's name of an input of the motor driver -> label of the target's pin, if a motor takes the servo's place.
        given_up: whether the user or a rule said that it is on no pin of the target.
        console: whether the port is the console, which takes no pins of the target.
        shares_with: title of another port that has the same pin of the source and another one of the target; otherwise empty.
            In the source's trace the two cannot be told apart.
        near: how far from a border of the program values are tried, as per cent and an addition; None for the device's usual
            distance.
        loop_ms: tolerance of the end of a wait in milliseconds, if the program waits for the device in a closed loop.
        placed: whether the program drives the device to positions that the device reports.
        timed: whether the program drives the device for a time.
        recounts: how far the last goal has to be from where the device stands for the next goal to be counted from there; 0 if it
            is always counted from the last one.
        most: greatest value that the board's pin can show of a signal that is measured as it is; 0 for no bound.
        rests_high: whether the target holds its pin high from its start, since the component there does nothing at that level.
    """

    name: str
    source: str
    target: str
    component: str = ""
    identity: str = ""
    functions: tuple[str, ...] = ()
    device: str = ""
    pin: str = ""
    line: bool = False
    group: str = ""
    settings: Mapping[str, Any] = {}
    shown: bool = False
    averaged: bool = False
    pulsed: bool = False
    called_at: frozenset[tuple[str, int]] = frozenset()
    kinds: frozenset[str] = frozenset()
    split: tuple[str, ...] = ()
    motor: Mapping[str, str] = {}
    given_up: bool = False
    console: bool = False
    shares_with: str = ""
    loop_ms: float = 0.0
    placed: bool = False
    timed: bool = False
    recounts: float = 0.0
    near: tuple[float, float] | None = None
    most: float = 0.0
    rests_high: bool = False

    @property
    def watched(self) -> bool:
        """Whether what the program does there is compared."""
        return self.compared and (self.shown or not self.device) and not self.line

    @property
    def compared(self) -> bool:
        """Whether anything that happens there can be compared: it is wired, and a pin of its own on both boards."""
        return bool(self.target) and not self.shares_with

    @property
    def title(self) -> str:
        """What reports call it: the component with the port."""
        return f"{self.component} ({self.name})" if self.component else self.name

    def to_json(self) -> dict[str, Any]:
        """The port as an element of `binding[]` in the JSON contract."""
        return {
            "port": self.name, "component": self.component or None, "source": self.source, "target": self.target or None,
            "device": self.device or None, "console": self.console,
        }  # fmt: skip


VOLTAGES = "voltages"
"""Kind of the device that shows a voltage at a pin of the converter, in millivolts."""


def bound_ports(plan: migration.MigrationPlan, folder: Path | None = None) -> list[BoundPort]:
    """The ports of a plan's program, in the order of the plan.

    Args:
        plan: a stored plan with its program and its source platform.
        folder: where the program's files are stored under the paths of the plan; without it, uses of ports in the bodies of
            macros and those that are decided at run time are not found.
    """
    assert plan.program is not None
    assert plan.source is not None
    own = OwnFunctionPins(plan)
    api = ApiIndex.of(plan.source).adapted(own)
    seen = views(plan.program, api)
    uses: dict[int, dict[str, set[str]]] = {}
    places: dict[int, set[tuple[str, int]]] = {}
    for use in _uses(plan, seen, folder):
        if use.pin is not None:
            uses.setdefault(use.pin, {}).setdefault(use.function, set()).add(use.direction)
            places.setdefault(use.pin, set()).add((Path(str(unit_of(use.call).path)).name, use.line))
    table = device_table(str(plan.source.name))
    resting = resting_pins(plan)
    averaged = set(table.texts("averaged", ()))
    pulses, beside = (set(table.texts(name, ())) for name in ("pulses", "pulses_beside"))
    rules, lines = table.tables("device", needed=False), set(table.table("lines").texts("functions", ()))
    found: dict[str, BoundPort] = {}
    others: list[BoundPort] = []
    for binding in plan.portBindings:
        channel = _CHANNEL.fullmatch(str(binding.name))
        number = int(binding.sourcePin)
        if channel is None and number < 0:
            continue
        source = f"AD{channel[1] or channel[2]}" if channel is not None else api.port_name(number)
        connection = binding.connection
        pin = bound_pin(binding)
        component = connection.component if connection is not None else None
        used = uses.get(number, {}) if channel is None else {}
        line = not lines.isdisjoint(used)
        device, called, near = ("", "", None) if line else _device(rules, used, channel is not None)
        if not (device or line) and any("in" in used[function] for function in used.keys() & own.levels_read()):
            device, called = LEVELS_DEVICE, _LEVELS_PIN
        port = BoundPort(
            str(binding.name), source, str(pin.label) if pin is not None else "",
            str(component.title or component.partTitle) if component is not None else "",
            str(component.elementId) if component is not None else "", tuple(used), device, called, line,
            averaged=bool(used) and bool(averaged & used.keys()),
            pulsed=not pulses.isdisjoint(used) and used.keys() <= pulses | beside,
            kinds=frozenset(kinds_of(connection)) if connection is not None else frozenset(),
            split=_split(plan, binding), motor=_motor(plan, binding), given_up=not binding.open,
            console=binding.choice == CONSOLE, near=near,
            called_at=frozenset(places.get(number, ())) if used else frozenset(),
            rests_high=pin is not None and resting.get(str(pin.label)) == 1,
            most=plan.board.volts * 1000 if device == VOLTAGES and plan.board is not None and not retains_platform(plan) else 0.0,
        )  # fmt: skip
        first = found.setdefault(source, port)
        if first is not port and first.target and port.target and first.target != port.target:
            if binding.conventionalPort is not None:  # a device of several pins is at the ports that the convention says
                first, port = port, first
            found[source] = replace(first, shares_with=port.title)
            others.append(replace(port, shares_with=first.title, device="", pin=""))
    _connect(found, _wired_devices(seen, table.tables("wired", needed=False), _roles(plan)), api)
    found = {source: _with_motor(port) for source, port in found.items()}
    for source in _asked_by_convention(plan, api):
        there = found.get(source)
        if there is not None and not there.device and not there.line:
            found[source] = replace(there, device=LEVELS_DEVICE, pin=_LEVELS_PIN)
    return [*found.values(), *others]


def _asked_by_convention(plan: migration.MigrationPlan, api: ApiIndex) -> list[str]:
    """The source pins of conventional ports that are digital inputs and belong to no particular component."""
    return [
        api.port_name(int(binding.sourcePin))
        for binding in plan.portBindings
        if (port := binding.conventionalPort) is not None
        and port.direction == platform.Direction.input
        and port.capability == platform.PinCapability.digital
        and not port.componentRole
        and int(binding.sourcePin) >= 0
    ]


_MOTOR_SPEED = 128
"""The greatest speed, in ticks/s, of a wheel whose motor takes the place of a servo: that of full power."""


def _with_motor(port: BoundPort) -> BoundPort:
    """The port with the wheel whose motion is compared if a motor takes the place of the servo: its pulses are levels there."""
    if not port.motor or (port.device and "servo" not in port.pin.split()):
        return port
    settings = {**port.settings, "ticks_per_s_limit": _MOTOR_SPEED}
    if port.device:
        return replace(port, settings=settings, shown=False)
    return replace(port, device="wheel", pin="servo", group=port.source, settings={**settings, "timed": 1}, timed=True)


def _motor(plan: migration.MigrationPlan, binding: migration.PortBinding) -> dict[str, str]:
    """The pins of the motor driver's channel that serves a port; empty if it is on none."""
    channel = channel_of(binding, (each for each in plan.motorChannels if not each.missing))
    if channel is None or binding.role != SERVO:
        return {}
    _, enable, first, second, awake = servo_pins(channel, [binding])
    pins = {"enable": enable, "first": first, "second": second, "awake": awake}
    return {name: str(pin.label) for name, pin in pins.items() if pin is not None}


def _split(plan: migration.MigrationPlan, binding: migration.PortBinding) -> tuple[str, ...]:
    """The pins of a component with a wire for each direction: the one that triggers it, and the one that answers."""
    pins = (written_pin(binding, list(plan.connections)), answering_pin(binding))
    return tuple(str(pin.label) for pin in pins if pin is not None)


def _uses(plan: migration.MigrationPlan, seen: Sequence[CodeView], folder: Path | None) -> list[PinUse]:
    """What the program does with its ports."""
    if folder is None:
        return pin_uses(seen)
    assert plan.program is not None
    try:
        sources = {str(u.path): inputs.read_bytes(folder / str(u.path), inputs.SOURCE) for u in plan.program.units}
    except OSError:
        return pin_uses(seen)  # the caller that needs the files reports that they are missing
    ports = program_ports(seen, port_flows(seen, sources)).ports
    return [use if use.pin == port.pin else replace(use, pin=port.pin) for port in ports for use in port.uses]


def _roles(plan: migration.MigrationPlan) -> dict[str, int]:
    """The conventional ports of a plan: name of the role -> number."""
    return {str(name): int(b.sourcePin) for b in plan.portBindings for name in (b.name, *b.names) if b.sourcePin >= 0}


def _connect(ports: dict[str, BoundPort], devices: Sequence[WiredDevice], api: ApiIndex) -> None:
    """Assign devices with several ports to these; a device on the bus gets a port of its own, named by its address."""
    for device in devices:
        if not device.pins:
            place = f"I2C {device.settings['address']:#04x}"
            ports[place] = BoundPort(place, place, place, device=device.kind, settings=device.settings)
            continue
        at = {called: api.port_name(number) for called, number in device.pins.items()}
        if not set(at.values()) <= ports.keys():
            continue
        group = next(iter(at.values()))
        functions = {name for source in at.values() for name in ports[source].functions}
        closed, placed, timed = (not functions.isdisjoint(by) for by in (device.closed_by, device.placed_by, device.timed_by))
        settings = {**device.settings, "timed": int(timed)} if device.placed_by else device.settings
        shown = () if closed else device_facts().get(device.kind, {}).get("shown", ())
        for source in dict.fromkeys(at.values()):
            called = [name for name, place in at.items() if place == source]
            ports[source] = replace(
                ports[source], device=device.kind, pin=" ".join(called), line=False, group=group, settings=settings,
                shown=not set(called).isdisjoint(shown), loop_ms=device.loop_ms if closed else 0.0,
                placed=placed, timed=timed, recounts=device.recounts,
            )  # fmt: skip


def resting_pins(plan: migration.MigrationPlan) -> dict[str, int]:
    """Label -> level (0 or 1) of the pins that a program holds from its start so that the component there does nothing.

    `ANY_LEVEL` stands for those that the target's core drives by itself.
    """
    core = {str(pin.label): ANY_LEVEL for pin in plan.board.pins if pin.drivenByCore} if plan.board is not None else {}
    return core | {str(c.pin.label): _LEVELS[str(c.restLevel)] for c in rest_levels(plan) if c.pin is not None}


@cache
def device_table(platform: str) -> DataTable:
    """The file `devices.toml` of a source platform: which device a function stands for, and what reads the console."""
    path = resources.find("platform_repo", f"{platform}/devices.toml")
    return DataTable(path, read_data(path))


def _device(
    rules: Sequence[DataTable], used: Mapping[str, set[str]], channel: bool
) -> tuple[str, str, tuple[float, float] | None]:
    """The kind of the device at a port (empty: none), its name of the port, and how far from borders values are tried."""
    ways = {way for told in used.values() for way in told}
    for rule in rules:
        if rule.flag("channels", False) != channel:
            continue
        wanted, beside = set(rule.texts("ways", ())), set(rule.texts("beside", ()))
        driven = not beside or not beside.isdisjoint(used)
        if channel or (not used.keys().isdisjoint(rule.texts("functions", ())) and wanted <= ways and driven):
            percent, more = rule.numbers("near", (0, 0))
            return rule.text("kind"), rule.text("pin"), (percent, more) if percent else None
    return "", "", None


def at_rest(device: str, kinds: frozenset[str]) -> Mapping[str, Json]:
    """What a device shows while nothing happens: setting -> value.

    Args:
        device: its kind.
        kinds: kinds of the component there.
    """
    facts = device_facts().get(device, {})
    own = [shown for kind, shown in facts.get("rest_of", {}).items() if kind in kinds]
    return dict(own[0] if own else facts.get("rest", {}))


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


def _wired_devices(views: Sequence[CodeView], rules: Sequence[DataTable], roles: Mapping[str, int]) -> list[WiredDevice]:
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
