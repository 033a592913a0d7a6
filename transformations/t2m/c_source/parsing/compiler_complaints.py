"""Finds what a C++ compiler will refuse in a finished program, by parsing it with libclang before anybody compiles it.

The target's own headers may be missing: a text with the types of the language replaces them. So only errors count that these
headers cannot cause, and of undeclared names only functions that the program itself defines. The checks made while reading
(`m2m.cpp_incompatibilities`) are more exact; this one finds what nobody foresaw.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Set
from typing import NamedTuple

from robosmi.transformations.knowledge.lexer import tokens
from robosmi.transformations.queries.source_text import ADAPTERS_FILE
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.bounds import cuts, shallow

_TYPES = b"""
typedef __INT8_TYPE__ int8_t; typedef __INT16_TYPE__ int16_t; typedef __INT32_TYPE__ int32_t; typedef __INT64_TYPE__ int64_t;
typedef __UINT8_TYPE__ uint8_t; typedef __UINT16_TYPE__ uint16_t; typedef __UINT32_TYPE__ uint32_t;
typedef __UINT64_TYPE__ uint64_t; typedef __INTPTR_TYPE__ intptr_t; typedef __UINTPTR_TYPE__ uintptr_t;
typedef __SIZE_TYPE__ size_t; typedef __PTRDIFF_TYPE__ ptrdiff_t; typedef bool boolean; typedef uint8_t byte;
typedef unsigned int word; typedef __builtin_va_list va_list; typedef struct __file FILE;
#define NULL __null
"""
_STUB = "/none/types"
"""A folder that exists on no machine: the program and the replaced headers are passed to libclang as texts."""
_SKETCH = "/none/sketch"
_FLAGS = (
    "-xc++", "-std=gnu++11", "-target", "avr", "-nostdinc", "-nostdinc++", "-fpermissive", "-w", "-ferror-limit=0",
    "-fno-spell-checking", f"-I{_SKETCH}", f"-I{_STUB}",
)  # fmt: skip
_INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*[<"]([^>"\n]+)[>"]', re.MULTILINE)
_BODIES = re.compile(
    rb"^((?:static )?inline (?>[^\n]*?\)(?= \{))) \{(?:[^\n]*\n(?:[ \t#][^\n]*\n|\n)*\}|[^\n]*\})$", re.MULTILINE
)
"""Matches inline functions of the adapters, whose bodies are not the program's own code."""
_ON_AFTER_MISSING = 0x200
"""Option of a parse: go on after a header that is not there."""
_NAMED = r"'[^']*'(?:\ \(aka\ '[^']*'\))?"
"""A name or type in a message."""
_SURE = re.compile(
    rf"""redefinition\ of\ '|definition\ of\ type\ {_NAMED}\ conflicts\ with\ typedef
    |functions\ that\ differ\ only\ in\ their\ return
    |excess\ elements\ in|too\ (?:many|few)\ arguments\ to\ function\ call|no\ matching\ function\ for\ call\ to\ '
    |expression\ is\ not\ assignable|cannot\ assign\ to\ (?:variable|non-static\ data\ member|return\ value)
    |function\ definition\ is\ not\ allowed\ here|comparison\ (?:of\ distinct\ pointer\ types|between\ pointer\ and\ integer)
    |cannot\ initialize\ an?\ (?:parameter|variable|member\ subobject|array\ element|return\ object)
    |assigning\ to\ {_NAMED}\ from\ (?:incompatible\ type\ )?{_NAMED}$|cannot\ cast\ from\ type
    |indirection\ requires\ pointer\ operand|member\ reference\ base\ type\ {_NAMED}\ is\ not\ a\ structure
    |cannot\ jump\ from|default\ initialization\ of\ an\ object\ of\ const|static\ declaration\ of\ {_NAMED}\ follows\ non-static
    |conflicting\ types\ for|variable-sized\ object\ may\ not\ be\ initialized|array\ is\ too\ small\ to\ include
    |initializer-string\ for\ char\ array\ is\ too\ long|use\ of\ undeclared\ label|redeclaration\ of\ '
    |cannot\ increment\ value\ of\ type|array\ type\ {_NAMED}\ is\ not\ assignable|array\ has\ incomplete\ element
    |invalid\ operands\ to\ binary\ expression|void\ function\ {_NAMED}\ should\ not\ return
    |non-void\ function\ {_NAMED}\ should\ return
    |called\ object\ type\ {_NAMED}\ is\ not\ a\ function|subscripted\ value\ is\ not|incompatible\ (?:pointer|integer|operand)
    |conversion\ from\ {_NAMED}\ to\ {_NAMED}\ is\ not\ allowed""",
    re.VERBOSE,
)
"""Matches errors that are about the program itself, not about a missing header."""
_UNKNOWN = re.compile(r"use of undeclared identifier '(\w+)'")
_DEFINED = re.compile(rb"\b(\w+)[ \t]*\([^;{}()]*\)\s*\{")
"""Functions that a text defines, and statements with a condition, whose names no identifier has."""


