"""The verdict on one scenario, from the runs of both sides: same, different, or why nothing can be decided.

The comparison of a single channel is in `original_side` and `robosmi.verify.traces.comparison`, the verdict on all scenarios
together in `robosmi.verify.traces.verdict`. If nothing was compared at all, this module says why.

The comparison of a channel tolerates tens of milliseconds, so two lamps that flash a millisecond apart could be swapped unseen.
So the order of events on different pins is compared, too. If a single thread of the program causes both, and the source keeps
their order and distance whatever its steps cost, the order is intended. Only events with a sharp begin are compared: levels and
begins of waves, not servo frames, and not text, which is sent later than it is printed. Near a change of an input the order may
depend on where in its loop the program is, so nothing is compared there.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import NamedTuple

from msgspec.structs import replace

from robosmi.base.quantities import quantity
from robosmi.errors import VerificationError
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.judgement.after_the_end import compared_after_the_end
from robosmi.transformations.verification.judgement.side_effects import NO_LEVELS, console_speed, foreign_pin, pulled_up
from robosmi.transformations.verification.original_side import (
    CONSOLE_CHANNEL,
    DRIVEN,
    PULSED,
    SCALED,
    SETTLED,
    STANDING,
    SourceRuns,
    channel_events,
    compared,
)
from robosmi.transformations.verification.pause_comparison import PAUSES, pauses_compared
from robosmi.transformations.verification.rest_comparison import RESTING, rests_compared
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.verify.scenario import Scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.traces.activity import BURST, LEVEL, WAVE, ActivityEvent
from robosmi.verify.traces.alignment import aligned
from robosmi.verify.traces.comparison import DIFFERENT, NOT_EXERCISED, RACY, RESONATOR, SAME, ChannelComparison, FirstDifference
from robosmi.verify.traces.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE, NOT_DECIDABLE, PROGRAM, ScenarioVerdict, Verdict

_UNSETTLED = {
    "unmodelled": "it calls a function without a host model",
    "recursion": "its calls exhaust the stack",
    "time limit": "it exceeds the time limit on this machine; simulate less time",
    "output limit": "it changes its pins or prints too often to record; simulate less time",
}
_ADVICE = {"unmodelled": "; check it on the bench, or add the function to the host model"}
_BESIDE = (DRIVEN, PULSED, STANDING, RESTING, PAUSES)
"""The suffixes of channels that tell more of what another one has."""
SAME_MS = 45.0
"""Events no further apart than this (in milliseconds) plus the error of the resonators count as simultaneous."""


def verdict_of(
    scenario: Scenario, runs: SourceRuns, trace: PinTrace, ports: Sequence[BoundPort], one_thread: bool,
    at_rest: Mapping[str, int] = NO_LEVELS,
) -> ScenarioVerdict:  # fmt: skip
    """Compare what the two sides have done in a scenario.

    A difference on a channel comes first; then a crash of the migrated program that the original does not share, which is a
    difference as well; then what prevents a decision. Nothing is compared after a crash, nor if a run of the original was given
    up.

    Args:
        scenario: the scenario.
        runs: the runs of the original.
        trace: the run of the migrated program.
        ports: the ports.
        one_thread: whether a single thread of the source does all that is observed, so that the order of close events is fixed.
        at_rest: the pins that the migrated program holds so that the component there does nothing, with their levels.
    """
    nominal = runs.nominal
    if runs.given_up:
        return ScenarioVerdict(scenario, NOT_DECIDABLE, (), scenario.horizon_ms, _given_up(runs))
    crashed_ms = trace.simulated_us / 1000 if trace.state == "crashed" else None
    horizon_ms = scenario.horizon_ms if crashed_ms is None else min(scenario.horizon_ms, crashed_ms)
    if nominal.status not in SETTLED:
        horizon_ms = min(horizon_ms, nominal.trace.simulated_us / 1000)
    whole, trace = trace, trace.until(1000 * horizon_ms)  # what happens after the horizon is not compared here
    target = channel_events(trace, ports, target=True)
    found = tuple(compared(name, seen, target[name], horizon_ms, runs.loop) for name, seen in runs.channels.items())
    found = tuple(each for each in found if each.status != NOT_EXERCISED or not each.channel.endswith((DRIVEN, PULSED, STANDING)))
    found = tuple(each for each in found if each.channel != EEPROM_CHANNEL or each.status in (SAME, DIFFERENT))
    unused = {port.title for port in ports if port.rests_high and not nominal.trace.levels(port.source)}
    found = tuple(replace(c, status=NOT_EXERCISED) if c.status == SAME and c.channel in unused else c for c in found)
    found += rests_compared(runs.rests, trace, ports)
    pauses = pauses_compared(runs.pauses, nominal.trace, trace, ports, scenario, horizon_ms)
    if any(each.status != NOT_EXERCISED for each in found):
        found += pauses
    found = tuple(_racy_text(each) if _is_mixed(each, runs, trace) else each for each in found)
    found = tuple(_sure(each) for each in found)
    found = _beside(_behind_their_own(found), nominal.trace, trace, ports, at_rest)
    found = compared_after_the_end(found, scenario, runs, whole, ports)
    if one_thread and all(c.status != DIFFERENT for c in found):
        found = _in_order(found, scenario, runs, target)
    if any(c.status == DIFFERENT for c in found):
        return ScenarioVerdict(scenario, DIFFERENT_VERDICT, found, horizon_ms)
    if crashed_ms is not None and not _crashes_by(runs, crashed_ms):
        went_on = "ends normally" if nominal.status == "finished" else "continues"
        message = f"the migrated program crashes on the simulator; the original {went_on}"
        crash = FirstDifference(crashed_ms, PROGRAM, message, None, None)
        return ScenarioVerdict(scenario, DIFFERENT_VERDICT, found, horizon_ms, crash=crash)
    reason = _doubt(scenario, runs, [c for c in found if c.status == RACY], crashed_ms)
    return ScenarioVerdict(scenario, NOT_DECIDABLE if reason else NO_DIFFERENCE, found, horizon_ms, reason)


def _beside(
    found: tuple[ChannelComparison, ...],
    source: PinTrace,
    target: PinTrace,
    ports: Sequence[BoundPort],
    at_rest: Mapping[str, int],
) -> tuple[ChannelComparison, ...]:
    """The channels, with differences that are no events of them: the console's speed, foreign pins, and pull-ups."""
    speed = console_speed(source, target, CONSOLE_CHANNEL) if any(each.channel == CONSOLE_CHANNEL for each in found) else None
    if speed is not None:
        others = [each for each in found if each.channel != CONSOLE_CHANNEL]
        found = (*others, ChannelComparison(CONSOLE_CHANNEL, DIFFERENT, speed))
    for pin in (foreign_pin(source, target, ports, at_rest), pulled_up(source, target, ports)):
        if pin is None:
            continue
        first_ms = min((each.difference.at_ms for each in found if each.difference is not None), default=0.0)
        pin = replace(pin, at_ms=max(pin.at_ms, first_ms))  # after what the robot fails to do, which says more
        others = [each for each in found if each.channel != pin.channel]
        its_own = next((each for each in found if each.channel == pin.channel and each.difference is not None), None)
        found = (*others, its_own or ChannelComparison(pin.channel, DIFFERENT, pin))
    return found


