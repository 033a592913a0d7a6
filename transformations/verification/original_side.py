"""The source's side of a verification: the program in its host model, run as it is and a few times with other costs and inputs.

What the runs of one scenario differ in tells how exact a comparison can be, and whether the scenario is racy.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from time import monotonic
from typing import Any

from msgspec import Struct

from robosmi.data_text import as_whole
from robosmi.transformations.verification.exact_numbers import MEASURED, with_exact_numbers
from robosmi.transformations.verification.places_seen import rests_seen
from robosmi.transformations.verification.played_devices import devices_at, played
from robosmi.transformations.verification.port_devices import BoundPort
from robosmi.transformations.verification.simulated_kinds import SimulatedKind, device_facts
from robosmi.typed import paired, replaced
from robosmi.verify.activity import IDLE, LEVEL, LINE, SIGHTS, WAVE, ActivityEvent, activity, console_lines, merged, text_lines
from robosmi.verify.alignment import with_vague_widths
from robosmi.verify.comparison import NOT_EXERCISED, RACY, SAME, ChannelComparison, ClosedLoop, compare
from robosmi.verify.driven_lines import held_levels, let_go_levels, pulse_lengths
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.original_calls import with_place
from robosmi.verify.original_coverage import coverage
from robosmi.verify.original_run import OriginalRun, Variation, run_original
from robosmi.verify.pulses import pulses_of
from robosmi.verify.resting_places import Rest
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import ConsoleByte, DeviceUse, PinTrace

CONSOLE_CHANNEL = "console"
DRIVEN = ", as it is driven"
"""Behind the name of a port at which a device is: the channel of what the program does to it."""
PULSED = ", its pulses"
"""Behind the name of a port at which one function makes all pulses: the channel of how long they are."""
STANDING = " standing"
"""Behind the names of the wheels that a program waits for: the channel of when none of them is driven."""
Place = tuple[str | int, ...]
"""File and line of a line of the source, file, line and number of a branch, or `channel` and the name of a channel."""
SETTLED = ("running", "finished")
"""Status of a run that came to its end by itself."""
LIMITS = ("time limit", "output limit")
"""Status of a run that was given up."""

_STANDS_US, _SURELY_US = 150_000.0, 250_000.0
"""Wheels without a pulse for less than the first time are still on their way: the library rests for 120 ms between two steps.
Below the second one another run may find them there, too."""

_LINE_PART = 0.025
"""Serial lines may be off by so much: an AVR at 16 MHz is 2.1 % too fast at 115200 baud."""
_GAPS_PART = 0.09
"""An interrupt that feeds a line leaves a gap between two bytes: so much of a byte's time on simulators, which have no second
register for what is sent next."""

_CLOCK_US = 45_000.0
"""Where in a second a program looks at its clock hangs on what it did before, which may take so much longer or shorter."""

_FACTORS = (
    Variation(1, block_factor=2.0, call_factor=2.0, line_part=-_GAPS_PART),
    Variation(2, block_factor=0.5, call_factor=0.5),
    Variation(3, noise=0.3, late_us=100.0, clock_us=_CLOCK_US),
    Variation(4, block_factor=1.3, call_factor=0.8, noise=0.3, late_us=100.0, clock_us=_CLOCK_US / 2),
    Variation(5, early_part=0.001, line_part=_LINE_PART),
)
"""What the program's steps cost in the varied runs; a microcontroller of another kind is about so much faster or slower."""
_SCALED = 2
"""So many of them, the first ones, differ only in what all steps cost: more in the first one, less in the second."""
_FURTHER = tuple(Variation(seed, noise=0.3, late_us=100.0, clock_us=_CLOCK_US * (seed % 3) / 2) for seed in range(6, 14))
"""Further ones for a scenario in which the migrated program differs: with noise, and inputs moved otherwise each time; in
the first two all of them as far as they may be, earlier and later."""
_MOVED_MS = 20.0
"""By so much the instants of inputs are moved: the longest time between two looks of a program that polls."""


