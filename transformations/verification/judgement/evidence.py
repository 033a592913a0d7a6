"""What a verdict rests on: how much of the source was reached, which of the wired outputs were compared, which adapters without
a body were called, and what nothing reaches from main.

A difference is explained by the library calls of the source near it: the one that acts on that channel, and the ones around it
(`calls_around`). The fault may lie in the adapter of any of these functions, and nothing seen from outside tells which: if a
lamp is on for too short a time, one function has switched it and another one has waited.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from pathlib import Path

from msgspec.structs import replace

from robosmi import inputs
from robosmi.metamodels import ccode, migration
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.programs.live_code import live_in
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES, open_bodies
from robosmi.transformations.verification.bound_devices.played_devices import played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.bound_devices.simulated_kinds import device_facts
from robosmi.transformations.verification.original_side import CONSOLE_CHANNEL, DRIVEN, PULSED, STANDING, SourceRuns
from robosmi.transformations.verification.pause_comparison import PAUSES
from robosmi.transformations.verification.rest_comparison import RESTING
from robosmi.transformations.verification.stored_bytes import EEPROM_CHANNEL
from robosmi.verify.missed_lines import line_ranges
from robosmi.verify.original import LibraryCall, Original, SourceCoverage
from robosmi.verify.scenario import Scenario
from robosmi.verify.toolchains.sketch import find_sketch
from robosmi.verify.traces.comparison import DIFFERENT, NOT_EXERCISED, SAME, FirstDifference
from robosmi.verify.traces.verdict import NOT_DECIDABLE, PROGRAM, CallsAround, ScenarioVerdict, Verdict

_ASPECTS = (DRIVEN, PULSED, STANDING, RESTING)
"""What the name of a channel ends with that is a second view of an output."""

_LONGEST_US = 3_000_000.0
"""Calls further away from the difference than this, in microseconds, are left out."""
_MARGIN_US = 1_000.0
_BEFORE, _AFTER = 6, 4
_MACRO = re.compile(r"^__builtin_propeller_")
"""Prefix of functions for which the platform's headers define macros with shorter names."""


def _open_now(output: Path) -> dict[str, bool]:
    """Function of the output program as it is now -> whether its body is still to be written, whatever the plan says."""
    sketch, _ = find_sketch(output)
    files = [sketch.main, *sketch.parts, *(path for path in sketch.folder.glob("*") if path.suffix in (".h", ".hpp"))]
    return open_bodies(inputs.read_text(path, inputs.SOURCE, errors=AS_BYTES) for path in files)


def cover(
    verdict: Verdict, program: Original, cases: Sequence[SourceRuns], racy: Sequence[bytes], plan: migration.MigrationPlan,
    output: Path, ports: Sequence[BoundPort],
) -> None:  # fmt: skip
    """Add to a verdict how much of the source the decided scenarios reach, and which unfinished adapters are called.

    Args:
        verdict: the verdict, with its scenarios.
        program: the original.
        cases: its runs in each of these scenarios.
        racy: the coverage counters of scenarios that were dropped since the source differs from itself.
        plan: the plan of the migration.
        output: the output folder, whose program as it now stands counts.
        ports: the ports.
    """
    decided = [
        runs.nominal.counts
        for runs, told in zip(cases, verdict.scenarios, strict=True)
        if runs.nominal.counts and told.verdict != NOT_DECIDABLE and told.crash is None and not verdict.nothing_compared
    ]
    if called := [
        _compared_counts(runs, told, program, ports)
        for runs, told in zip(cases, verdict.scenarios, strict=True)
        if runs.nominal.counts
    ]:
        verdict.reasons += _unfinished(program.coverage(called), plan, _open_now(output), program.stubbed)
    verdict.counted = len(decided)
    verdict.outputs = compared_outputs(verdict, ports)
    if not decided:
        return
    assert plan.program is not None
    dead = unreachable_functions(plan.program.units)
    covered = program.coverage(decided)
    ran = {(Path(file).name, name) for (file, line), name in covered.functions.items() if covered.lines[file, line]}
    dead = {place: text for place, text in dead.items() if place not in ran}  # called in a way that the model does not show
    verdict.unreachable = sorted(dead.values())
    dead_lines = {(Path(file).name, line) for (file, line), name in covered.functions.items() if (Path(file).name, name) in dead}
    verdict.outputs = compared_outputs(verdict, ports, dead_lines)
    covered = covered.without(dead)
    by_racy = program.coverage([c for c in racy if c]).without(dead) if any(racy) else None
    verdict.lines_pct = covered.line_percent
    only_racy = {place for place in covered.missed_branches if by_racy is not None and by_racy.branches.get(place, 0) > 0}
    missed = [place for place in covered.missed_branches if place not in only_racy]
    counted = len(covered.branches) - len(only_racy)
    verdict.branches_pct = 100.0 * (counted - len(missed)) / counted if counted else 100.0
    verdict.racy_branches = [f"{Path(file).name}:{line}" for file, line, _ in sorted(only_racy)]
    verdict.missed_branches = [f"{Path(file).name}:{line}" for file, line, _ in missed]
    verdict.missed_lines = line_ranges({place for place, count in covered.lines.items() if not count}, covered.lines)
    verdict.untaken = [f"{Path(file).name}:{line}" for file, line, _ in missed if covered.lines.get((file, line))]


def _compared_counts(runs: SourceRuns, told: ScenarioVerdict, program: Original, ports: Sequence[BoundPort]) -> bytes:
    """The coverage counters of what was compared: if the migrated program crashes, the source runs again up to that time."""
    if told.crash is None:
        return runs.nominal.counts
    return program.run(told.simulated_ms * 1000, played(ports, told.scenario, target=False)).counts


def _unfinished(
    covered: SourceCoverage, plan: migration.MigrationPlan, open_now: Mapping[str, bool], stubbed: Sequence[str]
) -> list[str]:
    """A reason for each adapter without a body that is called in a scenario, unless it does nothing on both sides."""
    lines = {(Path(file).name, line) for (file, line), count in covered.lines.items() if count}
    found = []
    for use in plan.adapterUses:
        without = use.status in (migration.AdapterStatus.todo, migration.AdapterStatus.unsupported)
        if use.name in stubbed or not open_now.get(str(use.targetName or use.name), without):
            continue
        if any((Path(_unit(call)).name, int(call.line)) in lines for call in use.calls):
            found.append(f"the program calls {use.name}, which has no body yet")
    return found


def _unit(element: Element | None) -> str:
    while element is not None and not isinstance(element, ccode.SourceUnit):
        element = element.eContainer()
    return str(element.path) if element is not None else ""


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
