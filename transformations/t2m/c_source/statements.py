"""Builders of statements: one function a kind of cursor, chosen from a table.

An expression's cursor where a statement is wanted is an expression statement. The end of a statement includes its
semicolon. Forms that are not taken apart (assembler, statements out of a header's macro) keep their text.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import Token
from robosmi.transformations.t2m.c_source import declarations, macros
from robosmi.transformations.t2m.c_source.context import MAX_DEPTH, StatementBuilder, UnitContext
from robosmi.transformations.t2m.c_source.expressions import expression
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.source import TextRange
from robosmi.transformations.t2m.c_source.parsing.tree import Node

COMPOUND, FOR = cursor_kinds.COMPOUND_STMT, cursor_kinds.FOR_STMT
_OTHER_DECLARATION, _VARIABLE, _DECLARATION = cursor_kinds.UNEXPOSED_DECL, cursor_kinds.VAR_DECL, cursor_kinds.DECL_STMT
_CONSTANT_KINDS = frozenset(
    {
        cursor_kinds.UNEXPOSED_EXPR,
        cursor_kinds.INTEGER_LITERAL,
        cursor_kinds.CHARACTER_LITERAL,
        cursor_kinds.PAREN_EXPR,
        cursor_kinds.UNARY_OPERATOR,
        cursor_kinds.BINARY_OPERATOR,
        cursor_kinds.CSTYLE_CAST_EXPR,
        cursor_kinds.CXX_BOOL_LITERAL_EXPR,
    }
)


def statement(context: UnitContext, node: Node) -> ccode.Statement:
    """The element for a statement's cursor."""
    if (waiting := context.later(ccode.UnknownStatement, statement, node)) is not None:
        return waiting
    while node.kind == cursor_kinds.UNEXPOSED_STMT and len(node.children) == 1:
        node = node.children[0]
    if context.depth > MAX_DEPTH:
        context.parsed.cut.append((node.start, node.end))
        return ccode.UnknownStatement(text=context.text(node), **context.source.place(node.start, node.end))
    context.depth += 1
    try:
        if node.from_macro and node.kind >= cursor_kinds.UNEXPOSED_STMT:
            whole = _from_header_macro(context, node)
            if whole is not None:
                return whole
        if node.kind in cursor_kinds.EXPRESSIONS:
            return _expression_statement(context, node)
        builder = context.builders.statements.get(node.kind)
        return builder(context, node) if builder else _unknown(context, node)
    finally:
        context.depth -= 1


def block(context: UnitContext, node: Node) -> ccode.Block:
    """A compound statement; the body of a function may be a `try` with its handlers, too, which is read as one."""
    if (waiting := context.later(ccode.Block, block, node)) is not None:
        return waiting
    if node.kind != COMPOUND:
        return context.builders.statements[node.kind](context, node)  # type: ignore[return-value]
    return ccode.Block(statements=[statement(context, c) for c in node.children], **context.source.place(node.start, node.end))


def _place(context: UnitContext, node: Node) -> TextRange:
    """The place of a statement with its semicolon."""
    end = node.end
    i = context.token_at(end)
    if i < len(context.tokens) and context.tokens[i][3] == ";":
        end = context.tokens[i][2]
    return context.source.place(node.start, end)


def _expression_statement(context: UnitContext, node: Node) -> ccode.Statement:
    return ccode.ExpressionStatement(expression=expression(context, node), **_place(context, node))


def _from_header_macro(context: UnitContext, node: Node) -> ccode.Statement | None:
    expansion = macros.expansion_of(context, node)
    if expansion is None or context.is_own(expansion) or not context.function_like(expansion):
        return None
    place = _place(context, node)
    return ccode.ExpressionStatement(expression=macros.macro_call(context, node, expansion, expression), **place)


def _unknown(context: UnitContext, node: Node) -> ccode.Statement:
    place = _place(context, node)
    text = context.source.text(place["startOffset"], place["endOffset"])
    what = "assembler" if node.kind in (cursor_kinds.ASM_STMT, cursor_kinds.MS_ASM_STMT) else "a statement of an unusual form"
    context.find("RS107", Severity.warning, f"{what} is copied as text", node.start, node.end, "check it by hand")
    return ccode.UnknownStatement(text=text, **place)


