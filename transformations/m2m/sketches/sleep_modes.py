"""Idle sleep of an AVR, which any interrupt ends and that of the core's clock after a millisecond at most, becomes such a wait.

A sketch that chooses a deeper mode sleeps until a pin wakes it, and stops its clock; its calls stay, and are places. Source:
ATmega328P data sheet DS40002061, section 10; wiring.c of ArduinoCore-avr (timer 0 overflows every 1.024 ms).
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.platforms.avr_bits import avr_bits
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.sketches.avr_calls import HEADERS, KIND
from robosmi.transformations.m2m.sketches.register_idioms import without
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit

_RULE = "idle-sleep"
_REASON = "idle sleep ends with the next interrupt, within a millisecond"
_WAIT = "delay(1);"


def sleep_modes(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of the calls, and of the header."""
    facts = avr_bits().sleep
    calls = [(view, call) for view in sketch.views for call in view.of_kind(ccode.Call) if call.calleeName in facts.calls]
    chosen = [call.arguments[0] for _, call in calls if call.calleeName == facts.select and call.arguments]
    idle = all(isinstance(mode, ccode.NameReference) and mode.name == facts.idle for mode in chosen)
    own_statements = all(isinstance(call.eContainer(), ccode.ExpressionStatement) for _, call in calls)
    if not calls or not idle or not own_statements or sketch.move.source.architecture == sketch.move.target.architecture:
        return
    for view, call in calls:
        text = _WAIT if call.calleeName in facts.sleeps else ""
        yield without(sketch, view, call, _RULE, _REASON, KIND, text)
    for view in sketch.views:
        for include in view.unit.includes:
            if include.header == facts.header:
                gone = (Replacement(int(include.startOffset), int(include.endOffset), ""),)
                yield SketchEdit(include, _RULE, "all that it is for is replaced", gone, HEADERS, (int(include.line),))
