"""Names as EOL and as Python write them."""

from __future__ import annotations

import re
from functools import cache

_BEFORE_CAPITAL = re.compile(r"(?<!^)(?=[A-Z])")


@cache
def snake(name: str) -> str:
    """An EOL name in Python's way.

    >>> snake("atLeastNMatch"), snake("ftuc")
    ('at_least_n_match', 'ftuc')
    """
    return _BEFORE_CAPITAL.sub("_", name).lower().rstrip("_")
