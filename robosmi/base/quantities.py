"""Counts in texts that people read."""

from __future__ import annotations


def quantity(count: int, noun: str, plural: str | None = None) -> str:
    """A number with its noun: `1 pin`, `2 pins`.

    Args:
        count: how many.
        noun: what, in the singular.
        plural: the plural, if it is not the noun with an `s`.
    """
    return f"{count} {noun if count == 1 else plural or f'{noun}s'}"
