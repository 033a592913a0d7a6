"""Where the ports of a program are on both boards, and which simulated device stands at each: the binding of a verification.

The ports, their pins on the target and the functions that use them are those of a stored plan. Which device a use means is data
of the source platform (`devices.toml`), what devices show at rest data of simulation. Nothing is run here.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from robosmi import resources
from robosmi.errors import UsageError, did_you_mean
from robosmi.metamodels import migration
from robosmi.project import read_data
from robosmi.transformations.knowledge.platform_api import ApiIndex
from robosmi.transformations.queries.code import views
from robosmi.transformations.queries.pin_uses import pin_uses
from robosmi.verify.scenario import POINTS, Points, Scenario
from robosmi.verify.simulation import DeviceUse
from robosmi.verify.tables import DataTable

_REST = "simulation/devices.toml"
_CHANNEL = re.compile(r"AD(\d+)|.*\.channel_(\d+)")
CONSOLE, TYPING = "console", "typing"
"""What scenarios call the console, and the device that types there."""


@dataclass(frozen=True)
class BoundPort:
    """A port of the program on both boards.

    Attributes:
        name: constant or variable of the program, the name of a conventional port, or P12.
        source: its pin on the source board (`P12`, `AD0`).
        target: label of its pin on the target, or empty where it is not wired.
        component: title of the component there, or empty.
        identity: of the component in the drawing, or empty.
        functions: the platform's functions that use it.
        device: kind of the device that plays it, or empty where the program's own doing is watched.
        line: whether it is a line of a bus or of a serial connection, which is neither played nor compared.
        pin: what the device calls it.
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

    @property
    def watched(self) -> bool:
        """Whether what the program does there is compared."""
        return bool(self.target) and not self.device and not self.line

    @property
    def title(self) -> str:
        """What reports call it: the component with the port."""
        return f"{self.component} ({self.name})" if self.component else self.name

    def to_json(self) -> dict[str, Any]:
        """The contract's form (`binding[]`)."""
        return {
            "port": self.name, "component": self.component or None, "source": self.source, "target": self.target or None,
            "device": self.device or None,
        }  # fmt: skip


def bound_ports(plan: migration.MigrationPlan) -> list[BoundPort]:
    """The ports of a plan's program, in the order of the plan.

    Args:
        plan: a stored plan with its program and its source platform.
    """
    assert plan.program is not None
    assert plan.source is not None
    uses: dict[int, dict[str, set[str]]] = {}
    for use in pin_uses(views(plan.program, ApiIndex.of(plan.source))):
        if use.pin is not None:
            uses.setdefault(use.pin, {}).setdefault(use.function, set()).add(use.direction)
    rules = _rules(str(plan.source.name))
    lines = set(_table(str(plan.source.name)).table("lines").texts("functions", ()))
    found: dict[str, BoundPort] = {}
    for binding in plan.portBindings:
        channel = _CHANNEL.fullmatch(str(binding.name))
        number = int(binding.sourcePin)
        if channel is None and number < 0:
            continue
        source = f"AD{channel[1] or channel[2]}" if channel is not None else f"P{number}"
        connection = binding.connection
        pin = connection.pin if connection is not None and connection.pin is not None else binding.pin
        component = connection.component if connection is not None else None
        used = uses.get(number, {}) if channel is None else {}
        line = not lines.isdisjoint(used)
        device, called = ("", "") if line else _device(rules, used, channel is not None)
        port = BoundPort(
            str(binding.name), source, str(pin.label) if pin is not None else "",
            str(component.title or component.partTitle) if component is not None else "",
            str(component.elementId) if component is not None else "", tuple(used), device, called, line,
        )  # fmt: skip
        found.setdefault(source, port)
    return list(found.values())


def reads_console(plan: migration.MigrationPlan) -> bool:
    """Whether a plan's program reads what is typed."""
    assert plan.source is not None
    known = _table(str(plan.source.name)).table("console").texts("reads", ())
    return any(use.name in known for use in plan.adapterUses)


