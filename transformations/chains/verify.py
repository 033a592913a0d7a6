"""The chain `verify`: does the migrated program do the same? The original and the sketch run under the same scenarios.

The sources are those stored with the plan, the sketch is the one that now stands in the output folder. Scenarios are given,
stored with the models, or made by a search; new ones are stored. Nothing else is written but the trace that was asked for.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.doing import doing
from robosmi.errors import SourceError, VerificationError
from robosmi.metamodels import migration, platform
from robosmi.model.files import write_atomic
from robosmi.transformations.chains.models import MigrationModels, stored_models
from robosmi.transformations.chains.output import Generated, produce
from robosmi.transformations.chains.simulate import plan_beside
from robosmi.transformations.knowledge.board_models import load_board
from robosmi.transformations.m2t.task_list import PICTURE
from robosmi.transformations.queries.source_text import is_header
from robosmi.transformations.queries.step_counts import most_steps
from robosmi.transformations.verification.difference_calls import calls_around
from robosmi.transformations.verification.judging import why_nothing_was_compared
from robosmi.transformations.verification.original_side import (
    CONSOLE_CHANNEL,
    Place,
    places_reached,
    run_source,
    run_varied,
)
from robosmi.transformations.verification.originals import original_program, with_stored_names
from robosmi.transformations.verification.played_devices import signals_of
from robosmi.transformations.verification.port_devices import (
    BoundPort,
    bound_ports,
    reads_console,
    resting_pins,
    texts_understood,
)
from robosmi.transformations.verification.scenario_search import search
from robosmi.transformations.verification.scenario_verdicts import Case, ComparedScenario, compare_scenarios
from robosmi.transformations.verification.source_reached import cover
from robosmi.transformations.verification.target_side import LIMIT_S, TargetSide
from robosmi.trust import acting
from robosmi.typed import sum_of
from robosmi.verify.compile_report import LITTLE_RAM, CompileReport
from robosmi.verify.host_model import load_host_model
from robosmi.verify.libraries import STAND_IN
from robosmi.verify.original_build import OriginalProgram
from robosmi.verify.scenario import Scenario, read_scenario
from robosmi.verify.simulation import PinTrace
from robosmi.verify.temporary import temporary_folder
from robosmi.verify.toolchain import compile_sketch
from robosmi.verify.trace_picture import trace_svg
from robosmi.verify.vcd import vcd_text
from robosmi.verify.verdict import DIFFERENT_VERDICT, NO_DIFFERENCE, NOT_COMPILED, NOT_DECIDABLE, Verdict

FOLDER = "scenarios"
"""Where scenarios are stored, beside the models."""


class Verified(Struct):
    """A verification with what was written.

    Attributes:
        verdict: the verdict.
        compiled: how the migrated program was compiled.
        written: files that were written, with their kind.
    """

    verdict: Verdict
    compiled: CompileReport
    written: list[tuple[Path, str]] = []

    @property
    def findings(self) -> list[Finding]:
        """What the compiler found, but for mere information."""
        return [f for f in self.compiled.diagnostics if f.severity is not Severity.info]

    @property
    def result(self) -> dict[str, Any]:
        """The contract's part of the document."""
        return self.verdict.to_json()

    def lines(self) -> list[str]:
        """What a person reads."""
        return self.verdict.lines()


