"""A change of text that the target's language wants: what the rules of `language_gap` and `old_c` give.

What a rule does to the text is in `edit_rules`; what becomes of it in the plan is `platform_dependence`'s.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from robosmi.metamodels import ccode
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType


class Change(NamedTuple):
    """A change of text that C++ wants.

    Attributes:
        element: what is changed.
        rule: the rule of `edit_rules` that changes it.
        text: what the rule puts in.
        reason: why, one sentence.
    """

    element: ccode.Located
    rule: str
    text: str
    reason: str


Rule = Callable[[CodeView, bytes, Mapping[str, FunctionType]], Iterator[Change]]
"""View of a unit, its bytes, what adapters take and give -> the changes."""
