"""Decides how code that a program starts on other cores runs on a target with one core: as coroutines.

A program that starts no such code, or only through functions without an adapter, has no such decision. The only changes of its
text are calls of `yield` in loops that would otherwise starve the others (`yielding`). Which loops have to yield, and how much
stack is needed, is computed by `queries.cooperation`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from robosmi.metamodels import ccode, migration
from robosmi.transformations.m2m.yielding import YIELD, yields
from robosmi.transformations.queries.code import CodeView, CogStart, cogs_of
from robosmi.transformations.queries.cooperation import (
    Waiting,
    gives_way,
    giving_way,
    main_loop,
    stack_bytes,
    starts_at_once,
)
from robosmi.transformations.queries.live_code import live_in
from robosmi.transformations.queries.main_function import Division
from robosmi.transformations.queries.plan_adapters import closure
from robosmi.transformations.queries.source_text import SourceText
from robosmi.transformations.queries.stack_depth import CORE_INTERRUPT, IDLE, interrupt_bytes, measured_stacks

SPARE = 1.25
"""Safety factor on the estimated stack size of a coroutine."""
_ENDS = re.compile(r"_end\b|stop\b|join\b|exit\b")


def concurrency(
    views: Sequence[CodeView],
    uses: Sequence[migration.AdapterUse],
    divisions: Sequence[Division],
    texts: Sequence[SourceText],
) -> migration.Concurrency | None:
    """The decision how code started on other cores runs; None if the program starts none that an adapter supports.

    Args:
        views: a view of each unit.
        uses: the adapters of the plan.
        divisions: how each main is divided.
        texts: the text of each unit.
    """
    filled = {str(use.name): closure([use.adapter]) for use in uses if use.adapter is not None}
    starts = [s for view in views for s in cogs_of(view) if any(p.name == YIELD for p in filled.get(s.via, ()))]
    if not starts:
        return None
    functions = _functions(views, starts)
    waiting = Waiting(giving_way(views, uses))
    stacks = measured_stacks(filled.items())
    handled = interrupt_bytes([p for pieces in filled.values() for p in pieces]) - CORE_INTERRUPT  # which is in IDLE
    needs = [(f, IDLE + stack_bytes(f, stacks)) for f in functions]
    most = max((need for _, need in needs), default=2 * IDLE)
    live = {id(each) for each in live_in([view.unit for view in views])}
    slots, why = starts_at_once([s.call for s in starts if id(s.call) in live], {name for name in filled if _ENDS.search(name)})
    made = migration.Concurrency(
        slots=slots,
        stackBytes=-int((-most * SPARE - handled) // 8) * 8,
        starts=[s.call for s in starts],
        functions=functions,
        choice="coroutines",
        chosenBy=migration.ChosenBy.rule,
        confidence=1.0,
        evidence=[
            *why,
            *(f"'{f.name}' is estimated to need {need} bytes of stack" for f, need in needs),
            *([f"interrupts of what the program uses take up to {handled} bytes of each stack"] if handled else []),
        ],
    )
    divided = {id(d.loop) for d in divisions if d.loop is not None}
    for view, text in zip(views, texts, strict=True):
        made.changes.extend(yields(view, text, waiting, divided))
    made.loopGivesWay = any(
        gives_way(each, waiting) for view in views if (each := main_loop(view)) is not None and id(each) in divided
    )
    return made


def _functions(views: Sequence[CodeView], starts: Sequence[CogStart]) -> list[ccode.Function]:
    """The program's functions that are started on other cores, without duplicates."""
    own = {str(d.name): d for v in views for d in v.unit.declarations if isinstance(d, ccode.Function) and d.definition}
    return [own[name] for name in dict.fromkeys(s.function for s in starts) if name in own]
