"""The source's side of a verification: the original, run as it is and a few times with other costs and inputs.

The differences between these runs of one scenario show how exact a comparison can be, and whether the scenario is racy.

Two boards never measure exactly alike, so a measured number in printed text may differ. All other numbers of the same text, such
as a counter or the number of a channel, do not depend on measurements and must be equal on every board. Two further runs of the
source, whose devices show a little more and a little less, tell which numbers change. If the accuracy of the measurements is
known, more runs yield the range in which a measured number may lie, so that a number that is always one too large is not excused.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.data_text import Json, as_list, as_number, as_whole
from robosmi.transformations.verification.bound_devices.played_devices import brief_pins, devices_at, played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.simulated_kinds import SimulatedKind, device_facts
from robosmi.transformations.verification.bound_devices.varied_devices import MOVED_MS, moved_devices, put_down_anywhere
from robosmi.transformations.verification.pause_comparison import Pause, observed_pauses
from robosmi.transformations.verification.rest_comparison import observed_rests
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL, stored_events
from robosmi.verify.original import Original, OriginalRun, Variation
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import ConsoleByte, DeviceUse, PinChange, PinTrace
from robosmi.verify.toolchains.processor_time import used_s
from robosmi.verify.traces.activity import (
    IDLE,
    LEVEL,
    LINE,
    READING,
    SIGHTS,
    WAVE,
    ActivityEvent,
    activity,
    console_lines,
    merged,
    text_lines,
    with_joined_tones,
)
from robosmi.verify.traces.alignment import numbers_of, shape_of, with_vague_widths
from robosmi.verify.traces.comparison import NOT_EXERCISED, RACY, SAME, ChannelComparison, ClosedLoop, compare
from robosmi.verify.traces.driven_lines import let_go_levels, level_durations, pulse_lengths
from robosmi.verify.traces.goals_of_motions import Rest
from robosmi.verify.traces.pulses import pulses_of

CONSOLE_CHANNEL = "console"
DRIVEN = ", as it is driven"
"""Suffix of the channel with the levels at which the program holds a port, or lets it go."""
PULSED = ", its pulses"
"""Suffix of the channel with the pulse widths at a port where one function makes all pulses."""
STANDING = " standing"
"""Suffix of the channel with when none of the wheels is driven for which the program waits."""
Place = tuple[str | int, ...]
"""(file, line) or (file, line, number of a branch) in the source, ("channel", name), or a goal of `scenario_goals`."""
ChannelEvents = dict[str, list[list[ActivityEvent]]]
"""Name of each channel -> for each of `SIGHTS` its events in one run."""
SETTLED = ("running", "finished")
"""Statuses of runs that ended by themselves, or at the horizon."""
LIMITS = ("time limit", "output limit")
"""Statuses of runs that were given up."""

_STANDS_US, _SURELY_US = 150_000.0, 250_000.0
"""Wheels stand still if no pulse comes for the first time: within a motion the library pauses for 120 ms between two steps. A
pause below the second time may be missing in another run.
"""

_LINE_PART = 0.025
"""By this part serial lines may be faster: an AVR at 16 MHz is 2.1 % too fast at 115200 baud."""
_GAPS_PART = 0.09
"""Gap between two bytes of a line fed by an interrupt, in byte times: simulators lack the second transmit register."""
_FULL, _BYTE_US, _FORMATTING_PART = 0.8, 1_100.0, 0.5
"""A console is always full if its bytes, each as long as the shortest (at most that of 9600 baud), take this part of the time.

