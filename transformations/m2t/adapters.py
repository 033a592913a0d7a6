"""Adapters as templates show them: one for each platform function that is called (paper 3.4).

An adapter keeps the function's signature, so that the calls of the retained code stay as they are (adapter pattern).
Bodies are placeholders with a TODO; what is left is in the task list.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from robosmi.metamodels import migration, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.adapter_signature import target_signature
from robosmi.transformations.queries.plan import beside_its_declaration, needs_own_types, target_of
from robosmi.transformations.queries.source_text import is_header


@dataclass(frozen=True)
class Adapter:
    """An adapter.

    Attributes:
        use: what of the plan it is.
        name: its name in the sketch.
        signature: the function's as it was.
        header: where that is declared, empty where nobody knows it.
        notes: comments.
        prefix: what stands before its signature.
        target_signature: its signature.
        parameters: the names of its parameters.
        result: what its placeholder gives back, empty for void.
    """

    use: migration.AdapterUse
    name: str
    signature: str
    header: str
    notes: list[str]
    prefix: str
    target_signature: str
    parameters: list[str]
    result: str


def adapters(plan: migration.MigrationPlan, uses: Iterable[migration.AdapterUse]) -> list[Adapter]:
    """Adapters of a plan as templates show them."""
    several = plan.program is not None and sum(not is_header(u) for u in plan.program.units) > 1
    prefix = "static inline " if target_of(plan).language == "C" else "inline " if several else ""
    return [_adapter(plan, use, prefix) for use in uses]


def _adapter(plan: migration.MigrationPlan, use: migration.AdapterUse, prefix: str) -> Adapter:
    header = ancestor_of_kind(use.function, platform.Header) if use.function else None
    return Adapter(
        use, use.targetName, use.signature, header.name if header else "", [*use.notes, *_pin_notes(plan, use)], prefix,
        target_signature(use), [p.name for p in use.parameters], use.result.emptyValue if use.result is not None else "",
    )  # fmt: skip


def made_apart(plan: migration.MigrationPlan) -> list[migration.AdapterUse]:
    """The adapters that are functions of their own; of others the body stands where the program declares them."""
    return [use for use in plan.adapterUses if not beside_its_declaration(use)]


def with_own_types(plan: migration.MigrationPlan) -> list[migration.AdapterUse]:
    """The adapters that can only stand behind the program's own types."""
    return [use for use in plan.adapterUses if needs_own_types(use)]


def _pin_notes(plan: migration.MigrationPlan, adapter: migration.AdapterUse) -> list[str]:
    """Which target pins the function's conventions mean, since no text of the program says so."""
    conventions = list(adapter.function.conventions) if adapter.function is not None else []
    return [
        f"{binding.name} ({binding.what}) is {binding.choice or 'not bound'}"
        for binding in plan.portBindings
        if binding.convention is not None and any(c is binding.convention for c in conventions)
    ]
