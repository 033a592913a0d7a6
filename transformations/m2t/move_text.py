"""What changed when a program was moved on to another board, as texts for report, page and terminal."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from robosmi.metamodels import migration
from robosmi.transformations.queries.plans.plan import move_counts, open_choices

WORDS = {
    "kept": "kept", "proposed": "proposed", "decided": "decided by you", "open": "open", "lost": "your choice does not fit",
}  # fmt: skip
"""What became of a choice -> its words."""
_SHOWN = 5


class MoveText(Struct, frozen=True):
    """The change as texts.

    Attributes:
        board: title of the former board.
        total: the sum in words.
        waits: what has to be done about proposed pins; empty if nothing.
        rows: subject, before, after, what became of it with the reason; what needs attention first.
    """

    board: str
    total: str
    waits: str
    rows: Sequence[tuple[str, str, str, str]]


def move_text(plan: migration.MigrationPlan) -> MoveText | None:
    """The change since the plan for another board; None if there was none."""
    move = plan.move
    if move is None:
        return None
    counts, left = move_counts(move), len(open_choices(plan))
    parts = [(counts["kept"], "kept"), (counts["decided"], "decided anew"), (counts["proposed"], "proposed")]
    words = [f"{number} {word}" for number, word in parts if number] + [f"{left} open"] * bool(left)
    lost = counts["lost"]
    words += [f"{lost} of your choices do{'es' * (lost == 1)} not fit"] * bool(lost)
    order = {"lost": 0, "open": 1, "proposed": 2, "decided": 3, "kept": 4}
    changes = sorted(move.changes, key=lambda c: (order[c.kind.name], c.before == c.after))
    rows = [
        (
            str(c.subject), str(c.before) or "none yet", str(c.after) or "open",
            WORDS[c.kind.name] + (f": {c.why}" if c.why else ""),
        )
        for c in changes
    ]  # fmt: skip
    waits = "nobody has approved the proposed pins yet" if move.pinsProposed else ""
    return MoveText(str(move.board) or str(move.target), ", ".join(words) or "no choices", waits, rows)


def move_lines(plan: migration.MigrationPlan) -> list[str]:
    """The lines for a terminal: the sum, then what does not fit and what changed, the first ones of both."""
    text = move_text(plan)
    if text is None or plan.move is None:
        return []
    told = [f"{c.subject}: {c.why}" for c in plan.move.changes if c.kind is migration.ChangeKind.lost]
    told += [
        f"{c.subject}: {c.before} -> {c.after}"
        for c in plan.move.changes
        if c.kind is not migration.ChangeKind.lost and c.before and c.after and c.before != c.after
    ]
    more = [f"and {len(told) - _SHOWN} more"] if len(told) > _SHOWN else []
    return [f"from {text.board}: {text.total}", *(f"  {line}" for line in [*told[:_SHOWN], *more])]
