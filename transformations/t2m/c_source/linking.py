"""Links uses to declarations once all units are built, and makes the externals of a program.

A name of the program's own is linked to its element: by the parser's declaration, or by name for a function that is called
before it is declared or stands in another unit. Any other name becomes one external a program.

The signature of a function that nothing declares is inferred from its calls, by rules measured on real programs with libclang:
the number of arguments, an argument's class (integer, real, pointer, record), a first argument with a percent sign for a variadic
function, a value that is used for a function that is not void. The linkage marks it as a guess.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.construct import connect
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.lexer import KEYWORDS, TYPE_WORDS
from robosmi.transformations.queries.source_text import HEADERS
from robosmi.transformations.t2m.c_source import type_kinds
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.macros import header_of
from robosmi.transformations.t2m.c_source.parsing import clang, cursor_kinds
from robosmi.transformations.t2m.c_source.parsing.clang import ClangLibrary, Cursor, Type
from robosmi.transformations.t2m.c_source.parsing.tree import Node

_STRENGTH = ["constantUse", "indexedUse", "writtenUse", "typeUse", "called"]
FUNCTION_KINDS = (cursor_kinds.FUNCTION_DECL, cursor_kinds.CXX_METHOD)
_CLASS = re.compile(r"(\w+)\s*(?:<[^()]*>\s*)?::\s*~?\w+\s*$")
"""The class in front of a method's name."""
_TAGS = frozenset({"struct", "union", "enum", "class"})