def _behind_their_own(found: tuple[ChannelComparison, ...]) -> tuple[ChannelComparison, ...]:
    """The channels, where how a line is driven differs no earlier than what happens on it: a missing wave says more."""
    first = {each.channel: each.difference.at_ms for each in found if each.difference is not None}
    return tuple(
        replace(each, difference=replace(each.difference, at_ms=max(each.difference.at_ms, own_ms)))
        if each.difference is not None and (own_ms := first.get(each.channel.removesuffix(DRIVEN))) is not None
        else each
        for each in found
    )


def ended_badly(runs: SourceRuns) -> bool:
    """Whether the original did not run to its end, so that nothing can be decided whatever the migrated program does."""
    return bool(runs.given_up) or runs.nominal.status not in SETTLED


def without_target(scenario: Scenario, runs: SourceRuns, error: VerificationError) -> ScenarioVerdict:
    """The verdict on a scenario in which the run of the migrated program is not known.

    Args:
        scenario: the scenario.
        runs: the runs of the original.
        error: why that run is not known.
    """
    unknown = f"the migrated program did not run in '{scenario.name}': {error.message}"
    if runs.given_up:
        unknown = f"{_given_up(runs)}; {unknown}"
    elif ended_badly(runs):
        unknown = f"{_doubt(scenario, runs, (), None)}; {unknown}"
    return ScenarioVerdict(scenario, NOT_DECIDABLE, (), 0.0, unknown)


