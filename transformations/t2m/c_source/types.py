"""Type uses and declarators: the type as written comes from the tokens, its meaning on the source platform from libclang.

libclang alone would lose pointers and names of undeclared types, and the tokens alone know no typedef. `declarations` makes
declarations of them.
"""

from __future__ import annotations

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.lexer import QUALIFIERS, STORAGE_WORDS, STORAGE_WORDS_OF_CXX, TYPE_WORDS
from robosmi.transformations.t2m.c_source import type_kinds
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.parsing.clang import ClangLibrary, Cursor, Type

_SIGNED = frozenset(
    {
        type_kinds.CHAR_S,
        type_kinds.SCHAR,
        type_kinds.SHORT,
        type_kinds.INT,
        type_kinds.LONG,
        type_kinds.LONGLONG,
        type_kinds.INT128,
        type_kinds.FLOAT,
        type_kinds.DOUBLE,
        type_kinds.LONGDOUBLE,
    }
)  # CXTypeKind: Char_S to LongDouble
_TYPE_OF = frozenset(["typeof", "__typeof__", "__typeof"])
"""What GNU C calls the type of an expression with."""
_ARITHMETIC = frozenset(range(3, 24))
_POINTER, _ENUM, _DOUBLE = (
    type_kinds.POINTER,
    type_kinds.ENUM,
    frozenset({type_kinds.DOUBLE, type_kinds.LONGDOUBLE}),
)
_STORAGES = {0: "unspecified", 1: "unspecified", 2: "externStorage", 3: "staticStorage", 6: "autoStorage", 7: "registerStorage"}


_UNSIGNED = frozenset(range(type_kinds.BOOL, type_kinds.CHAR_S))


class Specifiers(Struct):
    """The specifiers before the declarators of a declaration.

    Attributes:
        text: the type, without storage words, a record's body and attribute macros.
        end: index of the first token after them.
        start: offset of the first token of the type.
        base: the tag or typedef name that they name, or empty.
        constant: whether `const` is among them.
    """

    text: str
    end: int
    start: int
    base: str
    constant: bool


def enumerator_value(lib: ClangLibrary, literal: Cursor) -> int:
    """The value of a constant of an enumeration; libclang extends the sign of one that fills its unsigned type."""
    value = int(lib.getEnumConstantDeclValue(literal))
    if value >= 0:
        return value
    kind = lib.getCanonicalType(lib.getEnumDeclIntegerType(lib.getCursorSemanticParent(literal)))
    return value & (1 << 8 * int(lib.Type_getSizeOf(kind))) - 1 if kind.kind in _UNSIGNED else value


def storage(context: UnitContext, cursor: Cursor) -> ccode.Storage:
    """Storage class of a declaration."""
    literal: ccode.Storage = enum_literal(ccode.Storage, _STORAGES.get(context.lib.Cursor_getStorageClass(cursor), "unspecified"))
    return literal


def specifiers(context: UnitContext, offset: int, stop: int) -> Specifiers:
    """The specifiers that start at an offset; never reads beyond the offset `stop` (the declared name)."""
    tokens = context.tokens
    i = context.token_at(offset)
    words: list[str] = []
    base, seen, start = "", False, -1
    cxx = context.source.language == "C++"
    while i < len(tokens) and tokens[i][1] < stop:
        kind, begin, _, text = tokens[i]
        if kind != "name":
            break
        if text == "template" and not words:
            i = _behind_template(context, i)
            continue
        if text == "auto" and cxx:
            words.append(text)
            start, seen, i = (begin if start < 0 else start), True, i + 1
            continue
        if text in STORAGE_WORDS or text in context.attribute_macros or (text in STORAGE_WORDS_OF_CXX and cxx):
            i += 1
            continue
        if text in ("__attribute__", "__attribute", "_Alignas"):
            i = context.matching(i + 1) + 1
            continue
        if text in QUALIFIERS:
            words.append(text)
        elif text in TYPE_WORDS:
            words.append(text)
            seen = True
        elif text in ("struct", "union", "enum"):
            words.append(text)
            seen = True
            if i + 1 < len(tokens) and tokens[i + 1][0] == "name":
                i += 1
                base = tokens[i][3]
                words.append(base)
            if i + 1 < len(tokens) and tokens[i + 1][3] == "{":
                i = context.matching(i + 1)
        elif not seen:
            following = tokens[i + 1][3] if i + 1 < len(tokens) else ""
            if following in TYPE_WORDS or following in STORAGE_WORDS or _attribute(context, i, stop):
                i += 1  # a macro that nobody knows stands for an attribute or a storage class
                continue
            base, seen = text, True
            if cxx:
                text, i = _qualified(context, i, stop)
            words.append(text)
        else:
            break
        start = begin if start < 0 else start
        i += 1
    constant = "const" in words or "__const" in words
    return Specifiers(" ".join(words) or "int", i, start if start >= 0 else offset, base, constant)


