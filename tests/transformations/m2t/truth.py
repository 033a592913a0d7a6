"""Checks the consistency of a plan: one verdict for each element, changes of text that do not cross, sums that add up."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from itertools import combinations
from typing import Any

from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2t.task_list import VERDICT_WORDS
from robosmi.transformations.queries.plans.verdicts import EFFORTS, VERDICTS, constructs
from robosmi.transformations.queries.plans.waiting_calls import CALL_STATES, NO_SUPPORT, TO_WRITE
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


def report_faults(plan: migration.MigrationPlan, said: Mapping[str, Any], report: str) -> list[str]:
    """The numbers of a plan, of its JSON and of its report that do not add up.

    Args:
        plan: the plan.
        said: the JSON of the contract's `plan`.
        report: the text of MIGRATION.md.
    """
    work, verdicts, rows = said["work"], said["verdicts"], said["constructs"]
    listed = re.findall(rf"^\| \d* \| `.*` \| ({'|'.join(VERDICT_WORDS.values())}) \| ", report, re.MULTILINE)
    words = Counter(VERDICT_WORDS[row["verdict"]] for row in rows)
    sums = {
        "dispositions": (len(plan.dispositions), sum(said["dispositions"].values()), verdicts["total"], len(rows), len(listed)),
        "constructs": (len({id(c.element) for c in constructs(plan)}), verdicts["total"]),
        "verdicts": (verdicts["total"], sum(verdicts[each] for each in VERDICTS)),
        "rows by verdict": (words, Counter(listed), Counter({VERDICT_WORDS[v]: verdicts[v] for v in VERDICTS if verdicts[v]})),
        "calls": (said["call_sites"]["total"], work["calls"]["total"], sum(work["calls"][state] for state in CALL_STATES)),
        "calls with a body": (
            said["call_sites"]["with_body"],
            sum(work["calls"][state] for state in CALL_STATES if state not in (TO_WRITE, NO_SUPPORT)),
        ),
        "choices": (said["open_choices"], work["decide"]["open"], len(work["decide"]["answers"])),
        "tasks": (len(plan.tasks), said["tasks"], work["decide"]["open"] + work["write"]["total"] + _unused(plan)),
        "efforts": (work["write"]["total"], sum(work["write"][effort] for effort in EFFORTS)),
        "checks": (work["check"]["total"], len(plan.checks) + _unused(plan), len(work["check"]["items"])),
        "ticks": (len(re.findall(r"^- \[[ x]\] ", report, re.MULTILINE)), len(plan.tasks) + len(plan.checks)),
        "works": (
            re.findall(r"^- \*\*Works\*\*: (\d+) of (\d+) calls", report, re.MULTILINE),
            [(str(work["calls"]["working"]), str(work["calls"]["total"]))] if work["calls"]["total"] else [],
        ),
    }  # fmt: skip
    return [f"{name}: {', '.join(map(str, numbers))}" for name, numbers in sums.items() if any(n != numbers[0] for n in numbers)]


def _unused(plan: migration.MigrationPlan) -> int:
    return sum(task.rule == "RS331" for task in plan.tasks)