The time of everything in such a program is that of printing: of the line on the source, and on the target also of the formatting
of numbers, which the model of the source does not charge. In one run printing takes longer by the last part.
"""

_CLOCK_US = 45_000.0
"""By this much, in microseconds, the instant within a second may vary at which a program reads a clock."""

_FACTORS = (
    Variation(1, block_factor=2.0, call_factor=2.0, line_part=-_GAPS_PART),
    Variation(2, block_factor=0.5, call_factor=0.5),
    Variation(3, noise=0.3, late_us=100.0, clock_us=_CLOCK_US),
    Variation(4, block_factor=1.3, call_factor=0.8, noise=0.3, late_us=100.0, clock_us=_CLOCK_US / 2),
    Variation(5, early_part=0.001, line_part=_LINE_PART),
)
"""The varied runs: by which factors the costs of the program's steps differ, as they do on another microcontroller."""
SCALED = 2
"""Number of varied runs, the first ones, that differ only in the costs of all steps: higher in one, lower in the other."""
_FURTHER = tuple(Variation(seed, noise=0.3, late_us=100.0, clock_us=_CLOCK_US * (seed % 3) / 2) for seed in range(6, 14))
"""Further varied runs for a scenario in which the migrated program differs: with noise, and with inputs moved by other times in
each; in the first two all inputs are moved by the greatest time, earlier and later.
"""


class SourceRuns(Struct, frozen=True):
    """The runs of the original in one scenario.

    Attributes:
        nominal: the run that is compared with the migrated program.
        varied: the varied runs; their traces are emptied, since `channels` has their events.
        channels: name of each channel -> for each of `SIGHTS` its events in the nominal run, then in each varied run.
        given_up: status of the run that reached a limit, after which there are no runs; empty if there was none.
        loop: the closed loop in which the program waits for what it drives, if it does.
        rests: name of each device that comes to rest -> its places of rest in the nominal run, then in each varied run.
        pauses: name of each device that is asked -> the program's pauses in the nominal run, then in each varied run.
    """

    nominal: OriginalRun
    varied: tuple[OriginalRun, ...]
    channels: dict[str, list[list[list[ActivityEvent]]]]
    given_up: str = ""
    loop: ClosedLoop | None = None
    rests: dict[str, list[list[Rest]]] = {}
    pauses: dict[str, list[list[Pause]]] = {}

    @property
    def unsteady(self) -> bool:
        """Whether the nominal run ends in order, and a varied one does not."""
        return self.nominal.status in SETTLED and any(run.status not in SETTLED for run in self.varied)

    @property
    def nondeterministic_channels(self) -> list[str]:
        """The channels on which the runs of the source differ from each other; not what is stored, which may be measured."""
        horizon = self.nominal.trace.simulated_us / 1000
        return [
            name
            for name, seen in self.channels.items()
            if name != EEPROM_CHANNEL and compared(name, seen, [own for own, *_ in seen], horizon, self.loop).status == RACY
        ]


def channel_events(trace: PinTrace, ports: Sequence[BoundPort], target: bool) -> ChannelEvents:
    """The events of each channel in a trace, for each of `SIGHTS`: the watched ports, what devices report, and the console.

    Args:
        trace: the trace.
        ports: the ports.
        target: whether it is the target's trace.
    """
    if not target:
        trace = _at_rest(trace, ports)
    found = {port.title: _at_port(trace, port, target) for port in ports if port.watched}
    for port in ports:
        known = device_facts().get(port.device, {})
        if port.compared and known.get("driven"):
            found[f"{port.title}{DRIVEN}"] = [level_durations(trace, port.target if target else port.source)]
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
    if wheels := [p for p in ports if p.loop_ms and p.compared and not p.motor and "servo" in p.pin.split()]:
        pins = [port.target if target else port.source for port in wheels]
        found[f"{' and '.join(port.title for port in wheels)}{STANDING}"] = [_standing(trace, pins)]
    found[CONSOLE_CHANNEL] = [console_lines(trace, measures)]
    found[EEPROM_CHANNEL] = [stored_events(trace)]
    return found


def _at_rest(trace: PinTrace, ports: Sequence[BoundPort]) -> PinTrace:
    """The trace of the source with the pins high from its start that float there and are held high on the target."""
    held = tuple(PinChange(0.0, pin, 1) for pin in dict.fromkeys(port.source for port in ports if port.rests_high))
    return replace(trace, changes=(*held, *trace.changes)) if held else trace


