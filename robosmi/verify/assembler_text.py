"""The directives in assembler text that a compiler has made of a program: only those that compilers write are let through.

The text may hold more than the compiler's own: assembler statements of the program, and the names, sections, identifications and
file names that it gives, which a compiler copies as they are. Directives that read another file (`.incbin`, `.include`), or that
could make such a directive from parts (`.macro`, `.irp`), are refused before the assembler runs.

The assembler reads quotes in its own way: behind `.type x,` it takes one away, and the text ends at the next semicolon. So quotes
are refused but in the few forms in which compilers write them, each a line of its own.
"""

from __future__ import annotations

import re

from robosmi.errors import VerificationError

_NAME = r"[\w.$\x80-\xff]+"
_TEXT = r'"(?:[^"\\]|\\.)*"'
_DIRECTIVES = (
    r"\.(?:file|loc|ident|text|data|bss|section|pushsection|popsection|previous|globl|global|local|weak|weakref|hidden|internal"
    r"|protected|type|size|comm|lcomm|set|equ|align|p2align|balign|skip|space|zero|byte|value|short|word|hword|2byte|long|int"
    r"|4byte|quad|8byte|octa|float|single|double|tfloat|ascii|asciz|string|uleb128|sleb128|symver|subsection|code32|cfi_\w+)"
)
_OPERANDS = r"[-\w.$,+@%()*: \t]*"
_ORDINARY = re.compile(rf"[ \t]*(?:{_NAME}:|{_DIRECTIVES}(?:[ \t]{_OPERANDS})?|[a-z]\w*(?:[ \t]{_OPERANDS})?)?", re.ASCII)
"""Nearly every line of a compiler; what others say is looked at statement by statement."""
_QUOTED = re.compile(
    rf"[ \t]*(?:\.(?:ascii|asciz|string|ident)[ \t]+{_TEXT}"
    rf"|\.file[ \t]+(?:\d+[ \t]+)?{_TEXT}(?:[ \t]+{_TEXT})?(?:[ \t]+md5[ \t]+0x[\da-f]+)?"
    rf'|\.(?:push)?section[ \t]+[-\w.$\x80-\xff]+,[ \t]*"[\w?]*"(?:,[@%]\w+(?:,{_NAME})*)?'
    r'|#[ \t]*\d+[ \t]+"[^"\\;]*"(?: \d)?)[ \t]*',  # a place in the program, as comment
    re.ASCII,
)
"""The lines with quotes."""
_LABEL = re.compile(rf"[ \t]*{_NAME}[ \t]*:", re.ASCII)
_ASSIGNMENT = re.compile(rf"[ \t]*{_NAME}[ \t]*=", re.ASCII)
_WORD = re.compile(r"[ \t]*(?:(\.?[A-Za-z_\d][\w.]*)|$)", re.ASCII)
_NEVER = re.compile(r"\.\s*(?:incbin|include|macro|irpc?|rept|altmacro)\b", re.ASCII | re.IGNORECASE)
_SIGNS = ('"', "'", "/*", "\\", "\r", "\f", "\v", "\0")
"""Signs with which the assembler would read the rest of a line in another way than here."""


def check_directives(text: str) -> None:
    """Check the text that a compiler has made of a program.

    Args:
        text: the assembler text, a character for each byte.

    Raises:
        VerificationError: it has a directive, or a form of text, that no compiler writes.
    """
    suspicious = _NEVER.search(text) is not None
    for line in text.split("\n"):
        if (suspicious or not _ORDINARY.fullmatch(line)) and not _QUOTED.fullmatch(line):
            _check_line(line)


def _check_line(line: str) -> None:
    if never := _NEVER.search(line):
        raise assembler_error(never[0])
    for sign in _SIGNS:
        if sign in line:
            raise assembler_error(sign)
    for statement in line.partition("#")[0].split(";"):  # the rest is a comment
        _check_statement(statement)


def _check_statement(statement: str) -> None:
    while label := _LABEL.match(statement):
        statement = statement[label.end() :]
    if _ASSIGNMENT.match(statement):
        return
    word = _WORD.match(statement)
    if word is None:
        raise assembler_error(statement)
    if word[1] and word[1].startswith(".") and not re.fullmatch(_DIRECTIVES, word[1], re.ASCII):
        raise assembler_error(word[1])


def assembler_error(what: str) -> VerificationError:
    """The error for assembler text that is not compiled."""
    return VerificationError(
        f"the program has assembler text that cannot be compiled on this machine: {what.strip()!r}",
        fix="remove assembler text from the program",
    )