def verify(
    output: Path,
    *,
    scenarios: Sequence[Path] = (),
    engine: str | None = None,
    seed: int = 1,
    vcd: Path | None = None,
    generate: bool = True,
    budget_s: float = 240.0,
) -> Verified:
    """Compare a migrated program with its original.

    Args:
        output: the output folder of a migration.
        scenarios: files with scenarios; those stored with the models, and generated ones, if there are none.
        engine: name of the simulator.
        seed: of the search for scenarios.
        vcd: file for both traces of the first scenario that differs, else of the one in which most happens.
        generate: whether to search for scenarios where none are given.
        budget_s: seconds of this machine's time for that search.

    Raises:
        SourceError: there is no plan or program, or a file cannot be read or written.
        UsageError: a scenario names what is not there, or no simulator knows the board.
        MissingToolError: a compiler or simulator is not installed.
        VerificationError: the simulator crashed or did not end.
    """
    plan_file = plan_beside(output)
    if plan_file is None:
        raise SourceError(f"there is no stored plan in {output}", fix="name the output folder of migrate, with its models")
    models = stored_models(plan_file.parent.parent)
    plan = models.plan
    assert plan.program is not None
    assert plan.source is not None
    if not (plan_file.parent / FOLDER).resolve().is_relative_to(plan_file.parent.parent.resolve()):
        raise SourceError(
            "the scenarios lie outside of the output folder, by a link", location=Location(str(plan_file.parent / FOLDER)),
            fix="put a folder with copies of them there",
        )  # fmt: skip
    ports = bound_ports(plan, plan_file.parent)
    given = [read_scenario(path) for path in scenarios]
    for scenario in given:
        signals_of(ports, scenario)  # before anything is compiled
    with temporary_folder("verify") as place:
        folder = Path(place)
        (folder / "target").mkdir()
        report = compile_sketch(output, keep=folder / "target")
        verdict = Verdict(compiled=report.ok, compiler=report.tool, binding=[port.to_json() for port in ports])
        verdict.stand_ins = [library.name for library in report.libraries if library.source == STAND_IN]
        verdict.little_room = next((f"{f.message} [{f.rule}]" for f in report.diagnostics if f.rule == LITTLE_RAM), "")
        verdict.functions = {port.title: port.functions for port in ports}
        verdict.not_compared = [port.title for port in ports if port.line or not port.compared]
        verdict.why_not_compared = {
            port.title: f"one pin of the original, {port.source}, is both this and {port.shares_with}"
            for port in ports
            if port.shares_with
        }
        if not report.ok:
            return Verified(verdict, report)
        if report.elf is None:
            verdict.reasons.append(_too_big(report))
            return Verified(verdict, report)
        side = TargetSide(_board(models, report), report, ports, engine)
        verdict.engine = side.engine
        if not side.shows_console:
            verdict.not_compared.append(CONSOLE_CHANNEL)
        (folder / "source").mkdir()
        doing("compile the original")
        try:
            program = _original(models, plan_file.parent, folder / "source")
        except VerificationError as error:
            at = error.location
            where = f" ({Path(at.path).name}:{at.line})" if at is not None and at.line else ""
            verdict.reasons.append(f"the original cannot be run here: {error.message}{where}")
            return Verified(verdict, report)
        verdict.original = f"{program.model.title}, {program.compiler}"
        cases, made = _cases(
            program, ports, plan, given, plan_file.parent / FOLDER, seed if generate else None, verdict, budget_s
        )
        if verdict.racy and not made.new and not any(not runs.racy_channels for _, runs in cases):
            verdict.reasons.append(f"no scenario is left: in all {verdict.racy} that were made the source differs from itself")
        doing(f"run the migrated program in {len(cases)} scenario{'s' * (len(cases) != 1)}")
        one_thread, at_rest = plan.concurrency is None, resting_pins(plan)
        compared = compare_scenarios(program, ports, cases, side, one_thread, at_rest, whole=vcd is not None)
        kept = compared.kept
        verdict.engine = side.engine
        verdict.scenarios = [each.told for each in kept]
        for scenario, runs in compared.racy:
            verdict.racy += 1
            made.racy_counts.append(runs.nominal.counts)
            made.new.remove(scenario)
        if compared.undecided and verdict.verdict != DIFFERENT_VERDICT:
            raise compared.undecided[0]
        if cases and not kept:
            verdict.reasons.append(f"no scenario is left: in all {verdict.racy} that were made the source differs from itself")
        if (found := verdict.first_difference) is not None:
            runs = kept[verdict.scenarios.index(found[0])].runs
            verdict.calls = calls_around(program, ports, found[0].scenario, runs, found[1])
        if verdict.nothing_compared:
            verdict.reasons.append(why_nothing_was_compared(verdict, ports))
        cover(verdict, program, [each.runs for each in kept], made.racy_counts, plan, output, ports)
        done = Verified(verdict, report)
        _store(made.new, plan_file.parent / FOLDER, done)
        if kept:
            shown = kept[_shown(verdict)]
            _write_picture(plan_file.parent / PICTURE, shown, done)
            if vcd is not None and shown.trace is not None:
                _write_vcd(vcd, shown, shown.trace, done)
    return done


def _too_big(report: CompileReport) -> str:
    fits = f"; it fits {report.fits_on}" if report.fits_on else ""
    return f"the migrated program is too big for {report.board}, so that it was not run{fits}"


_RULES = {
    NO_DIFFERENCE: ("RS850", migration.SeverityLevel.info),
    DIFFERENT_VERDICT: ("RS851", migration.SeverityLevel.error),
    NOT_DECIDABLE: ("RS852", migration.SeverityLevel.warning),
    NOT_COMPILED: ("RS853", migration.SeverityLevel.error),
}
_ADVICE = {
    NO_DIFFERENCE: "look at the binding and the scenarios: what they do not show was not compared",
    DIFFERENT_VERDICT: "see: robosmi verify",
    NOT_DECIDABLE: "see: robosmi verify",
    NOT_COMPILED: "see: robosmi compile",
}


def verdict_finding(verdict: Verdict) -> migration.PlanFinding:
    """The verdict as a finding of a plan, for its report."""
    rule, severity = _RULES[verdict.verdict]
    return migration.PlanFinding(rule=rule, severity=severity, message=verdict.sentence(), fix=_ADVICE[verdict.verdict])


