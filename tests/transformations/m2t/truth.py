"""Checks that a plan tells the whole truth: one verdict for each element, changes of text that do not cross."""

from __future__ import annotations

from collections import Counter
from itertools import combinations

from robosmi.metamodels import ccode, migration
from robosmi.transformations.queries.text_changes import all_changes


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
        if "main-loop" in disposition.rules and isinstance(disposition.element, ccode.Loop):
            body = disposition.element.body
            inner = body.statements if isinstance(body, ccode.Block) else [body] if body is not None else []
            wanted |= {id(s): s for s in inner}
        hoisted = disposition.action is migration.Action.hoist and "hoist-local-beside" not in disposition.rules
        if hoisted and disposition.element is not None:
            counts[id(disposition.element.eContainer())] += 1  # the declaration is judged by the first that moves out
    return [f"{type(e).__name__} in line {e.line}: {counts[key]} verdicts" for key, e in wanted.items() if counts[key] != 1]


def overlaps(plan: migration.MigrationPlan) -> list[str]:
    """Pairs of changes of one unit that overlap without one being within the other."""
    ordered = sorted(all_changes(plan), key=lambda c: (c.unit.path if c.unit else "", c.startOffset, -c.endOffset))
    return [
        f"{a.startOffset}-{a.endOffset} and {b.startOffset}-{b.endOffset}"
        for a, b in combinations(ordered, 2)
        if a.unit is b.unit and b.startOffset < a.endOffset < b.endOffset and a.startOffset < b.startOffset
    ]
