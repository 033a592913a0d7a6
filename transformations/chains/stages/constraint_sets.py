"""Collects the constraints of a metamodel, built-in ones and those of every plug-in, into one module."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from robosmi.diagnostics import Finding
from robosmi.errors import RuleError
from robosmi.metamodels import hardware, migration
from robosmi.model import EmfModel
from robosmi.plugins import registry
from robosmi.query.rules.rule_language import place_of
from robosmi.transformations.constraints.finding_locations import in_file
from robosmi.validate import EVL

KIND: Final = "constraints"
"""The registry's kind for constraints: the name is a metamodel's, the value an `EVL`; all of one name are combined."""


def constraints_of(metamodel: str) -> EVL:
    """All constraints registered for a metamodel; an empty module if there are none.

    Args:
        metamodel: its name (`migration`).

    Raises:
        RuleError: a plug-in offers something else than an EVL, or an id that another constraint has.
        MissingToolError: a plug-in's module cannot be loaded.
    """
    return _together(registry().all(KIND, metamodel))


def added_findings(plan: migration.MigrationPlan) -> list[Finding]:
    """The findings of plug-ins' constraints on a plan and its models.

    Args:
        plan: the plan, with its findings so far.

    Raises:
        RuleError: a constraint raises, or a plug-in's constraints cannot be used.
    """
    code = [EmfModel(plan.program, name="code")] if plan.program is not None else []
    found = _added("ccode", *code) if code else []
    found += added_hardware_findings(plan.circuit) if plan.circuit is not None else []
    return found + (_added("migration", EmfModel(plan, name="plan"), *code) if _has_added("migration") else [])


def added_hardware_findings(circuit: hardware.Circuit) -> list[Finding]:
    """The findings of plug-ins' constraints on a drawing.

    Args:
        circuit: what is drawn.

    Raises:
        RuleError: a constraint raises, or a plug-in's constraints cannot be used.
    """
    found = _added("hardware", EmfModel(circuit, name="hardware")) if _has_added("hardware") else []
    return in_file(found, circuit.path)


def _added(metamodel: str, *models: EmfModel) -> list[Finding]:
    offered: list[tuple[EVL, str]] = registry().all(KIND, metamodel) if _has_added(metamodel) else []
    _refuse_faults(offered)
    built_in = {id(c) for made, owner in offered if not owner for c in made.declared()}
    found: list[Finding] = []
    for made, owner in offered:
        if ids := {c.id for c in made.declared() if owner and id(c) not in built_in}:
            found += [finding for finding in made.run(*models).findings() if finding.rule in ids]
    return found


def _has_added(metamodel: str) -> bool:
    return any(target in registry().providers for target in registry().targets(KIND, metamodel))


def _together(offered: Sequence[tuple[EVL, str]]) -> EVL:
    _refuse_faults(offered)
    together = EVL()
    for made, _ in offered:
        together.include(made)
    return together


def _refuse_faults(offered: Sequence[tuple[EVL, str]]) -> None:
    """Refuse an offer that is no EVL, or has the id of a built-in rule or of another constraint."""
    if not any(owner for _, owner in offered):
        return
    from robosmi.report.rules import built_in_rules  # few have plug-ins

    every: list[tuple[EVL, str]] = [each for name in registry().names(KIND) for each in registry().all(KIND, name)]
    taken = dict.fromkeys(built_in_rules(), "robosmi")
    known: set[int] = set()
    for made, owner in sorted(every, key=lambda each: each[1] != ""):  # what is built in comes first
        if not isinstance(made, EVL):
            raise RuleError(f"the constraints of {owner} are a {type(made).__name__}", fix="offer an EVL (robosmi.validate)")
        own = [c for c in made.declared() if id(c) not in known]
        if owner and (clash := next((c for c in own if c.id in taken), None)) is not None:
            other = "a built-in rule" if taken[clash.id] == "robosmi" else f"one of {taken[clash.id]}"
            raise RuleError(
                f"the id '{clash.id}' of the constraint {clash.name} of {owner} is taken by {other}",
                location=place_of(clash.check), fix="give it a unique id",
            )  # fmt: skip
        taken |= {c.id: owner or "robosmi" for c in own}
        known |= {id(c) for c in own}
