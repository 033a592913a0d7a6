"""Changes of text in a plan: which decision each belongs to, and which take effect where several overlap.

The changes are made when planning (`m2m.partition.text_changes`) and applied by `source_text`.
"""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import migration

CARRIED_OVER = frozenset({"own-macro", "own-function", "own-declaration", "main-once", "main-repeated"})
"""Rules whose elements are carried over unchanged except for their ports."""


def decision_of(change: migration.TextChange) -> migration.Decision | None:
    """The decision that a change belongs to, None for the user's own edit of the plan."""
    owner = change.eContainer()
    return owner if isinstance(owner, migration.Decision) else None


def all_changes(plan: migration.MigrationPlan) -> list[migration.TextChange]:
    """Every change of a plan in order of precedence among changes of the same range; persons' edits come first."""
    decisions: tuple[migration.Decision, ...] = (
        *plan.portBindings,
        *plan.portFlows,
        *plan.libraryChoices,
        *([plan.concurrency] if plan.concurrency is not None else []),
        *plan.dispositions,
        *(w for w in plan.widenings if w.choice != "keep"),
    )
    return [*plan.edits, *(change for decision in decisions for change in decision.changes)]


def effective(changes: Iterable[migration.TextChange]) -> list[migration.TextChange]:
    """The changes that take effect, in text order: not those within a range that another change replaces.

    Of changes with equal ranges the first wins. Of insertions at one place, those that begin with `)` come first in reverse
    order, then the others in the order given, so that earlier changes enclose later ones.
    """
    kept: list[_Placed] = []
    reach, unit = -1, ""
    inserted: list[_Placed] = []
    for placed in _in_order(changes):
        path, start, minus_end, _, _ = placed
        if path != unit:
            reach, unit = -1, path
        if start == -minus_end:
            inserted.append(placed)
        elif start >= reach:
            kept.append(placed)
            reach = -minus_end
    if inserted:
        closing = [each for each in inserted if each[4].replacement.startswith(")")]
        others = [each for each in inserted if not each[4].replacement.startswith(")")]
        kept += _outside(sorted([*reversed(closing), *others], key=lambda each: each[:2]), list(kept))
        kept.sort(key=lambda each: (each[0], each[1], -each[2]))
    return [change for *_, change in kept]


_Placed = tuple[str, int, int, int, migration.TextChange]
"""A sort key before its change: path of the unit, start, negated end, number in the order given."""


def _in_order(changes: Iterable[migration.TextChange]) -> list[_Placed]:
    """Changes in text order, the longest of those that begin at one place first, and of equal ones in the order given."""
    paths: dict[int, str] = {}
    found: list[_Placed] = []
    for number, change in enumerate(changes):
        unit = change.unit
        path = paths.get(id(unit))
        if path is None:
            path = paths[id(unit)] = str(unit.path) if unit is not None else ""
        found.append((path, change.startOffset, -change.endOffset, number, change))
    return sorted(found)


def _outside(inserted: list[_Placed], kept: list[_Placed]) -> list[_Placed]:
    """The insertions that do not lie inside a replaced range; both lists are in text order."""
    found: list[_Placed] = []
    ranges = iter(kept)
    current = next(ranges, None)
    for each in inserted:
        place = each[:2]
        while current is not None and (current[0], -current[2]) <= place:
            current = next(ranges, None)
        inside = current is not None and current[4].unit is each[4].unit and current[1] < each[1]
        if not inside:
            found.append(each)
    return found