class CompilerComplaint(NamedTuple):
    """A place of a program that a compiler refuses.

    Attributes:
        file: its name in the program's folder.
        line: the line.
        message: what the parser says.
    """

    file: str
    line: int
    message: str


def compiler_complaints(files: Mapping[str, bytes], main_header: str, adapters: str = ADAPTERS_FILE) -> list[CompilerComplaint]:
    """The lines of a program's files that a compiler refuses, each once, in the order of the files.

    None are told of a program that nests too deep for libclang; reading it has reported that.

    Args:
        files: the name of each file in the program's folder -> its bytes.
        main_header: the target's header that each file includes; a text with the types of the language replaces it.
        adapters: name of the file that contains the adapters.
    """
    texts = {f"{_SKETCH}/{name}": data for name, data in files.items()}
    shown = files.get(adapters, b"")
    texts[f"{_SKETCH}/{adapters}"] = _BODIES.sub(rb"\1;", shown)
    for data in files.values():
        for found in _INCLUDE.finditer(data):
            name = found[1].decode("utf-8", "replace")
            if name not in files:
                texts[f"{_STUB}/{name}"] = b""
    texts[f"{_STUB}/{main_header}"] = _TYPES
    if any(_nests_too_deep(path, text) for path, text in texts.items()):
        return []
    virtual = clang.unsaved(texts)
    own = {name.decode() for path, text in texts.items() if path.startswith(_SKETCH) for name in _DEFINED.findall(text)}
    told: dict[tuple[str, int], CompilerComplaint] = {}
    for name in files:
        if not name.endswith(".h"):
            for each in _complaints(f"{_SKETCH}/{name}", virtual, texts, own):
                if each.file != adapters:
                    told.setdefault((each.file, each.line), each)
    return list(told.values())


def _nests_too_deep(path: str, text: bytes) -> bool:
    return not (shallow(text) and b"define" not in text) and bool(cuts(path, text, tokens(text)))


def _complaints(
    path: str, virtual: list[clang.UnsavedFile], texts: Mapping[str, bytes], own: Set[str]
) -> Iterator[CompilerComplaint]:
    unit = clang.parse(path, _FLAGS, virtual, _ON_AFTER_MISSING)
    if unit is None:
        return
    library = clang.library()
    try:
        for number in range(library.getNumDiagnostics(unit)):
            handle = library.getDiagnostic(unit, number)
            if library.getDiagnosticSeverity(handle) >= clang.ERROR:
                message = library.text(library.getDiagnosticSpelling(handle))
                unknown = _UNKNOWN.match(message)
                if _SURE.match(message) or (unknown is not None and unknown[1] in own):
                    file, offset = clang.file_offset(library.getDiagnosticLocation(handle))
                    name = clang.file_name(file)
                    if name.startswith(_SKETCH):
                        yield CompilerComplaint(
                            name.removeprefix(f"{_SKETCH}/"), texts[name].count(b"\n", 0, offset) + 1, message
                        )
            library.disposeDiagnostic(handle)
    finally:
        library.disposeTranslationUnit(unit)
