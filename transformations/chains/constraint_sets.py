"""The constraints of a metamodel: the built-in ones and those of every plug-in, as one module.

What they check is theirs; which models are checked is `check`'s and `migrate`'s business.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.diagnostics import Finding
from robosmi.errors import RuleError
from robosmi.metamodels import migration
from robosmi.model import EmfModel
from robosmi.plugins import registry
from robosmi.typed import class_name
from robosmi.validate import EVL

KIND = "constraints"
"""The registry's kind of constraints; the name is a metamodel's, the value an `EVL`. All of one name add up."""


def constraints_of(metamodel: str) -> EVL:
    """All constraints that are registered for a metamodel; none are an empty module.

    Args:
        metamodel: its name (`migration`).

    Raises:
        RuleError: a plug-in offers something else than an EVL, or an id that another constraint has.
        MissingToolError: a plug-in's module cannot be loaded.
    """
    return _together(registry().all(KIND, metamodel))


def added_findings(plan: migration.MigrationPlan) -> list[Finding]:
    """What the constraints of plug-ins find in a plan and its models; nothing where no plug-in has any.

    Args:
        plan: the plan, with its findings so far.

    Raises:
        RuleError: a constraint raises, or a plug-in's constraints cannot be used.
    """
    found: list[Finding] = []
    for name, root in (("ccode", plan.program), ("hardware", plan.circuit), ("migration", plan)):
        offered: list[tuple[EVL, str]] = registry().all(KIND, name) if _has_added(name) else []
        if root is None or not offered:
            continue
        built_in = {id(c) for made, owner in offered if not owner for c in made.declared()}
        known = [EmfModel(root, name={"ccode": "code", "migration": "plan"}.get(name, name))]
        if name == "migration" and plan.program is not None:
            known.append(EmfModel(plan.program, name="code"))
        _together(offered)  # refuses ids that are taken
        for made, owner in offered:
            ids = {c.id for c in made.declared() if owner and id(c) not in built_in}
            if ids:
                found += [finding for finding in made.run(*known).findings() if finding.rule in ids]
    return found


def _has_added(metamodel: str) -> bool:
    return any(target in registry().providers for target in registry().targets(KIND, metamodel))


def _together(offered: Sequence[tuple[EVL, str]]) -> EVL:
    together = EVL()
    owners: dict[str, str] = {}
    known: set[int] = set()
    if any(owner for _, owner in offered):
        every: list[tuple[EVL, str]] = [each for name in registry().names(KIND) for each in registry().all(KIND, name)]
        built_in = [made for made, owner in every if not owner]
        owners = {c.id: "robosmi" for made in built_in for c in made.declared()}
        known = {id(c) for made in built_in for c in made.declared()}
    for made, owner in offered:
        if owner and not isinstance(made, EVL):
            raise RuleError(f"the constraints of {owner} are a {class_name(made)}", fix="offer an EVL (robosmi.validate)")
        own = [c for c in made.declared() if owner and id(c) not in known]
        if (taken := next((c for c in own if c.id in owners), None)) is not None:
            raise RuleError(
                f"the id '{taken.id}' of a constraint of {owner} is taken by one of {owners[taken.id]}",
                fix="give it an id of your own",
            )
        owners |= {c.id: owner for c in own}
        known |= {id(c) for c in own}
        together.include(made)
    return together