class SourceRuns(Struct, frozen=True):
    """The runs of one scenario.

    Attributes:
        nominal: the run that is compared.
        varied: the others.
        channels: name of each channel -> for each of `SIGHTS` its events in the nominal run, then in each varied run.
        given_up: the status of the run at which a limit was reached; there are no runs after it. Empty if there was none.
        loop: how the program waits for what it drives, if it does.
        rests: name of each device that comes to rest -> where it does so in the nominal run, then in each varied run.

    What varied runs do at the pins is in `channels` alone: their traces are empty.
    """

    nominal: OriginalRun
    varied: tuple[OriginalRun, ...]
    channels: dict[str, list[list[list[ActivityEvent]]]]
    given_up: str = ""
    loop: ClosedLoop | None = None
    rests: dict[str, list[list[Rest]]] = {}

    @property
    def unsteady(self) -> bool:
        """Whether the program comes to its end or to the horizon, and with other costs or inputs to no good end."""
        return self.nominal.status in SETTLED and any(run.status not in SETTLED for run in self.varied)

    @property
    def racy_channels(self) -> list[str]:
        """The channels on which the source differs from itself."""
        horizon = self.nominal.trace.simulated_us / 1000
        return [
            name
            for name, seen in self.channels.items()
            if compared(name, seen, [own for own, *_ in seen], horizon, self.loop).status == RACY
        ]


def channel_events(trace: PinTrace, ports: Sequence[BoundPort], target: bool) -> dict[str, list[list[ActivityEvent]]]:
    """What a trace has of each channel, for each of `SIGHTS`: the ports that are watched, and the console.

    Args:
        trace: what was seen.
        ports: the ports.
        target: whether the trace is the target's.
    """
    found = {port.title: _at_port(trace, port, target) for port in ports if port.watched}
    for port in ports:
        known = device_facts().get(port.device, {})
        if port.compared and known.get("driven"):
            found[f"{port.title}{DRIVEN}"] = [held_levels(trace, port.target if target else port.source)]
        elif port.compared and known.get("driven_as_output"):
            found[f"{port.title}{DRIVEN}"] = _at_port(trace, port, target)
        elif port.watched and port.pulsed:
            found[f"{port.title}{PULSED}"] = [pulse_lengths(trace, port.target if target else port.source)]
        elif port.watched and not port.device:
            found[f"{port.title}{DRIVEN}"] = [let_go_levels(trace, port.target if target else port.source)]
    measures = any(port.device in MEASURED for port in ports)
    for number, device in enumerate(devices_at(ports, target)):
        facts = device_facts().get(device.kind, {})
        told = [ports[n] for n in device.ports if facts.get("tells_at") in (ports[n].pin.split() or [""])]
        title = next((port.title for port in told if port.compared), "")
        if title:
            title = f"{title} {facts.get('tells_as', '')}".rstrip()
            found[title] = [_told(trace, number, facts, measures)]
    if wheels := [port for port in ports if port.loop_ms and port.compared and "servo" in port.pin.split()]:
        pins = [port.target if target else port.source for port in wheels]
        found[f"{' and '.join(port.title for port in wheels)}{STANDING}"] = [_standing(trace, pins)]
    found[CONSOLE_CHANNEL] = [console_lines(trace, measures)]
    return found


def _standing(trace: PinTrace, pins: Sequence[str]) -> list[ActivityEvent]:
    """When wheels are driven (1) and when none of them is (0), by the pulses at their pins."""
    found = [IDLE]
    end_us = 0.0
    for pulse in sorted(pulse for pin in pins for pulse in pulses_of(trace, pin)):
        pause_us = pulse.begin - end_us
        if len(found) == 1 or pause_us > _STANDS_US:
            barely = len(found) > 1 and pause_us < _SURELY_US
            if len(found) > 1:
                found.append(ActivityEvent(end_us, LEVEL, (0,), barely=barely))
            found.append(ActivityEvent(pulse.begin, LEVEL, (1,), barely=barely))
        end_us = max(end_us, pulse.end)
    if len(found) > 1 and trace.simulated_us - end_us > _SURELY_US:
        found.append(ActivityEvent(end_us, LEVEL, (0,)))
    return found


def _at_port(trace: PinTrace, port: BoundPort, target: bool) -> list[list[ActivityEvent]]:
    """What the program does at a port, for each sight; where it stands for a voltage, the frequency of a wave is left out."""
    pin = port.target if target else port.source
    pulses = pulses_of(trace, pin)
    seen = [activity(trace, pin, sight, pulses) for sight in SIGHTS]
    if not port.averaged:
        return seen
    return [merged([replaced(e, value=(0.0, e.value[1])) if e.kind == WAVE else e for e in events]) for events in seen]


def _told(trace: PinTrace, number: int, facts: SimulatedKind, measures: bool) -> list[ActivityEvent]:
    """What a device was told: text where it takes bytes, else a line for each thing that it noted."""
    seen = [event for event in trace.device_events if event.device == number]
    if text := facts.get("tells_text"):
        return text_lines(trace, [ConsoleByte(e.at_us, as_whole(e.value)) for e in seen if e.what == text], measures)
    told: list[ActivityEvent] = []
    of_value: dict[str, int] = {}
    for event in seen:
        if event.what in facts.get("tells", ()):
            of_value[str(event.value)] = len(told)
            told.append(ActivityEvent(event.at_us, LINE, (f"{event.what} {event.value}",)))
        elif event.what == facts.get("tells_barely") and (last := of_value.get(str(event.value))) is not None:
            told[last] = replaced(told[last], barely=True)
    return told


