"""The three-way merge of lists whose items come once."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Sequence
from typing import TypeVar

T = TypeVar("T", bound=Hashable)


def merged_members(base: Collection[T], a: Collection[T], b: Collection[T]) -> set[T]:
    """What is in both lists, and what one of them added."""
    before, ones, others = set(base), set(a), set(b)
    return (ones & others) | (ones - before) | (others - before)


def replaced_twice(base: Collection[T], a: Collection[T], b: Collection[T]) -> bool:
    """Whether both lists lack an item of the base, and each has new ones that the other lacks."""
    before, ones, others = set(base), set(a), set(b)
    return bool(before - ones - others and ones - before - others and others - before - ones)


def merged_order(
    base: Sequence[T], a: Sequence[T], b: Sequence[T], members: Collection[T], prefer: int | None = None
) -> list[T] | None:
    """The members in the order of the list that changed the order.

    What only one list has comes after the item that it follows there, what `a` added before what `b` added.

    Args:
        base: what both were made from.
        a: the first list.
        b: the second.
        members: what the merged list has.
        prefer: whose order counts if both changed it, 1 for `a` and 2 for `b`; None for neither.

    Returns:
        The merged list; None if both changed the order, in different ways, and neither is preferred.
    """
    inside = members if isinstance(members, (set, frozenset, dict)) else set(members)
    here, there = ([each for each in items if each in inside] for items in (a, b))
    common = set(here) & set(there)
    known = set(base)
    ones, others = ([each for each in items if each in common] for items in (here, there))
    before = [each for each in base if each in common]
    if ones == others or [each for each in others if each in known] == before:
        order = ones
    elif [each for each in ones if each in known] == before:
        order = others
    elif prefer is None:
        return None
    else:
        order = ones if prefer == 1 else others
    following: dict[T | None, list[T]] = {}
    for items in (here, there):
        last: T | None = None
        for each in items:
            if each in common:
                last = each
            else:
                following.setdefault(last, []).append(each)
    found = list(following.get(None, ()))
    for each in order:
        found += [each, *following.get(each, ())]
    return found
