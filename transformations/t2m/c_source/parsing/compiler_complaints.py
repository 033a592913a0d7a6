"""Finds what a C++ compiler will refuse in a finished program, by parsing it with libclang before anybody compiles it.

The target's own headers may be missing (`generated_program`). So only errors count that these headers cannot cause, of
undeclared names only functions that the program itself defines, and errors of syntax only in lines of which each word is known.
The checks made while reading (`m2m.language.cpp_incompatibilities`) are more exact; this one finds what nobody foresaw.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Set
from typing import NamedTuple

from robosmi.transformations.knowledge.lexer import KEYWORDS, tokens
from robosmi.transformations.t2m.c_source.parsing import clang
from robosmi.transformations.t2m.c_source.parsing.generated_program import SKETCH, GeneratedProgram

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
    |cast\ from\ pointer\ to\ smaller\ type
    |indirection\ requires\ pointer\ operand|member\ reference\ base\ type\ {_NAMED}\ is\ not\ a\ structure
    |cannot\ jump\ from|default\ initialization\ of\ an\ object\ of\ const|static\ declaration\ of\ {_NAMED}\ follows\ non-static
    |conflicting\ types\ for|variable-sized\ object\ may\ not\ be\ initialized|array\ is\ too\ small\ to\ include
    |initializer-string\ for\ char\ array\ is\ too\ long|use\ of\ undeclared\ label|redeclaration\ of\ '
    |cannot\ increment\ value\ of\ type|array\ type\ {_NAMED}\ is\ not\ assignable|array\ has\ incomplete\ element
    |invalid\ operands\ to\ binary\ expression|void\ function\ {_NAMED}\ should\ not\ return
    |non-void\ function\ {_NAMED}\ should\ return
    |called\ object\ type\ {_NAMED}\ is\ not\ a\ function|subscripted\ value\ is\ not|incompatible\ (?:pointer|integer|operand)
    |.*\ (?:is|are)\ (?:a\ )?C\+\+17\ extensions?
    |conversion\ from\ {_NAMED}\ to\ {_NAMED}\ is\ not\ allowed
    |extraneous\ (?:'\)'|closing\ brace)
    |overload\ resolution\ selected\ deleted\ operator|unterminated\ function-like\ macro\ invocation
    |(?:non-const|volatile)\ lvalue\ reference\ to\ type\ {_NAMED}\ cannot\ bind\ to\ a\ value\ of\ unrelated\ type""",
    re.VERBOSE,
)
"""Matches errors that are about the program itself, not about a missing header."""
_SURE_IN_CPP11 = re.compile(
    r"""'auto'\ return\ without\ trailing|deduced\ return\ types\ are|'auto'\ not\ allowed\ in\ lambda\ parameter
    |statement\ not\ allowed\ in\ constexpr|constexpr\ function's\ return\ type\ 'void'
    |(?:variable\ declaration|use\ of\ this\ statement|multiple\ return\ statements)\ in\ (?:a\ )?constexpr""",
    re.VERBOSE,
)
"""Matches errors of C++11 that later standards have not; avr-gcc only warns of the other forms of C++14."""
_UNKNOWN = re.compile(r"use of undeclared identifier '(\w+)'")
_EXPECTED = re.compile(r"expected |unexpected |.*: expected ")
"""Matches errors of syntax, which a macro or a type of a missing header causes, too."""
_ERROR = re.compile(rb"[ \t]*#[ \t]*error\b")
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


def compiler_complaints(
    program: GeneratedProgram, are_known: Callable[[Set[str]], bool] = lambda words: not words
) -> list[CompilerComplaint]:
    """The lines of a program's files that a compiler refuses, each once, in the order of the files.

    None are reported of a program that nests too deep for libclang; reading it has reported that.

    Args:
        program: the program, in C++.
        are_known: whether all of some words, which are no keywords, are the program's own, and no macro or type of a header.
    """
    own = (
        set[str]()
        if program.complete
        else {"main"}
        | {n.decode() for path, text in program.texts.items() if path.startswith(SKETCH) for n in _DEFINED.findall(text)}
    )
    told: dict[tuple[str, int], CompilerComplaint] = {}
    for _, unit in program.units:
        for each in _complaints(unit, program, own, are_known):
            if each.file != program.adapters:
                told.setdefault((each.file, each.line), each)
    return list(told.values())


def _complaints(
    unit: int, program: GeneratedProgram, own: Set[str], are_known: Callable[[Set[str]], bool]
) -> Iterator[CompilerComplaint]:
    """The errors of a unit; if the board's macros are there, `#error` is the program's answer to it."""
    texts, board = program.texts, program.complete
    library = clang.library()
    plain: dict[tuple[str, int], bool] = {}
    for number in range(library.getNumDiagnostics(unit)):
        handle = library.getDiagnostic(unit, number)
        if library.getDiagnosticSeverity(handle) >= clang.ERROR:
            message = library.text(library.getDiagnosticSpelling(handle))
            unknown = _UNKNOWN.match(message)
            file, offset = clang.file_offset(library.getDiagnosticLocation(handle))
            name = clang.file_name(file)
            if name.startswith(SKETCH):
                by_program = board and _ERROR.match(texts[name], texts[name].rfind(b"\n", 0, offset) + 1) is not None
                sure = bool(_SURE.match(message)) or (unknown is not None and unknown[1] in own) or by_program
                sure |= program.old_standard and bool(_SURE_IN_CPP11.match(message))
                if not sure and not board and _EXPECTED.match(message):
                    at = (name, texts[name].rfind(b"\n", 0, offset) + 1)
                    if at not in plain:  # a line may have many errors
                        plain[at] = are_known(_words(texts[name], at[1]))
                    sure = plain[at]
                if sure:
                    line = texts[name].count(b"\n", 0, offset) + 1
                    yield CompilerComplaint(name.removeprefix(f"{SKETCH}/"), line, f"#error {message}" if by_program else message)
        library.disposeDiagnostic(handle)


def _words(text: bytes, start: int) -> set[str]:
    """The words but for keywords of the line that starts at an offset, and of the one before that has any."""
    end = text.find(b"\n", start)
    before = text.rfind(b"\n", 0, len(text[:start].rstrip()) if start else 0) + 1
    line = text[before : end if end >= 0 else len(text)]
    return {word for kind, _, _, word in tokens(line) if kind == "name" and word not in KEYWORDS}