def with_verdict(made: Generated, *, strict: bool = False) -> Generated:
    """Compare what a migration made with the original, and write its report again with the verdict in it.

    Raises:
        MissingToolError: a compiler or simulator is not installed.
        VerificationError: the simulator crashed or did not end.
    """
    done = verify(made.output)
    made.models.plan.findings.append(verdict_finding(done.verdict))
    again = produce(made.models, made.output, strict=strict)
    again.notes = [*made.notes, *(note for note in again.notes if note not in made.notes)]
    again.verification = (done.verdict.to_json(), done.verdict.exit_code)
    return again


# ---- both sides


def _board(models: MigrationModels, report: CompileReport) -> platform.Board:
    stored = models.plan.board
    return stored if stored is not None and stored.name == report.board else load_board(report.board)


def _original(models: MigrationModels, folder: Path, place: Path) -> OriginalProgram:
    plan = models.plan
    assert plan.program is not None
    assert plan.source is not None
    stored = with_stored_names(list(plan.program.units), folder, place / "stored")
    sources = [stored / unit.path for unit in plan.program.units if not is_header(unit)]
    with acting():
        return original_program(sources, load_host_model(str(plan.source.name)), place, limit_s=LIMIT_S)


class _Made(Struct):
    new: list[Scenario] = []
    racy_counts: list[bytes] = []


def _cases(
    program: OriginalProgram, ports: list[BoundPort], plan: migration.MigrationPlan, given: list[Scenario], stored: Path,
    seed: int | None, verdict: Verdict, budget_s: float,
) -> tuple[list[Case], _Made]:  # fmt: skip
    """The scenarios with their runs of the source: the given ones alone, else stored and generated ones."""
    listed = given or [read_scenario(path, "stored") for path in sorted(stored.glob("*.toml"))]
    cases: list[Case] = []
    for number, scenario in enumerate(listed, 1):
        doing(f"run the original in scenario {number} of {len(listed)}, again and again")
        nominal = run_source(program, ports, scenario, LIMIT_S)
        cases.append((scenario, run_varied(program, ports, scenario, nominal, LIMIT_S)))
    made = _Made()
    if given or seed is None:
        return cases, made
    known: frozenset[Place] = frozenset().union(*(places_reached(program, runs.nominal, ports) for _, runs in cases))
    assert plan.program is not None
    steps = most_steps(plan.program)
    found = search(program, ports, texts_understood(plan), reads_console(plan), seed, known, budget_s, steps)
    fresh = [(s, r) for s, r in found.scenarios if not known or not places_reached(program, r.nominal, ports) <= known]
    verdict.racy = found.racy
    made.racy_counts = found.racy_counts
    made.new = [scenario for scenario, _ in fresh]
    if not cases and not fresh and found.least_racy is not None:  # what is not racy in it can be compared all the same
        least, nominal = found.least_racy
        fresh = [(least, run_varied(program, ports, least, nominal, LIMIT_S))]
    return [*cases, *fresh], made


# ---- what is written


def _store(scenarios: Sequence[Scenario], folder: Path, done: Verified) -> None:
    """New scenarios, each as a file beside the models."""
    try:
        for scenario in scenarios:
            number = 1
            while (path := folder / f"generated_{number:02}.toml").exists():
                number += 1
            folder.mkdir(exist_ok=True)
            write_atomic(path, scenario.text().encode())
            done.written.append((path, "scenario"))
    except OSError as error:
        raise SourceError(
            f"the scenarios cannot be stored: {error.strerror or error}", fix="check the folder's permissions"
        ) from error


def _shown(verdict: Verdict) -> int:
    """The number of the scenario that is shown: the first one that differs, else the one in which most happens."""
    busiest = max(range(len(verdict.scenarios)), key=lambda n: sum_of(c.events for c in verdict.scenarios[n].channels))
    return next((n for n, s in enumerate(verdict.scenarios) if s.verdict == DIFFERENT_VERDICT), busiest)


def _write_picture(path: Path, shown: ComparedScenario, done: Verified) -> None:
    """Both sides of a scenario as a picture, beside the models."""
    told = shown.told
    pairs = {name: (seen[0][0], shown.target[name]) for name, seen in shown.runs.channels.items() if name in shown.target}
    difference = None if told.first is None else (told.first.at_ms, told.first.channel, told.first.message)
    title = f"{told.scenario.name}: {told.verdict.replace('-', ' ')}"
    try:
        write_atomic(path, trace_svg(title, pairs, told.scenario.horizon_ms, difference).encode())
    except OSError as error:
        raise SourceError(
            f"the picture cannot be stored: {error.strerror or error}", fix="check the folder's permissions"
        ) from error
    done.written.append((path, "picture"))


def _write_vcd(vcd: Path, shown: ComparedScenario, trace: PinTrace, done: Verified) -> None:
    sides = {"source": shown.runs.nominal.trace, "target": trace}
    try:
        write_atomic(vcd, vcd_text(sides, shown.told.scenario.name).encode())
    except OSError as error:
        raise SourceError(f"the trace cannot be written: {error.strerror or error}", fix="give another file") from error
    done.written.append((vcd, "vcd"))