def _standing(trace: PinTrace, pins: Sequence[str]) -> list[ActivityEvent]:
    """When any of the wheels is driven (1), and when none is (0), judged by the pulses at their pins."""
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
    """The events at a port for each of `SIGHTS`; if the port represents a voltage, waves have no frequency."""
    pin = port.target if target else port.source
    pulses = pulses_of(trace, pin)
    seen = [activity(trace, pin, sight, pulses) for sight in SIGHTS]
    if not port.averaged:
        return seen
    return [merged([replace(e, value=(0.0, e.value[1])) if e.kind == WAVE else e for e in events]) for events in seen]


def _told(trace: PinTrace, number: int, facts: SimulatedKind, measures: bool) -> list[ActivityEvent]:
    """What a device has received: lines of text if it takes bytes, otherwise a line for each event that it has noted."""
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
            told[last] = replace(told[last], barely=True)
        elif event.what == facts.get("tells_slowly"):
            value, vague_us = as_list(event.value)
            last = of_value[str(value)]
            told[last] = replace(told[last], vague_us=as_number(vague_us))
    return told


def compared(
    channel: str,
    source: Sequence[Sequence[Sequence[ActivityEvent]]],
    target: Sequence[Sequence[ActivityEvent]],
    horizon_ms: float,
    loop: ClosedLoop | None = None,
) -> ChannelComparison:
    """Compare a channel at the first of `SIGHTS` at which no pause of the source is close to a limit.

    If there is none, all are compared: one without a difference is right, otherwise the one whose difference comes last.

    Args:
        channel: its name.
        source: for each of `SIGHTS` the events of the nominal run, then of each varied run.
        target: for each of `SIGHTS` the target's events.
        horizon_ms: the simulated time of both, in milliseconds.
        loop: the closed loop in which the program waits for what it drives, if it does.
    """
    found = []
    if loop is not None and channel.endswith(STANDING):
        loop = replace(loop, rests=True)
    pairs = list(zip(source, target, strict=True))
    clear = [pair for pair in pairs if not any(event.unclear for events in pair[0] for event in events)]
    for runs, theirs in clear[:1] or pairs:
        by_edges = any(event.kind == WAVE and event.pulses for event in theirs)
        own, *varied = [with_joined_tones(events, 1000 * horizon_ms) for events in runs] if by_edges else runs
        result = compare(channel, with_vague_widths(own, varied[:SCALED]), theirs, varied, horizon_ms, loop)
        if result.status in (SAME, NOT_EXERCISED):
            return result
        found.append(result)
    different = [result for result in found if result.difference is not None]
    return max(different, key=lambda result: result.difference.at_ms if result.difference else 0.0, default=found[0])


def run_source(
    program: Original, ports: Sequence[BoundPort], scenario: Scenario, limit_s: float = 60.0, whole: bool = False
) -> OriginalRun:
    """Run the source in a scenario as it is.

    Args:
        program: the original.
        ports: the ports.
        scenario: what happens.
        limit_s: seconds of processor time.
        whole: whether all changes of the pins are recorded, of those too that no channel shows.
    """
    devices, brief = played(ports, scenario, target=False), () if whole else brief_pins(ports, target=False)
    return program.run(scenario.horizon_ms * 1000, devices, limit_s=limit_s, brief=brief)


def places_reached(
    program: Original, run: OriginalRun, ports: Sequence[BoundPort], seen: ChannelEvents | None = None
) -> frozenset[Place]:
    """The lines and branches of the source that a run has reached, and the channels on which something has happened.

    Args:
        program: the original.
        run: the run.
        ports: the ports.
        seen: the events of each channel in the run, if they are worked out already.
    """
    if not run.counts:
        return frozenset()
    covered = program.coverage([run.counts])
    reached: list[Place] = [place for place, count in (*covered.lines.items(), *covered.branches.items()) if count]
    seen = channel_events(run.trace, ports, target=False) if seen is None else seen
    reached += [("channel", name) for name, (events, *_) in seen.items() if any(event != IDLE for event in events)]
    return frozenset(reached)


