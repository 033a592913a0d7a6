"""`main` as the target's `setup` and `loop` (paper 5.3, RQ1: what is outside the endless loop runs once, its body is repeated).

The plan's dispositions say how main is divided: the loop with the rule `main-loop` becomes `loop`, and hoisted locals are put
above. Without such a loop the whole body stays in `setup`. Comments between the parts stay with the part that follows, those
after the loop come last.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.query import ancestor_of_kind
from robosmi.quoting import c_comment
from robosmi.transformations.queries.block_braces import inside
from robosmi.transformations.queries.expression_type import of_use
from robosmi.transformations.queries.plans.plan import RUN_IN_SETUP
from robosmi.transformations.queries.plans.plan_adapters import rest_levels, setup_statements
from robosmi.transformations.queries.source_text import Piece, SourceText, reindent
from robosmi.transformations.queries.text_changes import decision_of

if TYPE_CHECKING:
    from robosmi.model.elements.driver import Item


class MainPart(Struct, frozen=True):
    """A piece of carried-over text and what it comes from.

    Attributes:
        text: whole lines, each ending in a line feed.
        step: the step of the method that made it (code, hardware, generation).
        rule: which part of the generated text it is.
        elements: the model elements it comes from.
    """

    text: str
    step: str
    rule: str
    elements: Sequence[Item]


def hoisted_parts(plan: migration.MigrationPlan, source: SourceText, main: ccode.Function) -> Iterator[MainPart]:
    """The locals that move out of main to file scope."""
    hoisted = _hoists(plan, main)
    parameters = _parameters(main) if _loop(plan, main) is not None else []
    for line in parameters:
        yield MainPart(line, "generation", "parameter of main", [main])
    for disposition in hoisted:
        assert disposition.hoisted is not None
        text = source.copied(disposition.hoisted, disposition)
        yield MainPart(text + "\n", "code", "hoisted local", [disposition.element, disposition])
    if hoisted or parameters:
        yield MainPart("\n", "generation", "blank", [main])


def _loop(plan: migration.MigrationPlan, main: ccode.Function) -> ccode.Loop | None:
    """The loop of main that becomes `loop`, None if there is none."""
    found = next((d.element for d in plan.dispositions if "main-loop" in d.rules and _is_inside(d, main)), None)
    return found if isinstance(found, ccode.Loop) else None


def _inside(plan: migration.MigrationPlan, main: ccode.Function) -> list[migration.Disposition]:
    return [d for d in plan.dispositions if _is_inside(d, main)]


def _is_inside(disposition: migration.Disposition, main: ccode.Function) -> bool:
    element = disposition.element
    return element is not None and ancestor_of_kind(element, ccode.Function) is main


def _hoists(plan: migration.MigrationPlan, main: ccode.Function) -> list[migration.Disposition]:
    hoisted = (d for d in plan.dispositions if d.hoisted is not None and _is_inside(d, main))
    return sorted(hoisted, key=lambda d: d.element.startOffset if d.element is not None else 0)


def heading(source: SourceText, main: ccode.Function) -> int:
    """Offset of the first of the comments directly above main, which belong to it; main's own offset if there are none."""
    position = int(main.startOffset)
    for comment in reversed(source.comments_in(0, position)):
        gap = source.data[comment.endOffset : position]
        if gap.strip() or gap.count(b"\n") > 1 or not source.blank(source.line_start(comment.startOffset), comment.startOffset):
            break
        position = source.line_start(comment.startOffset)
    return position


