"""Ports that the source uses by convention, that the user bound, and that no adapter uses, such as encoders of a drive."""

from __future__ import annotations

from robosmi.metamodels import migration


def is_idle(plan: migration.MigrationPlan, binding: migration.PortBinding) -> bool:
    """Whether a bound port of a source convention is used by no adapter, while every function of that convention has one."""
    if binding.origin != "convention" or binding.conventionalPort is not None or binding.pin is None:
        return False
    functions = [use for use in plan.adapterUses if use.function is not None]
    users = [use for use in functions if use.function and any(c.pin == binding.sourcePin for c in use.function.conventions)]
    return all(use.adapter is not None for use in users)
