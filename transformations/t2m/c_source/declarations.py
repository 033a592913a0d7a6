"""Builders of declarations: functions, variables, types, at file scope and in blocks.

Names, storage and constants come from the parser, types and declarators from the tokens (`types`). Bodies are built by
`statements`. Cursors that are no named declaration (a lone semicolon, a static assertion) give nothing.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise, takewhile

from msgspec.structs import replace

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.t2m.c_source import types
from robosmi.transformations.t2m.c_source.context import DeclarationBuilder, UnitContext
from robosmi.transformations.t2m.c_source.expressions import constructs, expression, operands
from robosmi.transformations.t2m.c_source.parsing import cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.tree import Node

PARAMETER, COMPOUND, TRY, FIELD, LITERAL, TYPE_REF = (
    cursor_kinds.PARM_DECL,
    cursor_kinds.COMPOUND_STMT,
    cursor_kinds.CXX_TRY_STMT,
    cursor_kinds.FIELD_DECL,
    cursor_kinds.ENUM_CONSTANT_DECL,
    cursor_kinds.TYPE_REF,
)
TEMPLATE_PARAMETERS = (
    cursor_kinds.TEMPLATE_TYPE_PARAMETER,
    cursor_kinds.TEMPLATE_NON_TYPE_PARAMETER,
    cursor_kinds.TEMPLATE_TEMPLATE_PARAMETER,
)


def group(context: UnitContext, nodes: Sequence[Node], start: int | None = None) -> list[ccode.Declaration]:
    """The declarations for sibling cursors, in text order.

    Args:
        context: of the unit.
        nodes: the cursors.
        start: where the one declaration begins that they all belong to; the parser says of the later ones only where they are.
    """
    starts = Counter(n.start for n in nodes if n.kind == cursor_kinds.VAR_DECL)
    made: list[ccode.Declaration] = []
    for node in _without_linkage(nodes):
        builder = context.builders.declarations.get(node.kind)
        if builder is not None and not (
            node.kind in (cursor_kinds.STRUCT_DECL, cursor_kinds.UNION_DECL, cursor_kinds.CLASS_DECL, cursor_kinds.ENUM_DECL)
            and _only_named(context, node)
        ):
            if start is not None and not made:
                node.start = start  # the parser counts a record that is named here for the first time as the one before it
            element = _variable(context, node, start) if node.kind == cursor_kinds.VAR_DECL else builder(context, node)
            if starts[node.start] > 1 and isinstance(element, ccode.Variable):
                element.shared = True
            made.append(element)
            if isinstance(element, ccode.Record) and context.source.language == "C":
                made += _enumerations_within(context, node)
    return made


def _enumerations_within(context: UnitContext, record: Node) -> list[ccode.Declaration]:
    """The enumerations defined among a record's members, whose names in C belong to the enclosing scope."""
    made: list[ccode.Declaration] = []
    for node in record.children:
        if node.kind == cursor_kinds.ENUM_DECL and context.lib.isCursorDefinition(node.cursor):
            made.append(_enumeration(context, node))
        elif node.kind in (cursor_kinds.STRUCT_DECL, cursor_kinds.UNION_DECL):
            made += _enumerations_within(context, node)
    return made


def _without_linkage(nodes: Sequence[Node]) -> Iterator[Node]:
    """The cursors, with each `extern "C" { }` block replaced by its contents."""
    pending = list(reversed(nodes))
    while pending:
        node = pending.pop()
        if node.kind == cursor_kinds.LINKAGE_SPEC:
            pending.extend(reversed(node.children))
        else:
            yield node


def _only_named(context: UnitContext, node: Node) -> bool:
    """Whether a record or enumeration is first named in another declaration, as in `struct unknown x;`."""
    if node.kind in (
        cursor_kinds.CLASS_TEMPLATE,
        cursor_kinds.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION,
    ) or context.lib.isCursorDefinition(node.cursor):
        return False
    i = context.token_at(node.end)
    return not (i < len(context.tokens) and context.tokens[i][3] == ";")


