"""The chain `check`: evaluates all constraints registered for the metamodel of a drawing, a plan or any other model.

A plan is checked together with the models that it refers to. Files are read like in every other command, so the readers'
findings are reported, too. Nothing is written.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from robosmi.diagnostics import Finding, Severity
from robosmi.errors import UsageError
from robosmi.metamodels import hardware, migration
from robosmi.model import EmfModel, Metamodel, Model, open_model
from robosmi.model.ecore.ecore_lint import lint
from robosmi.model.ecore.ecore_loader import load_metamodels
from robosmi.model.ecore.metamodels import built_in
from robosmi.model.generator.codegen import render
from robosmi.model.versions import read_current
from robosmi.plugins import registry
from robosmi.project import Project, project_of
from robosmi.query import root_of
from robosmi.report import Report
from robosmi.report.notebook import Findings
from robosmi.resources import project_of_input
from robosmi.transformations.chains.hardware import drawing_for
from robosmi.transformations.chains.stages.constraint_sets import KIND, constraints_of
from robosmi.transformations.chains.stages.edited_plan import STORED
from robosmi.transformations.chains.stages.readers import is_drawing
from robosmi.transformations.chains.stages.sources import project_of_output
from robosmi.transformations.constraints.electrical_plan import wired
from robosmi.transformations.constraints.finding_locations import in_file

DAMAGING = frozenset({"RS258"})
"""Rules whose errors say that a pin of the board may be destroyed. The user who knows better accepts them (`[[accept]]`)."""
_CONTRADICTIONS = frozenset({"RS607", "RS608", "RS609", "RS610", "RS613"})
"""Rules whose warnings, for those who only read a model, are errors when it is checked, as in Eclipse EMF's validation."""


class Checked:
    """The checked model and the findings.

    Args:
        project: the project file that judges the findings.
    """

    def __init__(self, project: Project) -> None:
        self.project = project
        self.models: list[dict[str, Any]] = []
        self.findings: list[Finding] = Findings()
        self.sound: str | None = None
        """What is said of a metamodel, "" where there are findings about it; None for other models."""

    @property
    def result(self) -> dict[str, Any]:
        """The command's part of the document."""
        return {"models": self.models}

    def lines(self) -> list[str]:
        """Text for a terminal."""
        if any(m["constraints"] for m in self.models):
            return [f"{m['model']}: {m['elements']} elements, {m['constraints']} constraints" for m in self.models]
        if self.sound is None:
            known = ", ".join(registry().names(KIND))
            read = [f"{m['model']}: {m['elements']} elements" for m in self.models]
            return [*read, f"no constraints for this model; known: {known}"]
        return [self.sound] if self.sound else []


def check(path: str | Path, metamodels: Sequence[Path] = (), target: str | None = None) -> Checked:
    """Check a model.

    Args:
        path: a drawing, a stored plan, the output folder of a migration for its plan, or a model file of any technology.
        metamodels: the `.ecore` files of an XMI file whose metamodels are not known.
        target: the target whose board a drawing has; if None that of the project file.

    Raises:
        SourceError: it or its project file cannot be read, or it has another board than the target's.
        ModelError: it contradicts its metamodel.
        UsageError: there is no such target, or a target is given for something else than a drawing.
    """
    file = Path(path)
    if (plan := file / STORED).is_file():
        file = plan
    with project_of_input(file):
        return _checked(file, metamodels, target)


def _checked(file: Path, metamodels: Sequence[Path], target: str | None) -> Checked:
    done = Checked(project_of(file))
    if target and (metamodels or not is_drawing(file)):
        raise UsageError(
            "--target is for drawings and pin tables",
            fix="leave it out: a plan has its target; for another one: robosmi migrate OUT --target NAME -o NEW",
        )
    if metamodels:
        metamodel = Metamodel.load(*metamodels)
        done.findings += _judged(metamodel.findings)
        return _validated(done, [open_model(file, "emf", metamodel=metamodel)])
    if is_drawing(file):
        read = drawing_for(file, done.project.roles, target)
        done.findings += read.findings
        return _validated(done, [EmfModel(read.circuit, name="hardware")])
    if file.suffix == ".ecore":
        made = render([file])
        odd = [*made.findings, *_judged(lint(file, load_metamodels([file])))]
        done.findings += odd  # whatever keeps a metamodel from being used is an error with all its reasons
        done.sound = "" if odd else f"{file}: the metamodel is correct ({made.classes} classes)"
    if file.suffix != ".xmi":
        return _validated(done, [open_model(file)])
    root = next(iter(read_current(file, built_in(), inside=Path(os.path.realpath(file)).parent).values()))
    if isinstance(root, migration.MigrationPlan) and root.circuit is not None:
        wired(root)  # the board is the plan's, not the repository's
    if isinstance(root, migration.MigrationPlan) and file.match(STORED):
        done.project = project_of_output(file.parents[1], root)
    models = [EmfModel(root, name=file.stem)]
    if isinstance(root, migration.MigrationPlan):
        parts = {
            "code": root.program,
            "hardware": root.circuit,
            "platform": root_of(root.target) if root.target is not None else None,
        }
        models += [EmfModel(part, name=name) for name, part in parts.items() if part is not None]
    return _validated(done, models)


def _validated(done: Checked, models: Sequence[Model]) -> Checked:
    for model in models:
        done.findings += _judged(model.findings) if isinstance(model, EmfModel) else []
        sets = [constraints_of(name) for name in _metamodels(model) if name in registry().names(KIND)]
        for one in sets:
            found = one.run(model, *_referred(model, models))
            named = map(_with_port, found.findings(), (unsatisfied.element for unsatisfied in found.unsatisfied))
            done.findings += in_file(list(named), _path(model))
        counted = sum(len(c.constraints) for one in sets for module in one.modules() for c in module.contexts)
        done.models.append({"model": model.name, "elements": len(list(model.all_contents())), "constraints": counted})
    return done


def _judged(findings: Sequence[Finding]) -> list[Finding]:
    return [
        replace(each, severity=Severity.error) if each.rule in _CONTRADICTIONS and each.severity is Severity.warning else each
        for each in findings
    ]


def _with_port(finding: Finding, element: object) -> Finding:
    """A finding with the name of the port that it is about, if any, as `migrate` reports it."""
    if not isinstance(element, migration.PortBinding):
        return finding
    return replace(finding, evidence={**finding.evidence, "port": str(element.name)})


def _path(model: Model) -> str:
    """The file that a model was read from, of a drawing the drawing; "" where that is not known."""
    roots = model.roots if isinstance(model, EmfModel) else []
    drawn = next((root.path for root in roots if isinstance(root, hardware.Circuit)), "")
    return drawn or (str(model.path) if model.path is not None else "")


def _referred(model: Model, models: Sequence[Model]) -> list[Model]:
    """The program of a plan, which some constraints on plans need."""
    is_plan = isinstance(model, EmfModel) and any(isinstance(r, migration.MigrationPlan) for r in model.roots)
    return [m for m in models if m is not model and m.name == "code"] if is_plan else []


def _metamodels(model: Model) -> list[str]:
    """The names of a model's metamodels; empty for a technology without metamodels."""
    return list(dict.fromkeys(kind.partition("::")[0] for kind, _ in model.types() if "::" in kind))


def upload_refusals(output: Path) -> Sequence[Finding]:
    """The errors of a plan that the user has to accept before its program is uploaded; the registry's query of that name.

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
