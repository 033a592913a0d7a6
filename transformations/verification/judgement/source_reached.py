"""What a verdict rests on: how much of the source was reached, and which adapters without a body were called."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from robosmi import inputs
from robosmi.metamodels import ccode, migration
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.reports.written_bodies import AS_BYTES, open_bodies
from robosmi.transformations.verification.bound_devices.played_devices import played
from robosmi.transformations.verification.bound_devices.port_devices import BoundPort
from robosmi.transformations.verification.judgement.compared_outputs import compared_outputs, unreachable_functions
from robosmi.transformations.verification.original_side import SourceRuns
from robosmi.verify.missed_lines import line_ranges
from robosmi.verify.original import Original, SourceCoverage
from robosmi.verify.toolchains.sketch import find_sketch
from robosmi.verify.traces.verdict import NOT_DECIDABLE, ScenarioVerdict, Verdict


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
