"""Builders of expressions: one function a kind of cursor, chosen from a table.

Parentheses and implicit conversions have no element of their own. What comes whole out of an object-like macro is a
reference to that macro's name, as the text says; what comes out of a function-like macro of a header is a call of it
(`macros`). Too deep or unknown forms become `UnknownExpression`. Links to declarations are made later (`linking`).
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence

from robosmi.errors import TooLargeError
from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source import literals, macros, types
from robosmi.transformations.t2m.c_source.context import MAX_DEPTH, ExpressionBuilder, UnitContext
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor, written_template
from robosmi.transformations.t2m.c_source.parsing.tree import Node

UNEXPOSED, DECL_REF, MEMBER, CALL, PAREN, UNARY, BINARY, COMPOUND_ASSIGN, CAST, COMPOUND_LITERAL = (
    cursor_kinds.UNEXPOSED_EXPR,
    cursor_kinds.DECL_REF_EXPR,
    cursor_kinds.MEMBER_REF_EXPR,
    cursor_kinds.CALL_EXPR,
    cursor_kinds.PAREN_EXPR,
    cursor_kinds.UNARY_OPERATOR,
    cursor_kinds.BINARY_OPERATOR,
    cursor_kinds.COMPOUND_ASSIGNMENT_OPERATOR,
    cursor_kinds.CSTYLE_CAST_EXPR,
    cursor_kinds.COMPOUND_LITERAL_EXPR,
)
FUNCTION_KINDS = (
    cursor_kinds.FUNCTION_DECL,
    cursor_kinds.CXX_METHOD,
    cursor_kinds.CONSTRUCTOR,
    cursor_kinds.CONVERSION_FUNCTION,
    cursor_kinds.FUNCTION_TEMPLATE,
    cursor_kinds.OVERLOADED_DECL_REF,
)  # with templates and sets of overloaded functions
TYPE_REF = cursor_kinds.TYPE_REF
MOST_CALLS = 10_000
"""Calls of one file, those that macros make included: so many do not fit into the 32 KB of a Propeller or an Uno."""

_POINTERS = frozenset((101, 112, 114))
"""CXTypeKind of pointers, and of arrays with and without a size."""
UNARY_OPERATORS = ("", "++", "--", "++", "--", "&", "*", "+", "-", "~", "!", "__real", "__imag", "__extension__", "co_await")
BINARY_OPERATORS = (
    "", ".*", "->*", "*", "/", "%", "+", "-", "<<", ">>", "<=>", "<", ">", "<=", ">=", "==", "!=", "&", "^", "|", "&&", "||",
    "=", "*=", "/=", "%=", "+=", "-=", "<<=", ">>=", "&=", "^=", "|=", ",",
)  # fmt: skip


def expression(context: UnitContext, node: Node) -> ccode.Expression:
    """The element for an expression's cursor."""
    if (waiting := context.later(ccode.UnknownExpression, expression, node)) is not None:
        return waiting
    if context.depth > MAX_DEPTH:
        return truncated_expression(context, node)
    context.depth += 1
    try:
        while True:
            if node.from_macro and (found := macros.from_macro(context, node, expression)) is not None:
                return found
            if node.kind not in (UNEXPOSED, PAREN) or len(node.children) != 1:
                break
            node = node.children[0]
        builder = context.builders.expressions.get(node.kind)
        return (builder and builder(context, node)) or unknown(context, node)
    finally:
        context.depth -= 1


def truncated_expression(context: UnitContext, node: Node) -> ccode.Expression:
    """An expression below the deepest level that is built, kept as text."""
    context.parsed.cut.append((node.start, node.end))
    return unknown(context, node)


def unknown(context: UnitContext, node: Node) -> ccode.Expression:
    """An expression without a builder, kept as text."""
    return ccode.UnknownExpression(text=context.text(node), **context.source.place(node.start, node.end))


def operands(node: Node) -> list[Node]:
    """The children that are expressions."""
    return [c for c in node.children if c.kind in cursor_kinds.EXPRESSIONS]


def _name(context: UnitContext, node: Node) -> ccode.Expression:
    referenced = context.lib.getCursorReferenced(node.cursor)
    name = context.spelling(node.cursor) if node.from_macro else context.text(node)
    element = ccode.NameReference(name=name, **context.source.place(node.start, node.end))
    context.references.append((element, referenced))
    return element


