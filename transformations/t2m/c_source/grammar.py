"""The builders of C and of what C++ adds, put together; programs of both are read with one set.

The builders of C are in `declarations`, `statements`, `expressions` and `types`. Those of C++ are here, as far as the metamodel
`ccode` can express it. Classes become records with methods, templates what they are a template of, `extern "C"` blocks their
declarations, `try` a block with its handlers, `new`, `delete` and `throw` unary operators, a call of an overloaded operator the
operation that the text has. What has no form in the metamodel (a structured binding) stays text, and its calls are listed as
unresolved.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source import declarations, expressions, statements, types
from robosmi.transformations.t2m.c_source.context import Builders, ExpressionBuilder, StatementBuilder, UnitContext
from robosmi.transformations.t2m.c_source.expressions import CALL, call, constructor_call, constructs, expression, operands
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.tree import Node
from robosmi.transformations.t2m.c_source.statements import statement

CONSTRUCTOR, DESTRUCTOR = cursor_kinds.CONSTRUCTOR, cursor_kinds.DESTRUCTOR
VARIABLE, CATCH, TRY = cursor_kinds.VAR_DECL, cursor_kinds.CXX_CATCH_STMT, cursor_kinds.CXX_TRY_STMT
FUNCTION_TEMPLATE, CLASS_TEMPLATE = cursor_kinds.FUNCTION_TEMPLATE, cursor_kinds.CLASS_TEMPLATE
_OPERATOR = re.compile(r"operator\s*([^\w\s].*)")


def _named_cast(context: UnitContext, node: Node) -> ccode.Expression | None:
    """A C++ cast such as `static_cast<T>(x)` or `T(x)`."""
    children = operands(node)
    if not children:
        return None
    if node.kind == cursor_kinds.CXX_FUNCTIONAL_CAST_EXPR:  # Pin(8) looks like a call
        context.covered.add(types.last_of_name(context, node.start, node.end))
        if children[-1].kind == CALL and constructs(context, children[-1]):
            return constructor_call(context, children[-1])
    return ccode.Cast(operand=expression(context, children[-1]), **context.source.place(node.start, node.end))


def _word(operator: str) -> ExpressionBuilder:
    """A builder for a prefix operator that is a word, such as `new` or `throw`."""

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


def _call(context: UnitContext, node: Node) -> ccode.Expression:
    children = operands(node)
    if context.source.language == "C++":
        if len(children) == 1 and (children[0].start, children[0].end) == (node.start, node.end):
            return expression(context, children[0])  # a constructor that the text does not name
        if constructs(context, node):
            return constructor_call(context, node)
        children = [c for c in children if not _is_call_operator(context, c)]
        if (operation := _overloaded(context, node)) is not None:
            return operation
    return call(context, node, children)


def _lambda(context: UnitContext, node: Node) -> ccode.Expression | None:
    """A lambda: its text, its own variables and parameters, and what its body does."""
    body = next((child for child in node.children if child.kind == cursor_kinds.COMPOUND_STMT), None)
    if body is None:
        return None
    return ccode.Lambda(
        text=context.text(node),
        captures=_captures(context, node),
        parameters=[declarations.parameter(context, child) for child in node.children if child.kind == cursor_kinds.PARM_DECL],
        body=context.builders.block(context, body),
        **context.source.place(node.start, node.end),
    )


def _captures(context: UnitContext, node: Node) -> list[ccode.Variable]:
    """The variables that a lambda's captures declare (`[k = 300]`): those that refer to themselves."""
    named = [child for child in node.children if child.kind == cursor_kinds.VARIABLE_REF]
    declared = [(child, context.lib.getCursorReferenced(child.cursor)) for child in named]
    own = [cursor for child, cursor in declared if context.name_offset(cursor) == context.name_offset(child.cursor)]
    made = declarations.group(context, [context.parsed.reader.subtree(cursor) for cursor in own])
    variables = [each for each in made if isinstance(each, ccode.Variable)]
    for variable, cursor in zip(variables, own, strict=True):
        variable.valueType = types.deduced(context, context.lib.getCursorType(cursor))
    return variables


