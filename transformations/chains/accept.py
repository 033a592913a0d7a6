"""The chain `accept`: stores that a finding is on purpose, as an `[[accept]]` of the project file beside the sources.

It is one run, which a single `undo` reverts, like a choice. What is accepted stays listed, with its reason.
"""

from __future__ import annotations

from pathlib import Path

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.errors import SourceError
from robosmi.files.commit import again_when_changed
from robosmi.files.recovery import at_work
from robosmi.generate.output_paths import Places
from robosmi.generate.project_entries import accepted_in_project
from robosmi.project import FILE_NAME, Accepted, Project, load_project
from robosmi.query import Q
from robosmi.quoting import toml
from robosmi.report import Report
from robosmi.transformations.chains.stages.edited_plan import STORED, refuse_unseen
from robosmi.transformations.chains.stages.models import MigrationModels, stored_models
from robosmi.transformations.chains.stages.output import Generated, produce
from robosmi.transformations.chains.stages.sources import project_folder
from robosmi.transformations.m2t.task_list import VERDICT_RULES
from robosmi.transformations.queries.plans.plan import as_findings

_UNREADABLE = "RS902"
"""The rule for a file that cannot be read."""


@again_when_changed
def accept(output: Path, accepted: Accepted, *, source: Path | None = None, seen: str | None = None) -> Generated:
    """Store that the findings of a rule about an element are on purpose, or no longer.

    Args:
        output: the output folder of a migration.
        accepted: the rule, the element as `[[accept]]` names it, and the reason; an empty reason takes the entry out.
        source: a source of the program, where the place of the last migration's is not known; robosmi.toml lies beside it.
        seen: the digest of the plan that the person has seen; None to take it as it is.

    Raises:
        SourceError: the folder has no plan, or the project file cannot be read or written.
        StoppedError: the plan is not the one that was seen, or another run is at work.
    """
    with at_work(output):
        data = Places(output).read(STORED) or b""
        refuse_unseen(output, data, seen)
        models = stored_models(output)
        place, reason = project_folder(output, models.plan, source)
        change = accepted_in_project(place, accepted) if place is not None else None
        if change is None or change.stays:
            entry = f"rule = {toml(accepted.rule)}, element = {toml(accepted.element)}, reason = {toml(accepted.reason)}"
            fix = f"write an [[accept]] into {FILE_NAME} next to the program: {entry}"
            why = change.stays if change is not None else reason
            raise SourceError(f"this cannot be saved: {why}", location=Location(str(output / STORED)), fix=fix)
        run = f"{'on purpose' if accepted.reason else 'no longer on purpose'}: {accepted.rule} of {accepted.element}"
        return produce(models, output, inputs={STORED: data}, outside=change.files, run=run)


def project_findings(models: MigrationModels, output: Path, source: Path | None = None) -> list[Finding]:
    """The findings of a stored plan without its verdict, as the project file beside the sources judges them.

    A project file that cannot be read is a finding, too, and judges nothing.

    Args:
        models: the stored plan and its models.
        output: its folder.
        source: as for `accept`.
    """
    place, _ = project_folder(output, models.plan, source)
    report, project, faults = Report("page"), Project(), list[Finding]()
    try:
        project = load_project(place) if place is not None else project
    except SourceError as error:
        faults = [Finding(_UNREADABLE, Severity.error, error.message, error.location, fix=error.fix)]
    own = as_findings(Q(f for f in models.plan.findings if str(f.rule) not in VERDICT_RULES), models.places)
    report.findings = [*faults, *models.notes, *own]
    report.judge(project.severity, project.accept)
    return sorted(report.findings, key=lambda finding: -finding.severity)
