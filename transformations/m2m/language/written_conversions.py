"""Conversions that are implicit in C and need a cast in C++: pointers, strings, functions, enumerations and values in lists."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from msgspec.structs import replace

from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.m2m.language.unprototyped_pointers import value_prototypes
from robosmi.transformations.m2m.language.written_types import gives_text, written_type
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import (
    FunctionType,
    ValueType,
    expectations,
    type_of,
)

_EMPTY = re.compile(r"\(\s*\)\s*$")
NULLS = re.compile(rb"NULL|\(?\s*0[xX]?0*[uUlL]*\s*\)?")


def conversions(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find the values of a unit that need a cast, each with the type to cast to."""
    said = value_prototypes(view)
    for value, place in expectations(view, functions):
        wanted = place
        if id(value) in said:
            wanted = replace(place, spelling=_EMPTY.sub(f"({said[id(value)]})", place.spelling))
        text = data[value.startOffset : value.endOffset]
        null = NULLS.fullmatch(text) and (wanted.depth or wanted.function)
        if text and not null and not _in_macro(value) and (reason := _conversion(value, wanted, functions)):
            kind = written_type(value, wanted, data)
            if kind:
                yield Change(value, "convert" if is_primary(value) else "convert-compound", kind, reason)


def _conversion(value: ccode.Expression, wanted: ValueType, functions: Mapping[str, FunctionType]) -> str:
    """The reason why C++ needs a cast; empty if it does not."""
    if wanted.base == "void" and wanted.depth and not wanted.function and _names_function(value):
        return "a function is no such pointer in C++"
    if wanted.rows:
        return _rows(type_of(value, functions), wanted)
    if wanted.function:
        to_array = wanted.spelling.rstrip().endswith("(*)")  # its dimensions stand behind, where no parameters are
        return "" if to_array else _function_pointer(value, wanted)
    if gives_text(value):
        if wanted.array and isinstance(value, ccode.StringLiteral):
            return ""
        if wanted.depth == 1 and wanted.base in ("char", "void") and not wanted.constant:
            return "a text is constant in C++"
        return "a text is no such pointer in C++" if wanted.depth == 1 and wanted.base not in ("char", "void") else ""
    if wanted.depth == 0 and isinstance(wanted.declaration, ccode.Enumeration):
        given = type_of(value, functions)
        literal = value.target if isinstance(value, ccode.NameReference) else None
        same = (given is not None and given.declaration is wanted.declaration) or (
            isinstance(literal, ccode.EnumerationLiteral) and literal.eContainer() is wanted.declaration
        )
        return "" if same else "a number is no value of an enumeration in C++"
    if wanted.arithmetic and isinstance(value.eContainer(), ccode.InitializerList):
        return "" if _fits(value, wanted) else "C++ narrows no value in a list on its own"
    given = type_of(value, functions)
    if given is None or given.function:
        return ""
    if given.spelling.replace(" ", "") == wanted.spelling.replace(" ", "") and not given.array:
        return ""  # an array may be constant or changing with what it is in
    if wanted.depth and given.depth:
        return _pointers(given, wanted)
    if wanted.depth and given.arithmetic:
        return "a number is no pointer in C++"
    if given.depth and wanted.arithmetic:
        return "a pointer is no number in C++"
    return ""


def _in_macro(value: ccode.Expression) -> bool:
    """Whether a macro expands to both an argument and its call, so that both have the same place in the text."""
    call = value.eContainer()
    return isinstance(call, ccode.Call) and (value.startOffset, value.endOffset) == (call.startOffset, call.endOffset)


def _names_function(value: ccode.Expression) -> bool:
    """Whether a value is a function's address, except where it is returned by a function that returns a function pointer."""
    inner = value.operand if isinstance(value, ccode.Unary) and value.operator == "&" else value
    around = ancestor_of_kind(value, ccode.Function) if isinstance(value.eContainer(), ccode.Return) else None
    gives = around is not None and "(*" in around.signature.replace(" ", "")
    return isinstance(inner, ccode.NameReference) and isinstance(inner.target, ccode.Function) and not gives


_LIMITS = {
    "char": (-128, 127),
    "signed char": (-128, 127),
    "int8_t": (-128, 127),
    "unsigned char": (0, 255),
    "uint8_t": (0, 255),
    "short": (-32768, 32767),
    "int": (-32768, 32767),
    "int16_t": (-32768, 32767),
    "unsigned": (0, 65535),
    "unsigned int": (0, 65535),
    "unsigned short": (0, 65535),
    "uint16_t": (0, 65535),
    "long": (-(2**31), 2**31 - 1),
    "int32_t": (-(2**31), 2**31 - 1),
    "unsigned long": (0, 2**32 - 1),
    "uint32_t": (0, 2**32 - 1),
    "bool": (0, 1),
    "size_t": (0, 65535),
}
"""The range of values that each type holds on every target; int has 16 bits on some."""