def _function(context: UnitContext, node: Node) -> ccode.Declaration:
    at = context.name_offset(node.cursor)
    name = context.spelling(node.cursor)
    context.declarators.add(at)
    stop = at if at >= 0 else node.end
    spec = types.specifiers(context, node.start, stop)
    pointer, _, depth, _ = types.declarator(context, spec, stop)
    open_ = context.token_at(stop) + 1
    close = context.matching(open_) if open_ < len(context.tokens) and context.tokens[open_][3] == "(" else -1
    end = context.tokens[close][2] if close >= 0 else node.end
    signature = _signature_text(context, spec, stop, end)
    if name.startswith("~"):
        context.declarators.add(at + 1)
    if node.kind == cursor_kinds.CONSTRUCTOR:  # what a constructor initialises looks like calls
        context.declarators.update(c.start for c in node.children if c.kind in (cursor_kinds.TYPE_REF, cursor_kinds.MEMBER_REF))
    if node.kind in (
        cursor_kinds.CONSTRUCTOR,
        cursor_kinds.DESTRUCTOR,
        cursor_kinds.CONVERSION_FUNCTION,
    ):  # constructors, destructors and conversions have no type of their own
        spec = replace(spec, text="", base="")
    result = types.type_use(
        context,
        node.cursor,
        spec,
        pointer.replace("(", "").replace(")", ""),
        "",
        depth,
        context.lib.getCursorResultType(node.cursor),
    )
    of_value = 0 <= close < len(context.tokens) - 1 and context.tokens[close + 1][3] == ")"  # a pointer to a function is given
    parameters = [parameter(context, c) for c in node.children if c.kind == PARAMETER and not (of_value and c.start >= end)]
    body = next((c for c in node.children if c.kind in (COMPOUND, TRY)), None)
    element = ccode.Function(
        name=name,
        comment=context.comment(node) if context.depth == 0 else None,
        storage=types.storage(context, node.cursor),
        variadic="..." in signature or None,
        signature=signature,
        definition=body is not None or None,
        returnType=result,
        parameters=parameters,
        body=context.builders.block(context, body) if body is not None else None,
        initializers=_member_initializers(context, node) if node.kind == cursor_kinds.CONSTRUCTOR else [],
        templateParameters=_template_parameters(context, node),
        **context.source.place(node.start, node.end),
    )
    if node.kind == cursor_kinds.CXX_METHOD:
        words = [token[3] for token in context.tokens[context.token_at(node.start) : context.token_at(node.end)]]
        if words[:1] == ["virtual"]:
            element.virtual = True
            if words[-2:] == ["=", "0"]:
                element.pure = True
    context.register(node.cursor, element)
    return element


def _member_initializers(context: UnitContext, node: Node) -> list[ccode.MemberInitializer]:
    """What stands between the colon and the body of a constructor: each member or base class with what it is given."""
    found: list[ccode.MemberInitializer] = []
    for named, value in pairwise(c for c in node.children if c.kind != PARAMETER):
        if named.kind in (TYPE_REF, cursor_kinds.MEMBER_REF) and value.kind in cursor_kinds.EXPRESSIONS:
            made = value.kind == cursor_kinds.CALL_EXPR and constructs(context, value)
            given = [c for c in operands(value) if c.end > c.start] if made else [value]
            found.append(
                ccode.MemberInitializer(
                    name=context.text(named),
                    arguments=[expression(context, each) for each in given],
                    **context.source.place(named.start, value.end),
                )
            )
    return found


def _template_parameters(context: UnitContext, node: Node) -> list[ccode.TemplateParameter]:
    """The parameters of a template, which come before all else below its cursor; none for what is no template."""
    found: list[ccode.TemplateParameter] = []
    for child in takewhile(lambda c: c.kind in TEMPLATE_PARAMETERS, node.children):
        at = context.name_offset(child.cursor)
        kind = default = None
        if child.kind == cursor_kinds.TEMPLATE_NON_TYPE_PARAMETER:
            stop = at if at >= 0 else child.end
            spec = types.specifiers(context, child.start, stop)
            pointer, dims, depth, _ = types.declarator(context, spec, stop)
            kind = types.type_use(context, child.cursor, spec, pointer, dims, depth)
            default = next((expression(context, c) for c in child.children if c.kind in cursor_kinds.EXPRESSIONS), None)
        parameter = ccode.TemplateParameter(
            name=context.spelling(child.cursor),
            valueType=kind,
            defaultValue=default,
            **context.source.place(child.start, child.end),
        )
        context.register(child.cursor, parameter)
        found.append(parameter)
    return found


