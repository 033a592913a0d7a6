"""Conventional ports that a person bound and nothing uses on the target: encoders of a drive that is steered without them."""

from __future__ import annotations

from robosmi.metamodels import migration


def is_idle(plan: migration.MigrationPlan, binding: migration.PortBinding) -> bool:
    """Whether a port that a convention of the source has is bound, while all functions with it have adapters that use it not."""
    if binding.origin != "convention" or binding.conventionalPort is not None or binding.pin is None:
        return False
    functions = [use for use in plan.adapterUses if use.function is not None]
    users = [use for use in functions if use.function and any(c.pin == binding.sourcePin for c in use.function.conventions)]
    return all(use.adapter is not None for use in users)
