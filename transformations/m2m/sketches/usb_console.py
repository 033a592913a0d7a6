"""Lets a sketch whose console becomes USB wait for it, for a time: what it prints before a computer opens it would be lost.

A robot without a computer starts all the same, so a wait without end gets one.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit, setup_start
from robosmi.transformations.queries.source_text import SourceText

_CONSOLE = "Serial"


def usb_console(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edit behind the first statement that begins the console, or of the wait that the sketch has."""
    limit = sketch.facts.console_wait_ms
    if not limit:
        return
    waits = [loop for view in sketch.views for loop in view.of_kind(ccode.While) if _waits(loop)]
    for loop in waits:
        if loop.condition is not None:
            reason = f"without a computer it would wait for ever; it goes on after {limit} ms"
            yield SketchEdit(loop, "console-wait", reason, (inserted(int(loop.condition.endOffset), f" && millis() < {limit}"),))
    loops = (loop for view in sketch.views for loop in view.of_kind(ccode.While))
    bounded = any(isinstance(loop.condition, ccode.Binary) and _asks(loop.condition.left) for loop in loops)
    for view in sketch.views if not waits and not bounded else ():
        for call in view.of_kind(ccode.Call):
            callee = call.calleeExpression
            begins = (
                isinstance(callee, ccode.Member) and callee.name == "begin" and isinstance(callee.object, ccode.NameReference)
            )
            statement = ancestor_of_kind(call, ccode.Statement)
            if not begins or callee.object.name != _CONSOLE or not isinstance(statement, ccode.ExpressionStatement):  # type: ignore[union-attr]
                continue
            if _is_of_constructor(call):
                start = setup_start(sketch.views, sketch.sources)
                if start is not None:
                    _, setup, at = start
                    reason = "objects are made before the core opens its USB: what is printed there is lost"
                    text = f" while (!{_CONSOLE} && millis() < {limit}) {{}}"
                    yield SketchEdit(setup, "console-wait", reason, (inserted(at, text),))
                return
            if isinstance(statement.eContainer(), ccode.Block):
                end = SourceText(view.unit, sketch.sources[str(view.unit.path)], ()).statement_end(statement)
                text = f" while (!{_CONSOLE} && millis() < {limit}) {{}}"
                yield SketchEdit(
                    statement, "console-wait", "what is printed before a computer opens the console would be lost",
                    (inserted(end, text),),
                )  # fmt: skip
                return


def _is_of_constructor(call: ccode.Call) -> bool:
    """Whether a call is in a constructor, which runs before `setup` where its object is global."""
    function = ancestor_of_kind(call, ccode.Function)
    name = str(function.name).split("::") if function is not None else [""]
    owner = function.eContainer() if function is not None else None
    return name[-1] == (str(owner.name) if isinstance(owner, ccode.Record) else name[-2] if len(name) > 1 else "")


def _waits(loop: ccode.While) -> bool:
    """Whether a loop does nothing but wait for the console."""
    condition, body = loop.condition, loop.body
    empty = body is None or isinstance(body, ccode.EmptyStatement) or (isinstance(body, ccode.Block) and not body.statements)
    delays = isinstance(body, ccode.Block) and len(body.statements) == 1
    return (empty or delays) and _asks(condition)


def _asks(condition: ccode.Expression | None) -> bool:
    """Whether a condition is that the console is not open."""
    operand = condition.operand if isinstance(condition, ccode.Unary) and condition.operator == "!" else None
    if isinstance(operand, ccode.Member) and operand.name == "operator bool":
        operand = operand.object
    return isinstance(operand, ccode.NameReference) and operand.name == _CONSOLE