def _if(context: UnitContext, node: Node) -> ccode.Statement:
    initial, declaration, children = leading(context, node)
    condition = expression(context, children[0]) if children else None
    then = statement(context, children[1]) if len(children) > 1 else None
    other = statement(context, children[2]) if len(children) > 2 else None
    return ccode.If(
        initial=initial,
        declaration=declaration,
        condition=condition,
        thenBranch=then,
        elseBranch=other,
        **context.source.place(node.start, node.end),
    )


def leading(context: UnitContext, node: Node) -> tuple[ccode.Statement | None, ccode.DeclarationStatement | None, list[Node]]:
    """The parts of a C++ statement head before the condition: an initial statement, a declared condition variable, the rest.

    libclang does not report the initial statement of every kind of head; it is kept as text then.
    """
    children = node.children
    if context.source.language != "C++":
        return None, None, children
    initial: ccode.Statement | None = None
    opened = context.token_at(node.start) + 1
    if opened < len(context.tokens) and context.tokens[opened][3] == "constexpr":
        opened += 1
    if node.kind != FOR and opened < len(context.tokens) and context.tokens[opened][3] == "(" and not node.from_macro:
        ends = _semicolons(context, opened)
        if ends:
            first = [child for child in children if child.start < ends[0][2]]
            children = [child for child in children if child.start >= ends[0][2]]
            initial = statement(context, first[0]) if first else _head_as_text(context, context.tokens[opened + 1][1], ends[0][2])
    elif children and children[0].kind == _DECLARATION and node.kind != FOR:
        initial, children = statement(context, children[0]), children[1:]
    variable = next((child for child in children if child.kind == _VARIABLE), None)
    if variable is None:
        return initial, None, children
    if context.text(variable).endswith(":"):  # of a loop over a range
        variable.end = context.tokens[context.token_before(variable.end) - 1][2]
    place = context.source.place(variable.start, variable.end)
    declaration = ccode.DeclarationStatement(declarations=declarations.group(context, [variable]), **place)
    return initial, declaration, [child for child in children if child is not variable]


def _head_as_text(context: UnitContext, start: int, end: int) -> ccode.Statement:
    place = context.source.place(start, end)
    text = context.source.text(start, end)
    if text == ";":
        return ccode.EmptyStatement(**place)
    context.find(
        "RS107", Severity.warning, "the first statement of a loop's head is copied as text", start, end, "check it by hand"
    )
    return ccode.UnknownStatement(text=text, **place)


def _semicolons(context: UnitContext, opened: int) -> list[Token]:
    """The semicolons directly within a pair of parentheses, as tokens."""
    depth, found = 0, []
    for token in context.tokens[opened : context.matching(opened)]:
        depth += (token[3] in ("(", "[", "{")) - (token[3] in (")", "]", "}"))
        if token[3] == ";" and depth == 1:
            found.append(token)
    return found


def _while(context: UnitContext, node: Node) -> ccode.Statement:
    _, declaration, children = leading(context, node)
    condition, body = (children[0], children[-1]) if len(children) > 1 else (None, children[0] if children else None)
    return ccode.While(
        form=ccode.LoopForm.whileLoop,
        endless=(condition is not None and constant_true(context, condition)) or None,
        declaration=declaration,
        condition=expression(context, condition) if condition is not None else None,
        body=statement(context, body) if body is not None else None,
        **context.source.place(node.start, node.end),
    )


def _do(context: UnitContext, node: Node) -> ccode.Statement:
    body, condition = (
        (node.children[0], node.children[-1]) if len(node.children) > 1 else (node.children[0] if node.children else None, None)
    )
    return ccode.DoWhile(
        form=ccode.LoopForm.doLoop,
        endless=(condition is not None and constant_true(context, condition)) or None,
        body=statement(context, body) if body is not None else None,
        condition=expression(context, condition) if condition is not None else None,
        **_place(context, node),
    )


def _for(context: UnitContext, node: Node) -> ccode.Statement:
    initial, condition, step, body = for_parts(context, node)
    first = statement(context, initial) if initial is not None else None
    _, declaration, _ = leading(context, node)
    return ccode.For(
        form=ccode.LoopForm.forLoop,
        endless=(condition is None and body is not None) or (condition is not None and constant_true(context, condition)) or None,
        initial=first,
        declaration=declaration,
        condition=expression(context, condition) if condition is not None else None,
        step=expression(context, step) if step is not None else None,
        body=statement(context, body) if body is not None else None,
        **context.source.place(node.start, node.end),
    )