def _signature_text(context: UnitContext, spec: types.Specifiers, stop: int, end: int) -> str:
    """The text of a function's type and parameter list; if it is declared after others in one declaration, without theirs.

    Args:
        context: the unit's context.
        spec: the declaration's specifiers.
        stop: offset of the name.
        end: offset after the parameter list.
    """
    tokens, first = context.tokens, context.token_at(stop)
    while first > spec.end and tokens[first - 1][3] in ("*", "const", "volatile", "("):
        first -= 1
    behind = first > spec.end and tokens[first - 1][3] == ","
    text = f"{spec.text} {context.source.text(tokens[first][1], end)}" if behind else context.source.text(spec.start, end)
    return " ".join(text.split())


def parameter(context: UnitContext, node: Node) -> ccode.Parameter:
    """A parameter of a function or a lambda."""
    at = context.name_offset(node.cursor)
    name = context.spelling(node.cursor)
    stop = at if at >= 0 and name else node.end
    spec = types.specifiers(context, node.start, stop)
    pointer, dims, depth, _ = types.declarator(context, spec, stop)
    if at >= 0:
        context.declarators.add(at)
    use = types.type_use(context, node.cursor, spec, pointer, dims, depth)
    value = next((c for c in reversed(node.children) if c.kind in cursor_kinds.EXPRESSIONS), None)
    given = value is not None and at >= 0 and context.tokens[context.token_before(value.start)][3] == "="
    element = ccode.Parameter(
        name=name or None,
        valueType=use,
        defaultValue=expression(context, value) if value is not None and given else None,
        **context.source.place(node.start, node.end),
    )
    context.register(node.cursor, element)
    return element


def _variable(context: UnitContext, node: Node, start: int | None = None) -> ccode.Declaration:
    at = context.name_offset(node.cursor)
    stop = at if at >= 0 else node.end
    spec = types.specifiers(context, node.start if start is None else start, stop)
    pointer, dims, depth, after = types.declarator(context, spec, stop)
    use = types.type_use(context, node.cursor, spec, pointer, dims, depth)
    context.declarators.add(at)
    initial: ccode.Expression | None = None
    written = after < len(context.tokens) and context.tokens[after][3] in ("=", "(", "{") and node.kind == cursor_kinds.VAR_DECL
    assigned = written and context.tokens[after][3] == "="
    if written:
        begin = context.tokens[after][1]
        value = next(
            (c for c in reversed(node.children) if c.kind in cursor_kinds.EXPRESSIONS and (c.start >= begin or c.from_macro)),
            None,
        )
        called = node.children[-1] if node.children and context.source.language == "C++" else None
        if called is not None and called.kind == cursor_kinds.CALL_EXPR and called.start == at and not assigned:
            initial = expression(context, called)  # Lamp lamp(8);
        elif value is not None:
            initial = expression(context, value)
        elif assigned:
            start, end = _lost_initializer(context, after)
            initial = ccode.UnknownExpression(text=context.source.text(start, end), **context.source.place(start, end))
    element = ccode.Variable(
        name=context.spelling(node.cursor),
        comment=context.comment(node) if context.depth == 0 else None,
        storage=types.storage(context, node.cursor),
        initialised=assigned or None,
        valueType=use,
        initializer=initial,
        **context.source.place(node.start, node.end),
    )
    context.register(node.cursor, element)
    return element


