"""Decides how code that a program starts on other cores runs on a target with one core: as coroutines.

A program that starts no such code, or only through functions without an adapter, has no such decision. The only changes of its
text are calls of `yield` where it would otherwise starve the other coroutines: in loops, at backward jumps, in macros that are
loops. Which loops have to yield, and how much stack is needed, is computed by `queries.resources.cooperation`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.lexer import closing, tokens
from robosmi.transformations.queries.block_braces import inside
from robosmi.transformations.queries.code import CodeView, CogStart, cogs_of
from robosmi.transformations.queries.plans.plan_adapters import closure
from robosmi.transformations.queries.programs.live_code import live_in
from robosmi.transformations.queries.programs.main_function import Division
from robosmi.transformations.queries.resources.cooperation import (
    Waiting,
    gives_way,
    giving_way,
    loops_of,
    main_loop,
    stack_bytes,
    starts_at_once,
)
from robosmi.transformations.queries.resources.stack_depth import CORE_INTERRUPT, IDLE, interrupt_bytes, measured_stacks
from robosmi.transformations.queries.source_text import SourceText

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
            *(f"'{f.name}' needs about {need} bytes of stack" for f, need in needs),
            *([f"interrupts use up to {handled} bytes of each stack"] if handled else []),
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


# ---- calls of `yield`

GIVE_WAY = "give-way"
"""Rule of text changes: a loop yields to the other coroutines."""
YIELD = "yield"
"""The target's function that yields to the other coroutines, and the adapter piece that switches between them."""
REASON = "the others continue only when this loop waits"
_HEAD = re.compile(rb"[ \t]*#[ \t]*define[ \t]+\w+(?:\([^)]*\))?")


def yields(view: CodeView, text: SourceText, waiting: Waiting, divided: set[int]) -> Iterator[migration.TextChange]:
    """The changes that make those loops of a unit yield that may otherwise starve the other coroutines.

    Args:
        view: the unit.
        text: its text.
        waiting: which statements certainly wait, and so yield.
        divided: `id()` of loops that became functions, which are called repeatedly.
    """
    macros: dict[int, ccode.Macro] = {}
    for loop in loops_of(view):
        if id(loop) in divided or gives_way(loop, waiting):
            continue
        use = _use_around(loop, view)
        if use is None or _stands_behind(loop, use):
            yield from _in_loop(loop, text)
        elif use.macro is not None and use.macro in view.unit.macros:
            macros[id(use.macro)] = use.macro
    for macro in macros.values():
        yield from _in_macro(macro, text)
    for goto in view.of_kind(ccode.Goto):
        if _use_around(goto, view) is None and _goes_back(goto, view, waiting):
            start, end = int(goto.startOffset), text.statement_end(goto)
            yield from (_change(text, start, start, f"{{ {YIELD}(); "), _change(text, end, end, " }"))


def _use_around(element: ccode.Located, view: CodeView) -> ccode.MacroUse | None:
    """The macro use that an element begins in, so that its text is in the macro; None if it is in the unit's text."""
    uses = (use for use in view.unit.macroUses if use.startOffset <= element.startOffset < use.endOffset)
    return next(uses, None)


def _stands_behind(loop: ccode.Loop, use: ccode.MacroUse) -> bool:
    """Whether only the head of a loop comes from the macro and its body is in the text (`FOR_EVER { ... }`, `UNTIL(x);`)."""
    return loop.body is not None and loop.body.startOffset >= use.endOffset


def _goes_back(goto: ccode.Goto, view: CodeView, waiting: Waiting) -> bool:
    """Whether a goto jumps backwards over statements none of which certainly waits."""
    function = ancestor_of_kind(goto, ccode.Function)
    labels = (each for each in view.of_kind(ccode.Label) if each.name == goto.labelName)
    label = next((each for each in labels if ancestor_of_kind(each, ccode.Function) is function), None)
    if label is None or label.startOffset > goto.startOffset:
        return False
    block = ancestor_of_kind(label, ccode.Block)
    between = (
        (s for s in block.statements if label.startOffset <= s.startOffset and s.endOffset <= goto.startOffset) if block else ()
    )
    return not any(waiting.waits(s.statement if isinstance(s, ccode.Label) else s) for s in between)


def _in_loop(loop: ccode.Loop, text: SourceText) -> list[migration.TextChange]:
    """The shortest change that makes a loop yield in each iteration."""
    body = loop.body
    if isinstance(body, ccode.Block):
        start = inside(text.data, body)[0]
        return [_change(text, start, start, f" {YIELD}();")]
    if body is None or isinstance(body, ccode.EmptyStatement):
        end = text.data.find(b";", int(body.startOffset) if body is not None else int(loop.endOffset))
        return [_change(text, end, end + 1, f" {YIELD}();")] if end >= 0 else []
    start, end = int(body.startOffset), text.statement_end(body)
    return [_change(text, start, start, f"{{ {YIELD}(); "), _change(text, end, end, " }")]


def _in_macro(macro: ccode.Macro, text: SourceText) -> Iterator[migration.TextChange]:
    """The same for loops in a macro's definition: `while (x);`, `for (;;) { ... }`, `do { ... } while (x)`."""
    head = _HEAD.match(text.data, int(macro.startOffset), int(macro.endOffset))
    first = head.end() if head is not None else text.data.find(str(macro.name).encode(), int(macro.startOffset)) + len(macro.name)
    words = [t for t in tokens(text.data[first : macro.endOffset]) if t[0] != "comment" and t[3] != "\\"]
    opened: list[bool] = []  # of each brace that is open: whether it is the body of a do
    at, tail = 0, False
    while at < len(words):
        word = words[at][3]
        if word == "{":
            opened.append(at > 0 and words[at - 1][3] == "do")
            if opened[-1]:
                place = first + words[at][2]
                yield _change(text, place, place, f" {YIELD}();")
        elif word == "}":
            tail = bool(opened and opened.pop())
        elif word in ("while", "for") and not tail:
            close = closing(words, at + 1)
            if close == len(words):
                return
            following = words[close + 1] if close + 1 < len(words) else None
            if following is not None and following[3] in ("{", ";"):
                block = following[3] == "{"
                place = first + (following[2] if block else following[1])
                yield _change(text, place, place, f" {YIELD}()" + ";" * block)
        else:
            tail = False
        at += 1


def _change(text: SourceText, start: int, end: int, new: str) -> migration.TextChange:
    return migration.TextChange(
        unit=text.unit, startOffset=start, endOffset=end, replacement=new, rule=GIVE_WAY, reason=REASON, step=migration.Step.code
    )
