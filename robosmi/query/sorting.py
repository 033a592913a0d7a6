"""The order that `sort_by` goes by.

Numbers are compared by value, texts with texts, Booleans with Booleans; as soon as a None, an element or a collection takes part
in a comparison, both sides are compared as texts. Source: SortByOperation of Epsilon. Nothing here is called by users.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cmp_to_key
from typing import TYPE_CHECKING, Any, TypeVar

from robosmi.query.problems import OperandError
from robosmi.query.values import Long, as_string, collection_kind, is_number

if TYPE_CHECKING:
    from robosmi.query.values import Answer

T = TypeVar("T")

_NUMBERS = frozenset({int, float, Long})
_UNORDERED: Any = vars(object)["__lt__"]


def sorted_by(items: list[T], body: Callable[[T], Any]) -> list[T]:
    """The items in the order of the body's values; the body is called once for each, in order.

    Raises:
        OperandError: two values have no order between them.
    """
    values: list[Any] = []
    note = values.append

    def keyed(x: T) -> Any:
        note(value := body(x))
        return value

    try:
        made: list[T] | None = sorted(items, key=keyed)  # moves the items without touching them, twice as fast as by their places
    except TypeError:
        if len(values) < len(items):
            raise  # of the body, not of a comparison
        made = None
    classes = {x.__class__ for x in values}
    if made is not None and (classes <= _NUMBERS or classes in ({str}, {bool})):
        return made
    by_value = cmp_to_key(_compare)
    order = sorted(range(len(items)), key=[by_value(v) for v in values].__getitem__)
    return [items[i] for i in order]


def _compare(left: Any, right: Any) -> int:
    if is_number(left) and is_number(right):
        return int(left > right) - int(left < right)
    if _comparable(left) and _comparable(right):
        if isinstance(left, bool) != isinstance(right, bool):  # Python has an order between them, EOL has none
            raise OperandError(f"sort_by: {left!r} and {right!r} have no order between them")
        try:
            return int(left > right) - int(left < right)
        except TypeError as error:
            raise OperandError(f"sort_by: {left!r} and {right!r} have no order between them") from error
    first, second = as_string(left), as_string(right)
    return (first > second) - (first < second)


def _comparable(value: Answer) -> bool:
    if isinstance(value, (str, bool)) or is_number(value):
        return True
    own: Any = getattr(value.__class__, "__lt__", None)  # dates and the like, and Python's tuples of keys
    return isinstance(value, tuple) or (collection_kind(value) is None and own is not _UNORDERED)
