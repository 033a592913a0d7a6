"""What is left of register idioms when their pins are bound: functions of interrupts, and statements without a purpose there.

Pin change interrupts become functions that `attachInterrupt` calls; the statements that prepare a conversion, or wait for it,
go, since `analogRead` does both. The pins themselves are changed with their bindings (`m2m.ports.port_texts`).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import Replacement, inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.ports.register_idioms import change_handler, converter_reads, pin_changes
from robosmi.transformations.queries.ports.timer_outputs import TimerOutputs, timer_outputs

_REST = re.compile(rb"[ \t]*;")
_RULE, _TIMER = "register-idiom", "timer_register"


def register_idioms(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of functions and statements."""
    if sketch.move.source.architecture == sketch.move.target.architecture:
        return
    done = set[int]()
    for each in pin_changes(sketch.views):
        use = next((u for u in each.view.unit.macroUses if int(u.startOffset) == int(each.handler.startOffset)), None)
        if use is None:
            continue
        text = f"void {change_handler(each.handler)}()"
        changed = (Replacement(int(use.startOffset), int(use.endOffset), text),)
        reason = "a change of its pins calls it"
        yield SketchEdit(each.handler, _RULE, reason, changed, "isr_vector", (int(use.line),))
        for view, statement in each.enables:
            if id(statement) not in done:
                done.add(id(statement))
                yield without(sketch, view, statement, _RULE, "attachInterrupt enables the interrupt", "other_register")
    converted = converter_reads(sketch.views)
    for view, place in converted.rest if converted is not None else ():
        yield without(sketch, view, place, _RULE, "analogRead converts, and waits for it", "adc_register")
    for timer in timer_outputs(sketch.views) if sketch.facts.pwm_frequency else ():
        yield from _timer_rest(sketch, timer)


def _timer_rest(sketch: MovedSketch, timer: TimerOutputs) -> Iterator[SketchEdit]:
    """What is left of a timer that drives pins: its settings go, and its servos get objects."""
    by_servo = "a servo object makes the pulses"
    reason = by_servo if timer.servos else f"analogWrite drives the pins of {timer.timer}"
    for view, statement in (*timer.settings, *timer.begun):
        if timer.attaches is None or statement is not timer.attaches.element:
            yield without(sketch, view, statement, _RULE, reason, _TIMER)
    for each in (*timer.writes, *([timer.attaches] if timer.attaches is not None else [])):
        yield SketchEdit(each.element, _RULE, reason, (), _TIMER, (int(each.element.line),))
    if timer.attaches is not None:
        text = "#include <Servo.h>\n" + "".join(f"Servo {name};\n" for name in timer.servos)
        yield SketchEdit(timer.attaches.element, _RULE, by_servo, (inserted(0, text),))


def without(
    sketch: MovedSketch, view: CodeView, element: ccode.Located, rule: str, reason: str, kind: str, text: str = ""
) -> SketchEdit:
    """The edit that removes a statement, with its line if nothing else is on it, or puts a text in its place."""
    data = sketch.sources[str(view.unit.path)]
    start, end = int(element.startOffset), int(element.endOffset)
    if not data[start:end].endswith(b";") and (rest := _REST.match(data, end)) is not None:
        end = rest.end()
    begun = data.rfind(b"\n", 0, start) + 1
    if not text and not data[begun:start].strip():
        start = begun
    return SketchEdit(element, rule, reason, (Replacement(start, end, text),), kind, (int(element.line),))
