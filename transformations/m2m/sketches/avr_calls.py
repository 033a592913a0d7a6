"""Names of avr-libc get the functions that do the same on the target: waits, interrupts on and off, atomic blocks, the watchdog.

Idle sleep becomes a wait (data sheet DS40002061, section 10). A header goes when all that it is for is replaced. Each name is a
place of its own; one that has no counterpart stays a task.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.knowledge.platforms.avr_bits import avr_bits
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.sketches.register_idioms import without
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView

KIND, HEADERS = "avr_libc_call", "avr_include"
_RULE = "avr-libc"
_ATOMIC = "for (bool atomic = (noInterrupts(), true); atomic; interrupts(), atomic = false)"
"""A block without interrupts; it must end at its end."""
_WAIT = "_delay_ms"
_IDLE_RULE = "idle-sleep"
_IDLE_REASON = "idle sleep ends with the next interrupt, within a millisecond"
_IDLE_WAIT = "delay(1);"


def avr_calls(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of the names, and of the headers of units all of whose names have one."""
    facts = sketch.facts
    if not facts.calls:
        return
    for view in sketch.views:
        lines, cured = sketch.lines(KIND, view), set[int]()
        for use in view.unit.macroUses:
            made = _replaced(sketch, view, use) if int(use.line) in lines else None
            if made is not None:
                reason, changes = made
                cured.add(int(use.line))
                yield SketchEdit(use, _RULE, reason, changes, KIND, (int(use.line),))
        for call in view.of_kind(ccode.Call):
            changes = _called(sketch, view, call) if int(call.line) in lines and not call.viaMacro else ()
            if changes and int(call.line) not in cured:
                yield SketchEdit(call, _RULE, f"the target calls '{call.calleeName}' otherwise", changes, KIND, (int(call.line),))
        for include in view.unit.includes:
            there = facts.includes.get(str(include.header))
            if there is not None:
                start, end = int(include.startOffset), int(include.endOffset)
                text = f"#include <{there}>" if there else ""
                reason = f"the target has no <{include.header}>"
                yield SketchEdit(include, _RULE, reason, (Replacement(start, end, text),), HEADERS, (int(include.line),))


def _replaced(sketch: MovedSketch, view: CodeView, use: ccode.MacroUse) -> tuple[str, tuple[Replacement, ...]] | None:
    """Why and how a use of a macro changes; None if nothing takes its place."""
    name, text = str(use.name), str(use.text)
    start, end = int(use.startOffset), int(use.endOffset)
    data = sketch.sources[str(view.unit.path)]
    head = Replacement(start, start + len(name), "")
    if data[start : start + len(name)].decode("utf-8", "replace") != name:
        return None
    if (there := sketch.facts.calls.get(name)) is not None:
        return f"the target calls '{name}' otherwise", (head._replace(text=there),)
    argument = text[text.find("(") + 1 : text.rfind(")")].strip()
    if name == "ATOMIC_BLOCK" and _ends_at_its_end(view, use):
        return "interrupts are off in the block", (Replacement(start, end, _ATOMIC),)
    if sketch.facts.watchdog is not None:
        begins, feeds = sketch.facts.watchdog
        limit = avr_bits().watchdog.get(argument)
        if name == "wdt_enable" and limit is not None:
            return "the watchdog has the same limit", (Replacement(start, end, begins.replace("{ms}", str(limit))),)
        if name == "wdt_reset":
            return "the watchdog is fed", (Replacement(start, end, feeds),)
    return None


def _called(sketch: MovedSketch, view: CodeView, call: ccode.Call) -> tuple[Replacement, ...]:
    """How a call of a function changes: its name, and for a wait with a fraction its unit."""
    name, start, end = str(call.calleeName), int(call.startOffset), int(call.endOffset)
    if name == _WAIT and len(call.arguments) == 1:
        given = call.arguments[0]
        if isinstance(given, ccode.IntegerLiteral):
            return (Replacement(start, start + len(name), "delay"),)
        text = sketch.sources[str(view.unit.path)][int(given.startOffset) : int(given.endOffset)].decode("utf-8", "replace")
        return (Replacement(start, end, f"delayMicroseconds(1000.0 * ({text}))"),)
    there = sketch.facts.calls.get(name)
    return (Replacement(start, start + len(name), there),) if there is not None else ()


def _ends_at_its_end(view: CodeView, use: ccode.MacroUse) -> bool:
    """Whether nothing leaves an atomic block before its end, which would leave interrupts off."""
    block = next((each for each in view.of_kind(ccode.For) if int(each.startOffset) == int(use.startOffset)), None)
    leaving = (ccode.Return, ccode.Break, ccode.Continue, ccode.Goto)
    return block is not None and not any(isinstance(each, leaving) for each in all_contents(block))


def sleep_modes(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of idle sleep, which any interrupt ends and that of the core's clock after 1.024 ms at most; and of its header.

    A sketch that chooses a deeper mode sleeps until a pin wakes it, and stops its clock: its calls stay, and are places.
    """
    facts = avr_bits().sleep
    calls = [(view, call) for view in sketch.views for call in view.of_kind(ccode.Call) if call.calleeName in facts.calls]
    chosen = [call.arguments[0] for _, call in calls if call.calleeName == facts.select and call.arguments]
    idle = all(isinstance(mode, ccode.NameReference) and mode.name == facts.idle for mode in chosen)
    own_statements = all(isinstance(call.eContainer(), ccode.ExpressionStatement) for _, call in calls)
    if not calls or not idle or not own_statements or sketch.move.source.architecture == sketch.move.target.architecture:
        return
    for view, call in calls:
        text = _IDLE_WAIT if call.calleeName in facts.sleeps else ""
        yield without(sketch, view, call, _IDLE_RULE, _IDLE_REASON, KIND, text)
    for view in sketch.views:
        for include in view.unit.includes:
            if include.header == facts.header:
                gone = (Replacement(int(include.startOffset), int(include.endOffset), ""),)
                yield SketchEdit(include, _IDLE_RULE, "all that it is for is replaced", gone, HEADERS, (int(include.line),))
