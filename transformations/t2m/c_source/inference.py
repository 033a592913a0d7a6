"""The signature of a function that nothing declares, inferred from its calls.

Rules as measured on real programs (research note on libclang, section 4): the number of arguments, an argument's class
(integer, real, pointer, record), a first argument with a percent sign for a variadic function, a value that is used for a
function that is not void. A guess is a guess: the linkage says so.
"""

from __future__ import annotations

import re

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.transformations.t2m.c_source import cursor_kinds, type_kinds
from robosmi.transformations.t2m.c_source.clang import ClangLibrary, Type
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.tree import Node

_POINTER, _RECORD, _FLOATING, _ARRAYS, _FUNCTIONS = (
    type_kinds.POINTER,
    type_kinds.RECORD,
    (type_kinds.FLOAT, type_kinds.DOUBLE, type_kinds.LONGDOUBLE),
    (type_kinds.CONSTANTARRAY, type_kinds.INCOMPLETEARRAY, type_kinds.VARIABLEARRAY),
    (type_kinds.FUNCTIONNOPROTO, type_kinds.FUNCTIONPROTO),
)


class CallSite(Struct):
    """A call with its unit's context and its cursor."""

    context: UnitContext
    call: ccode.Call
    node: Node | None


class Inferred:
    """The signature inferred for a function."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.returns = "void"
        self.types: list[str] = []
        self.variadic = False

    def signature(self) -> str:
        """Return type, name and parameter types."""
        types = ", ".join([*self.types, *(["..."] if self.variadic else [])]) or "void"
        return f"{self.returns}{'' if self.returns.endswith('*') else ' '}{self.name}({types})"

    def parameters(self) -> list[ccode.Parameter]:
        """Unnamed parameters of the inferred types."""
        return [ccode.Parameter(valueType=ccode.TypeUse(spelling=t, pointerDepth=t.count("*") or None)) for t in self.types]


def infer(name: str, sites: list[CallSite]) -> Inferred:
    """The signature that all calls of a function agree with."""
    result = Inferred(name)
    rows = [_argument_types(site) for site in sites]
    counts = {len(row) for row in rows}
    shortest = min(counts, default=0)
    formats = [i for i in range(shortest) if any(_is_format(site.call.arguments[i]) for site in sites)]
    if len(counts) > 1 or formats:
        result.variadic = True
        shortest = min(shortest, formats[0] + 1) if formats else shortest
    result.types = [_common([row[i] for row in rows]) for i in range(shortest)]
    values = [v for v in (_value_type(site.call) for site in sites) if v]
    if values:
        result.returns = next((v for v in values if v != "int"), "int")
    return result


def _argument_types(site: CallSite) -> list[str]:
    node = site.node
    if node is None or node.kind != cursor_kinds.CALL_EXPR:
        return [_literal_type(a) for a in site.call.arguments]
    children = [c for c in node.children if c.kind in cursor_kinds.EXPRESSIONS]
    return [_type_name(site.context, c) for c in children[1:]]


def _type_name(context: UnitContext, node: Node) -> str:
    while node.kind in (cursor_kinds.UNEXPOSED_EXPR, cursor_kinds.PAREN_EXPR) and len(node.children) == 1:
        node = node.children[0]
    if node.kind == cursor_kinds.STRING_LITERAL:
        return "const char *"
    kind = context.lib.getCursorType(node.cursor)
    key = (kind.kind, kind.data[0], kind.data[1])
    known = context.argument_types.get(key)
    if known is None:
        known = context.argument_types[key] = _argument_type(context.lib, kind)
    return known


def _argument_type(lib: ClangLibrary, kind: Type) -> str:
    """The parameter type for an argument of this type of libclang."""
    canonical = lib.getCanonicalType(kind)
    text = lib.text(lib.getTypeSpelling(kind))
    if canonical.kind in _FLOATING:
        return "float" if canonical.kind == type_kinds.FLOAT else "double"
    if canonical.kind in _ARRAYS:
        return re.sub(r"\s*\[.*", " *", text)
    if canonical.kind in _FUNCTIONS:
        return "void *"
    if canonical.kind in (_POINTER, _RECORD):
        return "void *" if "(" in text else text
    return "int"


def _literal_type(argument: ccode.Expression) -> str:
    if isinstance(argument, ccode.StringLiteral):
        return "const char *"
    return "double" if isinstance(argument, ccode.FloatingLiteral) else "int"


def _common(types: list[str]) -> str:
    """One type that covers all given ones: a pointer before a floating type before int."""
    pointers = [t for t in types if t.endswith("*")]
    if pointers:
        return pointers[0] if len(set(pointers)) == 1 else next((p for p in pointers if "char" in p), "void *")
    return next((t for t in types if t != "int"), "int")


def _is_format(argument: ccode.Expression) -> bool:
    return isinstance(argument, ccode.StringLiteral) and "%" in str(argument.text)


def _value_type(call: ccode.Call) -> str | None:
    """The type that the value of a call must fit, None where it is not used."""
    container = call.eContainer()
    if isinstance(container, ccode.ExpressionStatement):
        return None
    if isinstance(container, ccode.For) and (container.step is call):
        return None
    if isinstance(container, ccode.Cast) and container.target is not None:
        text = str(container.target.spelling)
        return None if text == "void" else text
    if isinstance(container, ccode.Variable) and container.valueType is not None:
        return str(container.valueType.spelling).replace("const ", "") or "int"
    if isinstance(container, ccode.Assignment) and isinstance(container.left, ccode.NameReference):
        target = container.left.target
        if (
            isinstance(target, (ccode.Variable, ccode.Parameter))
            and target.valueType is not None
            and not target.valueType.arrayDims
        ):
            return str(target.valueType.spelling)
    return "int"
