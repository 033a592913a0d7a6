"""`main` as the target's `setup` and `loop` (paper 4, RQ1: what stands outside the endless loop runs once, its body is repeated).

How main is divided is in the plan's dispositions: a loop with rule `main-loop` is the one that becomes `loop`; locals
with rule `hoist-local` become globals. Without such a loop the whole body stays in `setup`.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.generate.environment import render
from robosmi.generate.text import Part
from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.source_text import Piece, SourceText, reindent


def main_parts(plan: migration.MigrationPlan, source: SourceText, main: ccode.Function) -> Iterator[Part]:
    """The parts that take main's place: hoisted locals, `setup`, `loop`."""
    assert main.body is not None
    inside = [d for d in plan.dispositions if d.element is not None and _in_main(d.element, main)]
    loop = next((d.element for d in inside if d.rule == "main-loop"), None)
    for disposition in inside:
        if disposition.rule in ("hoist-local", "hoist-local-split"):
            yield from _hoisted(source, disposition)
    body = main.body
    statements = list(body.statements)
    start, end = _first_line(source, body.startOffset + 1), body.endOffset - 1
    if not isinstance(loop, ccode.Loop):
        yield from _function("setup", source, start, _last_line(source, end), statements, main)
        yield Part("\n", "generation", "blank", [main])
        yield Part(render("arduino/function.j2", name="loop", body=""), "generation", "loop", [main])
        return
    place = statements.index(loop)
    border = source.line_start(loop.startOffset)
    border = border if source.blank(border, loop.startOffset) else loop.startOffset
    yield from _function("setup", source, start, border, statements[:place], main)
    yield Part("\n", "generation", "blank", [main])
    inner = loop.body
    if isinstance(inner, ccode.Block):
        first = _first_line(source, inner.startOffset + 1)
        yield from _function("loop", source, first, _last_line(source, inner.endOffset - 1), list(inner.statements), loop)
    elif inner is None or isinstance(inner, ccode.EmptyStatement):
        yield from _function("loop", source, loop.endOffset, loop.endOffset, [], loop)
    else:
        last = source.data.find(b";", inner.endOffset - 1) + 1 or inner.endOffset
        yield from _function("loop", source, inner.startOffset, last, [inner], loop)


def _in_main(element: ccode.Located, main: ccode.Function) -> bool:
    return ancestor_of_kind(element, ccode.Function) is main


def _hoisted(source: SourceText, disposition: migration.Disposition) -> Iterator[Part]:
    """The declaration of a local that main's loop uses, at file scope."""
    variable = disposition.element
    assert isinstance(variable, ccode.Variable)
    end = source.line_end(variable.endOffset - 1)
    text = source.data[variable.startOffset : end].decode(source.unit.encoding or "utf-8", errors="replace").replace("\r\n", "\n").strip()
    if disposition.rule == "hoist-local-split" and variable.initializer is not None:
        head = source.data[variable.startOffset : variable.initializer.startOffset].decode(source.unit.encoding or "utf-8", errors="replace")
        text = head.rstrip().removesuffix("=").rstrip().removeprefix("const ") + ";"
    yield Part(text + "\n", "code", "hoisted local", [variable, disposition])
    yield Part("\n", "generation", "blank", [variable])


def _function(
    name: str, source: SourceText, start: int, end: int, statements: list[ccode.Statement], owner: ccode.Located
) -> Iterator[Part]:
    """`void name() { ... }` around copied text, one part for each run of lines."""
    yield Part(f"void {name}() {{\n", "generation", name, [owner])
    pieces = [p for p in source.pieces(start, end, statements) if p.text]
    texts = reindent([p.text if p.text.endswith("\n") else p.text + "\n" for p in pieces])
    if texts:
        texts[0], texts[-1] = texts[0].lstrip("\n"), texts[-1].rstrip("\n") + "\n"
    for piece, text in zip(pieces, texts, strict=True):
        if text.strip():
            yield Part(text if text.endswith("\n") else text + "\n", "code", "retained statement", _elements(piece))
        elif text:
            yield Part("\n", "code", "blank", [owner])
    yield Part("}\n", "generation", name, [owner])


def _elements(piece: Piece) -> list[object]:
    return [*piece.elements, *(e.decision for e in piece.edits if e.decision is not None)]


def _first_line(source: SourceText, offset: int) -> int:
    """Behind the rest of the line if that is blank."""
    end = source.line_end(offset)
    return end if source.blank(offset, end) else offset


def _last_line(source: SourceText, offset: int) -> int:
    """The start of the line if all before the offset on it is blank."""
    start = source.line_start(offset)
    return start if source.blank(start, offset) else offset