@cache
def _rules(platform: str) -> tuple[DataTable, ...]:
    return tuple(_table(platform).tables("device", needed=False))


@cache
def _table(platform: str) -> DataTable:
    path = resources.find("platform_repo", f"{platform}/devices.toml")
    return DataTable(path, read_data(path))


def _device(rules: Sequence[DataTable], used: Mapping[str, set[str]], channel: bool) -> tuple[str, str]:
    """The kind of the device at a port, and what it calls the port; two empty texts for none."""
    ways = {"out" if way == "unknown" else way for told in used.values() for way in told}
    for rule in rules:
        if rule.flag("channels", False) != channel:
            continue
        wanted = set(rule.texts("ways", ()))
        if channel or (not used.keys().isdisjoint(rule.texts("functions", ())) and wanted <= ways):
            return rule.text("kind"), rule.text("pin")
    return "", ""


# ---- devices of a scenario


def device_facts() -> Mapping[str, Any]:
    """What devices show at rest and in generated scenarios, by kind."""
    return _facts(resources.find("platform_repo", _REST))


@cache
def _facts(path: Path) -> Mapping[str, Any]:
    return read_data(path)


def played(ports: Iterable[BoundPort], scenario: Scenario | None, target: bool) -> list[DeviceUse]:
    """The devices of a scenario at the pins of one of the boards; an input without a signal shows what it shows at rest.

    Args:
        ports: the ports.
        scenario: what happens; None for nothing.
        target: whether the pins are those of the target.

    Raises:
        UsageError: a signal is of no component, port or pin of the program.
    """
    ports = list(ports)
    signals = signals_of(ports, scenario)
    made: list[DeviceUse] = []
    for number, port in enumerate(ports):
        place = port.target if target else port.source
        kind = port.device
        if not place or not kind:
            continue
        given = dict(signals.get(number, {}))
        rest = device_facts().get(kind, {}).get("rest", {})
        settings: dict[str, Any] = {name: [[0.0, value]] for name, value in rest.items()}
        for name, points in given.items():
            before = settings.get(name, []) if points[0][0] > 0 else []  # at rest until its first point
            settings[name] = [*before, *(list(point) for point in points)]
        settings = settings or {POINTS: []}  # a device that does nothing at rest
        made.append(DeviceUse(kind, {port.pin: place}, settings))
    if CONSOLE in (scenario.signals if scenario is not None else {}):
        assert scenario is not None
        made.append(DeviceUse(TYPING, {}, {POINTS: [list(point) for point in scenario.signals[CONSOLE][POINTS]]}))
    return made


def signals_of(ports: Sequence[BoundPort], scenario: Scenario | None) -> dict[int, Mapping[str, Points]]:
    """The signals of a scenario by the number of their port.

    Raises:
        UsageError: a signal is of no component, port or pin of the program, or of one that the program does not read.
    """
    found: dict[int, Mapping[str, Points]] = {}
    for name, settings in (scenario.signals if scenario is not None else {}).items():
        if name == CONSOLE:
            if set(settings) != {POINTS}:
                raise UsageError("what is typed on the console is one list of points", fix='write console = [[100, "text"]]')
            continue
        fitting = [n for n, port in enumerate(ports) if name in _names(port)]
        inputs = [n for n in fitting if ports[n].device]
        if not inputs:
            known = sorted({each for port in ports if port.device for each in _names(port)[:2] if each})
            why = (
                "which the program does not read" if fitting else f"which is no component, port or pin{did_you_mean(name, known)}"
            )
            raise UsageError(f"the scenario has a signal of '{name}', {why}", fix=f"use one of: {', '.join([*known, CONSOLE])}")
        if len(inputs) > 1:
            raise UsageError(
                f"the scenario has a signal of '{name}', which has {len(inputs)} ports",
                fix=f"use one of: {', '.join(ports[n].name for n in inputs)}",
            )
        found[inputs[0]] = settings
    return found


def _names(port: BoundPort) -> tuple[str, ...]:
    return (port.component, port.name, f"#{port.identity}" if port.identity else "", port.source, port.target)
