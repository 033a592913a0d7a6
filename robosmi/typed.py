"""What the standard library does, under signatures that keep the types of what goes in.

Anything that is more than a name for one call of the standard library does not belong here.
"""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterable
from typing import AnyStr, TypeVar

H = TypeVar("H", bound=Hashable)


def distinct(values: Iterable[H]) -> list[H]:
    """Each value once, in the order in which they come first.

    >>> distinct(["red", "green", "red"])
    ['red', 'green']
    """
    return list(dict.fromkeys(values))


def matches(pattern: re.Pattern[AnyStr] | AnyStr, text: AnyStr, flags: int = 0) -> list[AnyStr]:
    """What a pattern finds in a text, in order: what its group matched if it has one, the whole match if it has none.

    >>> matches(r"(\\w+)=", "red=1 green=2")
    ['red', 'green']
    """
    compiled = pattern if isinstance(pattern, re.Pattern) else re.compile(pattern, flags)
    if compiled.groups > 1:
        raise TypeError(f"the pattern {compiled.pattern!r} has several groups: ask finditer for what each of them matched")
    return compiled.findall(text)
