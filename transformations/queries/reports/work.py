"""The work that a plan leaves to the user, in the order in which it is done: decide, write, check on the bench; and what works.

The numbers of the report, of the terminal and of `--json` are those of this module. They add up, and tests hold them against the
plan.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from functools import cached_property
from typing import Any

from msgspec import Struct

from robosmi.base.data_text import Json
from robosmi.metamodels import migration, platform
from robosmi.query import Q, ancestor_of_kind
from robosmi.transformations.queries.plans.answers import answer
from robosmi.transformations.queries.plans.plan import decisions
from robosmi.transformations.queries.plans.verdicts import EFFORTS, constructs, unserved_headers, verdict_counts
from robosmi.transformations.queries.plans.waiting_calls import WITH_CARE, WORKS, CallStates
from robosmi.transformations.queries.reports.board_needs import board_needs

DECIDE = frozenset({"RS330", "RS401"})
"""Rules of tasks that ask for a choice."""
UNUSED = "RS331"
"""The rule of components that are drawn and not used, which are to be checked on the bench."""


class Group(Struct, frozen=True):
    """Tasks of one cause that are done together.

    Attributes:
        title: what they have in common, such as a header; empty for tasks that stand alone.
        reason: the cause, said once.
        tasks: the tasks.
    """

    title: str
    reason: str
    tasks: tuple[migration.PlanTask, ...]


class Work:
    """The work that a plan leaves to the user.

    Args:
        plan: the plan, complete.
        calls: the value of the property `calls`, if it is known already.
    """

    def __init__(self, plan: migration.MigrationPlan, calls: dict[str, int] | None = None) -> None:
        self.plan = plan
        self._calls = calls

    @cached_property
    def calls(self) -> dict[str, int]:
        """How many calls of platform functions are in each state of `waiting_calls`, and `total`."""
        return self._calls if self._calls is not None else CallStates(self.plan).counts()

    @cached_property
    def unread(self) -> int:
        """How many calls are in text that the parser could not read, whatever function they call."""
        return sum(len(unit.unresolved) for unit in self.plan.program.units) if self.plan.program is not None else 0

    @property
    def working(self) -> int:
        """How many calls work on the target as on the source, some of them with limits."""
        return self.calls[WORKS] + self.calls[WITH_CARE]

    @cached_property
    def decide(self) -> list[migration.PlanTask]:
        """The tasks that are open choices."""
        return [task for task in self.plan.tasks if task.rule in DECIDE]

    @cached_property
    def write(self) -> list[migration.PlanTask]:
        """The tasks for which something is to be written, the smallest effort first."""
        mine = [task for task in self.plan.tasks if task.rule not in DECIDE and task.rule != UNUSED]
        return sorted(mine, key=lambda task: EFFORTS.index(task.effort) if task.effort in EFFORTS else -1)

    @cached_property
    def check(self) -> list[migration.PlanTask]:
        """What is to be seen on the bench: the plan's checks, then what is drawn and not used."""
        return [*self.plan.checks, *(task for task in self.plan.tasks if task.rule == UNUSED)]

    def choices(self) -> tuple[Q[migration.Decision], Q[migration.Decision]]:
        """All choices of the user, and those of them that are open."""
        found = decisions(self.plan)
        return found, found.select(lambda d: d.open)

    def groups(self) -> list[Group]:
        """The tasks of `write` grouped by cause: by the header that the target cannot serve, all others in one group."""
        reasons = unserved_headers(self.plan)
        found: dict[str, list[migration.PlanTask]] = {}
        for task in self.write:
            header = _header(task) if task.effort == "large" else ""
            found.setdefault(header if header in reasons else "", []).append(task)
        return [Group(title, reasons.get(title, ""), tuple(tasks)) for title, tasks in found.items()]

    def to_json(self) -> dict[str, Any]:
        """The contract's `work`."""
        efforts = Counter(str(task.effort) for task in self.write)
        all_choices, left = self.choices()
        return {
            "calls": {**self.calls, "working": self.working},
            "unread_calls": self.unread,
            "decide": {
                "total": len(all_choices), "decided": len(all_choices) - len(left), "open": len(left),
                "answers": [_answer(self.plan, d) for d in left],
            },
            "write": {
                "total": len(self.write), "done": sum(task.done for task in self.write),
                **{effort: efforts[effort] for effort in EFFORTS},
            },
            "check": {
                "total": len(self.check), "done": sum(task.done for task in self.check),
                "items": [{"message": str(task.message), "done": bool(task.done)} for task in self.check],
            },
        }  # fmt: skip


def work_json(plan: migration.MigrationPlan, sources: Mapping[str, bytes]) -> dict[str, Json]:
    """The work as part of the contract's `plan`: `work`, `needs` (of the board), `verdicts` (counts) and `constructs[]`.

    Args:
        plan: the plan, complete.
        sources: path of a unit -> its bytes.
    """
    judged = constructs(plan, sources)
    return {
        "work": Work(plan).to_json(),
        "needs": board_needs(plan).to_json(),
        "verdicts": verdict_counts(judged),
        "constructs": [construct.to_json() for construct in judged],
    }


def _answer(plan: migration.MigrationPlan, decision: migration.Decision) -> dict[str, Json]:
    how = answer(plan, decision)
    return {
        "subject": how.subject, "flag": how.flag, "robosmi_toml": {"table": how.table, "line": how.line},
        "candidates": list(how.candidates),
    }  # fmt: skip


def _header(task: migration.PlanTask) -> str:
    """The header of the platform function or name that a task is about."""
    for element in task.elements:
        about = (
            element.function if isinstance(element, migration.AdapterUse)
            else element.symbol if isinstance(element, migration.SymbolUse)
            else None
        )  # fmt: skip
        header = ancestor_of_kind(about, platform.Header) if about is not None else None
        if header is not None:
            return str(header.name)
    return ""
