"""Removes the source's inline assembler, whose instructions the target's microcontroller does not have.

What every GNU assembler accepts stays: an empty text (a compiler barrier), directives, labels, `nop`. A statement with any
other instruction, or a use of a macro that contains one, becomes a comment, so that the rest of the program compiles. Assembler
at file scope that is not in a macro is not part of the code model and stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.metamodels import ccode
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType

LEFT_OUT = "source-assembler"
"""The rule of `text_changes` that turns assembler into a comment."""
REASON = "another microcontroller does not have the source's instructions"
_ASSEMBLER = re.compile(r"\b(?:__asm__|__asm|asm)\b")
_PIECE = re.compile(r'"((?:[^"\\]|\\.)*)"\s*|(:)|([A-Za-z_]\w*)|(.)', re.DOTALL)
_WORDS_BEFORE = frozenset(["volatile", "__volatile__", "__volatile", "inline", "goto"])
_COMMON = re.compile(r"(?:[\w.$]+:\s*)*(?:\..*|nop)?", re.IGNORECASE | re.DOTALL)
"""A line of assembler that is valid on any microcontroller: labels, directives and `nop`."""


def assembler(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Find assembler statements, and uses of the program's macros that expand to them."""
    macros = {str(m.name): str(m.body) for unit in view.program.units for m in unit.macros}
    foreign: dict[str, bool] = {}
    for statement in view.of_kind(ccode.UnknownStatement):
        if _foreign(str(statement.text), macros, foreign):
            yield Change(statement, LEFT_OUT, "", REASON)
    for use in view.unit.macroUses:
        if use.macro is not None and _foreign(str(use.macro.name), macros, foreign) and not _in_a_declaration(use, view):
            yield Change(use, LEFT_OUT, "", REASON)


def _in_a_declaration(use: ccode.MacroUse, view: CodeView) -> bool:
    return any(d.startOffset <= use.startOffset < d.endOffset for d in view.unit.declarations) or any(
        m.startOffset <= use.startOffset < m.endOffset for m in view.unit.macros
    )


def _foreign(text: str, macros: Mapping[str, str], known: dict[str, bool]) -> bool:
    """Whether a text is the source's assembler, or begins with a macro that expands to it."""
    found = _ASSEMBLER.match(text.lstrip())
    if found is not None:
        return not all(_COMMON.fullmatch(line.strip()) for line in _lines(text.lstrip()[found.end() :]))
    word = re.match(r"\s*(\w+)", text)
    if word is None or word[1] not in macros:
        return False
    if word[1] not in known:
        known[word[1]] = False  # a macro that names itself
        known[word[1]] = _foreign(macros[word[1]], macros, known)
    return known[word[1]]


def _lines(text: str) -> Iterator[str]:
    """The instruction lines up to the operands; a part that is no string literal, such as a macro argument, counts as a line."""
    template: list[str] = []
    for piece in _PIECE.finditer(text):
        if piece[1] is not None:
            template.append(piece[1])
        elif piece[2] is not None:
            break
        elif piece[3] is not None and piece[3] not in _WORDS_BEFORE:
            yield piece[3]
    yield from re.split(r"\\n|;|\n", "".join(template).replace("\\t", " "))