def _sure(found: ChannelComparison) -> ChannelComparison:
    """The comparison of a channel: if it is racy, no difference counts, since a robot's actions depend on its earlier ones.

    The console is the exception.
    """
    if found.itself is None or found.difference is None or found.channel == CONSOLE_CHANNEL:
        return found
    return replace(found, status=RACY, difference=None)


def _in_order(
    found: tuple[ChannelComparison, ...],
    scenario: Scenario,
    runs: SourceRuns,
    target: Mapping[str, Sequence[list[ActivityEvent]]],
) -> tuple[ChannelComparison, ...]:
    """The channels, one of which is different if close events of two of them have another order on the target."""
    same = [c.channel for c in found if c.status == SAME and not c.channel.endswith(_BESIDE)]
    changes_ms = [float(at_ms) for settings in scenario.signals.values() for points in settings.values() for at_ms, _ in points]
    disorder = first_disorder(
        {name: runs.channels[name][0] for name in same},
        {name: target[name][0] for name in same},
        [at for at in changes_ms if at > 0],
    )
    if disorder is None:
        return found
    return tuple(replace(c, status=DIFFERENT, difference=disorder) if c.channel == disorder.channel else c for c in found)


def _is_mixed(found: ChannelComparison, runs: SourceRuns, trace: PinTrace) -> bool:
    """Whether the first difference of the text is only that cores printing at about the same time alternate otherwise.

    Then both sides have printed the same characters by the next pause of the source.
    """
    if found.channel != CONSOLE_CHANNEL or found.difference is None:
        return False
    allowed_us = 1000 * (SAME_MS + RESONATOR * found.difference.at_ms)
    at_us = 1000 * found.difference.at_ms
    if not any(abs(mixed_us - at_us) <= allowed_us for mixed_us in runs.nominal.mixed_text_us):
        return False
    source = runs.nominal.trace
    times = [*(byte.at_us for byte in source.console), source.simulated_us]
    pauses = [last for last, after in pairwise(times) if after >= at_us and after - last > allowed_us]
    if not pauses:
        return True
    until_us = max(at_us, pauses[0]) + allowed_us
    printed = [Counter(byte.byte for byte in each.console if byte.at_us <= until_us) for each in (source, trace)]
    return printed[0] == printed[1]


def _racy_text(found: ChannelComparison) -> ChannelComparison:
    return ChannelComparison(found.channel, RACY, None, found.events, found.greatest_dt_ms)


def _crashes_by(runs: SourceRuns, at_ms: float) -> bool:
    """Whether a run of the original has ended badly at about that time or before: a crash may be the original's own fault."""
    latest_ms = at_ms + SAME_MS + RESONATOR * at_ms
    return any(run.status not in SETTLED and run.trace.simulated_us / 1000 <= latest_ms for run in (runs.nominal, *runs.varied))


def _given_up(runs: SourceRuns) -> str:
    """Why a scenario decides nothing if a run of the original was given up."""
    varied = "" if runs.nominal.status == runs.given_up else " with slightly changed timing"
    return f"the original did not finish{varied} ({_UNSETTLED[runs.given_up]})"


def _doubt(scenario: Scenario, runs: SourceRuns, racy: Sequence[ChannelComparison], crashed_ms: float | None) -> str:
    """Why a scenario without a difference decides nothing; empty if it does decide."""
    nominal = runs.nominal
    if nominal.status not in SETTLED:
        cause = (f": {nominal.cause}" if nominal.cause else "") + _ADVICE.get(nominal.status, "")
        reason = f"the original did not finish ({_UNSETTLED.get(nominal.status, nominal.status)}{cause})"
        if crashed_ms is not None:
            ended_ms = nominal.trace.simulated_us / 1000
            reason = f"both programs crash: {reason} at {ended_ms:.1f} ms, the migrated program crashed at {crashed_ms:.1f} ms"
        return reason
    if crashed_ms is not None:
        return (
            f"the migrated program crashes at {crashed_ms:.1f} ms; the original does not finish either "
            "with slightly changed timing"
        )
    if racy:
        where = "; ".join(f"{c.channel}: {c.itself}" if c.itself is not None else c.channel for c in racy)
        change = "" if scenario.origin == "generated" else "move the inputs of this test case by some milliseconds, or "
        advice = f"{change}check on the bench what depends on chance or exact timing"
        return f"the original is not repeatable in '{scenario.name}' ({where}); {advice}"
    return ""