def main_parts(plan: migration.MigrationPlan, source: SourceText, main: ccode.Function) -> Iterator[MainPart]:
    """The functions that replace main: `setup`, `loop`, and those for what follows the loop."""
    assert main.body is not None
    hoisted = _hoists(plan, main)
    loop = _loop(plan, main)
    cuts = [(c.startOffset, c.endOffset) for d in hoisted if d.hoisted is not None for c in d.changes if _whole(c, d.hoisted)]
    body = main.body
    statements = list(body.statements)
    start, end = inside(source.data, body)
    start = _first_line(source, start)
    yield from _comments(source, main.startOffset, body.startOffset, main)
    if loop is None:
        ahead = [f"  {line}" for line in (*_setup(plan), *_parameters(main))]
        yield from _function("setup", source, start, _last_line(source, end), statements, main, cuts, ahead)
        yield MainPart("\n", "generation", "blank", [main])
        yield MainPart(f"void loop() {{\n{_GIVES_WAY if plan.concurrency is not None else ''}}}\n", "generation", "loop", [main])
        return
    after, ends = _ends(plan, main)
    for name in (*([after] if after else []), *ends):
        yield MainPart(f"void {name}();\n", "generation", "end of main", [main])
    if after or ends:
        yield MainPart("\n", "generation", "blank", [main])
    place = statements.index(loop)
    border = source.line_start(loop.startOffset)
    border = border if source.blank(border, loop.startOffset) else loop.startOffset
    yield from _function("setup", source, start, border, statements[:place], main, cuts, [f"  {line}" for line in _setup(plan)])
    yield MainPart("\n", "generation", "blank", [main])
    inner = loop.body
    shared = plan.concurrency
    lines = [_GIVES_WAY] if shared is not None and not shared.loopGivesWay else []
    if isinstance(inner, ccode.Block):
        yield from _comments(source, loop.startOffset, inner.startOffset, loop)
        first, behind = inside(source.data, inner)
        behind = _last_line(source, behind)
        yield from _function("loop", source, _first_line(source, first), behind, list(inner.statements), loop, first=lines)
        last = inner.endOffset
    elif inner is None or isinstance(inner, ccode.EmptyStatement):
        yield from _function("loop", source, loop.endOffset, loop.endOffset, [], loop, first=lines)
        last = loop.startOffset
    else:
        yield from _comments(source, loop.startOffset, inner.startOffset, loop)
        last = source.statement_end(inner)
        yield from _function("loop", source, inner.startOffset, last, [inner], loop, first=lines)
    if after:
        following = list(statements[place + 1 :])
        yield MainPart("\n", "generation", "blank", [main])
        left = bool(following) and isinstance(following[-1], ccode.Return)
        tail = [] if left else [f"  {ends[0]}();\n" if ends else _STAYS]
        last = _first_line(source, source.statement_end(loop))
        yield from _function(after, source, last, _last_line(source, end), following, main, tail=tail)
    else:
        yield from _comments(source, last, body.endOffset, main)
    for name in ends:
        text = f"\n// main has ended: nothing is repeated any more\nvoid {name}() {{\n{_STAYS}}}\n"
        yield MainPart(text, "generation", "end of main", [main])


_GIVES_WAY = "  yield();  // the others get on\n"
_STAYS = "  for (;;) yield();\n"


def _ends(plan: migration.MigrationPlan, main: ccode.Function) -> tuple[str, list[str]]:
    """The name of the function for the code after the loop (empty if there is none), and those for the end of main."""
    inside = _inside(plan, main)
    after = next((str(d.runsIn) for d in inside if d.runsIn), "")
    return after, sorted({str(d.goesOnIn) for d in inside if d.goesOnIn} - {after})


def _comments(source: SourceText, start: int, end: int, owner: ccode.Located) -> Iterator[MainPart]:
    """The comments of a range that is otherwise dropped, each on a line of its own."""
    for comment in source.comments_in(start, end):
        text = source.slice(comment.startOffset, comment.endOffset)[0].strip()
        yield MainPart(text + "\n", "code", "retained comment", [comment, owner])


def _setup(plan: migration.MigrationPlan) -> list[str]:
    """The first statements of `setup`: rest levels of pins (level before direction: nothing moves), then adapters'.

    A high level that the core may lose is written once more.
    """
    levels, loses = [], plan.target is not None and bool(plan.target.losesLevel)
    for connection in rest_levels(plan):
        write = f"digitalWrite({connection.name}, {connection.restLevel.upper()});"
        levels.append(f"{write}  // {_idle(connection)}\n")
        levels.append(f"pinMode({connection.name}, OUTPUT);\n")
        if loses and connection.restLevel == "high":
            levels.append(f"{write}\n")
    return [*levels, *(f"{statement}\n" for statement in setup_statements(plan)), *_early_calls(plan)]


