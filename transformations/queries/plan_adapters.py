"""Operations on the adapters that a plan refers to: what is emitted, in which order, and what it asks of the program."""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import migration, platform
from robosmi.typed import distinct


def closure(adapters: Iterable[platform.Adapter]) -> list[platform.Adapter]:
    """The pieces and all that they need, each once and behind what it needs."""
    found: dict[platform.Adapter, None] = {}

    def add(piece: platform.Adapter, above: tuple[platform.Adapter, ...]) -> None:
        if piece in found or piece in above:
            return
        for needed in piece.needs:
            add(needed, (*above, piece))
        found[piece] = None

    for adapter in adapters:
        add(adapter, ())
    return list(found)


def emitted(plan: migration.MigrationPlan) -> list[platform.Adapter]:
    """The pieces that a plan's program gets: of names, of functions, of its changed text, and what these need."""
    symbols = [use.adapter for use in plan.symbolUses]
    functions = [use.adapter for use in plan.adapterUses]
    return closure(piece for piece in (*symbols, *functions, *plan.helpers) if piece is not None)


def setup_statements(plan: migration.MigrationPlan) -> list[str]:
    """The statements that the pieces need at the start of the program, each once."""
    return distinct(str(statement) for piece in emitted(plan) for statement in piece.setup)


def rest_levels(plan: migration.MigrationPlan) -> list[migration.Connection]:
    """The connections whose pins get a level before all else, one for each pin."""
    return list({c.pin: c for c in reversed(list(plan.connections)) if c.restLevel and c.pin is not None}.values())[::-1]


def limits(use: migration.AdapterUse) -> list[str]:
    """What the adapter of a use, with all that it needs, does not do."""
    pieces = closure([use.adapter]) if use.adapter is not None else []
    return distinct(str(limit) for piece in reversed(pieces) for limit in piece.limits)
