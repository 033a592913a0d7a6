"""The library calls of the source near a difference: the one that acts on that channel, and the ones around it.

The fault may lie in the adapter of any of these functions, and nothing seen from outside tells which: if a lamp is on for too
short a time, one function has switched it and another one has waited.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from pathlib import Path

from msgspec.structs import replace

from robosmi.transformations.verification.bound_devices.played_devices import played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.original_side import CONSOLE_CHANNEL, DRIVEN, PULSED, SourceRuns
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.verify.original import LibraryCall, Original
from robosmi.verify.scenario import Scenario
from robosmi.verify.traces.comparison import FirstDifference
from robosmi.verify.traces.verdict import CallsAround

_LONGEST_US = 3_000_000.0
"""Calls further away from the difference than this, in microseconds, are left out."""
_MARGIN_US = 1_000.0
_BEFORE, _AFTER = 6, 4
_MACRO = re.compile(r"^__builtin_propeller_")
"""Prefix of functions for which the platform's headers define macros with shorter names."""


def calls_around(
    program: Original, ports: Sequence[BoundPort], scenario: Scenario, runs: SourceRuns, difference: FirstDifference
) -> CallsAround:
    """The library calls of the source near a difference: those between the channel's events before and after it.

    Args:
        program: the original.
        ports: its ports.
        scenario: the scenario with the difference.
        runs: the runs of the original in it.
        difference: the difference.
    """
    at_us = difference.at_ms * 1000
    events = runs.channels.get(difference.channel, [[[]]])[0][0]
    earlier = max((event.at_us for event in events if event.at_us < at_us - 1), default=0.0)
    later = min((event.at_us for event in events if event.at_us > at_us + 1), default=at_us)
    begin_us = max(0.0, earlier - _MARGIN_US, at_us - _LONGEST_US)
    end_us = min(later + _MARGIN_US, at_us + _LONGEST_US, scenario.horizon_ms * 1000)
    if end_us <= begin_us:
        return CallsAround()
    made = program.calls(played(ports, scenario, target=False), begin_us, end_us)
    calls = [replace(call, function=_MACRO.sub("", call.function)) for call in made]
    maker = last_call_for(difference.channel, calls, ports, at_us, program.stores)
    told = {(call.function, call.file, call.line): call for call in calls if call.at_us <= at_us}
    after = {(call.function, call.file, call.line): call for call in reversed(calls) if call.at_us > at_us}
    near = [*sorted(told.values(), key=_when)[-_BEFORE:], *sorted(after.values(), key=_when)[:_AFTER]]
    around = {(call.function, call.file, call.line): call for call in near if call != maker}
    return CallsAround(maker, tuple(sorted(around.values(), key=_when)))


def last_call_for(
    channel: str, calls: Sequence[LibraryCall], ports: Sequence[BoundPort], at_us: float, stores: Collection[str] = ()
) -> LibraryCall | None:
    """The last call up to an instant that acts on a channel, otherwise the first one after it; None if there is none.

    Args:
        channel: the channel's name: the console, the EEPROM, or the title of a port, with a suffix if the port has several
            channels.
        calls: the calls of the source, in order of time.
        ports: the ports, with the functions that use each.
        at_us: the instant, in microseconds.
        stores: the functions that store bytes in the EEPROM.
    """
    name = channel.removesuffix(DRIVEN).removesuffix(PULSED)
    port = next((port for port in ports if port.title and (name == port.title or name.startswith(f"{port.title} "))), None)
    functions = port.functions if port is not None else stores if channel == EEPROM_CHANNEL else ()
    makes = [call for call in calls if (call.prints if channel == CONSOLE_CHANNEL else call.function in functions)]
    if port is not None:  # the same function may be called for other ports, too
        makes = [call for call in makes if (Path(call.file).name, call.line) in port.called_at] or makes
    before = [call for call in makes if call.at_us <= at_us + _MARGIN_US / 2]
    return before[-1] if before else makes[0] if makes else None


def _when(call: LibraryCall) -> float:
    return call.at_us