def _is_call_operator(context: UnitContext, node: Node) -> bool:
    """Whether a cursor is the `operator()` that libclang reports between a called object and its arguments."""
    return context.text(node)[:1] == "(" and context.spelling(node.cursor) == "operator()"


def _overloaded(context: UnitContext, node: Node) -> ccode.Expression | None:
    """The unary or binary operation that calls an overloaded operator; None for any other call."""
    match = _OPERATOR.match(context.spelling(node.cursor))
    if match is None or context.text(node).startswith("operator"):
        return None
    operator = match[1].strip()
    parts = [
        c
        for c in operands(node)
        if not _OPERATOR.match(
            context.spelling(c.cursor) if c.kind in (cursor_kinds.UNEXPOSED_EXPR, cursor_kinds.DECL_REF_EXPR) else ""
        )
    ]
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


def _try(context: UnitContext, node: Node) -> ccode.Block:
    context.find("RS107", Severity.warning, "exceptions are parsed as plain blocks", node.start, node.end, "check it by hand")
    parts = [_catch(context, child) if child.kind == CATCH else statement(context, child) for child in node.children]
    return ccode.Block(statements=parts, **context.source.place(node.start, node.end))


def _catch(context: UnitContext, node: Node) -> ccode.Statement:
    """The handler of an exception as a block; if it names the exception, a block of that declaration and its own block."""
    caught = [child for child in node.children if child.kind == VARIABLE and context.spelling(child.cursor)]
    if not caught:
        return statement(context, node.children[-1])
    place = context.source.place(caught[0].start, caught[0].end)
    declaration = ccode.DeclarationStatement(declarations=declarations.group(context, caught), **place)
    body = statement(context, node.children[-1])
    return ccode.Block(statements=[declaration, body], **context.source.place(node.start, node.end))


def _for_range(context: UnitContext, node: Node) -> ccode.Statement:
    initial, declaration, children = statements.leading(context, node)
    if declaration is None:  # for (auto [a, b] : pairs)
        message = "the model does not contain the variables of this loop"
        context.find("RS107", Severity.warning, message, node.start, node.end, "check it by hand")
    over = [child for child in children[:-1] if child.kind in cursor_kinds.EXPRESSIONS and child.end > child.start]
    return ccode.For(
        form=ccode.LoopForm.forLoop,
        initial=initial,
        declaration=declaration,
        range=expression(context, over[0]) if over else None,
        body=statement(context, children[-1]) if children else None,
        **context.source.place(node.start, node.end),
    )


EXPRESSIONS: Mapping[int, ExpressionBuilder] = {
    CALL: _call,
    **dict.fromkeys(
        (
            cursor_kinds.CXX_STATIC_CAST_EXPR,
            cursor_kinds.CXX_DYNAMIC_CAST_EXPR,
            cursor_kinds.CXX_REINTERPRET_CAST_EXPR,
            cursor_kinds.CXX_CONST_CAST_EXPR,
            cursor_kinds.CXX_FUNCTIONAL_CAST_EXPR,
        ),
        _named_cast,
    ),
    cursor_kinds.CXX_THROW_EXPR: _word("throw"),
    cursor_kinds.CXX_NEW_EXPR: _word("new"),
    cursor_kinds.CXX_DELETE_EXPR: _word("delete"),
    cursor_kinds.LAMBDA_EXPR: _lambda,
}
"""CXCursorKind -> builder, for expressions that C lacks or builds differently."""

STATEMENTS: Mapping[int, StatementBuilder] = {TRY: _try, cursor_kinds.CXX_FOR_RANGE_STMT: _for_range}
"""CXCursorKind -> builder, for statements that C lacks."""


BUILDERS = Builders(
    expressions={**expressions.BUILDERS, **EXPRESSIONS},
    statements={**statements.BUILDERS, **STATEMENTS},
    declarations=declarations.BUILDERS,
    block=statements.block,
)
