"""EOL's values in Python: which kind of collection a value is, when two are equal, how one is written as text.

Integer is int within 32 bits, Long is `Long` or a larger int, Real is float, String is str, Boolean is bool; a list or tuple
counts as a Sequence, a set as a Set, and a many-valued feature as what `ordered` and `unique` say. Two equalities, as in the
engine: `equal` is the operator `=`; `key` is what membership, sets and maps go by (there 2 is not 2.0). Not here: arithmetic.
Source: Kolovos et al., The Epsilon Object Language; EolObjectComparator and DefaultPrettyPrinter of Epsilon.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Sequence, Set as AbstractSet
from decimal import Decimal
from typing import TYPE_CHECKING, Any, TypeAlias, TypeGuard, TypeVar, cast

from robosmi.model.elements.ecore import ECollection, EEnumLiteral

if TYPE_CHECKING:
    from collections.abc import Mapping

    from robosmi.base.functions import Function
    from robosmi.model.elements.driver import Item, Model, Type

V = TypeVar("V")
W = TypeVar("W")
Answer: TypeAlias = "Item | Type | EolType | Model | Iterable[Answer] | Mapping[Answer, Answer]"
"""What an expression may give: an element, a plain value, a type, a model, or a collection or map of these."""
INT_MIN, INT_MAX = -(2**31), 2**31 - 1


class Long(int):
    """An integer of 64 bits, as `factorial` gives; equal to the same Integer but another member of a collection."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"Long({int(self)})"


class EolType:
    """A type of EOL's own.

    Args:
        name: as EOL writes it.
        exact: whether a value is of exactly this type (`isTypeOf`).
        kind: whether it is of this type or a subtype (`isKindOf`); the same as exact if None.
    """

    def __init__(self, name: str, exact: Function, kind: Function | None = None) -> None:
        self.name = name
        self.is_type = exact
        self.is_kind = kind or exact

    def __repr__(self) -> str:
        return self.name

    def __str__(self) -> str:
        return self.name


_KINDS: dict[type, str] = {
    list: "Sequence", tuple: "Sequence", range: "Sequence", set: "Set", frozenset: "Set", type({}.keys()): "Set",
    type({}.values()): "Bag", type({}.items()): "Set",
}  # fmt: skip


def is_number(value: V) -> TypeGuard[int | float]:
    """Whether the value is an EOL number; a Boolean is none.

    >>> is_number(2.5), is_number(True)
    (True, False)
    """
    return isinstance(value, (int, float)) and value.__class__ is not bool


def collection_kind(value: V) -> str | None:
    """Its kind: "Sequence", "Bag", "Set" or "OrderedSet", or None if the value is no collection; texts and maps are none.

    >>> collection_kind([1]), collection_kind({1}), collection_kind("ab")
    ('Sequence', 'Set', None)
    """
    cls = value.__class__
    kind = _KINDS.get(cls)
    if kind is None:
        kind = getattr(cls, "_eol_kind", None)
        if kind is None:
            if isinstance(value, ECollection):
                feature = value.feature
                return (
                    ("OrderedSet" if feature.unique else "Sequence") if feature.ordered else ("Set" if feature.unique else "Bag")
                )
            if isinstance(value, (list, tuple)):
                return "Sequence"
            if isinstance(value, AbstractSet):
                return "Set"
    return kind


def key(given: V) -> Hashable:
    """What membership compares: a hashable stand-in, the same for values that are equal in Java's sense.

    >>> key(1) == key(1.0), key(1) == key(True), key([1, 2]) == key((1, 2))
    (False, False, True)
    """
    value: Any = given
    cls = value.__class__
    if cls is str or value is None:
        return given
    if cls is int:
        return ("Integer" if INT_MIN <= value <= INT_MAX else "Long", value)
    if cls is float:
        return ("Real", value)
    if cls is bool:
        return ("Boolean", value)
    if cls is Long:
        return ("Long", int(value))
    kind = collection_kind(value)
    if kind is not None:
        if isinstance(value, ECollection):
            kind = "Sequence"  # EMF's lists are equal to Sequences, whatever their kind
        kind = getattr(cls, "_eol_equals", None) or kind
        keys = (key(x) for x in value)
        return (kind, frozenset(keys) if kind.endswith("Set") else tuple(keys))
    if isinstance(value, dict) or hasattr(cls, "_eol_map"):
        return (getattr(cls, "_eol_map", "Map"), frozenset((key(k), key(v)) for k, v in value.items()))
    try:
        hash(value)
    except TypeError:
        return ("id", id(value))
    return given


