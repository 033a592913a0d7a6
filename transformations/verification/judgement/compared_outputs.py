"""What a comparison covers: which of the wired outputs were compared, and what nothing reaches from main."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from robosmi.metamodels import ccode
from robosmi.transformations.queries.programs.live_code import live_in
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.transformations.verification.original_side import CONSOLE_CHANNEL, DRIVEN, PULSED, STANDING
from robosmi.transformations.verification.pause_comparison import PAUSES
from robosmi.transformations.verification.rest_comparison import RESTING
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.verify.traces.comparison import DIFFERENT, NOT_EXERCISED, SAME
from robosmi.verify.traces.verdict import PROGRAM, Verdict

_ASPECTS = (DRIVEN, PULSED, STANDING, RESTING)
"""What the name of a channel ends with that is a second view of an output."""


def compared_outputs(
    verdict: Verdict, ports: Sequence[BoundPort], dead: Collection[tuple[str, int]] = frozenset()
) -> dict[str, bool]:
    """Each output that is wired on both boards -> whether something was compared there.

    These are the ports that the program drives, what devices such as displays receive, the lines of buses, the console if the
    program prints, and the EEPROM if it stores something. A port of the source that is several pins of the target is one that is
    not compared. An output that only unreachable code drives is none. An input that the program also drives is one.

    Args:
        verdict: the verdict, with its scenarios.
        ports: the ports.
        dead: file name and line of what nothing reaches from main.
    """
    idle = {port.title for port in ports if port.called_at and port.called_at <= set(dead)}
    found = {
        port.title: False
        for port in ports
        if port.target and (port.watched or port.line or port.shares_with) and port.title not in idle
    }
    inputs = {port.title for port in ports if device_facts().get(port.device, {}).get("driven_as_output")}
    for channel in verdict.channels():
        name, status = str(channel["name"]), channel["status"]
        if name.endswith(PAUSES) or (status == NOT_EXERCISED and (name in (PROGRAM, CONSOLE_CHANNEL) or name in idle)):
            continue  # a sensor that the program asks is no output
        if not name.endswith(_ASPECTS):
            found[name] = found.get(name, False) or status in (SAME, DIFFERENT)
        elif status in (SAME, DIFFERENT) and ((output := _output(name)) in found or output in inputs):
            found[output] = True
    found |= {name: False for name in (CONSOLE_CHANNEL, EEPROM_CHANNEL) if name in verdict.not_compared}
    return found


def _output(channel: str) -> str:
    return next(channel.removesuffix(aspect) for aspect in _ASPECTS if channel.endswith(aspect))


def unreachable_functions(units: Sequence[ccode.SourceUnit]) -> dict[tuple[str, str], str]:
    """The functions of a program that nothing reaches from main: (file name, name) -> `file:first-last name`.

    Args:
        units: of the program.
    """
    live = {id(element) for element in live_in(units)}
    return {
        (Path(str(unit.path)).name, str(each.name)): f"{Path(str(unit.path)).name}:{each.line} {each.name}"
        for unit in units
        for each in unit.declarations
        if isinstance(each, ccode.Function) and each.body is not None and id(each) not in live
    }
