"""Servos turn as far as on their own board: `attach(pin)` gets the pulse widths that it has there by default."""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit

KIND = "servo"


def servo_limits(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of the calls of `attach` with a pin alone; they cure the places of a unit if it has no call in a macro."""
    limits = sketch.facts.servo_limits
    if not limits:
        return
    low, high = limits
    calls = [(view, call) for view in sketch.views for call in view.of_kind(ccode.Call) if _attaches(call)]
    alone = [(view, call) for view, call in calls if len(call.arguments) == 1]
    if any(call.viaMacro for _, call in alone):
        return
    units = [view.unit for view, _ in alone]
    cured = {id(view.unit): tuple(sorted(sketch.lines(KIND, view))) for view in sketch.views}
    for number, (view, call) in enumerate(alone):
        yield SketchEdit(
            call, "servo-limits", f"the pulses of a servo are {low} to {high} microseconds on its own board",
            (inserted(int(call.endOffset) - 1, f", {low}, {high}"),), KIND,
            cured.pop(id(view.unit), ()) if view.unit not in units[:number] else (),
        )  # fmt: skip
    for view in sketch.views:  # units that only declare servos, and those whose servos have limits of their own
        if id(view.unit) in cured and (lines := cured[id(view.unit)]):
            yield SketchEdit(view.unit, "servo-limits", "its servos have their limits", (), KIND, lines)


def _attaches(call: ccode.Call) -> bool:
    callee = call.callee
    return str(call.calleeName) == "attach" and callee is not None and str(callee.header or "").startswith("Servo")
