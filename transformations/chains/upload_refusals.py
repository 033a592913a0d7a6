"""What keeps a program from being put on its board: findings of its plan by which the board may be damaged.

They are errors that do not keep a sketch from being written or compiled. A person who knows better accepts them in the project
file (`[[accept]]`).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robosmi.diagnostics import Finding, Severity
from robosmi.project import Project, load_project
from robosmi.report import Report
from robosmi.transformations.chains.check import check
from robosmi.transformations.chains.stages.models import load_models
from robosmi.transformations.chains.stages.sources import project_folder

DAMAGING = frozenset({"RS258"})
"""Rules whose errors say that a pin of the board may be destroyed."""


def upload_refusals(output: Path) -> Sequence[Finding]:
    """The errors of a plan that a person has to accept before its program is uploaded; the registry's query of that name.

    Args:
        output: the output folder of a migration; any other folder has none.

    Raises:
        SourceError: the plan or the project file cannot be read.
    """
    plan = output / "models" / "plan.xmi"
    if not plan.is_file():
        return []
    report = Report("upload")
    report.findings = [finding for finding in check(plan).findings if finding.rule in DAMAGING]
    if report.findings:
        project = _project_of(output, plan)
        report.judge(project.severity, project.accept)
    return [finding for finding in report.findings if finding.severity is Severity.error]


def _project_of(output: Path, plan: Path) -> Project:
    """The project file in the output folder, else the one beside the program that the plan was made from."""
    own = load_project(output)
    if own.path is not None:
        return own
    folder, _ = project_folder(output, load_models(plan).plan)
    return load_project(folder) if folder is not None else own
