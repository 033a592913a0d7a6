"""The change of text that the target's language needs at one element, as the rules of `language_gap` and `old_c` return it.

What a rule does to the text is in `m2m.partition.text_changes`; `m2m.partition.platform_dependence` enters the changes into the
plan.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from robosmi.metamodels import ccode
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType


class Change(NamedTuple):
    """A change of text that C++ needs.

    Attributes:
        element: the element that changes.
        rule: the rule of `text_changes` that changes it.
        text: the text that the rule inserts.
        reason: the reason, in one sentence.
    """

    element: ccode.Located
    rule: str
    text: str
    reason: str


Rule = Callable[[CodeView, bytes, Mapping[str, FunctionType]], Iterator[Change]]
"""A function from a unit's view, its bytes and the types of the adapters' functions to the changes it finds."""