def _fits(value: ccode.Expression, wanted: ValueType) -> bool:
    """Whether a value in an initializer list needs no cast to the type (C++ forbids narrowing there)."""
    real = wanted.base in ("float", "double")
    if isinstance(value, ccode.FloatingLiteral):
        return real
    sign, literal = (-1, value.operand) if isinstance(value, ccode.Unary) and value.operator == "-" else (1, value)
    if isinstance(literal, ccode.FloatingLiteral):
        return real
    if isinstance(literal, ccode.IntegerLiteral):
        least, most = _LIMITS.get(wanted.base, (-(2**31), 2**31 - 1))
        return real or least <= sign * literal.value <= most
    given = type_of(value, {})
    if isinstance(value, ccode.Binary):
        return wanted.base == "int"
    return given is None or given.base == wanted.base


def _pointers(given: ValueType, wanted: ValueType) -> str:
    lost = "a pointer to a constant is no such pointer in C++" if given.constant and not wanted.constant else ""
    lost = lost or ("a pointer to what may change is no such pointer in C++" if given.changing and not wanted.changing else "")
    if wanted.base == "void" and wanted.depth == 1:
        return lost
    if given.base == "void":
        return "C++ does not convert void * on its own"
    if given.depth > 1 and given.constant != wanted.constant:
        return lost or "C++ makes nothing constant behind more than one pointer"
    return "the pointers are of different types" if (given.base, given.depth) != (wanted.base, wanted.depth) else lost


def _rows(given: ValueType | None, wanted: ValueType) -> str:
    """The reason why C++ needs a cast to a pointer to an array; empty if it does not."""
    if given is None or not (given.rows or given.depth):
        return ""
    words = wanted.spelling.partition("(*")[0].replace("*", " ").split()
    if given.base == "void":
        return "C++ does not convert void * on its own"
    if given.constant and "const" not in words:
        return "a pointer to a constant is no such pointer in C++"
    return "a pointer to what may change is no such pointer in C++" if given.changing and "volatile" not in words else ""


def _function_pointer(value: ccode.Expression, wanted: ValueType) -> str:
    inner = value.operand if isinstance(value, ccode.Unary) and value.operator == "&" else value
    function = inner.target if isinstance(inner, ccode.NameReference) else None
    if isinstance(function, ccode.Function):
        taken = wanted.spelling.rpartition("(*")[2].partition(")")[2].strip().strip("()")
        wants = [plain_type(p) for p in taken.split(",") if plain_type(p) not in ("", "void")]
        takes = [plain_type(p.valueType.spelling) for p in function.parameters if p.valueType is not None]
        returned = plain_type(wanted.spelling.partition("(*")[0])
        gives = plain_type(function.returnType.spelling) if function.returnType is not None else ""
        return "the function takes or gives something else than the place wants" if wants != takes or returned != gives else ""
    if isinstance(inner, ccode.Cast) and inner.target is not None:
        return "" if "(*" in inner.target.spelling else "the place wants a pointer to a function"
    if isinstance(inner, ccode.NameReference):
        target = inner.target
        use = target.valueType if isinstance(target, (ccode.Variable, ccode.Parameter, ccode.Field)) else None
        plain = use is not None and "(*" not in use.spelling
        unknown = isinstance(inner.target, ccode.ExternalSymbol) and inner is not value
        return "the place wants a pointer to a function" if plain or unknown else ""
    return "the place wants a pointer to a function"


def plain_type(spelling: str) -> str:
    """A type without blanks and without a parameter's name, for comparison."""
    words = re.sub(r"\s+", " ", spelling).strip()
    found = re.fullmatch(r"(.*[*\s])[A-Za-z_]\w*", words)
    keeps = found is None or words.rpartition(" ")[2] in ("int", "char", "long", "short", "unsigned", "float", "double", "void")
    return (words if keeps or found is None else found[1]).replace(" ", "")


def is_primary(value: ccode.Expression) -> bool:
    """Whether a cast written before a value applies to all of it without parentheses."""
    kinds = (ccode.Call, ccode.NameReference, ccode.Member, ccode.Index, ccode.StringLiteral, ccode.IntegerLiteral, ccode.Unary)
    return isinstance(value, kinds)