def _lost_initializer(context: UnitContext, equals: int) -> tuple[int, int]:
    """The range of an initialiser that libclang dropped."""
    i = equals + 1
    start = end = context.tokens[equals][2]
    while i < len(context.tokens) and context.tokens[i][3] not in (",", ";"):
        close = context.matching(i) if context.tokens[i][3] in ("(", "[", "{") else i
        start = context.tokens[i][1] if end == context.tokens[equals][2] else start
        end = context.tokens[close][2]
        i = close + 1
    return start, end


def _typedef(context: UnitContext, node: Node) -> ccode.Declaration:
    at = context.name_offset(node.cursor)
    stop = at if at >= 0 else node.end
    spec = types.specifiers(context, node.start, stop)
    pointer, dims, depth, _ = types.declarator(context, spec, stop)
    context.declarators.add(at)
    use = types.type_use(context, node.cursor, spec, pointer, dims, depth)
    element = ccode.Typedef(name=context.spelling(node.cursor), aliased=use, **context.source.place(node.start, node.end))
    context.register(node.cursor, element)
    return element


def _alias(context: UnitContext, node: Node) -> ccode.Declaration:
    """`using Name = type;`, which is a typedef in another order."""
    name = context.token_at(context.name_offset(node.cursor))
    equals = next((i for i in range(name, len(context.tokens)) if context.tokens[i][3] == "="), name)
    use = types.written_type(context, context.tokens[equals][2], node.end, context.lib.getCursorType(node.cursor))
    element = ccode.Typedef(name=context.spelling(node.cursor), aliased=use, **context.source.place(node.start, node.end))
    context.register(node.cursor, element)
    return element


def _base(context: UnitContext, node: Node) -> ccode.TypeUse:
    """A base class, without `public` and the like."""
    named = next((c for c in node.children if c.kind in (TYPE_REF, cursor_kinds.TEMPLATE_REF)), node)
    return types.written_type(context, named.start, node.end, context.lib.getCursorType(node.cursor))


def _record(context: UnitContext, node: Node) -> ccode.Declaration:
    parameters = _template_parameters(context, node)
    friends = [c for friend in node.children if friend.kind == cursor_kinds.FRIEND_DECL for c in friend.children]
    context.declarators.update(context.name_offset(c.cursor) for c in friends)  # declarations that look like calls
    inside = [*node.children, *(c for c in friends if context.lib.isCursorDefinition(c.cursor))]
    fields = [_field(context, c) for c in node.children if c.kind == FIELD]
    methods = [
        m
        for c in sorted(inside, key=lambda each: each.start)
        if c.kind
        in (
            cursor_kinds.FUNCTION_DECL,
            cursor_kinds.CXX_METHOD,
            cursor_kinds.CONSTRUCTOR,
            cursor_kinds.DESTRUCTOR,
            cursor_kinds.CONVERSION_FUNCTION,
            cursor_kinds.FUNCTION_TEMPLATE,
        )
        and isinstance(m := _function(context, c), ccode.Function)
    ]
    kind = {cursor_kinds.STRUCT_DECL: "structType", cursor_kinds.UNION_DECL: "unionType"}.get(node.kind, "classType")
    if node.kind in (cursor_kinds.CLASS_TEMPLATE, cursor_kinds.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION):
        first = context.tokens[_keyword(context, node)][3]
        kind = {"struct": "structType", "union": "unionType"}.get(first, kind)
    element = ccode.Record(
        name=_tag(context, node),
        recordKind=enum_literal(ccode.RecordKind, kind),
        bases=[_base(context, c) for c in node.children if c.kind == cursor_kinds.CXX_BASE_SPECIFIER],
        templateParameters=parameters,
        fields=fields,
        staticMembers=[
            m
            for c in node.children
            if c.kind == cursor_kinds.VAR_DECL and isinstance(m := _static_member(context, c), ccode.Variable)
        ],
        methods=methods,
        **context.source.place(node.start, node.end),
    )
    context.register(node.cursor, element)
    return element


def _static_member(context: UnitContext, node: Node) -> ccode.Declaration:
    """A static data member; names mean its definition outside of the class if it has no value here."""
    element = _variable(context, node)
    if isinstance(element, ccode.Variable) and element.initializer is None:
        del context.declared[context.pointer(node.cursor)]
    return element