def _qualified(context: UnitContext, number: int, stop: int) -> tuple[str, int]:
    """A C++ name with its qualifiers and template arguments (`std::vector<int>`), and the index of its last token."""
    tokens, last = context.tokens, number
    while last + 1 < len(tokens) and tokens[last + 1][1] < stop:
        following = [t[3] for t in tokens[last + 1 : last + 4]]
        if following[:2] == [":", ":"] and len(following) == 3 and tokens[last + 3][1] < stop and tokens[last + 3][0] == "name":
            last += 3
        elif following[0] == "<":
            behind = _behind_template(context, last)
            if behind <= last + 1 or tokens[behind - 1][1] >= stop:
                break
            last = behind - 1
        else:
            break
    return " ".join(context.source.text(tokens[number][1], tokens[last][2]).split()), last


def last_of_name(context: UnitContext, start: int, end: int) -> int:
    """The offset of the last part of a qualified name, such as `abort` in `std::abort()`; in C the start itself."""
    if context.source.language != "C++":
        return start
    number = context.token_at(start)
    while number + 1 < len(context.tokens) and context.tokens[number][3] in (":", "new"):
        number += 1
    _, last = _qualified(context, number, end)
    while last > number and context.tokens[last][0] != "name":
        last -= 1
    return context.tokens[last][1] if last < len(context.tokens) else start


def _behind_template(context: UnitContext, number: int) -> int:
    """The index of the token after `template <...>`."""
    depth, i = 0, number + 1
    while i < len(context.tokens):
        text = context.tokens[i][3]
        depth += (text == "<") - (text == ">") - 2 * (text == ">>")
        i += 1
        if depth <= 0:
            break
    return i


def _attribute(context: UnitContext, number: int, stop: int) -> bool:
    """Whether a token is a macro before the type, such as INLINE in `INLINE count_t f(void)`."""
    _, begin, _, _ = context.tokens[number]
    if not context.expansions_at(begin) or number + 1 >= len(context.tokens):
        return False
    kind, following, _, text = context.tokens[number + 1]
    return kind == "name" and following < stop and text not in QUALIFIERS and not context.expansions_at(following)


_BEFORE_A_NAME = frozenset(["*", "(", "const", "volatile", "restrict", "^", "&", "&&"]) | {
    f"__{word}{end}" for word in ("const", "volatile", "restrict") for end in ("", "__")
}
"""Tokens that may stand between a type and a name; GNU C also spells qualifiers with underscores."""


def declarator(context: UnitContext, spec: Specifiers, name_offset: int) -> tuple[str, str, int, int]:
    """The declarator around a name.

    Returns:
        The pointer part as written (`*`, `(*)`, ...), the array dimensions, the number of pointer levels, and the number of the
        token behind the declarator.
    """
    tokens = context.tokens
    name = context.token_at(name_offset)
    first = name
    while first - 1 >= spec.end and tokens[first - 1][3] in _BEFORE_A_NAME:
        first -= 1
    before = [t[3] for t in tokens[first:name]]
    i = name + 1 if name < len(tokens) and tokens[name][1] == name_offset and tokens[name][0] == "name" else name
    dims, after = "", ""
    opened = before.count("(")
    while i < len(tokens):
        text = tokens[i][3]
        if text == "[":
            close = context.matching(i)
            dims += context.source.text(tokens[i][1], tokens[close][2])
            i = close + 1
        elif text == ")" and opened:
            opened -= 1
            after += ")"
            i += 1
        elif text == "(" and "(" in before and not opened:
            close = context.matching(i)
            after += " ".join(context.source.text(tokens[i][1], tokens[close][2]).split())
            i = close + 1
        else:
            break
    return "".join(w if w in "*(" else f" {w}" for w in before) + after, dims, before.count("*"), i


