"""What the standard library does, under signatures that keep the types of what goes in.

Anything that is more than a name for one call of the standard library does not belong here.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import TypeVar

H = TypeVar("H", bound=Hashable)


def distinct(values: Iterable[H]) -> list[H]:
    """Each value once, in the order in which they come first.

    >>> distinct(["red", "green", "red"])
    ['red', 'green']
    """
    return list(dict.fromkeys(values))