def why_nothing_was_compared(verdict: Verdict, ports: Sequence[BoundPort]) -> str:
    """Why a verdict has no channel on which anything was compared, and what to do about each.

    Args:
        verdict: a verdict without any comparison.
        ports: the ports.
    """
    idle = [str(channel["name"]) for channel in verdict.channels()]
    where = "in any test case (give one in which it changes: --scenario FILE)"
    if verdict.racy:
        others = quantity(verdict.racy, "other")
        where = (
            f"in the remaining test cases; in {others} the original is not repeatable "
            "(give one in which it is repeatable: --scenario FILE, or check on the bench)"
        )
    parts = [f"{', '.join(idle)}: no change {where}"] if idle else []
    if consoles := [port.title for port in ports if not port.target and port.console]:
        parts.append(f"{', '.join(consoles)}: the console (no pin)")
    if none := [port.title for port in ports if not port.target and port.given_up and not port.console]:
        parts.append(f"{', '.join(none)}: not connected, by the plan")
    if unbound := [port for port in ports if not port.target and not port.given_up]:
        advice = " ".join(f"--bind {port.name}=PIN" for port in unbound)
        parts.append(f"{', '.join(port.title for port in unbound)}: not connected on the target (to connect: migrate {advice})")
    if lines := [port.title for port in ports if port.line and port.target]:
        parts.append(f"{', '.join(lines)}: a bus or serial line (check it on the bench)")
    return f"nothing was compared: {'; '.join(parts)}"


# ---- the order of events on different pins

_SURE_MS = 0.3
"""Events closer to each other have no order: the source's times are not known below about 100 us."""
_NEAR_MS = 150.0
"""Events further apart are compared by their times only."""
_QUIET_MS = 150.0
"""Minimum time between the last change of an input and an event that is compared."""
_SHARP = (LEVEL, WAVE, BURST)


class _Begin(NamedTuple):
    """The begin of an event in the source's nominal run, with its times in the varied runs and on the target (ms)."""

    at_ms: float
    channel: str
    event: ActivityEvent
    varied_ms: tuple[float, ...]
    target_ms: float
    target: ActivityEvent


def first_disorder(
    source: Mapping[str, Sequence[Sequence[ActivityEvent]]],
    target: Mapping[str, Sequence[ActivityEvent]],
    input_changes_ms: Sequence[float],
) -> FirstDifference | None:
    """The first two events of different channels that come in the other order on the target, or None.

    Args:
        source: channel -> its events in the nominal run, then in each varied run; channels without a difference of their own.
        target: channel -> the target's events.
        input_changes_ms: when inputs change, on either side.
    """
    begins = [begin for channel, runs in source.items() for begin in _begins(channel, runs, target[channel])]
    begins.sort(key=lambda begin: begin.at_ms)
    for number, before in enumerate(begins):
        if any(0 <= before.at_ms - at_ms <= _QUIET_MS for at_ms in input_changes_ms):
            continue
        for after in begins[number + 1 :]:
            if after.at_ms - before.at_ms > _NEAR_MS or any(before.at_ms <= at_ms <= after.at_ms for at_ms in input_changes_ms):
                break
            if after.channel != before.channel and _swapped(before, after):
                return _told(before, after)
    return None


def _begins(channel: str, runs: Sequence[Sequence[ActivityEvent]], target: Sequence[ActivityEvent]) -> list[_Begin]:
    """The sharp begins on a channel that have a counterpart in all runs and on the target."""
    nominal, *varied = runs
    sharp = [number for number in range(1, len(nominal)) if _sharp(nominal[number - 1], nominal[number])]
    if not sharp:
        return []  # text and servos: nothing to align
    seen = [dict(aligned(nominal, run).pairs) for run in varied]
    theirs = dict(aligned(nominal, target).pairs)
    found = []
    for number in sharp:
        if number not in theirs:
            continue
        times = [run[pairs[number]].at_us / 1000 for run, pairs in zip(varied, seen, strict=True) if number in pairs]
        if len(times) == len(varied):
            event, other = nominal[number], target[theirs[number]]
            found.append(_Begin(event.at_us / 1000, channel, event, tuple(times), other.at_us / 1000, other))
    return found


