"""Findings of a stored plan that follow from its decisions, found anew when a decision was changed.

They are what `migrate` finds in a plan whose decisions are made: faults of the wiring with its libraries, and of ports. All other
findings are those of reading, which the stored models were made by.
"""

from __future__ import annotations

from robosmi.metamodels import migration
from robosmi.model import EmfModel
from robosmi.transformations.constraints.electrical_plan import plan_faults, plan_rules
from robosmi.transformations.constraints.plan_ports import by_words, port_faults, ports
from robosmi.transformations.m2m.plan_tasks import plan_findings
from robosmi.transformations.queries.waiting_calls import ports_of_runs_bound


def renew_findings(plan: migration.MigrationPlan, words: bool = True) -> None:
    """Bring the findings of a plan in line with its decisions, in the place where they stood.

    Args:
        plan: the plan.
        words: also those that need the repository's words for kinds of components; else these stay as they are.
    """
    rules = plan_rules() | {
        constraint.id for module in ((ports, by_words) if words else (ports,)) for constraint in module.declared()
    }
    before = [f for f in plan.findings if f.rule != "RS327" or not ports_of_runs_bound(plan)]
    at = next((number for number, finding in enumerate(before) if finding.rule in rules), len(before))
    stored = {str(entry.path): str(entry.path) for entry in plan.inputs}
    model = EmfModel(plan, name="plan")
    new = plan_findings(plan, [*plan_faults(plan, model), *port_faults(plan, words, model)], stored)
    kept = [[f for f in some if f.rule not in rules] for some in (before[:at], before[at:])]
    plan.findings.clear()
    plan.findings.extend([*kept[0], *new, *kept[1]])