def run_varied(
    program: Original, ports: Sequence[BoundPort], scenario: Scenario, nominal: OriginalRun, limit_s: float = 60.0,
    until_racy: bool = False, own: ChannelEvents | None = None,
) -> SourceRuns:  # fmt: skip
    """Add the varied runs of a scenario to its nominal run.

    Args:
        program: the original.
        ports: the ports.
        scenario: the scenario.
        nominal: its nominal run.
        limit_s: seconds of processor time for all of them.
        until_racy: whether to stop as soon as a channel is racy; then there are too few runs to compare the other channels
            well.
        own: the events of each channel in the nominal run, if they are worked out already.
    """
    devices = played(ports, scenario, target=False)
    until = used_s() + limit_s
    seen = [channel_events(nominal.trace, ports, target=False) if own is None else own]
    rests = {name: [each] for name, each in observed_rests(nominal.trace, ports, target=False).items()}
    pauses = {name: [each] for name, each in observed_pauses(nominal.trace, ports, target=False).items()}
    loop = _loop(nominal.trace, ports)
    runs = SourceRuns(nominal, (), _by_channel(seen), nominal.status if nominal.status in LIMITS else "", loop, rests, pauses)
    full = is_always_full(nominal.trace)
    for variation in _FACTORS if not runs.given_up else ():
        if full and variation.line_part < 0:
            variation = replace(variation, line_part=-_FORMATTING_PART)
        chance = random.Random(variation.seed)
        moved = moved_devices(devices, chance) if variation.noise else put_down_anywhere(devices, chance)
        run = _run(program, ports, scenario, moved, until, variation)
        if run.status in LIMITS:
            return replace(runs, given_up=run.status)
        seen.append(channel_events(run.trace, ports, target=False))
        rests = _with_rests(rests, run.trace, ports)
        pauses = _with_pauses(pauses, run.trace, ports)
        emptied = replace(run, trace=replace(run.trace, changes=(), waves=(), console=(), device_events=()))
        runs = SourceRuns(nominal, (*runs.varied, emptied), _by_channel(seen), loop=loop, rests=rests, pauses=pauses)
        if until_racy and runs.nondeterministic_channels:
            return runs

    def again(showing: Sequence[DeviceUse]) -> ChannelEvents:
        run = _run(program, ports, scenario, showing, until)
        return channel_events(run.trace, ports, target=False)

    return replace(runs, channels=with_exact_numbers(runs.channels, devices, again)) if not runs.given_up else runs


def is_always_full(trace: PinTrace) -> bool:
    """Whether a program prints nearly all the time, so that printing decides when it does anything."""
    times = [byte.at_us for byte in trace.console]
    shortest = min((after - before for before, after in pairwise(times) if after > before), default=0.0)
    return 0 < shortest <= _BYTE_US and len(times) * shortest > _FULL * trace.simulated_us


def _run(
    program: Original, ports: Sequence[BoundPort], scenario: Scenario, devices: Sequence[DeviceUse], until: float,
    variation: Variation | None = None,
) -> OriginalRun:  # fmt: skip
    """A run of a scenario with other devices, until a processor time (see `used_s`)."""
    limit_s = max(0.0, until - used_s())
    return program.run(scenario.horizon_ms * 1000, devices, variation, limit_s, brief_pins(ports, target=False))