def _early_calls(plan: migration.MigrationPlan) -> list[str]:
    """Calls of the functions that run before main on the source, in text order."""
    early = (d.element for d in plan.dispositions if RUN_IN_SETUP in d.rules)
    found = sorted((f for f in early if isinstance(f, ccode.Function)), key=lambda f: int(f.startOffset))
    return [f"{name}();  // it runs before main\n" for name in dict.fromkeys(str(f.name) for f in found)]


def _idle(connection: migration.Connection) -> str:
    title = connection.component.title if connection.component is not None else connection.name
    return c_comment(f"{title} does nothing yet")


def _parameters(main: ccode.Function) -> list[str]:
    """Declarations of main's parameters as variables with the value 0, since the target passes none."""
    kinds = [(p.name, of_use(p.valueType)) for p in main.parameters if p.references]
    return [
        f"{kind.spelling}{'' if kind.spelling.endswith('*') else ' '}{name} = 0;\n" for name, kind in kinds if kind is not None
    ]


def _whole(change: migration.TextChange, copy: migration.TextCopy) -> bool:
    """Whether a change removes all of a copied text from main, so that nothing of it remains there."""
    return change.startOffset <= copy.startOffset and copy.endOffset <= change.endOffset


def _start(statement: ccode.Statement) -> int:
    return int(statement.startOffset)


def _function(
    name: str,
    source: SourceText,
    start: int,
    end: int,
    statements: list[ccode.Statement],
    owner: ccode.Located,
    cuts: Sequence[tuple[int, int]] = (),
    first: Sequence[str] = (),
    tail: Sequence[str] = (),
) -> Iterator[MainPart]:
    """`void name() { ... }` around copied text, one part for each run of lines.

    Args:
        name: name of the function.
        source: where the text is copied from.
        start, end: the range that is copied.
        statements: the statements in it.
        owner: the element that the function comes from.
        cuts: ranges that are left out.
        first: lines at the beginning of the body.
        tail: lines at the end of the body.
    """
    yield MainPart(f"void {name}() {{\n", "generation", name, [owner])
    for line in first:
        yield MainPart(line, "generation", "first statement", [owner])
    pieces: list[Piece] = []
    position = start
    ordered = sorted(statements, key=_start)
    for cut_start, cut_end in [*sorted(c for c in cuts if start <= c[0] < end), (end, end)]:
        here = ordered[bisect_left(ordered, position, key=_start) : bisect_left(ordered, cut_start, key=_start)]
        pieces += [p for p in source.pieces(position, cut_start, here) if p.text]
        position = cut_end
    texts = _indented(pieces, source)
    if texts:
        texts[0], texts[-1] = texts[0].lstrip("\n"), texts[-1].rstrip("\n") + "\n"
    for piece, text in zip(pieces, texts, strict=True):
        if text.strip():
            yield MainPart(text if text.endswith("\n") else text + "\n", "code", "retained statement", _elements(piece))
        elif text:
            yield MainPart("\n", "code", "blank", [owner])
    for line in tail:
        yield MainPart(line, "generation", "end of main", [owner])
    yield MainPart("}\n", "generation", name, [owner])


def _indented(pieces: Sequence[Piece], source: SourceText) -> list[str]:
    """The texts of pieces with equal indentation; a first line that begins within a source line has none of its own."""
    texts = [p.text if p.text.endswith("\n") else p.text + "\n" for p in pieces]
    if not pieces or source.line_start(pieces[0].start) == pieces[0].start:
        return reindent(texts)
    head, _, rest = texts[0].partition("\n")
    others = reindent([rest, *texts[1:]], head.endswith("\\"))
    return [f"  {head.strip()}\n{others[0]}" if head.strip() else others[0], *others[1:]]


def _elements(piece: Piece) -> list[Item]:
    return [*piece.elements, *(d for change in piece.changes if (d := decision_of(change)) is not None)]


def _first_line(source: SourceText, offset: int) -> int:
    """The offset after the rest of the line if that is blank, else the offset itself."""
    end = source.line_end(offset)
    return end if source.blank(offset, end) else offset


def _last_line(source: SourceText, offset: int) -> int:
    """The start of the line if it is blank up to the offset, else the offset itself."""
    start = source.line_start(offset)
    return start if source.blank(start, offset) else offset
