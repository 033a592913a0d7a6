"""Expressions of a unit with their types, for the work on integer widths: libclang's tree of the expanded text.

Types are libclang's own for the source platform; the target's version of a declared type follows its typedefs down to those
that the target's own headers define (`size_t`). `m2m.widths.width_rules` decides what to do about widths.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.queries.macros.expansion import Expanded, expanded_unit
from robosmi.transformations.queries.macros.macro_definitions import Definition, TextPlace
from robosmi.transformations.queries.numbers import Machine, Number
from robosmi.transformations.queries.typed import NumberKind, TypedExpression, raised_recursion_limit
from robosmi.transformations.t2m.c_source import type_kinds
from robosmi.transformations.t2m.c_source.expressions import BINARY_OPERATORS, UNARY_OPERATORS
from robosmi.transformations.t2m.c_source.literals import integer_value
from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import Cursor
from robosmi.transformations.t2m.c_source.parsing.invocation import VIRTUAL
from robosmi.transformations.t2m.c_source.parsing.source import ReadSource
from robosmi.transformations.t2m.c_source.parsing.translation_unit import Parsed, parse
from robosmi.transformations.t2m.c_source.parsing.tree import MAX_TREE_DEPTH, Node
from robosmi.transformations.t2m.c_source.types import enumerator_value

UNEXPOSED, PAREN, NAME, MEMBER, CALL, UNARY, BINARY, COMPOUND, CAST, LIST, CASE = (
    cursor_kinds.UNEXPOSED_EXPR,
    cursor_kinds.PAREN_EXPR,
    cursor_kinds.DECL_REF_EXPR,
    cursor_kinds.MEMBER_REF_EXPR,
    cursor_kinds.CALL_EXPR,
    cursor_kinds.UNARY_OPERATOR,
    cursor_kinds.BINARY_OPERATOR,
    cursor_kinds.COMPOUND_ASSIGNMENT_OPERATOR,
    cursor_kinds.CSTYLE_CAST_EXPR,
    cursor_kinds.INIT_LIST_EXPR,
    cursor_kinds.CASE_STMT,
)
_BOOL, _CHARS = type_kinds.BOOL, frozenset((type_kinds.CHAR_U, type_kinds.CHAR_S))
_SIGNED = frozenset(range(type_kinds.CHAR_S, type_kinds.FLOAT))
_REAL, _POINTERS, _ENUM, _TYPEDEF, _ELABORATED = (
    (type_kinds.FLOAT, type_kinds.DOUBLE, type_kinds.LONGDOUBLE),
    (type_kinds.POINTER, type_kinds.CONSTANTARRAY, type_kinds.VECTOR, type_kinds.INCOMPLETEARRAY, type_kinds.VARIABLEARRAY),
    type_kinds.ENUM,
    type_kinds.TYPEDEF,
    type_kinds.ELABORATED,
)
_FORMS = {
    NAME: "name",
    MEMBER: "member",
    CALL: "call",
    cursor_kinds.INTEGER_LITERAL: "literal",
    cursor_kinds.FLOATING_LITERAL: "real",
    cursor_kinds.STRING_LITERAL: "text",
    cursor_kinds.CHARACTER_LITERAL: "character",
    UNARY: "unary",
    cursor_kinds.ARRAY_SUBSCRIPT_EXPR: "index",
    BINARY: "binary",
    COMPOUND: "compound",
    cursor_kinds.CONDITIONAL_OPERATOR: "conditional",
    CAST: "cast",
    cursor_kinds.COMPOUND_LITERAL_EXPR: "cast",
    LIST: "list",
    cursor_kinds.CXX_UNARY_EXPR: "size",
    CASE: "case",
    cursor_kinds.IF_STMT: "if",
    cursor_kinds.SWITCH_STMT: "switch",
    cursor_kinds.WHILE_STMT: "if",
    cursor_kinds.DO_STMT: "if",
    cursor_kinds.FOR_STMT: "if",
    cursor_kinds.RETURN_STMT: "return",
    cursor_kinds.VAR_DECL: "declaration",
    cursor_kinds.FUNCTION_DECL: "function",
    cursor_kinds.FIELD_DECL: "declaration",
    cursor_kinds.LAMBDA_EXPR: "lambda",
    cursor_kinds.ENUM_CONSTANT_DECL: "declaration",
}
_FUNCTIONS = frozenset((cursor_kinds.FUNCTION_DECL, cursor_kinds.CXX_METHOD, cursor_kinds.FUNCTION_TEMPLATE))
_LITERAL, _PARAMETER, _FUNCTION = cursor_kinds.ENUM_CONSTANT_DECL, cursor_kinds.PARM_DECL, cursor_kinds.FUNCTION_DECL
MOST_DEPTH = MAX_TREE_DEPTH


def typed_unit(
    unit: ccode.SourceUnit,
    path: str,
    data: bytes,
    macros: Mapping[str, list[Definition]],
    api: ApiIndex,
    machines: tuple[Machine, Machine],
    include_dirs: Sequence[str] = (),
    defines: Sequence[str] = (),
    platform: Collection[str] = (),
    wider: Collection[str] = (),
    before: Sequence[str] = (),
    stayed: list[TextPlace] | None = None,
) -> list[TypedExpression]:
    """The top-level declarations of a unit as typed trees.

    Args:
        unit: the unit.
        path: path of its file, for includes beside it.
        data: its bytes.
        macros: the program's, by name.
        api: the source platform.
        machines: the integer models of the source and of the target.
        include_dirs, defines: as the program was read.
        platform: names of functions that adapters replace.
        wider: names of standard types that are written as wider ones.
        before: paths of headers that are included before the unit in the file that includes it.
        stayed: a list to which the macro uses are appended that were too large to expand.
    """
    expanded = expanded_unit(unit, data, macros)
    if stayed is not None:
        stayed += expanded.stayed
    source = ReadSource(path, expanded.data, expanded.data, "UTF-8", "", len(expanded.data))
    source._lines = [0]
    source.tokens = tokens(expanded.data)
    parsed = parse(source, api, include_dirs, defines)
    if parsed is not None and before and any(d.offset >= 0 and not d.about_missing for d in parsed.diagnostics):
        parsed.close()
        parsed = parse(source, api, include_dirs, defines, before)
    if parsed is None:
        return []
    try:
        with raised_recursion_limit():
            named = {name: _named_parameters(name, api) for name in platform}
            return _Reader(parsed, expanded, machines, named, wider).read()
    finally:
        parsed.close()


def _named_parameters(name: str, api: ApiIndex) -> int:
    """How many parameters a function of the platform names if it takes more than these, else -1."""
    lists = [entry.parameters for entry in api.entries(name) if "..." in entry.parameters]
    return lists[0].count(",") if lists else -1


class _Reader:
    def __init__(
        self,
        parsed: Parsed,
        expanded: Expanded,
        machines: tuple[Machine, Machine],
        platform: Mapping[str, int],
        wider: Collection[str],
    ) -> None:
        self.lib = clang.library()
        self.parsed, self.expanded, self.platform, self.wider = parsed, expanded, platform, wider
        self.here, self.there = machines
        self.data = parsed.source.data
        self.ends: dict[int, int] = {}
        self.enumerations: dict[tuple[int | None, ...], Number] = {}
        for expansion in parsed.expansions:
            self.ends.setdefault(expansion.start, expansion.end)
        self.begins: dict[int, int] = {}
        for start, end in self.ends.items():
            self.begins[end] = min(start, self.begins.get(end, start))
        self.names = {e.start: e.name for e in reversed(parsed.expansions)}
        self._kinds: dict[str, NumberKind] = {}

    def read(self) -> list[TypedExpression]:
        """All of the unit's top level."""
        return [self._made(node, 0) for node in self.parsed.nodes]

    def _made(self, node: Node, depth: int) -> TypedExpression:
        if depth > MOST_DEPTH:
            return TypedExpression("other")
        outer, converted = node, None
        bracketed, layers = False, [(node.start, node.end)]
        while len(node.children) == 1:
            inner = node.children[0]
            if node.kind == inner.kind not in (UNEXPOSED, PAREN) and (inner.start, inner.end) == (node.start, node.end):
                node = inner  # a constant expression, which the parser shows twice
                continue
            if node.kind not in (UNEXPOSED, PAREN):
                break
            if node.kind == UNEXPOSED:
                if (inner.start, inner.end) != (node.start, node.end) or inner.kind not in cursor_kinds.EXPRESSIONS:
                    break
                converted = converted or node
            else:
                bracketed = True
            node = inner
            layers.append((node.start, node.end))
        form = _FORMS.get(node.kind, "other")
        made = TypedExpression(form, bracketed=bracketed)
        if node.kind in cursor_kinds.EXPRESSIONS:
            made.kind = self.kind(node)
            made.converted = self.kind(converted) if converted is not None else made.kind
            made.places = self.expanded.places(outer.start, outer.end)
            made.inner = self.expanded.places(node.start, node.end)
            made.layers = tuple(dict.fromkeys(p for layer in dict.fromkeys(layers) for p in self.expanded.places(*layer)))
            if self._of_header_macro(node):
                made.form, made.name, made.origin = "macro", self.names.get(node.start, ""), "platform"
                return made
        if node.kind in (NAME, CALL, MEMBER):
            self._named(node, made)
        elif node.kind == UNARY:
            number = self.lib.getCursorUnaryOperatorKind(node.cursor)
            made.operator, made.postfix = UNARY_OPERATORS[number], number in (1, 2)
        elif node.kind in (BINARY, COMPOUND):
            made.operator = BINARY_OPERATORS[self.lib.getCursorBinaryOperatorKind(node.cursor)]
            if made.operator == "=":
                made.form = "assign"
        elif form in ("literal", "character", "text"):
            made.text = self.data[node.start : node.end].decode("latin-1")
            made.value = integer_value(made.text) if form == "literal" else self._value(node)
        elif form in ("function", "declaration"):
            made.name = self.lib.text(self.lib.getCursorSpelling(node.cursor))
            made.kind = self.typed(
                self.lib.getCursorResultType(node.cursor) if form == "function" else self.lib.getCursorType(node.cursor)
            )
        children = node.children if form != "lambda" else [self._captured(child) for child in node.children]
        made.children = [self._made(child, depth + 1) for child in children]
        if form == "declaration" and self.lib.getCursorType(node.cursor).kind == type_kinds.AUTO:
            made.deduced = tuple(range(len(made.children)))
        elif node.kind in _FUNCTIONS and self.lib.getCursorResultType(node.cursor).kind == type_kinds.AUTO:
            made.form = "lambda"
        if form == "case" and made.children:
            made.value = self._value(node.children[0])
        return made

    def _captured(self, node: Node) -> Node:
        """The declaration of a lambda's own variable (`[k = 300]`) in place of its name; any other node as it is."""
        lib = self.lib
        if node.kind != cursor_kinds.VARIABLE_REF:
            return node
        declared = lib.getCursorReferenced(node.cursor)
        here, there = (self.parsed.reader.offset(lib.getCursorLocation(each)) for each in (node.cursor, declared))
        return self.parsed.reader.subtree(declared) if here == there else node

    def _of_header_macro(self, node: Node) -> bool:
        """Whether an expression comes out of the body of a macro that the program does not define."""
        if not node.from_macro:
            return False
        end = self.ends.get(node.start)
        if end is not None:
            return node.end <= end
        return self.begins.get(node.end, node.start) < node.start

    def _value(self, node: Node) -> int | None:
        found = self.lib.Cursor_Evaluate(node.cursor)
        if not found:
            return None
        value = self.lib.EvalResult_getAsLongLong(found) if self.lib.EvalResult_getKind(found) == 1 else None
        self.lib.EvalResult_dispose(found)
        return value

    def _named(self, node: Node, made: TypedExpression) -> None:
        lib = self.lib
        referenced = lib.getCursorReferenced(node.cursor)
        made.name = lib.text(lib.getCursorSpelling(referenced)) or lib.text(lib.getCursorSpelling(node.cursor))
        if node.kind == MEMBER:
            made.bits = lib.getFieldDeclBitWidth(referenced)
            return
        if node.kind == CALL and node.children:
            called = lib.getCursorType(node.children[0].cursor)
            called = called if called.kind != _POINTERS[0] else lib.getPointeeType(called)
            if lib.isFunctionTypeVariadic(lib.getCanonicalType(called)):
                made.fixed = lib.getNumArgTypes(lib.getCanonicalType(called))
        if node.kind == CALL:
            made.deduced = self._deduced(referenced)
        file, _ = clang.file_offset(lib.getCursorLocation(referenced))
        name = clang.file_name(file)
        if made.name in self.platform:
            made.origin, made.fixed = "platform", self.platform[made.name]
        elif referenced.kind == _FUNCTION:
            implicit = self.parsed.reader.is_implicit(referenced)
            made.origin = "standard" if implicit or not name or name.startswith(VIRTUAL) else "program"
        else:
            made.origin = "platform" if name.startswith(VIRTUAL) else "program"
        if referenced.kind == _LITERAL and made.origin == "program":
            made.form = "enumerator"
            parent = lib.getCursorSemanticParent(referenced)
            named = self._plainly(lib.getCanonicalType(lib.getCursorType(parent)))
            made.kind = made.kind._replace(target=self._enumeration(parent), enumeration=named)

    def _deduced(self, called: Cursor) -> tuple[int, ...]:
        """The children of a call whose types a template's parameters take."""
        lib = self.lib
        template = lib.getSpecializedCursorTemplate(called)
        if template.kind in cursor_kinds.INVALID:
            return ()
        written, made = lib.getCursorType(template), lib.getCursorType(called)
        pairs = ((lib.getArgType(written, n), lib.getArgType(made, n)) for n in range(max(lib.getNumArgTypes(written), 0)))
        named = ([lib.text(lib.getTypeSpelling(each)) for each in pair] for pair in pairs)
        return tuple(place for place, (wanted, given) in enumerate(named, 1) if wanted != given)

    # ---- types

    def kind(self, node: Node) -> NumberKind:
        """The type of an expression on both platforms."""
        return self.typed(self.lib.getCursorType(node.cursor))

    def typed(self, kind: clang.Type) -> NumberKind:
        """A type on both platforms, computed once for each spelling."""
        key = f"{kind.kind} {self.lib.text(self.lib.getTypeSpelling(kind))}"
        found = self._kinds.get(key)
        if found is None:
            found = self._kinds[key] = self._typed(kind)
        return found

    def _typed(self, kind: clang.Type) -> NumberKind:
        plain = self.lib.getCanonicalType(kind)
        number = self._number(plain)
        if number is None:
            return NumberKind(pointer=plain.kind in _POINTERS)
        base = self._plainly(plain)
        enumeration = base if plain.kind == _ENUM else ""
        return NumberKind(number, plain.kind in _CHARS, target=self._target(kind), base=base, enumeration=enumeration)

    def _plainly(self, kind: clang.Type) -> str:
        """The spelling of a type without qualifiers."""
        return " ".join(w for w in self.lib.text(self.lib.getTypeSpelling(kind)).split() if w not in ("const", "volatile"))

    def _number(self, plain: clang.Type) -> Number | None:
        if plain.kind in _REAL:
            return Number(32, True, real=True)
        if plain.kind == _ENUM:
            plain = self.lib.getCanonicalType(self.lib.getEnumDeclIntegerType(self.lib.getTypeDeclaration(plain)))
        if not _BOOL <= plain.kind <= 20:
            return None
        return Number(int(self.lib.Type_getSizeOf(plain)) * 8, plain.kind in _SIGNED)

    def _target(self, kind: clang.Type) -> Number | None:
        lib = self.lib
        for _ in range(50):
            if kind.kind == _ELABORATED:
                kind = lib.Type_getNamedType(kind)
            elif kind.kind == _TYPEDEF:
                declared = lib.getTypeDeclaration(kind)
                name = lib.text(lib.getCursorSpelling(declared))
                file, _offset = clang.file_offset(lib.getCursorLocation(declared))
                own = not clang.file_name(file).startswith(VIRTUAL) and file
                if not own and name not in self.wider and (number := self.there.number(name)) is not None:
                    return number
                kind = lib.getTypedefDeclUnderlyingType(declared)
            else:
                break
        if kind.kind == _ENUM:
            return self._enumeration(lib.getTypeDeclaration(kind))
        plain = lib.getCanonicalType(kind)
        if plain.kind in _CHARS:
            return Number(8, self.there.char_signed)
        return self._number(plain)

    def _enumeration(self, declared: Cursor) -> Number:
        """The type that values of an enumeration are promoted to in C++ on the target."""
        key = tuple(declared.data)
        if key not in self.enumerations:
            self.enumerations[key] = self._promoted(declared)
        return self.enumerations[key]

    def _promoted(self, declared: Cursor) -> Number:
        values: list[int] = []

        def visitor(cursor: Cursor, parent: Cursor, data: int | None) -> int:
            if cursor.kind == _LITERAL:
                values.append(enumerator_value(self.lib, cursor))
            return 1

        clang.visit(declared, visitor)
        least, most = min(values, default=0), max(values, default=0)
        bits = max(most.bit_length(), (-least - 1).bit_length() if least < 0 else 0)
        signed = least < 0
        for width in (self.there.int_bits, self.there.long_bits, 64):
            if bits < width:
                return Number(width, True)
            if bits == width and not signed:
                return Number(width, False)
        return Number(64, True)
