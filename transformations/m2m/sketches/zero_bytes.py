"""Calls of `write(0)` name the byte that they send: where there is one for bytes and one for texts, 0 may be either."""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit


def zero_bytes(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits of the arguments that are a literal 0, or a macro for it."""
    objects = frozenset(sketch.facts.writes_bytes)
    if not objects:
        return
    zeros = {str(macro.name) for view in sketch.views for macro in view.unit.macros if _is_zero(str(macro.body or ""))}
    for view in sketch.views:
        for call in view.of_kind(ccode.Call):
            member = call.calleeExpression
            owner = member.object if isinstance(member, ccode.Member) else None
            of_port = isinstance(owner, ccode.NameReference) and owner.name in objects
            if call.calleeName != "write" or not of_port or call.viaMacro or len(call.arguments) != 1:
                continue
            given = call.arguments[0]
            literal = isinstance(given, ccode.IntegerLiteral) and not given.value
            if literal or (isinstance(given, ccode.NameReference) and given.name in zeros):
                reason = "0 is the byte here, and no text"
                yield SketchEdit(given, "zero-byte", reason, (inserted(int(given.startOffset), "(uint8_t)"),))


def _is_zero(body: str) -> bool:
    try:
        return not int(body.strip("() "), 0)
    except ValueError:
        return False
