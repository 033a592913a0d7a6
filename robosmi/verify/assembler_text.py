"""The directives in assembler text that a compiler has made of a program: only those that compilers write are let through.

The text may hold more than the compiler's own: assembler statements of the program, and the names and sections that it gives,
which a compiler copies as they are. Directives that read another file (`.incbin`, `.include`), or that could make such a
directive from parts (`.macro`, `.irp`), are refused before the assembler runs.
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
_ORDINARY = re.compile(
    rf"[ \t]*(?:{_NAME}:|{_DIRECTIVES}(?:[ \t]{_OPERANDS}(?:{_TEXT}[\w.,@% \t]*)?)?|[a-z]\w*(?:[ \t]{_OPERANDS})?)?", re.ASCII
)
"""Nearly every line of a compiler; what others say is looked at statement by statement."""
_STATEMENT = re.compile(rf'(?:{_TEXT}|[^"#;])*')
_LABEL = re.compile(rf"[ \t]*(?:{_NAME}|{_TEXT})[ \t]*:", re.ASCII)
_ASSIGNMENT = re.compile(rf"[ \t]*{_NAME}[ \t]*=", re.ASCII)
_WORD = re.compile(r"[ \t]*(?:(\.?[A-Za-z_\d][\w.]*)|$)", re.ASCII)
_QUOTED = re.compile(_TEXT)
_NEVER = re.compile(r"\.\s*(?:incbin|include|macro|irpc?|rept|altmacro)\b", re.ASCII | re.IGNORECASE)
_SIGNS = ("'", "/*", "\\", "\r", "\f", "\v", "\0")
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
        if suspicious or not _ORDINARY.fullmatch(line):
            _check_line(line)


def _check_line(line: str) -> None:
    at = 0
    while True:
        found = _STATEMENT.match(line, at)
        assert found is not None
        _check_statement(found[0])
        at = found.end() + 1
        if at > len(line) or line[at - 1] == "#":  # the rest is a comment
            return
        if line[at - 1] == '"':  # a text that does not end in its line
            raise _refused('"')


def _check_statement(statement: str) -> None:
    bare = _QUOTED.sub('""', statement)
    for sign in _SIGNS:
        if sign in bare:
            raise _refused(sign)
    if never := _NEVER.search(bare):
        raise _refused(never[0])
    while label := _LABEL.match(bare):
        bare = bare[label.end() :]
    if _ASSIGNMENT.match(bare):
        return
    word = _WORD.match(bare)
    if word is None:
        raise _refused(bare)
    if word[1] and word[1].startswith(".") and not re.fullmatch(_DIRECTIVES, word[1], re.ASCII):
        raise _refused(word[1])


def _refused(what: str) -> VerificationError:
    return VerificationError(
        f"the program has assembler text that cannot be compiled on this machine: {what.strip()!r}",
        fix="remove assembler text from the program",
    )
