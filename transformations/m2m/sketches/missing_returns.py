"""Functions that end without the value they promise get one, where the target's tools refuse them.

What such a call gives is undefined on every board, so that any value will do. A function that returns a reference is a place.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.query import all_contents
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit
from robosmi.transformations.queries.block_braces import inside, is_torn
from robosmi.transformations.queries.portability.analysed_program import PortabilityPlace

KIND = "missing_return"
_RULE = "missing-return"
_NOTHING = frozenset(["", "void"])
"""Types of functions that return no value."""


def missing_returns(sketch: MovedSketch) -> Iterator[SketchEdit | PortabilityPlace]:
    """The edits at the end of such functions, and the functions that get none."""
    if not sketch.facts.needs_return:
        return
    for view in sketch.views:
        by_macro = {int(use.startOffset) for use in view.unit.macroUses}  # `ISR(...)`: its type is not what the text says
        for function in view.of_kind(ccode.Function):
            body, kind = function.body, function.returnType
            spelling = str(kind.spelling).strip() if kind is not None else ""
            if (
                body is None
                or int(function.startOffset) in by_macro
                or spelling in _NOTHING
                or function.name == "main"
                or _is_constructor(function)
                or not _falls_through(body)
            ):
                continue
            if "&" in spelling or is_torn(body):
                yield sketch.place(KIND, function, str(function.name))
                continue
            data = sketch.sources[str(view.unit.path)]
            end = inside(data, body)[1]
            space = "" if data[end - 1 : end].isspace() else " "
            reason = f"'{function.name}' ends without a value, which the target's tools refuse"
            yield SketchEdit(function, _RULE, reason, (inserted(end, f"{space}return {{}}; "),))


def _is_constructor(function: ccode.Function) -> bool:
    """Whether a function has the name of its class; a template's constructor has a type in the model."""
    owner = function.eContainer()
    return isinstance(owner, ccode.Record) and str(function.name).partition("<")[0] == str(owner.name).partition("<")[0]


def _falls_through(statement: ccode.Statement | None) -> bool:
    """Whether the text behind a statement may be reached from it."""
    if isinstance(statement, ccode.Block):
        return all(map(_falls_through, statement.statements))
    if isinstance(statement, ccode.If):
        return _falls_through(statement.thenBranch) or _falls_through(statement.elseBranch)
    if isinstance(statement, ccode.Loop):
        return not statement.endless or _breaks(statement)
    if isinstance(statement, ccode.Switch):
        inner = statement.body
        parts = list(inner.statements) if isinstance(inner, ccode.Block) else [inner]
        has_default = any(isinstance(each, ccode.Default) for each in parts)
        return not has_default or _breaks(statement) or _falls_through(parts[-1])
    if isinstance(statement, (ccode.Case, ccode.Default, ccode.Label)):
        return _falls_through(statement.statement)
    return not isinstance(statement, (ccode.Return, ccode.Goto, ccode.Break, ccode.Continue, ccode.UnknownStatement))


def _breaks(outer: ccode.Statement) -> bool:
    """Whether a loop or a switch is left by a `break` of its own."""
    return any(isinstance(each, ccode.Break) and _left_by(each) is outer for each in all_contents(outer))


def _left_by(leaving: ccode.Break) -> object:
    around = leaving.eContainer()
    while around is not None and not isinstance(around, (ccode.Loop, ccode.Switch)):
        around = around.eContainer()
    return around
