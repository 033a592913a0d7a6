"""Builders of what C++ has beyond C, as far as the metamodel `ccode` can say it; programs of both are read with one set.

Classes become records with methods, templates what they are a template of, `extern "C"` blocks their declarations, `try` a block,
a loop over a range a `for` without condition, `new`, `delete` and `throw` unary operators, a call of an overloaded operator the
operation that the text has. What has no form in the metamodel (a lambda) stays text, and its calls are listed as unresolved.
"""

from __future__ import annotations

import re

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source import declarations, expressions, statements, types
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.expressions import expression, operands
from robosmi.transformations.t2m.c_source.statements import statement
from robosmi.transformations.t2m.c_source.tree import Node

METHOD, CONSTRUCTOR, DESTRUCTOR, CONVERSION = 21, 24, 25, 26
FUNCTION_TEMPLATE, CLASS_TEMPLATE, PARTIAL_TEMPLATE, LINKAGE = 30, 31, 32, 23
_OPERATOR = re.compile(r"operator\s*([^\w\s].*)")


def _named_cast(context: UnitContext, node: Node) -> ccode.Expression | None:
    """`static_cast<T>(x)` and the like, and `T(x)`."""
    children = operands(node)
    if not children:
        return None
    return ccode.Cast(operand=expression(context, children[-1]), **context.source.place(node.start, node.end))


def _word(operator: str) -> expressions.Builder:
    """A builder for an operator that is a word before its operand."""

    def build(context: UnitContext, node: Node) -> ccode.Expression | None:
        children = [c for c in operands(node) if c.end > c.start]
        if not children:
            return None
        if operator == "new":  # the name of the class stands before the parentheses
            context.covered.add(types.last_of_name(context, node.start, node.end))
        return ccode.Unary(
            operator=operator, operand=expression(context, children[-1]), **context.source.place(node.start, node.end)
        )

    return build


def overloaded(context: UnitContext, node: Node) -> ccode.Expression | None:
    """The operation that a call of an overloaded operator is in the text; None for any other call."""
    match = _OPERATOR.match(context.spelling(node.cursor))
    if match is None or context.text(node).startswith("operator"):
        return None
    operator = match[1].strip()
    parts = [c for c in operands(node) if not _OPERATOR.match(context.spelling(c.cursor) if c.kind in (100, 101) else "")]
    place = context.source.place(node.start, node.end)
    if operator == "()" or not parts or len(parts) > 2:
        return None
    built = [expression(context, c) for c in parts]
    if operator == "[]" and len(built) == 2:
        return ccode.Index(array=built[0], index=built[1], **place)
    if len(built) == 1:
        return ccode.Unary(operator=operator, operand=built[0], **place)
    kind = ccode.Assignment if operator.endswith("=") and operator not in ("==", "!=", "<=", ">=") else ccode.Binary
    return kind(operator=operator, left=built[0], right=built[1], **place)


def _try(context: UnitContext, node: Node) -> ccode.Statement:
    context.find("RS107", Severity.warning, "exceptions are read as plain blocks", node.start, node.end, "read it by hand")
    parts: list[ccode.Statement] = []
    for child in node.children:
        inner = child.children[-1] if child.kind == 223 and child.children else child  # CXX_CATCH_STMT
        parts.append(statement(context, inner))
    return ccode.Block(statements=parts, **context.source.place(node.start, node.end))


def _for_range(context: UnitContext, node: Node) -> ccode.Statement:
    body = node.children[-1] if node.children else None
    variables = [c for c in node.children if c.kind == 9 and c.end > c.start]
    over = [c for c in node.children[:-1] if 100 <= c.kind < 200 and c.end > c.start]
    initial: ccode.Statement | None = None
    if variables:
        place = context.source.place(variables[0].start, over[0].end if over else variables[0].end)
        initial = ccode.DeclarationStatement(declarations=declarations.group(context, variables[:1]), **place)
    return ccode.For(
        form=ccode.LoopForm.forLoop,
        initial=initial,
        step=expression(context, over[0]) if over else None,
        body=statement(context, body) if body is not None else None,
        **context.source.place(node.start, node.end),
    )


def enable() -> None:
    """Add these builders to those of C."""
    expressions.BUILDERS.update(dict.fromkeys((124, 125, 126, 127, 128), _named_cast))
    expressions.BUILDERS.update({133: _word("throw"), 134: _word("new"), 135: _word("delete")})
    statements.BUILDERS.update({224: _try, 225: _for_range})