def compared(
    channel: str,
    source: Sequence[Sequence[Sequence[ActivityEvent]]],
    target: Sequence[Sequence[ActivityEvent]],
    horizon_ms: float,
    loop: ClosedLoop | None = None,
) -> ChannelComparison:
    """Compare a channel as the first sight has it in which no pause of the source is unclear.

    Where there is none, all are asked, and one that tells no difference is right; else the one in which it comes last.

    Args:
        channel: its name.
        source: for each sight the events of the nominal run, then of each varied one.
        target: for each the target's events.
        horizon_ms: how long both ran.
        loop: how the program waits for what it drives, if it does.
    """
    found = []
    if loop is not None and channel.endswith(STANDING):
        loop = replaced(loop, rests=True)
    pairs = list(paired(source, target))
    clear = [pair for pair in pairs if not any(event.unclear for events in pair[0] for event in events)]
    for (own, *varied), theirs in clear[:1] or pairs:
        result = compare(channel, with_vague_widths(own, varied[:_SCALED]), theirs, varied, horizon_ms, loop)
        if result.status in (SAME, NOT_EXERCISED):
            return result
        found.append(result)
    different = [result for result in found if result.difference is not None]
    return max(different, key=lambda result: result.difference.at_ms if result.difference else 0.0, default=found[0])


def run_source(program: OriginalProgram, ports: Sequence[BoundPort], scenario: Scenario, limit_s: float = 60.0) -> OriginalRun:
    """The nominal run of a scenario."""
    run = run_original(program, scenario.horizon_ms * 1000, played(ports, scenario, target=False), limit_s=limit_s)
    return with_place(program, run)


def places_reached(program: OriginalProgram, run: OriginalRun, ports: Sequence[BoundPort]) -> frozenset[Place]:
    """The lines and branches of the source that a run has reached, and the channels on which it has done something."""
    if not run.counts:
        return frozenset()
    covered = coverage(program, [run.counts])
    reached: list[Place] = [place for place, count in (*covered.lines.items(), *covered.branches.items()) if count]
    seen = channel_events(run.trace, ports, target=False)
    reached += [("channel", name) for name, (events, *_) in seen.items() if any(event != IDLE for event in events)]
    return frozenset(reached)


def run_varied(
    program: OriginalProgram, ports: Sequence[BoundPort], scenario: Scenario, nominal: OriginalRun, limit_s: float = 60.0,
    until_racy: bool = False,
) -> SourceRuns:  # fmt: skip
    """The varied runs of a scenario beside its nominal one.

    Args:
        program: the original.
        ports: the ports.
        scenario: what happens.
        nominal: its nominal run.
        limit_s: seconds of this machine's time for all of them.
        until_racy: whether no further runs are wanted when the source differs from itself on a channel; other channels could not
            be compared well then.
    """
    devices = played(ports, scenario, target=False)
    until = monotonic() + limit_s
    seen = [channel_events(nominal.trace, ports, target=False)]
    rests = {name: [each] for name, each in rests_seen(nominal.trace, ports, target=False).items()}
    loop = _loop(nominal.trace, ports)
    runs = SourceRuns(nominal, (), _by_channel(seen), nominal.status if nominal.status in LIMITS else "", loop, rests)
    for variation in _FACTORS if not runs.given_up else ():
        chance = random.Random(variation.seed)
        moved = moved_devices(devices, chance) if variation.noise else put_down_anywhere(devices, chance)
        run = run_original(program, scenario.horizon_ms * 1000, moved, variation, max(0.0, until - monotonic()))
        if run.status in LIMITS:
            return replaced(runs, given_up=run.status)
        seen.append(channel_events(run.trace, ports, target=False))
        rests = _with_rests(rests, run.trace, ports)
        emptied = replaced(run, trace=replaced(run.trace, changes=(), waves=(), console=(), device_events=()))
        runs = SourceRuns(nominal, (*runs.varied, emptied), _by_channel(seen), loop=loop, rests=rests)
        if until_racy and runs.racy_channels:
            return runs

    def again(showing: Sequence[DeviceUse]) -> dict[str, list[list[ActivityEvent]]]:
        run = run_original(program, scenario.horizon_ms * 1000, showing, limit_s=max(0.0, until - monotonic()))
        return channel_events(run.trace, ports, target=False)

    return replaced(runs, channels=with_exact_numbers(runs.channels, devices, again)) if not runs.given_up else runs