_NUMERIC = frozenset({int, float, bool, Long})


def unique(items: Iterable[V]) -> list[V]:
    """Each item once, in the order first seen, by `key`."""
    found = list(items)
    classes = {x.__class__ for x in found}
    if len(classes & _NUMERIC) < 2 and not any(compares_itself(cls) for cls in classes):
        try:
            return list(dict.fromkeys(found))  # the same answer, ten times faster
        except TypeError:
            pass
    seen: dict[Hashable, V] = {}
    for item in found:
        seen.setdefault(key(item), item)
    return list(seen.values())


def compares_itself(cls: type) -> bool:
    """Whether the class is one of collections or maps, which have an equality of their own."""
    own = cls in _KINDS or hasattr(cls, "_eol_kind") or hasattr(cls, "_eol_map")
    return own or issubclass(cls, (list, tuple, dict, AbstractSet, ECollection))


def position(items: Sequence[V], value: V) -> int:
    """The index of the first item that is the value in the sense of `key`, or -1."""
    cls = value.__class__
    if cls in _NUMERIC:
        return next((i for i, x in enumerate(items) if x.__class__ is cls and x == value), -1)
    if compares_itself(cls):
        searched = key(value)
        return next((i for i, x in enumerate(items) if key(x) == searched), -1)
    try:
        return items.index(value)
    except ValueError:
        return -1


def equal(left: V, right: W) -> bool:
    """EOL's `=`: numbers by value, Bags and Sets (OrderedSets too) without order, a Sequence never equals a Set.

    >>> equal(1, 1.0), equal(1, True), equal({1, 2}, {2, 1}), equal([1], {1})
    (True, False, True, False)
    """
    if left is right:
        return True
    if is_number(left) and is_number(right):
        return bool(left == right)
    kind = collection_kind(left)
    if kind == "Bag" and collection_kind(right) == "Bag":
        return Counter(_keys(left)) == Counter(_keys(right))
    return bool(key(left) == key(right))


def _keys(values: Any) -> Iterator[Hashable]:
    return (key(x) for x in values)


def as_string(given: V) -> str:
    """A value as EOL prints it: nothing for None, `true`, `1.0E10`, `Sequence {1, "a"}`.

    >>> as_string([1, "a", None, 2.5]), as_string(None), as_string(1e10)
    ('Sequence {1, "a", , 2.5}', '', '1.0E10')
    """
    value: Any = given
    cls = value.__class__
    if cls is str:
        return str(value)
    if value is None:
        return ""
    if cls is bool:
        return "true" if value else "false"
    if cls is float:
        return _real(value)
    if isinstance(value, int):
        return str(int(value))
    kind = collection_kind(value)
    if kind is not None:
        items = list(value)
        return f"{kind} {{{', '.join(_quoted(x) for x in items)}}}"
    if isinstance(value, dict) or hasattr(cls, "_eol_map"):
        entries = (f"{_quoted(k)}->{_quoted(v)}" for k, v in value.items())
        return f"{getattr(cls, '_eol_map', 'Map')} {{{', '.join(entries)}}}"
    if isinstance(value, EEnumLiteral):
        return str(value.literal or value.name)
    return str(value)


def _quoted(value: V) -> str:
    return f'"{value}"' if isinstance(value, str) else as_string(value)


def _real(value: float) -> str:
    """Java's Double.toString."""
    if math.isnan(value):
        return "NaN"
    if math.isinf(value):
        return "Infinity" if value > 0 else "-Infinity"
    if value == 0 or 1e-3 <= abs(value) < 1e7:
        return repr(value)
    sign, digits, exponent = Decimal(repr(value)).normalize().as_tuple()
    rest = "".join(str(digit) for digit in digits[1:]) or "0"
    return f"{'-' if sign else ''}{digits[0]}.{rest}E{len(digits) - 1 + int(exponent)}"


def flattened(items: list[Any]) -> list[Any] | None:
    """The items with all nested ones in their place, or None if nothing is nested; nothing recurses."""
    if not any(collection_kind(x) is not None for x in items):
        return None
    flat: list[Any] = []
    pending: list[Iterator[Any]] = [iter(items)]
    while pending:
        for x in pending[-1]:
            if collection_kind(x) is not None:
                pending.append(iter(cast(Iterable[Any], x)))
                break
            flat.append(x)
        else:
            pending.pop()
    return flat
