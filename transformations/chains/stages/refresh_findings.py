"""Finds those findings of a stored plan anew that follow from its decisions, after a decision was changed.

They are the ones that `migrate` makes from a decided plan: faults of the wiring with its libraries, and of ports. All others
come from reading the inputs, like the stored models.
"""

from __future__ import annotations

from robosmi.metamodels import migration
from robosmi.model import EmfModel
from robosmi.transformations.constraints.code_move import severity_by
from robosmi.transformations.constraints.electrical_plan import plan_faults, plan_rules
from robosmi.transformations.constraints.plan_ports import by_words, port_faults, ports
from robosmi.transformations.m2m.plan_tasks import plan_findings


def refresh_findings(plan: migration.MigrationPlan, words: bool = True) -> None:
    """Replace the findings of a plan that depend on its decisions, keeping their position in the list.

    Args:
        plan: the plan.
        words: also those that need the repository's words for kinds of components or its index of libraries; else these stay.
    """
    rules = plan_rules(words) | {
        constraint.id for module in ((ports, by_words) if words else (ports,)) for constraint in module.declared()
    }
    there = [(finding, str(finding.rule)) for finding in plan.findings]
    for finding, rule in there:
        if (weight := severity_by(plan, rule)) is not None:
            finding.severity = weight
    obsolete = [finding for finding, rule in there if rule in rules]
    kept = [rule in rules for _, rule in there]
    at = kept.index(True) if True in kept else len(kept)
    stored = {str(entry.path): str(entry.path) for entry in plan.inputs}
    model = EmfModel(plan, name="plan")
    new = plan_findings(plan, [*plan_faults(plan, model, words), *port_faults(plan, words, model)], stored)
    together = kept.count(True) == len(obsolete) and all(kept[at + number] for number in range(len(obsolete)))
    if together and [_says(finding) for finding in obsolete] == [_says(finding) for finding in new]:
        return  # among thousands of others, taking them out and putting them back takes long
    for finding in obsolete:
        plan.findings.remove(finding)
    for number, finding in enumerate(new):
        plan.findings.insert(at + number, finding)


def _says(finding: migration.PlanFinding) -> tuple[object, ...]:
    """The attributes that `plan_findings` sets on a finding."""
    about = [id(element) for element in finding.elements]
    return finding.rule, finding.severity, finding.message, finding.fix, finding.path, finding.line, finding.column, about