def run_further(
    program: OriginalProgram, ports: Sequence[BoundPort], scenario: Scenario, runs: SourceRuns, limit_s: float = 60.0
) -> SourceRuns:
    """The runs of a scenario with further varied ones, which tell better whether the source differs from itself.

    Args:
        program: the original.
        ports: the ports.
        scenario: what happens.
        runs: those that there are.
        limit_s: seconds of this machine's time for all further ones.
    """
    devices = played(ports, scenario, target=False)
    until = monotonic() + limit_s
    channels, rests = runs.channels, runs.rests
    for number, variation in enumerate(_FURTHER):
        chance = random.Random(variation.seed)
        ways = (-_MOVED_MS, _MOVED_MS)
        moved = moved_devices(devices, chance, ways[number] if number < len(ways) else None)
        run = run_original(program, scenario.horizon_ms * 1000, moved, variation, max(0.0, until - monotonic()))
        if run.status in LIMITS:
            break
        seen = channel_events(run.trace, ports, target=False)
        channels = {name: [[*events, seen[name][sight]] for sight, events in enumerate(each)] for name, each in channels.items()}
        rests = _with_rests(rests, run.trace, ports)
    return replaced(runs, channels=channels, rests=rests)


def _with_rests(
    rests: Mapping[str, list[list[Rest]]], trace: PinTrace, ports: Sequence[BoundPort]
) -> dict[str, list[list[Rest]]]:
    """Where devices come to rest, with one more run of the source."""
    seen = rests_seen(trace, ports, target=False)
    return {name: [*each, seen[name]] for name, each in rests.items()}


def _loop(trace: PinTrace, ports: Sequence[BoundPort]) -> ClosedLoop | None:
    """How a program waits for the wheels that it drives, from the first pulse for one of them on."""
    wheels = [port for port in ports if port.loop_ms and "servo" in port.pin.split()]
    driven = [pulse.begin for port in wheels for pulse in pulses_of(trace, port.source)]
    return ClosedLoop(min(driven) / 1000, max(port.loop_ms for port in wheels)) if driven else None


def _by_channel(seen: Sequence[Mapping[str, list[list[ActivityEvent]]]]) -> dict[str, list[list[list[ActivityEvent]]]]:
    return {name: [list(runs) for runs in zip(*(each[name] for each in seen), strict=True)] for name in seen[0]}


def moved_devices(devices: Sequence[DeviceUse], chance: random.Random, by_ms: float | None = None) -> list[DeviceUse]:
    """Devices whose signals change a little earlier or later, and whose values are a little off.

    Args:
        devices: the devices.
        chance: what is random.
        by_ms: by how much all signals are later; each change by another time if None.
    """
    facts = device_facts()
    made = []
    for use in devices:
        percent = float(facts.get(use.kind, {}).get("jitter_percent", 0))
        smallest = float(facts.get(use.kind, {}).get("jitter_least", 0))
        settings = {
            name: [_moved(point, chance, percent, smallest, by_ms) for point in value] if _is_signal(value) else value
            for name, value in use.settings.items()
        }
        for name, value in settings.items():
            if _is_signal(value):
                settings[name] = sorted(value, key=lambda point: float(point[0]))
        for name, usual in facts.get(use.kind, {}).get("jitter", {}).items():
            settings[name] = usual * (1 + chance.uniform(-percent, percent) / 100)
        made.append(replaced(use, settings=settings))
    return put_down_anywhere(made, chance)


def put_down_anywhere(devices: Sequence[DeviceUse], chance: random.Random) -> list[DeviceUse]:
    """Devices of which nobody knows where exactly they stand at first, somewhere else there.

    How long a closed loop needs to come to a place hangs on it: each varied run is one more sample of that.
    """
    facts = device_facts()
    return [
        replaced(
            use,
            settings={
                **use.settings,
                **{name: chance.uniform(*ends) for name, ends in facts.get(use.kind, {}).get("anywhere", {}).items()},
            },
        )
        for use in devices
    ]


def _is_signal(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(point, list) and len(point) == 2 for point in value)


def _moved(point: list[Any], chance: random.Random, percent: float, least: float, by_ms: float | None) -> list[Any]:
    at_ms, value = point
    later_ms = chance.uniform(-_MOVED_MS, _MOVED_MS) if by_ms is None else by_ms
    at_ms = max(0.0, at_ms + later_ms) if at_ms else at_ms
    if percent and isinstance(value, (int, float)):
        off = chance.uniform(-1, 1)
        value = value + off * max(abs(value) * percent / 100, min(least, abs(value)))
    return [at_ms, value]