class Linker:
    """Links the units of one program.

    Args:
        contexts: the contexts of the units, in order.
        declarations: the declarations at file scope of each unit.
    """

    def __init__(self, contexts: list[UnitContext], declarations: list[list[ccode.Declaration]]) -> None:
        self.contexts = contexts
        self.externals: dict[tuple[str, str], ccode.Declaration] = {}
        self.own_functions: list[dict[str, ccode.Function]] = [_functions(d) for d in declarations]
        self.own_types = [_types(c) for c in contexts]
        self._included = [{os.path.abspath(path) for path in context.parsed.inclusions[1:]} for context in contexts]
        """For each unit the files that are read with it."""
        read = set().union(*self._included)
        self._shared = [c.source.path.lower().endswith(HEADERS) or os.path.abspath(c.source.path) in read for c in contexts]
        """For each unit whether it is a header: by its file name, or because another unit includes it."""
        self._header_values = _values_of_headers(self._shared, declarations)
        self._numbers = {os.path.abspath(context.source.path): number for number, context in enumerate(contexts)}
        self._headers_read: dict[tuple[int, int], int | None] = {}
        """(number of a unit, handle of a file read with it) -> number of the unit of that file, None if it is none."""
        self._uses: dict[str, str] = {}
        self._sites: dict[str, list[CallSite]] = {}
        self._headers: dict[str, tuple[str, str]] = {}
        self._defined: set[str] = set()

    def run(self) -> list[ccode.Declaration]:
        """Link everything; the externals, sorted by kind and name."""
        for number, context in enumerate(self.contexts):
            self._link_calls(number, context)
            self._link_names(number, context)
            self._link_types(number, context)
        functions: list[ccode.Declaration] = []
        for name in sorted(self._sites):
            function = self._external_function(name, self._sites[name])
            functions.append(function)
            for site in self._sites[name]:
                connect(site.call, "callee", function)
        symbols = [self.externals[key] for key in sorted(self.externals)]
        return functions + symbols

    def _link_calls(self, number: int, context: UnitContext) -> None:
        nodes = {id(call): node for call, node, _ in context.call_nodes}
        for call, cursor in context.calls:
            element = context.declared.get(context.pointer(cursor)) if cursor is not None else None
            function = element if isinstance(element, ccode.Function) else None
            name = str(call.calleeName)
            if function is None or not function.definition:
                whole = qualified(context.lib, cursor, name)
                function = self._own(number, whole) or self._of_unit(number, context, cursor, whole) or function
            if function is not None:
                connect(call, "callee", function)
                continue
            declared = cursor is not None and not context.parsed.reader.is_implicit(cursor)
            header = (header_of(context, cursor) if declared else None) or ""
            if header and name not in self._headers:
                self._headers[name] = (header, self._declared_signature(context, cursor, name))
                if cursor is not None and context.api.header_kind(header) is None and context.lib.isCursorDefinition(cursor):
                    self._defined.add(name)
            elif cursor is not None and name not in self._headers and name not in context.parsed.prelude.functions:
                self._headers[name] = ("", self._builtin_signature(context, cursor, name))
            self._sites.setdefault(name, []).append(CallSite(context, call, nodes.get(id(call))))

    def _own(self, number: int, name: str) -> ccode.Function | None:
        """The program's own function of that `qualified` name: a visible definition (the unit's own first), else a prototype."""
        own = self.own_functions[number].get(name)
        if own is not None and own.definition:
            return own
        for functions in self.own_functions:
            function = functions.get(name)
            if function is not None and function.definition and function.storage.name != "staticStorage":
                return function
        if own is not None and own.storage.name != "staticStorage":
            return own
        return self._static_of_header(number, name) or own

    def _static_of_header(self, number: int, name: str) -> ccode.Function | None:
        """The static function of that name if just one header that the unit includes defines one.

        A header may call what another one defines that is included before it.
        """
        found = [
            functions[name]
            for header, functions in enumerate(self.own_functions)
            if name in functions and functions[name].definition and self._shared[header] and self._meets(number, header)
        ]
        return found[0] if len(found) == 1 else None

    def _meets(self, number: int, header: int) -> bool:
        """Whether a unit may have the names of a header: it includes it, or is one itself."""
        return self._shared[number] or os.path.abspath(self.contexts[header].source.path) in self._included[number]

    def _of_unit(self, number: int, context: UnitContext, cursor: Cursor | None, name: str) -> ccode.Function | None:
        """The function of that name in the program's header that libclang resolved the call to; this finds static ones too."""
        if cursor is None:
            return None
        file, _ = clang.file_offset(context.lib.getCursorLocation(cursor))
        if file is None or file == context.parsed.reader.file:
            return None
        if (number, file) not in self._headers_read:
            self._headers_read[number, file] = self._numbers.get(os.path.abspath(clang.file_name(file)))
        header = self._headers_read[number, file]
        return self.own_functions[header].get(name) if header is not None else None

    @staticmethod
    def _declared_signature(context: UnitContext, cursor: Cursor | None, name: str) -> str:
        if cursor is None or cursor.kind not in FUNCTION_KINDS:
            return f"{name}(...)"
        text = context.lib.text(context.lib.getCursorPrettyPrinted(cursor, None))
        text = text.partition("{")[0].strip()
        for word in ("extern ", "static ", "inline ", "__inline__ "):
            text = text.removeprefix(word)
        return text

    @staticmethod
    def _builtin_signature(context: UnitContext, cursor: Cursor, name: str) -> str:
        """libclang's built-in signature of a library function, empty if it has none."""
        if cursor.kind not in FUNCTION_KINDS:
            return ""
        kind: str = context.lib.text(context.lib.getTypeSpelling(context.lib.getCursorType(cursor)))
        result, open_, rest = kind.partition("(")
        return f"{result}{name}({rest}" if open_ and rest != ")" else ""

    def _external_function(self, name: str, sites: list[CallSite]) -> ccode.Function:
        header, signature = self._headers.get(name, ("", ""))
        inferred = infer(name, sites)
        if signature:
            return ccode.Function(
                name=name,
                linkage=ccode.Linkage.declaredInHeader if header else ccode.Linkage.inferred,
                header=header or None,
                signature=signature,
                variadic="..." in signature or None,
                definition=name in self._defined,
                returnType=ccode.TypeUse(spelling=signature.partition(f"{name}(")[0].strip() or inferred.returns),
                parameters=inferred.parameters(),
            )
        return ccode.Function(
            name=name,
            linkage=ccode.Linkage.inferred,
            signature=inferred.signature(),
            variadic=inferred.variadic or None,
            returnType=ccode.TypeUse(spelling=inferred.returns),
            parameters=inferred.parameters(),
        )

    def _link_names(self, number: int, context: UnitContext) -> None:
        for reference, cursor in context.references:
            element = context.declared.get(context.pointer(cursor))
            name = str(reference.name)
            if isinstance(element, ccode.Function) and not element.definition:
                element = self._own(number, name) or element
            if element is None:
                element = self._own(number, name) or self._of_header(name)
            if element is None:
                element = self._external_symbol(context, reference, cursor)
            if element is not None:
                connect(reference, "target", element)

    def _of_header(self, name: str) -> ccode.Declaration | None:
        """The variable or enumerator of that name that an own header declares, or the definition of that variable."""
        return self._header_values.get(name)

    def _external_symbol(self, context: UnitContext, reference: ccode.NameReference, cursor: Cursor) -> ccode.Declaration | None:
        name = str(reference.name)
        header = header_of(context, cursor)
        if header is None and not context.parsed.prelude.declares(name):
            return None
        return self._symbol(name, header or "", _use(reference))

    def _symbol(self, name: str, header: str, use: str) -> ccode.Declaration:
        known = self.externals.get(("symbol", name))
        if known is None:
            linkage = ccode.Linkage.declaredInHeader if header else ccode.Linkage.inferred
            known = ccode.ExternalSymbol(
                name=name, linkage=linkage, header=header or None, use=enum_literal(ccode.SymbolUse, use)
            )
            self.externals[("symbol", name)] = known
            self._uses[name] = use
        elif _STRENGTH.index(use) > _STRENGTH.index(self._uses[name]) and isinstance(known, ccode.ExternalSymbol):
            self._uses[name] = use
            known.use = enum_literal(ccode.SymbolUse, use)
        return known

    def _link_types(self, number: int, context: UnitContext) -> None:
        headers: dict[str, str] | None = None
        for use, name in context.type_uses:
            own = self._own_type(number, name, use, context.source.language)
            if own is None and name not in KEYWORDS and name not in TYPE_WORDS:
                if headers is None:
                    headers = _type_headers(context)
                own = self._symbol(name, headers.get(name, ""), "typeUse")
            if own is not None:
                connect(use, "declaration", own)

    def _own_type(self, number: int, name: str, use: ccode.TypeUse, language: str) -> ccode.Declaration | None:
        """The type of that name that the unit, else one of the program's headers, declares: by a tag or by a typedef."""
        tag = not _TAGS.isdisjoint(use.spelling.split())
        headers = (t for t, shared in zip(self.own_types, self._shared, strict=True) if shared)
        for types in (self.own_types[number], *headers):
            found = types.get((name, tag)) or (types.get((name, True)) if language == "C++" else None)
            if found is not None:
                return found
        return None


