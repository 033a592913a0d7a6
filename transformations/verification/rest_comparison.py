"""The places at which driven devices, such as wheels, rest between two motions, and their comparison with the target's.

A robot that turns by 69 degrees instead of 90 makes the same motions at nearly the same times, so the places at which its wheels
rest are compared. If the program drives to a place by what its encoders report, all correct runs rest within a known distance
of each other, so a correct target rests within that distance of each run of the source. If the program drives for a time, each
motion is compared separately, and the distance that the device covers in one servo frame at each change of speed, and a
percentage of the path, are allowed as well. `goals_of_motions` says where each motion is compared from.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy

from robosmi.base.data_text import as_list, as_number
from robosmi.transformations.verification.bound_devices.played_devices import devices_at
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import LINE, ActivityEvent
from robosmi.verify.traces.alignment import aligned
from robosmi.verify.traces.comparison import DIFFERENT, NOT_EXERCISED, SAME, ChannelComparison, FirstDifference
from robosmi.verify.traces.goals_of_motions import WAY, Driven, Expected, Goals, Rest, RestKind

RESTING = " at rest"
"""The suffix of the channel with the places at which the device at a port rests."""
_RESTS = "rests"


def observed_rests(trace: PinTrace, ports: Sequence[BoundPort], target: bool) -> dict[str, list[Rest]]:
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
    theirs = observed_rests(trace, ports, target=True)
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
            *numbers, barely, timed, beyond = as_list(event.value)
            place, way, changes, since_us = map(as_number, numbers)
            driven = None
            if timed is not None:
                timed_way, timed_changes, aim = as_list(timed)
                driven = Driven(as_number(timed_way), as_number(timed_changes), str(aim))
            found.append(Rest(since_us / 1000, place, way, changes, bool(barely), driven, as_number(beyond)))
    return found


# ---- the comparison

_LEAST_MARGIN = 0.2
"""The part of the allowed distance that the target may differ beyond runs of the source that differ by all of it."""
_LATE_MS = 500.0
"""A rest that begins later or earlier than in all runs of the source by more than this and `WAY` is another rest."""


def compare_rests(channel: str, runs: Sequence[Sequence[Rest]], target: Sequence[Rest], kind: RestKind) -> ChannelComparison:
    """Compare the places at which a device rests, up to the first rest that not all runs have.

    Args:
        channel: the name of the channel.
        runs: the rests in each run of the source, the nominal run first.
        target: the rests of the migrated program.
        kind: how they are compared.
    """
    nominal, *varied = runs
    others = [*varied, target]
    found = [dict(aligned(_events(nominal), _events(each)).pairs) for each in others]
    goals = Goals(kind, len(others) + 1)
    first = compared = 0
    for number, rest in enumerate(nominal):
        if any(number not in pairs for pairs in found):
            if rest.barely:
                continue
            break
        row = [rest, *(each[pairs[number]] for each, pairs in zip(others, found, strict=True))]
        followed = copy(goals)
        expected = followed.of(nominal[first : number + 1], [each.place for each in row])
        if not _in_time(row) or not any(_one_rest(each) for each in expected):  # these are not the same rests
            if any(each.barely for each in row):
                continue
            break
        goals = followed
        expected = [each._replace(width=each.width + abs(rest.beyond - row[-1].beyond)) for each in expected]
        if not any(_fits(each) for each in expected):
            return ChannelComparison(channel, DIFFERENT, _told(channel, (row[0], row[-1]), expected[0], kind), compared)
        first, compared = number + 1, compared + 1
    return ChannelComparison(channel, SAME if compared else NOT_EXERCISED, events=compared)


def _one_rest(expected: Expected) -> bool:
    """Whether the runs of the source agree so far that they rest at one place, where all of them should."""
    own = expected.places[:-1]
    return expected.loose or max(own) - min(own) <= 2 * expected.width


def _fits(expected: Expected) -> bool:
    """Whether the target, which is the last one, rests where the runs of the source do."""
    least, most = _ends(expected)
    return least <= expected.places[-1] <= most


def _ends(expected: Expected) -> tuple[float, float]:
    """The least and the greatest place that is the same as in the runs of the source."""
    own = expected.places[:-1]
    margin = max(expected.width - (max(own) - min(own)), _LEAST_MARGIN * expected.width)
    return min(own) - margin, max(own) + margin


def _in_time(row: Sequence[Rest]) -> bool:
    """Whether the target, which is the last one, begins to rest at about the same time as the runs of the source."""
    *own, theirs = [rest.at_ms for rest in row]
    late_ms = _LATE_MS + WAY * max(own)
    return min(own) - late_ms <= theirs <= max(own) + late_ms


def _events(rests: Sequence[Rest]) -> list[ActivityEvent]:
    """Rests as equal events, so that the rests of two runs are matched by their order."""
    return [ActivityEvent(1000 * rest.at_ms, LINE, ("rests",), barely=rest.barely) for rest in rests]


def _told(channel: str, rests: tuple[Rest, Rest], expected: Expected, kind: RestKind) -> FirstDifference:
    """The difference, with a message that states both places and the tolerance."""
    places, (least, most) = (expected.places[0], expected.places[-1]), _ends(expected)
    does = f"turns by {{:.1f}} {kind.unit} until it rests"
    if not expected.moved:
        does = f"rests {{:.1f}} {kind.unit} from where it began"
    source, target = (
        ActivityEvent(1000 * rest.at_ms, LINE, (does.format(place),)) for rest, place in zip(rests, places, strict=True)
    )
    message = f"{target.value[0]}; the original {places[0]:.1f} (tolerance {least:.1f} to {most:.1f})"
    return FirstDifference(rests[0].at_ms, channel, message, source, target)
