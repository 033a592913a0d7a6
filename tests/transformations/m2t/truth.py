"""Checks that a plan tells the whole truth: one verdict for each element, edits that do not overlap."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

from robosmi.metamodels import ccode, migration


def verdict_faults(plan: migration.MigrationPlan) -> list[str]:
    """Elements without exactly one disposition: includes, macros, top declarations, statements of main and its loop."""
    counts = Counter(id(d.element) for d in plan.dispositions)
    wanted: dict[int, ccode.Located] = {}
    for unit in plan.program.units if plan.program else ():
        for element in (*unit.includes, *unit.macros, *unit.declarations):
            wanted[id(element)] = element
            if isinstance(element, ccode.Function) and element.name == "main" and element.body is not None:
                wanted |= {id(s): s for s in element.body.statements}
    for disposition in plan.dispositions:
        if disposition.rule == "main-loop" and isinstance(disposition.element, ccode.Loop):
            body = disposition.element.body
            inner = body.statements if isinstance(body, ccode.Block) else [body] if body is not None else []
            wanted |= {id(s): s for s in inner}
        if disposition.action is migration.Action.hoist and disposition.element is not None:
            counts[id(disposition.element.eContainer())] += 1  # the declaration is judged by the variable that moves out
    return [f"{type(e).__name__} in line {e.line}: {counts[key]} verdicts" for key, e in wanted.items() if counts[key] != 1]


def overlaps(plan: migration.MigrationPlan) -> list[str]:
    """Pairs of edits of one unit that overlap."""
    found = []
    for unit in plan.program.units if plan.program else ():
        edits = sorted((e for e in plan.edits if e.unit is unit), key=lambda e: (e.startOffset, e.endOffset))
        found += [
            f"{a.startOffset}-{a.endOffset} and {b.startOffset}-{b.endOffset}"
            for a, b in pairwise(edits)
            if b.startOffset < a.endOffset
        ]
    return found
