"""Macros: the preprocessor's elements of a unit, and expressions that come out of macro expansion.

An expression from an object-like macro becomes a reference to the macro's name. It is built as it expands if it contains a
call, if the meaning of the name changes within the file, or if an operator outside of the macro divides its text. An expression
from a function-like macro of a header becomes a call by that name with the arguments as written. The body of the program's own
function-like macros, those in its own headers included, is built as it expands, and its
calls are marked `viaMacro`.
"""

from __future__ import annotations

from collections.abc import Callable

from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.source import TextRange
from robosmi.transformations.t2m.c_source.parsing.tree import Expansion, Node

Build = Callable[[UnitContext, Node], ccode.Expression]
CALL = cursor_kinds.CALL_EXPR


def expansion_of(context: UnitContext, node: Node) -> Expansion | None:
    """The macro use that a whole node is expanded from; None if the node is part of an argument or extends beyond the use."""
    for expansion in context.expansions_at(node.start):
        if node.end <= expansion.end:
            return expansion
    return None


def from_macro(context: UnitContext, node: Node, build: Build) -> ccode.Expression | None:
    """The element for a node that comes out of a macro; None if it is to be built like any other node."""
    expansion = expansion_of(context, node)
    if expansion is None:
        return None
    own = context.is_own(expansion)
    if context.function_like(expansion):
        return None if own else macro_call(context, node, expansion, build)
    if own and (
        expansion.name in context.changing or node.start in context.divided or context.making == node.start or _has_call(node)
    ):
        return None
    element = ccode.NameReference(name=expansion.name, **context.source.place(expansion.start, expansion.end))
    if expansion.name not in context.user_macros:
        context.references.append((element, context.lib.getCursorReferenced(expansion.cursor)))
    return element


def macro_call(context: UnitContext, node: Node, expansion: Expansion, build: Build) -> ccode.Expression:
    """A use of a header's function-like macro as a call; its arguments are built from the expansion."""
    arguments: list[ccode.Expression] = []
    for start, end in context.arguments(expansion):
        found = _within(node, start, end)
        if found is None:
            arguments.append(ccode.UnknownExpression(text=context.source.text(start, end), **context.source.place(start, end)))
        else:
            arguments.append(build(context, found))
    element = ccode.Call(calleeName=expansion.name, arguments=arguments, **context.source.place(expansion.start, expansion.end))
    context.covered.add(expansion.start)
    context.calls.append((element, context.lib.getCursorReferenced(expansion.cursor)))
    return element


def call_place(context: UnitContext, node: Node) -> tuple[TextRange, str, bool]:
    """The place of a call, its callee's name if a header's macro hides it, and whether an own macro makes the call."""
    if not node.from_macro:
        return context.source.place(node.start, node.end), "", False
    for expansion in context.expansions_at(node.start):
        if context.is_own(expansion):
            context.covered.add(expansion.start)  # an alias: the text has a call by the macro's name
            end = max(expansion.end, node.end)
            return context.source.place(expansion.start, end), "", True
        return context.source.place(node.start, node.end), expansion.name, False
    repeated = node.start in context.covered  # a macro's argument that its body has twice
    return context.source.place(node.start, node.end), "", repeated


def _has_call(node: Node) -> bool:
    pending = [node]
    while pending:
        one = pending.pop()
        if one.kind == CALL:
            return True
        pending.extend(one.children)
    return False


def _within(node: Node, start: int, end: int) -> Node | None:
    """The first outermost expression that covers the range exactly, else the first that lies within it."""
    inside: Node | None = None
    pending = [node]
    while pending:
        one = pending.pop(0)
        if one.kind in cursor_kinds.EXPRESSIONS and start <= one.start and one.end <= end and one.end > one.start:
            if one.start == start and one.end == end:
                return one
            inside = inside or one
        pending = one.children + pending
    return inside


def uses(context: UnitContext) -> list[ccode.MacroUse]:
    """The macro uses of the file in text order."""
    found: list[ccode.MacroUse] = []
    seen: set[tuple[int, int]] = set()
    headers: dict[str, str] = {}
    for expansion in context.parsed.expansions:
        if (expansion.start, expansion.end) in seen:
            continue
        seen.add((expansion.start, expansion.end))
        own = context.is_own(expansion)
        header = "" if expansion.name in context.user_macros else headers.get(expansion.name)
        if header is None:
            header = headers[expansion.name] = header_of(context, context.lib.getCursorReferenced(expansion.cursor)) or ""
        like = context.function_like(expansion)
        if like or own:
            context.covered.add(expansion.start)  # also an object-like macro in front of parentheses
        found.append(
            ccode.MacroUse(
                name=expansion.name,
                text=context.source.text(expansion.start, expansion.end),
                functionLike=like or None,
                header=header or None,
                **context.source.place(expansion.start, expansion.end),
            )
        )
    return sorted(found, key=lambda use: int(use.startOffset))


def header_of(context: UnitContext, cursor: Cursor | None) -> str | None:
    """The header that declares a cursor, named as in an include; empty for the prelude, None for the file itself."""
    if cursor is None:
        return None
    file, _ = clang.file_offset(context.lib.getCursorLocation(cursor))
    if file == context.parsed.reader.file:
        return None
    return context.header_of_file(file)