def call(context: UnitContext, node: Node, children: Sequence[Node]) -> ccode.Expression:
    """Build a call.

    Args:
        context: the unit's context.
        node: the call's cursor.
        children: the cursors of the callee and of the arguments.

    Raises:
        TooLargeError: the file makes more than `MOST_CALLS`.
    """
    if len(context.call_nodes) >= MOST_CALLS:
        raise TooLargeError(
            f"the file makes more than {MOST_CALLS:,} calls, those in macros counted each time",
            location=context.source.location(node.start),
            fix="put repeated calls into loops, or leave generated code out",
        )
    callee = children[0] if children else None
    while callee is not None and callee.kind in (UNEXPOSED, PAREN) and len(callee.children) == 1:
        callee = callee.children[0]
    around, context.making = context.making, node.start if node.from_macro else context.making
    arguments = [expression(context, c) for c in children[1:]]
    context.making = around
    place, written, via_macro = macros.call_place(context, node)
    if callee is None or callee.kind == UNEXPOSED or (callee.kind == DECL_REF and _is_function(context, callee)):
        name = written or (
            context.spelling(callee.cursor if callee is not None else node.cursor)
            or context.spelling(node.cursor)
            or (context.text(callee) if callee is not None else "")
        )
        element = ccode.Call(calleeName=name, viaMacro=via_macro or None, arguments=arguments, **place)
        context.calls.append((element, _called(context, callee) if callee is not None else None))
        if not via_macro:
            context.covered.add(types.last_of_name(context, node.start, node.end))
    else:
        element = ccode.Call(
            calleeExpression=expression(context, callee), viaMacro=via_macro or None, arguments=arguments, **place
        )
        if callee.kind == MEMBER and context.lib.getCursorReferenced(callee.cursor).kind == cursor_kinds.CXX_METHOD:  # a method
            element.calleeName = context.spelling(callee.cursor)
            context.calls.append((element, _called(context, callee)))
        before = context.tokens[context.token_before(callee.end)]
        context.covered.add(before[1])
    context.call_nodes.append((element, node, callee))
    return element


def constructs(context: UnitContext, node: Node) -> bool:
    """Whether a call's cursor constructs an object."""
    return context.lib.getCursorReferenced(node.cursor).kind == cursor_kinds.CONSTRUCTOR


def constructor_call(context: UnitContext, node: Node) -> ccode.ConstructorCall:
    """The construction of an object: `Lamp(8)`, `Lamp{8}`, or what follows the name in `Lamp lamp(8);`."""
    context.covered.add(types.last_of_name(context, node.start, node.end))
    return ccode.ConstructorCall(
        className=context.spelling(node.cursor),
        arguments=[expression(context, child) for child in operands(node) if child.end > child.start],
        **context.source.place(node.start, node.end),
    )


def _called(context: UnitContext, callee: Node) -> Cursor:
    """The declaration of a called function, for an instance of a template the template."""
    referenced = context.lib.getCursorReferenced(callee.cursor)
    return written_template(referenced) if context.source.language == "C++" else referenced


def _is_function(context: UnitContext, callee: Node) -> bool:
    referenced = context.lib.getCursorReferenced(callee.cursor)
    if referenced.kind in FUNCTION_KINDS or (referenced.kind in cursor_kinds.INVALID and context.source.language == "C++"):
        return True  # in a template a name may have no declaration yet
    return context.pointer(referenced) not in context.declared and context.parsed.prelude.declares(
        context.spelling(callee.cursor)
    )


def _unary(context: UnitContext, node: Node) -> ccode.Expression | None:
    children = operands(node)
    if len(children) != 1:
        return None
    number = context.lib.getCursorUnaryOperatorKind(node.cursor)
    operand = expression(context, children[0])
    if UNARY_OPERATORS[number] == "__extension__":
        return operand
    return ccode.Unary(
        operator=UNARY_OPERATORS[number],
        postfix=number in (1, 2) or None,
        operand=operand,
        **context.source.place(node.start, node.end),
    )


def _binary(context: UnitContext, node: Node) -> ccode.Expression | None:
    children = operands(node)
    if len(children) != 2:
        return None
    if children[1].start < children[0].end:
        context.divided.add(children[1].start)
    operator = BINARY_OPERATORS[context.lib.getCursorBinaryOperatorKind(node.cursor)]
    left, right = expression(context, children[0]), expression(context, children[1])
    kind = ccode.Assignment if node.kind == COMPOUND_ASSIGN or operator == "=" else ccode.Binary
    return kind(operator=operator, left=left, right=right, **context.source.place(node.start, node.end))


def _conditional(context: UnitContext, node: Node) -> ccode.Expression | None:
    children = operands(node)
    if len(children) != 3:
        return None
    context.divided.update(after.start for one, after in itertools.pairwise(children) if after.start < one.end)
    parts = [expression(context, c) for c in children]
    return ccode.ConditionalExpression(
        condition=parts[0], whenTrue=parts[1], whenFalse=parts[2], **context.source.place(node.start, node.end)
    )


def _omitted(context: UnitContext, node: Node) -> ccode.Expression | None:
    """GNU C's `a ?: b`, which is `a` if that is not zero and else `b`: a choice without a condition of its own."""
    children = operands(node)
    if len(children) != 4 or len({(child.start, child.end) for child in children[:3]}) != 1:
        return None
    parts = [expression(context, child) for child in (children[0], children[3])]
    return ccode.ConditionalExpression(whenTrue=parts[0], whenFalse=parts[1], **context.source.place(node.start, node.end))


