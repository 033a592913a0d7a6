"""What keeps a program from being put on its board: findings of its plan by which the board may be damaged.

They are errors that do not keep a sketch from being written or compiled. A person who knows better accepts them in the project
file (`[[accept]]`).
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from robosmi.diagnostics import Finding, Severity
from robosmi.report import Report
from robosmi.transformations.chains.check import check

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
    report, checked = Report("upload"), check(plan)
    report.findings = [finding for finding in checked.findings if finding.rule in DAMAGING]
    report.judge(checked.project.severity, checked.project.accept)
    return [finding for finding in report.findings if finding.severity is Severity.error]
