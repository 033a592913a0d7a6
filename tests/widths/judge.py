"""Judges whether every operator of a program is computed with the same width and signedness in its sketch.

Both texts are parsed: the original for a 32-bit machine with unsigned char, the sketch for an AVR; the n-th operator of one
corresponds to the n-th of the other. Except for libclang, this judge shares nothing with the rules that it judges.
"""

from __future__ import annotations

import ctypes
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from clang import cindex

_KINDS, _TYPES = cindex.CursorKind, cindex.TypeKind
_BINARY = dict(enumerate(
    [
        "?", ".*", "->*", "*", "/", "%", "+", "-", "<<", ">>", "<=>", "<", ">", "<=", ">=", "==", "!=", "&", "^", "|", "&&", "||",
        "=", "*=", "/=", "%=", "+=", "-=", "<<=", ">>=", "&=", "^=", "|=", ",",
    ]
))  # fmt: skip
_UNARY = {7: "+", 8: "-", 9: "~", 10: "!"}
_UNSIGNED = frozenset([_TYPES.BOOL, _TYPES.CHAR_U, _TYPES.UCHAR, _TYPES.USHORT, _TYPES.UINT, _TYPES.ULONG, _TYPES.ULONGLONG])
_INTEGERS = _UNSIGNED | {_TYPES.CHAR_S, _TYPES.SCHAR, _TYPES.SHORT, _TYPES.INT, _TYPES.LONG, _TYPES.LONGLONG}
_POINTERS = frozenset([_TYPES.POINTER, _TYPES.CONSTANTARRAY, _TYPES.INCOMPLETEARRAY])
_STANDARD = """
typedef signed char int8_t; typedef unsigned char uint8_t; typedef short int16_t; typedef unsigned short uint16_t;
typedef %s int32_t; typedef unsigned %s uint32_t; typedef __SIZE_TYPE__ size_t; typedef __builtin_va_list va_list;
#define va_start(a, b) __builtin_va_start(a, b)
#define va_arg(a, t) __builtin_va_arg(a, t)
#define va_end(a) __builtin_va_end(a)
#define INT_MAX __INT_MAX__
#define INT32_MAX 2147483647L
#ifdef __cplusplus
extern "C" {
#endif
int atoi(const char *); long atol(const char *); int abs(int); long labs(long); int toupper(int); size_t strlen(const char *);
char *strcpy(char *, const char *); char *strcat(char *, const char *);
#ifdef __cplusplus
}
#endif
"""
_SOURCE = ("-target", "i386-unknown-none", "-x", "c", "-std=gnu99", "-funsigned-char")
_TARGET = ("-target", "avr", "-mmcu=atmega328p", "-x", "c++", "-std=gnu++11")


class Failure(NamedTuple):
    """An operator that is computed differently: its line in the sketch, and (bytes, unsigned) on source and target."""

    line: int
    operator: str
    wanted: tuple[int, bool]
    found: tuple[int, bool]


def failures(original: str, sketch: str) -> list[Failure]:
    """The operators of a sketch that are narrower than on the source, or of another signedness.

    Raises:
        AssertionError: a text does not parse, or their operators do not line up.
    """
    here, there = _operators(_parsed(original, _SOURCE)), _operators(_parsed(sketch, _TARGET))
    assert [_operator(c) for c in here] == [_operator(c) for c in there]
    found = []
    for source, target in zip(here, there, strict=True):
        wanted, got = _computed(source), _computed(target)
        if wanted is None or wanted[0] < 4 or got is None:
            continue
        if got[0] < wanted[0] or (got[0] == wanted[0] and got[1] != wanted[1]):
            found.append(Failure(target.location.line, _operator(target), wanted, got))
    return found


def _parsed(text: str, arguments: tuple[str, ...]) -> Any:
    plain = re.sub(r"^[ \t]*#[ \t]*include.*$", "", text, flags=re.MULTILINE)
    kind = "int" if arguments is _SOURCE else "long"
    files = [("program.c", plain), ("/standard.h", _STANDARD % (kind, kind))]
    given = [*arguments, "-nostdinc", "-w", "-Wno-c++11-narrowing", "-include", "/standard.h"]
    unit = cindex.Index.create().parse("program.c", given, unsaved_files=files)
    assert [d.spelling for d in unit.diagnostics if d.severity >= 3] == []
    return unit


def _kind_of(name: str, cursor: Any) -> int:
    function = getattr(cindex.conf.lib, name)
    function.argtypes, function.restype = [cindex.Cursor], ctypes.c_int
    return int(function(cursor))


def _operator(cursor: Any) -> str:
    if cursor.kind in (_KINDS.BINARY_OPERATOR, _KINDS.COMPOUND_ASSIGNMENT_OPERATOR):
        return _BINARY.get(_kind_of("clang_getCursorBinaryOperatorKind", cursor), "")
    if cursor.kind == _KINDS.UNARY_OPERATOR:
        return _UNARY.get(_kind_of("clang_getCursorUnaryOperatorKind", cursor), "")
    return "?:" if cursor.kind == _KINDS.CONDITIONAL_OPERATOR else ""


def _operators(unit: Any) -> list[Any]:
    return [c for top in unit.cursor.get_children() if _own(top) for c in _walk(top) if _operator(c)]


def _own(cursor: Any) -> bool:
    return cursor.location.file is not None and cursor.location.file.name == "program.c"


def _walk(cursor: Any) -> Iterator[Any]:
    yield cursor
    for child in cursor.get_children():
        twice = child.kind == cursor.kind and child.extent == cursor.extent  # a constant expression is shown twice
        yield from (c for n, c in enumerate(_walk(child)) if n or not twice)


def _shape(kind: Any) -> tuple[int, bool] | None:
    plain = kind.get_canonical()
    if plain.kind == _TYPES.ENUM:
        plain = plain.get_declaration().enum_type.get_canonical()
    return (plain.get_size(), plain.kind in _UNSIGNED) if plain.kind in _INTEGERS else None


def _computed(cursor: Any) -> tuple[int, bool] | None:
    """Bytes and signedness of the type in which an operator is computed; None if it computes nothing."""
    operator, children = _operator(cursor), list(cursor.get_children())
    if any(child.type.get_canonical().kind in _POINTERS for child in children):
        return None
    if operator in ("<", ">", "<=", ">=", "==", "!="):
        return _shape(children[0].type)
    if operator in ("*=", "/=", "%=", "+=", "-=", "&=", "^=", "|="):
        return _shape(children[1].type)
    return None if operator in ("&&", "||", "!", "=", ",", "<<=", ">>=") else _shape(cursor.type)
