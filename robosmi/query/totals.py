"""What collections say of the numbers in them: sum, product, least and greatest. Other items are passed over.

Integers have 32 bits, and 64 as soon as a Long takes part, so a sum wraps around as the engine's does.
Source: IterableOperationContributor and NumberUtil of Epsilon.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterable, Iterator
from math import prod
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from robosmi.query.problems import OperandError
from robosmi.query.values import INT_MAX, INT_MIN, Long, as_string, is_number

if TYPE_CHECKING:
    from robosmi.query.values import Answer

T = TypeVar("T")
_NUMBERS = frozenset({int, float, Long})


class Totals(Generic[T]):
    """The operations on numbers; `Q` and its kinds inherit them."""

    __slots__ = ()
    _items: list[T]

    def _numbers(self) -> Iterator[Any]:
        return (x for x in self._items if is_number(x))

    def sum(self) -> Any:
        """The sum of the numbers, 0 when there is none; other items are skipped.

        A sum of Integers wraps around at 32 bits, as in the engine; Python's `sum(q)` is exact.
        """
        items: Any = self._items if {x.__class__ for x in self._items} <= _NUMBERS else list(self._numbers())
        return _fitting(builtins.sum(items), items)

    def product(self) -> Any:
        """The product of the numbers; other items are skipped. 0.0 when empty, as EOL has it; wraps around as `sum` does."""
        items = list(self._numbers())
        return _fitting(prod(items), items) if self._items else 0.0

    def min(self, default: Any = 0) -> Any:
        """The smallest number; the default, a number or None, when there is none."""
        return builtins.min(self._numbers(), default=_number(default))

    def max(self, default: Any = 0) -> Any:
        """The greatest number; the default, a number or None, when there is none."""
        return builtins.max(self._numbers(), default=_number(default))


def _number(value: Answer) -> Any:
    if value is not None and not is_number(value):
        raise OperandError(f"the default is a number, not {as_string(value)}")
    return value


def _fitting(value: Any, items: Iterable[Any]) -> Any:
    """An exact result as the engine holds it: Integers have 32 bits, and 64 as soon as a Long takes part."""
    if isinstance(value, float) or (
        INT_MIN <= value <= INT_MAX and value.__class__ is int and Long not in {x.__class__ for x in items}
    ):
        return value
    long = any(x.__class__ is Long or not INT_MIN <= x <= INT_MAX for x in items)
    return Long((value + 2**63) % 2**64 - 2**63) if long else (value + 2**31) % 2**32 - 2**31