def _functions(declarations: Iterable[ccode.Declaration]) -> dict[str, ccode.Function]:
    """The functions by their names, those of methods with their classes."""
    found: dict[str, ccode.Function] = {}
    for declaration in declarations:
        if isinstance(declaration, ccode.Function):
            of_class = _CLASS.search(str(declaration.signature or "").partition("(")[0])
            name = f"{of_class[1]}::{declaration.name}" if of_class is not None else str(declaration.name)
            if declaration.definition or name not in found:
                found[name] = declaration
    return found


def qualified(library: ClangLibrary, cursor: Cursor | None, name: str) -> str:
    """The name of a function that is called; that of a method with its class, since other classes may have one of that name.

    Args:
        library: libclang.
        cursor: the function's declaration, if the parser knows it.
        name: its own name.
    """
    if cursor is None or cursor.kind != cursor_kinds.CXX_METHOD:
        return name
    return f"{library.text(library.getCursorSpelling(library.getCursorSemanticParent(cursor)))}::{name}"


def _values_of_headers(
    shared: Iterable[bool], declarations: Iterable[Iterable[ccode.Declaration]]
) -> dict[str, ccode.Declaration]:
    """Variables and enumerators that the program's headers declare, by name; a variable's definition takes precedence."""
    found: dict[str, ccode.Declaration] = {}
    defined: dict[str, ccode.Declaration] = {}
    for header, declared in zip(shared, declarations, strict=True):
        for each in declared:
            if isinstance(each, ccode.Variable) and each.name:
                if header:
                    found.setdefault(each.name, each)
                elif each.storage.name == "unspecified":
                    defined.setdefault(each.name, each)
            elif header and isinstance(each, ccode.Enumeration):
                found.update((str(literal.name), literal) for literal in each.literals)
    return {name: defined.get(name, each) for name, each in found.items()}


def _types(context: UnitContext) -> dict[tuple[str, bool], ccode.Declaration]:
    """The types that a unit declares, by (name, whether it is a tag)."""
    kinds = (ccode.Typedef, ccode.Record, ccode.Enumeration, ccode.TemplateParameter)
    found = (d for d in context.declared.values() if isinstance(d, kinds) and d.name)
    return {(str(d.name), not isinstance(d, (ccode.Typedef, ccode.TemplateParameter))): d for d in found}


def _type_headers(context: UnitContext) -> dict[str, str]:
    """Name of a type -> the header that declares it, for the types that the file uses."""
    found: dict[str, str] = {}
    pending = list(context.parsed.nodes)
    while pending:
        node = pending.pop()
        if node.kind == cursor_kinds.TYPE_REF:  # TYPE_REF
            name = context.source.text(node.start, node.end)
            if name not in found:
                found[name] = header_of(context, context.lib.getCursorReferenced(node.cursor)) or ""
        pending.extend(node.children)
    return found


def _use(reference: ccode.NameReference) -> str:
    container = reference.eContainer()
    if isinstance(container, ccode.Assignment) and container.left is reference:
        return "writtenUse"
    if isinstance(container, ccode.Index) and container.array is reference:
        return "indexedUse"
    if isinstance(container, ccode.Unary) and str(container.operator) in ("++", "--", "&"):
        return "writtenUse"
    return "constantUse"


_POINTER, _RECORD, _FLOATING, _ARRAYS, _FUNCTIONS = (
    type_kinds.POINTER,
    type_kinds.RECORD,
    (type_kinds.FLOAT, type_kinds.DOUBLE, type_kinds.LONGDOUBLE),
    (type_kinds.CONSTANTARRAY, type_kinds.INCOMPLETEARRAY, type_kinds.VARIABLEARRAY),
    (type_kinds.FUNCTIONNOPROTO, type_kinds.FUNCTIONPROTO),
)


# ---- inferred signatures


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