def _sharp(before: ActivityEvent, event: ActivityEvent) -> bool:
    """Whether the program determines the exact time of an event, unlike that of the end of a wave or of servo frames."""
    if event.kind not in _SHARP:
        return False
    return before.kind == LEVEL if event.kind == LEVEL else not (event.kind == WAVE and float(event.value[0]) <= 0)


def _swapped(before: _Begin, after: _Begin) -> bool:
    """Whether the target clearly reverses two events whose order and distance are the same in all runs of the source."""
    apart_ms = after.at_ms - before.at_ms
    spread_ms = max((abs(b - a - apart_ms) for a, b in zip(before.varied_ms, after.varied_ms, strict=True)), default=0.0)
    coarse_ms = max(_SURE_MS, *(_period_ms(each.event) for each in (before, after)))
    return apart_ms > 2 * spread_ms + coarse_ms and before.target_ms - after.target_ms > coarse_ms


def _period_ms(event: ActivityEvent) -> float:
    """The uncertainty of an event's begin: a wave's period, since its first period may be seen only partly; 0 for others."""
    return 1000 / float(event.value[0]) if event.kind == WAVE else 0.0


def _told(before: _Begin, after: _Begin) -> FirstDifference:
    message = (
        f"{before.event} comes {before.target_ms - after.target_ms:.2f} ms after {after.event} of {after.channel}; "
        f"in the original {after.at_ms - before.at_ms:.2f} ms before it"
    )
    return FirstDifference(before.at_ms, before.channel, message, before.event, before.target)


# ---- how late a program reacts to a contact

_REACTION_MS = 5.0
"""Tolerance of a reaction: two polling periods of a program that does nothing else."""


def first_late_reaction(
    found: Sequence[ChannelComparison],
    runs: SourceRuns,
    target: Mapping[str, Sequence[list[ActivityEvent]]],
    changes_ms: Sequence[float],
    loose_ms: float,
) -> tuple[str, FirstDifference] | None:
    """The first event after a change of a contact for which the target takes longer, or less long, than each run of the source.

    Only the first event of a channel after a change is compared: the time between further ones is that of an event. Where a
    varied run of the source sees the change at another pass of its loop, the target may as well.

    Args:
        found: the comparisons of the channels; only those that are the same are looked at.
        runs: the runs of the source.
        target: channel -> the target's events, for each sight.
        changes_ms: when contacts change.
        loose_ms: the tolerance beside that of each event.

    Returns:
        The channel and the difference.
    """
    late = []
    for channel in (each.channel for each in found if each.status == SAME and not each.channel.endswith(_BESIDE)):
        before_ms = 0.0
        for begin in _begins(channel, runs.channels[channel][0], target[channel][0]):
            since_ms = max((at_ms for at_ms in changes_ms if before_ms < at_ms <= begin.at_ms), default=None)
            before_ms = begin.at_ms
            if since_ms is None:
                continue
            allowed_ms = _REACTION_MS + RESONATOR * (begin.at_ms - since_ms) + _period_ms(begin.event) + loose_ms
            if all(abs(begin.target_ms - own_ms) > allowed_ms for own_ms in (begin.at_ms, *begin.varied_ms)):
                off_ms = begin.target_ms - begin.at_ms
                when = f"{abs(off_ms):.1f} ms too {'late' if off_ms > 0 else 'early'} after an input changes"
                message = f"{begin.target.does()} {when} (tolerance {allowed_ms:.1f} ms)"
                late.append((channel, FirstDifference(begin.at_ms, channel, message, begin.event, begin.target)))
    return min(late, key=lambda each: each[1].at_ms, default=None)


def costs_ms(found: Sequence[ChannelComparison], runs: SourceRuns) -> float:
    """By how much the costs of the program's steps move the events of a scenario, in milliseconds."""
    greatest = 0.0
    for channel in (each.channel for each in found if each.status == SAME and not each.channel.endswith(_BESIDE)):
        own, *varied = runs.channels[channel][0]
        for run in varied[:SCALED]:
            moved = (abs(run[other].at_us - own[number].at_us) / 1000 for number, other in aligned(own, run).pairs)
            greatest = max([greatest, *moved])
    return greatest