def _statement_expression(context: UnitContext, node: Node) -> ccode.Expression | None:
    """GNU C's `({ ... })`, whose value is that of its last statement: its text, and the statements in it."""
    if [child.kind for child in node.children] != [cursor_kinds.COMPOUND_STMT]:
        return None
    body = context.builders.block(context, node.children[0])
    return ccode.UnknownExpression(text=context.text(node), body=body, **context.source.place(node.start, node.end))


def _index(context: UnitContext, node: Node) -> ccode.Expression | None:
    children = operands(node)
    if len(children) != 2:
        return None
    array, index = expression(context, children[0]), expression(context, children[1])
    type_ = context.lib.getCanonicalType(context.lib.getCursorType(children[1].cursor))
    if type_.kind in _POINTERS:  # 1[row] is row[1]
        array, index = index, array
    return ccode.Index(array=array, index=index, **context.source.place(node.start, node.end))


def _member(context: UnitContext, node: Node) -> ccode.Expression:
    children = operands(node)
    arrow = False
    element = None
    if children:
        element = expression(context, children[0])
        arrow = b"->" in context.source.parsed[children[0].end : node.end]
    name = context.spelling(node.cursor)
    return ccode.Member(name=name, arrow=arrow or None, object=element, **context.source.place(node.start, node.end))


def _cast(context: UnitContext, node: Node) -> ccode.Expression | None:
    children = operands(node)
    if not children:
        return None
    operand = expression(context, children[-1])
    return ccode.Cast(target=_parenthesised_type(context, node), operand=operand, **context.source.place(node.start, node.end))


def _parenthesised_type(context: UnitContext, node: Node) -> ccode.TypeUse | None:
    i = context.token_at(node.start)
    if context.expansions_at(node.start):  # it stands in the body of a macro, whose use is all that is here
        return types.read_type(context, context.lib.getCursorType(node.cursor))
    if i < len(context.tokens) and context.tokens[i][3] != "(":
        i += 1  # sizeof
    if i >= len(context.tokens) or context.tokens[i][3] != "(":
        return None
    close = context.matching(i)
    return types.written_type(context, context.tokens[i][2], context.tokens[close][1], context.lib.getCursorType(node.cursor))


def _size_of(context: UnitContext, node: Node) -> ccode.Expression:
    children = operands(node)
    place = context.source.place(node.start, node.end)
    if children:
        return ccode.SizeOf(operand=expression(context, children[0]), **place)
    measured = _parenthesised_type(context, node)
    if measured is not None:  # the parser's type is that of the result, not of what is measured
        measured.canonical, measured.bits, measured.signed, measured.constant = measured.spelling, 0, False, False
    return ccode.SizeOf(measured=measured, **place)


def _initializer_list(context: UnitContext, node: Node) -> ccode.Expression:
    elements = [_element(context, c) for c in operands(node) if c.end > c.start]
    return ccode.InitializerList(elements=elements, **context.source.place(node.start, node.end))


def _element(context: UnitContext, node: Node) -> ccode.Expression:
    """An element of an initialiser list; `.name = value` and `[index] = value` become assignments without an object.

    The index of GNU C's `[first ... last] = value` is a binary expression with `...`.
    """
    if node.kind != UNEXPOSED or len(node.children) < 2:
        return expression(context, node)
    value = expression(context, node.children[-1])
    designator = node.children[-2]
    place = context.source.place(designator.start, designator.end)
    left: ccode.Expression
    if designator.kind == cursor_kinds.MEMBER_REF:  # MEMBER_REF
        left = ccode.Member(name=context.spelling(designator.cursor), **place)
    else:
        first = node.children[-3] if len(node.children) > 2 else designator
        index = expression(context, designator)
        if b"..." in context.source.data[first.end : designator.start]:
            place = context.source.place(first.start, designator.end)
            index = ccode.Binary(operator="...", left=expression(context, first), right=index, **place)
        left = ccode.Index(index=index, **place)
    return ccode.Assignment(operator="=", left=left, right=value, **context.source.place(node.start, node.end))


BUILDERS: Mapping[int, ExpressionBuilder] = {
    DECL_REF: _name,
    MEMBER: _member,
    CALL: lambda context, node: call(context, node, operands(node)),
    cursor_kinds.INTEGER_LITERAL: literals.integer,
    cursor_kinds.FLOATING_LITERAL: literals.floating,
    cursor_kinds.STRING_LITERAL: literals.string,
    cursor_kinds.CHARACTER_LITERAL: literals.character,
    UNARY: _unary,
    cursor_kinds.ARRAY_SUBSCRIPT_EXPR: _index,
    BINARY: _binary,
    COMPOUND_ASSIGN: _binary,
    cursor_kinds.CONDITIONAL_OPERATOR: _conditional,
    UNEXPOSED: _omitted,
    cursor_kinds.StmtExpr: _statement_expression,
    CAST: _cast,
    COMPOUND_LITERAL: _cast,
    cursor_kinds.INIT_LIST_EXPR: _initializer_list,
    cursor_kinds.CXX_UNARY_EXPR: _size_of,
}
"""CXCursorKind -> builder, of C; what no builder is for becomes an `UnknownExpression`."""
