"""An order of Python base classes for every class of a metamodel, where Ecore's order of supertypes has none.

Ecore lets a class inherit in any order, Python (C3) refuses orders that contradict each other. A class keeps Ecore's order
when it has a linearisation; where not, the class and its ancestors take one order that never contradicts itself: deepest
first, then by name. Ecore's own order stays in `eSuperTypes`.
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
    for cls in classes:
        depth[cls] = 1 + max((depth[base] for base in cls.supertypes), default=0)
    sorted_ones: set[Class] = set()
    while True:
        found: dict[Class, list[Class]] = {}
        orders: dict[Class, list[Class]] = {}
        failed = None
        for cls in classes:
            for candidate in _candidates(cls, cls in sorted_ones, depth):
                order = _merge(cls, candidate, orders)
                if order is not None:
                    found[cls], orders[cls] = candidate, order
                    break
            else:
                failed = cls
                break
        if failed is None:
            return found
        sorted_ones |= {failed, *failed.ancestors()}


def _candidates(cls: Class, canonical: bool, depth: dict[Class, int]) -> list[list[Class]]:
    own = list(cls.supertypes)
    if canonical:
        return [sorted(own, key=lambda base: (-depth[base], base.path))]
    above = {ancestor for base in own for ancestor in base.ancestors()}
    needed = [base for base in own if base not in above]
    return [own, needed] if len(needed) < len(own) else [own]


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
