"""Changes of text in a plan: whose they are, and which of them count where several want the same place.

The changes are made when planning (`m2m.text_changes`) and applied by `source_text`.
"""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.metamodels import migration

CARRIED_OVER = frozenset({"own-macro", "own-function", "own-declaration", "main-once", "main-repeated"})
"""Rules whose elements are carried over as they are, but for the ports in them."""


def decision_of(change: migration.TextChange) -> migration.Decision | None:
    """The decision that a change belongs to, None for a person's own edit of the plan."""
    owner = change.eContainer()
    return owner if isinstance(owner, migration.Decision) else None


def all_changes(plan: migration.MigrationPlan) -> list[migration.TextChange]:
    """Every change of a plan, in the order that says which of two with the same range counts: edits of persons come first."""
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
    """The changes in text order without those that lie in what another one takes away; of equal ones the first counts.

    Of insertions at one place the first stand outside: what opens a parenthesis comes in the order given, what closes one
    (a text that begins with it) in the reverse order and before all others.
    """
    kept: list[migration.TextChange] = []
    order = sorted((_path(c), c.startOffset, -c.endOffset, number, c) for number, c in enumerate(changes))
    reach, unit = -1, ""
    inserted: list[migration.TextChange] = []
    for path, start, minus_end, _, change in order:
        if path != unit:
            reach, unit = -1, path
        if start == -minus_end:
            inserted.append(change)
        elif start >= reach:
            kept.append(change)
            reach = -minus_end
    closing = [c for c in inserted if c.replacement.startswith(")")]
    placed = [*reversed(closing), *(c for c in inserted if not c.replacement.startswith(")"))]
    placed.sort(key=lambda c: (_path(c), c.startOffset))
    return sorted([*kept, *_outside(placed, kept)], key=lambda c: (_path(c), c.startOffset, c.endOffset))


def _outside(inserted: list[migration.TextChange], kept: list[migration.TextChange]) -> list[migration.TextChange]:
    """Insertions that do not stand inside a range that is replaced; both in text order."""
    found: list[migration.TextChange] = []
    ranges = iter(kept)
    current = next(ranges, None)
    for change in inserted:
        place = (_path(change), change.startOffset)
        while current is not None and (_path(current), current.endOffset) <= place:
            current = next(ranges, None)
        inside = current is not None and current.unit is change.unit and current.startOffset < change.startOffset
        if not inside:
            found.append(change)
    return found


def _path(change: migration.TextChange) -> str:
    return str(change.unit.path) if change.unit is not None else ""