def run_further(
    program: Original, ports: Sequence[BoundPort], scenario: Scenario, runs: SourceRuns, limit_s: float = 60.0
) -> SourceRuns:
    """Add further varied runs to those of a scenario, which show better whether the source differs from itself.

    Args:
        program: the original.
        ports: the ports.
        scenario: the scenario.
        runs: the runs so far.
        limit_s: seconds of processor time for all further ones.
    """
    devices = played(ports, scenario, target=False)
    until = used_s() + limit_s
    channels, rests, pauses = runs.channels, runs.rests, runs.pauses
    for number, variation in enumerate(_FURTHER):
        chance = random.Random(variation.seed)
        ways = (-MOVED_MS, MOVED_MS)
        moved = moved_devices(devices, chance, ways[number] if number < len(ways) else None)
        run = _run(program, ports, scenario, moved, until, variation)
        if run.status in LIMITS:
            break
        seen = channel_events(run.trace, ports, target=False)
        channels = {name: [[*events, seen[name][sight]] for sight, events in enumerate(each)] for name, each in channels.items()}
        rests = _with_rests(rests, run.trace, ports)
        pauses = _with_pauses(pauses, run.trace, ports)
    return replace(runs, channels=channels, rests=rests, pauses=pauses)


def _with_rests(
    rests: Mapping[str, list[list[Rest]]], trace: PinTrace, ports: Sequence[BoundPort]
) -> dict[str, list[list[Rest]]]:
    """The places of rest, with those of one more run of the source added."""
    seen = observed_rests(trace, ports, target=False)
    return {name: [*each, seen[name]] for name, each in rests.items()}


def _with_pauses(
    pauses: Mapping[str, list[list[Pause]]], trace: PinTrace, ports: Sequence[BoundPort]
) -> dict[str, list[list[Pause]]]:
    """The pauses between questions, with those of one more run of the source added."""
    seen = observed_pauses(trace, ports, target=False)
    return {name: [*each, seen[name]] for name, each in pauses.items()}


def _loop(trace: PinTrace, ports: Sequence[BoundPort]) -> ClosedLoop | None:
    """The closed loop in which a program waits for its wheels, from the first pulse for one of them; None without."""
    wheels = [port for port in ports if port.loop_ms and "servo" in port.pin.split()]
    driven = [pulse.begin for port in wheels for pulse in pulses_of(trace, port.source)]
    return ClosedLoop(min(driven) / 1000, max(port.loop_ms for port in wheels)) if driven else None


def _by_channel(seen: Sequence[ChannelEvents]) -> dict[str, list[list[list[ActivityEvent]]]]:
    return {name: [list(runs) for runs in zip(*(each[name] for each in seen), strict=True)] for name in seen[0]}


# ---- measured numbers in printed text

_PARTS = (0.07, -0.07)
"""Relative changes of measured values that are larger than two boards may differ by."""
_OFF = (1.0, -1.0, 0.5, -0.5)
"""Changes of measured values, as parts of what two boards may differ by."""
MEASURED = ("voltages", "capacitor", "ranger", "two_pin_ranger")
"""Devices whose values two boards never measure exactly alike."""
Channels = dict[str, list[list[list[ActivityEvent]]]]
Otherwise = Callable[[float | None, SimulatedKind, float, float, float], float | None]
"""Changes a value; further arguments: facts of the device's kind, its least and greatest value, and by which part."""


def with_exact_numbers(
    channels: Channels,
    devices: Sequence[DeviceUse],
    run: Callable[[Sequence[DeviceUse]], Mapping[str, list[list[ActivityEvent]]]],
) -> Channels:
    """The channels, with the exact numbers and the ranges of measured ones added to the nominal run's readings.

    Args:
        channels: name -> for each of `SIGHTS` the events of the nominal run, then those of each varied run.
        devices: the devices of the scenario.
        run: runs the source with other devices; returns its channels, name -> for each of `SIGHTS` its events.
    """
    names = [name for name, seen in channels.items() if any(_has_numbers(event) for event in seen[0][0])]

    def runs(other: Otherwise, parts: Sequence[float]) -> list[Mapping[str, list[list[ActivityEvent]]]]:
        return [run([_measured_otherwise(use, other, part) for use in devices]) for part in parts]

    wide = runs(_beyond_accuracy, _PARTS) if names else []
    near = runs(_within_accuracy, _OFF) if names and _all_known(devices) else []
    return {
        name: [
            [_marked(own, varied, [run[name][sight] for run in wide], [run[name][sight] for run in near]), *varied]
            for sight, (own, *varied) in enumerate(seen)
        ]
        if name in names
        else seen
        for name, seen in channels.items()
    }


