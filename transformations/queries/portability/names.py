"""The names that a unit uses and that its program does not declare, wherever they stand.

They come from the model: references, calls, uses of macros, bodies of the program's macros, and what the parser lost. Text that
the board's macros leave out is not in the model, but another board may compile it: its names come from the tokens.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Mapping

from msgspec import Struct

from robosmi import inputs
from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import directive_parts, tokens
from robosmi.transformations.queries.code import CodeView, unit_of
from robosmi.transformations.queries.macros.tokens import names_in

_LINE_END = re.compile(rb"\n")
_WORD = re.compile(r"[A-Za-z_]\w*", re.ASCII)
_MEMBER = frozenset([".", "->"])
_OPENS = frozenset(["if", "ifdef", "ifndef"])


class ForeignName(Struct, frozen=True):
    """A name that is used in a line; `text` is the whole use of a macro, else the name."""

    name: str
    line: int
    text: str = ""


def foreign_names(view: CodeView, sources: Mapping[str, bytes] | None = None) -> list[ForeignName]:
    """The names of a unit that its program does not declare, with each line in which they are used.

    Args:
        view: the unit.
        sources: path of a unit -> its bytes; None to read the file.
    """
    own = own_names(view.program)
    found = [*(use for use in _in_model(view) if use.name not in own), *_in_text(view, own, sources)]
    return sorted({(use.line, use.name): use for use in reversed(found)}.values(), key=lambda use: (use.line, use.name))


def own_names(program: ccode.Program) -> set[str]:
    """The names that a program declares at file scope, and those of its macros."""
    declared = {str(each.name) for unit in program.units for each in unit.declarations if not _only_external(each)}
    return declared | {str(macro.name) for unit in program.units for macro in unit.macros}


def _only_external(declaration: ccode.Declaration) -> bool:
    return isinstance(declaration, ccode.Variable) and declaration.storage.name == "externStorage"


def _in_model(view: CodeView) -> Iterator[ForeignName]:
    for reference in view.of_kind(ccode.NameReference):
        if reference.target is None or unit_of(reference.target) is None or _only_external(reference.target):
            yield ForeignName(str(reference.name), int(reference.line))
    for call in view.of_kind(ccode.Call):
        program_own = call.callee is not None and unit_of(call.callee) is not None
        if not program_own and not isinstance(call.calleeExpression, ccode.Member):
            yield ForeignName(str(call.calleeName or ""), int(call.line))
    for use in view.unit.macroUses:
        if use.macro is None:
            yield ForeignName(str(use.name), int(use.line), str(use.text or ""))
    for variable in view.of_kind(ccode.Variable):
        if _only_external(variable):
            yield ForeignName(str(variable.name), int(variable.line))
    for lost in view.unit.unresolved:
        yield ForeignName(str(lost.name), int(lost.line))


def _in_text(view: CodeView, own: set[str], sources: Mapping[str, bytes] | None) -> Iterator[ForeignName]:
    for macro in view.unit.macros:
        for name in names_in(str(macro.body or "")) - set(macro.parameters) - own:
            yield ForeignName(name, int(macro.line))
    statements = [(str(each.text or ""), int(each.line)) for each in view.of_kind(ccode.UnknownStatement)]
    expressions = [(str(each.text or ""), int(each.line)) for each in view.of_kind(ccode.UnknownExpression)]
    for text, line in (*statements, *expressions):
        yield from (ForeignName(name, line) for name in names_in(text) - own)
    yield from (use for use in _not_in_model(view.unit, sources) if use.name not in own)


def _not_in_model(unit: ccode.SourceUnit, sources: Mapping[str, bytes] | None) -> Iterator[ForeignName]:
    """The names in the text that conditional directives leave out, and in lines that the parser complains about."""
    damaged = {int(problem.line) for problem in unit.problems}
    ranges = list(left_out_ranges(unit.conditionals))
    if not ranges and not damaged:
        return
    path = str(unit.path)
    data = sources[path] if sources is not None else inputs.read_bytes(path, inputs.SOURCE)
    lines = [0, *(match.end() for match in _LINE_END.finditer(data))]
    starts = [start for start, _ in ranges]
    before = ""
    for kind, start, _, text in tokens(data):
        place = bisect_right(starts, start) - 1
        out = place >= 0 and start < ranges[place][1]
        if before not in _MEMBER and (out or (kind == "name" and bisect_right(lines, start) in damaged)):
            for name, offset in _names_of(kind, text):
                yield ForeignName(name, bisect_right(lines, start + offset))
        before = text if kind != "comment" else before


def _names_of(kind: str, text: str) -> Iterable[tuple[str, int]]:
    """The names in a token, with their offsets in it: itself, or those behind a `#define`."""
    if kind == "name":
        return [(text, 0)]
    if kind == "directive" and directive_parts(text)[0] == "define":
        return [(match[0], match.start()) for match in list(_WORD.finditer(text))[2:]]
    return []


def left_out_ranges(conditionals: Iterable[ccode.PreprocessorConditional]) -> Iterator[tuple[int, int]]:
    """The ranges of offsets that are not compiled, in text order.

    Args:
        conditionals: the directives of a unit, in text order.
    """
    open_: list[bool] = []
    start = -1
    for each in conditionals:
        if start >= 0:
            yield start, int(each.startOffset)
        if each.directive in _OPENS:
            open_.append(bool(each.active))
        elif each.directive == "endif":
            del open_[-1:]
        elif open_:
            open_[-1] = bool(each.active)
        start = -1 if all(open_) else int(each.endOffset)
    if start >= 0:
        yield start, start
