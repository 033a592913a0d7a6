"""An order of Python base classes for every class of a metamodel, where Ecore's order of supertypes has none.

Ecore lets a class inherit in any order, Python (C3) refuses orders that contradict each other. A class keeps Ecore's order
when it has a linearisation; where not, the class and its ancestors take one order that never contradicts itself: deepest
first, then by name. A class whose supertypes do not give that order names all its ancestors. Ecore's own order stays in
`eSuperTypes`.
"""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.model.ecore.ecore_description import Class
from robosmi.model.elements.ordering import post_order


def topological(classes: Sequence[Class]) -> tuple[list[Class], list[Class]]:
    """The classes and all their ancestors, supertypes first, and those that inherit from themselves."""
    cyclic: list[Class] = []
    ordered = list(post_order(classes, lambda cls: cls.supertypes, lambda circle: cyclic.append(circle[0])))
    return ordered, cyclic


def bases(classes: Sequence[Class]) -> dict[Class, list[Class]]:
    """Python's bases of each class, for classes without cycles and in an order with supertypes first.

    Args:
        classes: supertypes first, ancestors included (see `topological`).
    """
    depth: dict[Class, int] = {}
    ancestors: dict[Class, list[Class]] = {}  # in the order of last resort
    for cls in classes:
        depth[cls] = 1 + max((depth[base] for base in cls.supertypes), default=0)
        above = {each for base in cls.supertypes for each in (base, *ancestors[base])}
        ancestors[cls] = sorted(above, key=lambda each: (-depth[each], each.path))
    found: dict[Class, list[Class]] = {}
    orders: dict[Class, list[Class]] = {}
    sorted_ones: set[Class] = set()
    waiting = list(classes)
    while waiting:
        failed = None
        for cls in waiting:
            chosen = _sorted_bases(cls, ancestors[cls], orders) if cls in sorted_ones else _own_bases(cls, ancestors, orders)
            if chosen is None:
                failed = cls
                break
            found[cls], orders[cls] = chosen
        if failed is None:
            return found
        changed = {failed, *ancestors[failed]} - sorted_ones
        sorted_ones |= changed
        waiting = [cls for cls in classes if cls not in orders or cls in changed or not changed.isdisjoint(ancestors[cls])]
    return found


def _own_bases(
    cls: Class, ancestors: dict[Class, list[Class]], orders: dict[Class, list[Class]]
) -> tuple[list[Class], list[Class]] | None:
    """Ecore's supertypes in their order, else without those that another one inherits from."""
    own = list(cls.supertypes)
    above = {each for base in own for each in ancestors[base]}
    needed = [base for base in own if base not in above]
    for candidate in [own, needed] if len(needed) < len(own) else [own]:
        if (order := _merge(cls, candidate, orders)) is not None:
            return candidate, order
    return None


def _sorted_bases(cls: Class, ancestors: list[Class], orders: dict[Class, list[Class]]) -> tuple[list[Class], list[Class]]:
    """The supertypes if they give the sorted order, else all ancestors: where all orders are one, none contradicts another."""
    own = [base for base in ancestors if base in cls.supertypes]
    order = [cls, *ancestors]
    return (own if _merge(cls, own, orders) == order else ancestors), order


def _merge(cls: Class, own: list[Class], orders: dict[Class, list[Class]]) -> list[Class] | None:
    """Python's own merge (C3), or None where it fails."""
    lists = [list(reversed(orders[base])) for base in own] + [list(reversed(own))]  # the next one is the last: cheap to take
    result = [cls]
    while lists := [one for one in lists if one]:
        blocked = {c for one in lists for c in one[:-1]}
        head = next((one[-1] for one in lists if one[-1] not in blocked), None)
        if head is None:
            return None
        result.append(head)
        for one in lists:
            if one[-1] is head:
                one.pop()
    return result