def _has_numbers(event: ActivityEvent) -> bool:
    return event.kind == READING and bool(numbers_of(event))


def _all_known(devices: Sequence[DeviceUse]) -> bool:
    """Whether the scenario has measuring devices, and it is known of all of them by how much two boards may differ."""
    kinds = [use.kind for use in devices if use.kind in MEASURED]
    return bool(kinds) and all("off_least" in device_facts()[kind] for kind in kinds)


def _marked(
    source: Sequence[ActivityEvent],
    varied: Sequence[Sequence[ActivityEvent]],
    wide: Sequence[Sequence[ActivityEvent]],
    near: Sequence[Sequence[ActivityEvent]],
) -> list[ActivityEvent]:
    """The source's events; readings get `exact` and `between`, until the runs print lines of other shapes."""
    marked = list(source)
    for at, event in enumerate(source):
        if not _same_shapes(event, at, [*varied, *wide]):
            break
        if event.kind == READING:
            own = numbers_of(event)
            again = [numbers_of(run[at]) for run in (*varied, *wide)]
            exact = tuple(all(n[place] == each for n in again) for place, each in enumerate(own))
            measured = [any(n[place] != each for n in again[len(varied) :]) for place, each in enumerate(own)]
            between = tuple(None for _ in own)  # type: tuple[tuple[float, float] | None, ...]
            if near and _same_shapes(event, at, near):
                runs = [own, *again[: len(varied)], *(numbers_of(run[at]) for run in near)]
                between = tuple(_span(float(n[place]) for n in runs) if measured[place] else None for place in range(len(own)))
            marked[at] = replace(event, exact=exact, between=between)
    return marked


def _same_shapes(event: ActivityEvent, at: int, runs: Sequence[Sequence[ActivityEvent]]) -> bool:
    return all(at < len(run) and run[at].kind == event.kind and shape_of(run[at]) == shape_of(event) for run in runs)


def _span(numbers: Iterable[float]) -> tuple[float, float]:
    listed = list(numbers)
    return min(listed), max(listed)


def _measured_otherwise(use: DeviceUse, other: Otherwise, part: float) -> DeviceUse:
    """A device all of whose measured values are changed."""
    if use.kind not in MEASURED:
        return use
    facts = device_facts()[use.kind]
    changed: dict[str, Json] = {}
    for name, ends in facts["ends"].items():
        least, most = (as_number(end) for end in ends)
        points: Sequence[tuple[float, float | None]] = use.settings[name]
        changed[name] = [[at_ms, other(value, facts, least, most, part)] for at_ms, value in points]
    return replace(use, settings={**use.settings, **changed})


def _within_accuracy(value: float | None, facts: SimulatedKind, least: float, most: float, part: float) -> float | None:
    """A measured value that is changed by a part of what two boards may differ by, within the limits of the device."""
    if value is None:
        return None
    by = part * (facts["off_least"] + facts["off_percent"] / 100 * abs(value))
    return min(max(value + by, min(least, value)), max(most, value))


def _beyond_accuracy(value: float | None, facts: SimulatedKind, least: float, most: float, part: float) -> float:
    """A value that is changed by a part of itself, or of a tenth of the device's range if that is larger.

    If the device shows nothing, it is almost the greatest value instead.
    """
    if value is None:
        return most * (1 - abs(part))
    return min(max(value + part * max(value, 0.1 * (most - least)), least), most)