def _tag(context: UnitContext, node: Node) -> str | None:
    i = _keyword(context, node) + 1
    if i < len(context.tokens) and context.tokens[i - 1][3] == "enum" and context.tokens[i][3] in ("class", "struct"):
        i += 1
    while i < len(context.tokens) and context.tokens[i][3] in ("__attribute__", "__attribute"):
        i = context.matching(i + 1) + 1
    return context.tokens[i][3] if i < len(context.tokens) and context.tokens[i][0] == "name" and not node.from_macro else None


def _keyword(context: UnitContext, node: Node) -> int:
    """The index of the token `struct`, `class`, `union` or `enum`, after any template parameters."""
    i = context.token_at(node.start)
    if i < len(context.tokens) and context.tokens[i][3] == "template":
        depth = 0
        while i + 1 < len(context.tokens):
            i += 1
            text = context.tokens[i][3]
            depth += (text == "<") - (text == ">") - 2 * (text == ">>")
            if depth <= 0:
                break
        i += 1
    return min(i, len(context.tokens) - 1)


def _field(context: UnitContext, node: Node) -> ccode.Field:
    at = context.name_offset(node.cursor)
    stop = at if at >= 0 else node.end
    spec = types.specifiers(context, node.start, stop)
    pointer, dims, depth, after = types.declarator(context, spec, stop)
    context.declarators.add(at)
    width = context.lib.getFieldDeclBitWidth(node.cursor)
    use = types.type_use(context, node.cursor, spec, pointer, dims, depth)
    name = context.spelling(node.cursor)
    written = width <= 0 and at >= 0 and after < len(context.tokens) and context.tokens[after][3] in ("=", "{")
    begin = context.tokens[after][1] if written else node.end
    value = next((c for c in reversed(node.children) if c.kind in cursor_kinds.EXPRESSIONS and c.start >= begin), None)
    element = ccode.Field(
        name=name or None,
        valueType=use,
        bitWidth=width if width > 0 else None,
        initializer=expression(context, value) if value is not None else None,
        **context.source.place(node.start, node.end),
    )
    context.register(node.cursor, element)
    return element


def _enumeration(context: UnitContext, node: Node) -> ccode.Declaration:
    literals = []
    for child in node.children:
        if child.kind == LITERAL:
            value = types.enumerator_value(context.lib, child.cursor)
            literal = ccode.EnumerationLiteral(
                name=context.spelling(child.cursor), value=value, **context.source.place(child.start, child.end)
            )
            context.register(child.cursor, literal)
            literals.append(literal)
    element = ccode.Enumeration(name=_tag(context, node), literals=literals, **context.source.place(node.start, node.end))
    context.register(node.cursor, element)
    return element


def _namespace(context: UnitContext, node: Node) -> ccode.Declaration:
    return ccode.Namespace(
        name=context.spelling(node.cursor),
        declarations=group(context, node.children),
        **context.source.place(node.start, node.end),
    )


BUILDERS: Mapping[int, DeclarationBuilder] = {
    cursor_kinds.STRUCT_DECL: _record,
    cursor_kinds.UNION_DECL: _record,
    cursor_kinds.CLASS_DECL: _record,
    cursor_kinds.ENUM_DECL: _enumeration,
    cursor_kinds.FUNCTION_DECL: _function,
    cursor_kinds.VAR_DECL: _variable,
    cursor_kinds.TYPEDEF_DECL: _typedef,
    cursor_kinds.TYPE_ALIAS_DECL: _alias,
    cursor_kinds.CXX_METHOD: _function,
    cursor_kinds.NAMESPACE: _namespace,
    cursor_kinds.CONSTRUCTOR: _function,
    cursor_kinds.DESTRUCTOR: _function,
    cursor_kinds.CONVERSION_FUNCTION: _function,
    cursor_kinds.FUNCTION_TEMPLATE: _function,
    cursor_kinds.CLASS_TEMPLATE: _record,
    cursor_kinds.CLASS_TEMPLATE_PARTIAL_SPECIALIZATION: _record,
}
"""CXCursorKind -> builder."""