def type_use(
    context: UnitContext,
    cursor: Cursor,
    spec: Specifiers,
    pointer: str = "",
    dims: str = "",
    depth: int = 0,
    of: Type | None = None,
) -> ccode.TypeUse:
    """The type of a declaration.

    Args:
        cursor: the declaration.
        spec: its specifiers.
        pointer: pointer part of the declarator.
        dims: array dimensions as written.
        depth: pointer levels.
        of: the parser's type where it is not the cursor's own (the value of a function).
    """
    if (waiting := context.later(ccode.TypeUse, type_use, cursor, spec, pointer, dims, depth, of)) is not None:
        return waiting
    if spec.base in _TYPE_OF:
        return read_type(context, of or context.lib.getCanonicalType(context.lib.getCursorType(cursor)))
    spelling = f"{spec.text} {pointer}".strip() if pointer else spec.text
    return _type_use(context, of or context.lib.getCursorType(cursor), spelling, spec.base, dims, depth, spec.constant)


def written_type(context: UnitContext, start: int, end: int, kind: Type) -> ccode.TypeUse:
    """A type in parentheses (a cast, sizeof), given by the range inside them and the parser's type."""
    text = " ".join(context.source.text(start, end).split())
    spec = specifiers(context, start, end)
    dims = text[text.index("[") :] if "[" in text else ""
    return _type_use(context, kind, text, spec.base, dims, text.count("*"), spec.constant)


def deduced(context: UnitContext, kind: Type) -> ccode.TypeUse:
    """The type of a lambda's own variable, which is that of its value or a reference to it."""
    refers = context.lib.text(context.lib.getTypeSpelling(kind)).endswith("&")
    return _type_use(context, kind, "auto &" if refers else "auto", "", "", 0, constant=False)


def read_type(context: UnitContext, kind: Type) -> ccode.TypeUse:
    """A type that is not written out where it is used, given by libclang's type."""
    text = context.lib.text(context.lib.getTypeSpelling(kind))
    return _type_use(context, kind, text, "", "", text.count("*"), text.startswith("const "))


def _type_use(context: UnitContext, kind: Type, spelling: str, base: str, dims: str, depth: int, constant: bool) -> ccode.TypeUse:
    canonical, bits, signed, pointer = resolve(context, kind)
    if base in context.parsed.prelude.types:
        canonical = spelling + dims
        bits, signed = (context.api.settings["pointer_bits"], False) if depth else (0, False)
    elif depth and not pointer and not dims:
        bits, signed = context.api.settings["pointer_bits"], False
    use = ccode.TypeUse(
        spelling=spelling,
        canonical=canonical,
        bits=bits,
        signed=signed,
        pointerDepth=depth,
        arrayDims=dims or None,
        constant=constant or None,
    )
    if base:
        context.type_uses.append((use, base))
    return use


def resolve(context: UnitContext, kind: Type) -> tuple[str, int, bool, bool]:
    """Canonical spelling, width in bits (of an array's element), signedness, and whether it is a pointer."""
    key = (kind.data[0] or 0) ^ (kind.kind << 56)
    known = context.canonical.get(key)
    if known is not None:
        return known
    lib = context.lib
    canonical = lib.getCanonicalType(kind)
    text = lib.text(lib.getTypeSpelling(canonical))
    element = canonical
    for _ in range(8):
        if element.kind not in (
            type_kinds.CONSTANTARRAY,
            type_kinds.INCOMPLETEARRAY,
            type_kinds.VARIABLEARRAY,
        ):  # CXTypeKind: arrays
            break
        element = _element(lib, element)
    size = lib.Type_getSizeOf(element) if element.kind in _ARITHMETIC or element.kind in (_POINTER, _ENUM) else 0
    bits = 8 * size if size > 0 else 0
    if element.kind in _DOUBLE:
        bits = context.api.settings["double_bits"]
    signed = element.kind in _SIGNED or (element.kind == _ENUM)
    result = (text, bits, signed, element.kind == _POINTER)
    context.canonical[key] = result
    return result


def _element(lib: ClangLibrary, kind: Type) -> Type:
    return lib.getCanonicalType(lib.getArrayElementType(kind))