def for_parts(context: UnitContext, node: Node) -> tuple[Node | None, Node | None, Node | None, Node | None]:
    """Initial statement, condition, step and body of a for loop; libclang gives those present without saying which they are."""
    children = [child for child in node.children if child.kind != _VARIABLE]  # of the condition, in C++
    if len(children) == 4:
        return children[0], children[1], children[2], children[3]
    i = context.token_at(node.start)
    if i + 1 >= len(context.tokens) or context.tokens[i][3] != "for":  # out of a macro
        padded = [None] * (4 - len(children)) + list(children)
        return padded[0], padded[1], padded[2], padded[3]
    limits = [*(token[1] for token in _semicolons(context, i + 1)[:2]), context.tokens[context.matching(i + 1)][1]]
    parts: list[Node | None] = [None, None, None, None]
    for child in children:
        parts[next((k for k, limit in enumerate(limits) if child.start < limit), 3) if len(limits) == 3 else 3] = child
    return parts[0], parts[1], parts[2], parts[3]


def constant_true(context: UnitContext, node: Node) -> bool:
    """Whether a condition is made of constants alone and is not zero."""
    from robosmi.transformations.t2m.c_source.literals import evaluated

    pending = [node]
    while pending:
        one = pending.pop()
        if one.kind not in _CONSTANT_KINDS:
            return False
        pending.extend(one.children)
    return bool(evaluated(context, node))


def _switch(context: UnitContext, node: Node) -> ccode.Statement:
    initial, declaration, children = leading(context, node)
    selector = expression(context, children[0]) if children else None
    body = statement(context, children[-1]) if len(children) > 1 else None
    place = context.source.place(node.start, node.end)
    return ccode.Switch(initial=initial, declaration=declaration, selector=selector, body=body, **place)


def _case(context: UnitContext, node: Node) -> ccode.Statement:
    constant = expression(context, node.children[0]) if node.children else None
    inner = statement(context, node.children[-1]) if len(node.children) > 1 else None
    return ccode.Case(constant=constant, statement=inner, **_place(context, node))


def _default(context: UnitContext, node: Node) -> ccode.Statement:
    return ccode.Default(statement=statement(context, node.children[-1]) if node.children else None, **_place(context, node))


def _label(context: UnitContext, node: Node) -> ccode.Statement:
    inner = statement(context, node.children[-1]) if node.children else None
    return ccode.Label(name=context.spelling(node.cursor), statement=inner, **_place(context, node))


def _goto(context: UnitContext, node: Node) -> ccode.Statement:
    name = context.spelling(node.children[0].cursor) if node.children else ""
    return ccode.Goto(labelName=name, **_place(context, node))


def _return(context: UnitContext, node: Node) -> ccode.Statement:
    return ccode.Return(value=expression(context, node.children[0]) if node.children else None, **_place(context, node))


def _declaration(context: UnitContext, node: Node) -> ccode.Statement:
    if context.source.language == "C++" and any(child.kind == _OTHER_DECLARATION for child in node.children):
        return _unknown(context, node)  # auto [a, b] = pair;
    return ccode.DeclarationStatement(
        declarations=declarations.group(context, node.children, node.start), **_place(context, node)
    )


def _plain(kind: type[ccode.Statement]) -> Callable[[UnitContext, Node], ccode.Statement]:
    return lambda context, node: kind(**_place(context, node))


BUILDERS: Mapping[int, StatementBuilder] = {
    cursor_kinds.LABEL_STMT: _label,
    COMPOUND: block,
    cursor_kinds.CASE_STMT: _case,
    cursor_kinds.DEFAULT_STMT: _default,
    cursor_kinds.IF_STMT: _if,
    cursor_kinds.SWITCH_STMT: _switch,
    cursor_kinds.WHILE_STMT: _while,
    cursor_kinds.DO_STMT: _do,
    FOR: _for,
    cursor_kinds.GOTO_STMT: _goto,
    cursor_kinds.CONTINUE_STMT: _plain(ccode.Continue),
    cursor_kinds.BREAK_STMT: _plain(ccode.Break),
    cursor_kinds.RETURN_STMT: _return,
    cursor_kinds.NULL_STMT: _plain(ccode.EmptyStatement),
    _DECLARATION: _declaration,
}
"""CXCursorKind -> builder, of C; what no builder is for becomes an `UnknownStatement`."""
