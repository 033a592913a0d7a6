"""The places at which the simulated devices of a program rest in a run, and their comparison with the target's."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robosmi.data_text import as_list, as_number
from robosmi.transformations.verification.played_devices import devices_at
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.transformations.verification.simulated_kinds import device_facts
from robosmi.verify.comparison import NOT_EXERCISED, ChannelComparison
from robosmi.verify.goals_of_motions import Driven, Rest, RestKind
from robosmi.verify.resting_places import compare_rests
from robosmi.verify.simulation import PinTrace

RESTING = " at rest"
"""The suffix of the channel with the places at which the device at a port rests."""
_RESTS = "rests"


def rests_seen(trace: PinTrace, ports: Sequence[BoundPort], target: bool) -> dict[str, list[Rest]]:
    """The rests of each device in a run: channel -> rests, by time.

    Args:
        trace: the trace of the run.
        ports: the ports of the program.
        target: whether the trace is from the target.
    """
    return {
        name: _rests(trace, number)
        for number, device in enumerate(devices_at(ports, target))
        if device_facts().get(device.kind, {}).get("rests_in") and (name := _channel([ports[n] for n in device.ports]))
    }


def rests_compared(
    source: Mapping[str, Sequence[Sequence[Rest]]], trace: PinTrace, ports: Sequence[BoundPort]
) -> tuple[ChannelComparison, ...]:
    """The comparisons of all devices that rest on both sides.

    Args:
        source: channel -> the rests in each run of the source.
        trace: the trace of the migrated program.
        ports: the ports of the program.
    """
    theirs = rests_seen(trace, ports, target=True)
    kinds = {
        name: RestKind(
            facts["rests_in"], facts["rests_within"] if at[0].placed else 0.0, at[0].timed or not at[0].placed, at[0].recounts
        )
        for device in devices_at(ports, target=True)
        if "rests_in" in (facts := device_facts().get(device.kind, {}))
        and (name := _channel(at := [ports[n] for n in device.ports]))
    }
    found = [compare_rests(name, runs, theirs[name], kinds[name]) for name, runs in source.items() if name in theirs]
    return tuple(each for each in found if each.status != NOT_EXERCISED)


def _channel(ports: Sequence[BoundPort]) -> str:
    title = next((port.title for port in ports if port.compared and "servo" in port.pin.split()), "")
    return f"{title}{RESTING}" if title else ""


def _rests(trace: PinTrace, number: int) -> list[Rest]:
    found: list[Rest] = []
    for event in trace.device_events:
        if event.device == number and event.what == _RESTS:
            place, way, changes, since_us, barely, timed = as_list(event.value)
            driven = None
            if timed is not None:
                timed_way, timed_changes, aim = as_list(timed)
                driven = Driven(as_number(timed_way), as_number(timed_changes), str(aim))
            found.append(
                Rest(as_number(since_us) / 1000, as_number(place), as_number(way), as_number(changes), bool(barely), driven)
            )
    return found
