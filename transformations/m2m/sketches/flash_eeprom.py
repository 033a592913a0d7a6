"""Keeps what a sketch stores in its EEPROM on boards that have flash instead: begun in setup, committed where it is written.

The flash is erased with each commit, so that what a loop writes is committed behind the loop.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.replacements import inserted
from robosmi.transformations.m2m.sketches.sketch_edits import MovedSketch, SketchEdit, setup_start
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.source_text import SourceText

KIND = "eeprom"
_OBJECT, _HEADER = "EEPROM", "EEPROM.h"
_WRITES = frozenset(["write", "update", "put"])
_BEGINS = frozenset(["begin", "commit"])


def flash_eeprom(sketch: MovedSketch) -> Iterator[SketchEdit]:
    """The edits; none where a sketch begins its EEPROM itself, or uses the functions of avr-libc."""
    size = sketch.facts.eeprom_bytes
    uses = [(view, ref) for view in sketch.views for ref in view.of_kind(ccode.NameReference) if ref.name == _OBJECT]
    known = {line for view in sketch.views for line in sketch.lines(KIND, view)}
    if not size or not uses or not known or any(_method(ref) in _BEGINS for _, ref in uses):
        return
    start = setup_start(sketch.views, sketch.sources)
    if start is None:
        return
    view, setup, offset = start
    yield SketchEdit(
        setup, "eeprom-begin", "the data is kept in flash, and read from there first",
        (inserted(offset, f" {_OBJECT}.begin({size});"),),
    )  # fmt: skip
    if _HEADER not in view.includes:
        yield SketchEdit(setup, "eeprom-begin", f"setup begins {_OBJECT}", (inserted(0, f"#include <{_HEADER}>\n"),))
    done: set[tuple[int, int]] = set()
    for view in sketch.views:
        mine = [ref for own, ref in uses if own is view]
        ends = [(ref, end) for ref in mine if _writes(ref) and (end := _behind(ref, view, sketch)) is not None]
        for ref, end in ends:
            if (id(view.unit), end) not in done:
                done.add((id(view.unit), end))
                statement = ancestor_of_kind(ref, ccode.Statement)
                assert statement is not None
                reason = "what is written gets to the flash by it"
                yield SketchEdit(statement, "eeprom-commit", reason, (inserted(end, f" {_OBJECT}.commit();"),))
        if len(ends) == sum(map(_writes, mine)):
            lines = {int(ref.line) for ref in mine} | {int(i.line) for i in view.unit.includes if str(i.header) == _HEADER}
            cured = tuple(sorted(lines & sketch.lines(KIND, view)))
            yield SketchEdit(view.unit, "eeprom-commit", "its data is begun and committed", (), KIND, cured)


def _method(reference: ccode.NameReference) -> str:
    member = reference.eContainer()
    return str(member.name) if isinstance(member, ccode.Member) else ""


def _writes(reference: ccode.NameReference) -> bool:
    """Whether a use of the EEPROM changes it."""
    inner = reference.eContainer()
    if isinstance(inner, ccode.Member):
        return str(inner.name) in _WRITES
    if isinstance(inner, ccode.Index):
        outer = inner.eContainer()
        return (isinstance(outer, ccode.Assignment) and outer.left is inner) or (
            isinstance(outer, ccode.Unary) and str(outer.operator) in ("++", "--")
        )
    return False


def _behind(reference: ccode.NameReference, view: CodeView, sketch: MovedSketch) -> int | None:
    """Where to commit: behind the statement that writes, or behind the outermost loop around it; None if nothing fits there."""
    statement = ancestor_of_kind(reference, ccode.Statement)
    if statement is None:
        return None
    last: ccode.Statement = statement
    loop = ancestor_of_kind(statement, ccode.Loop)
    while loop is not None:
        if _is_endless(loop):
            break
        last, loop = loop, ancestor_of_kind(loop, ccode.Loop)
    if not isinstance(last.eContainer(), ccode.Block):  # the body of an `if` without braces
        return None
    return SourceText(view.unit, sketch.sources[str(view.unit.path)], ()).statement_end(last)


def _is_endless(loop: ccode.Loop) -> bool:
    condition = getattr(loop, "condition", None)
    return condition is None or (isinstance(condition, ccode.IntegerLiteral) and bool(condition.value))
