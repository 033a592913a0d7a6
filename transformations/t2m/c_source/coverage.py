"""Coverage and findings of one unit: calls in the text against calls in the model, the parser's complaints, what was cut.

A call in the text is an identifier followed by an opening parenthesis, outside declarators, directives and text that was
not compiled. Whatever of these has no call and no macro use in the model is listed, never dropped.
"""

from __future__ import annotations

import os
import re

from msgspec import Struct

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.knowledge.lexer import KEYWORDS
from robosmi.transformations.t2m.c_source.context import UnitContext
from robosmi.transformations.t2m.c_source.parsing.translation_unit import Diagnostic

_NO_CALL = KEYWORDS | {
    "defined",
    "__attribute",
    "__builtin_offsetof",
    "__alignof__",
    "_Alignof",
    "alignof",
    "_Static_assert",
    "static_assert",
    "constexpr",
}
_NO_CALL |= {"_Generic", "_Alignas", "_Atomic", "__typeof", "__real__", "__imag__", "__real", "__imag"}
_NO_CALL |= {"__builtin_choose_expr", "__builtin_types_compatible_p", "__builtin_va_arg"}  # they take types, or choose
_NO_CALL_OF_CXX = frozenset(["catch", "operator", "decltype", "noexcept", "alignas", "new", "delete", "throw"])


class Coverage(Struct):
    """Calls of one unit: how many are in its text, how many of those in the model, and those that are not."""

    in_text: int
    in_model: int
    unresolved: list[ccode.UnresolvedCall]


def calls(context: UnitContext) -> Coverage:
    """Compare the tokens with the model; a lost call is a finding RS102."""
    tokens = context.tokens
    in_text = in_model = 0
    lost: list[ccode.UnresolvedCall] = []
    types = {name for _, name in context.type_uses} | context.attribute_macros
    cxx = context.source.language == "C++"
    behind = 0  # of an attribute, whose words are no calls
    for i in range(len(tokens) - 1):
        if tokens[i + 1][3] != "(" or tokens[i][0] != "name" or i < behind:
            continue
        _, start, end, name = tokens[i]
        if name in ("__attribute__", "__attribute"):
            behind = context.matching(i + 1)
        if name in _NO_CALL or (cxx and name in _NO_CALL_OF_CXX) or start in context.declarators or not context.active(start):
            continue
        if start in context.covered:
            in_text += 1
            in_model += 1
        elif name not in types:
            in_text += 1
            lost.append(ccode.UnresolvedCall(name=name, **context.source.place(start, end)))
            cut = any(first <= start < last for first, last in context.parsed.cut)
            why = "its text is copied but not parsed" if cut else "its statement has a syntax error"
            message = f"the call of {name} is lost: {why}"
            context.find("RS102", Severity.warning, message, start, end, "correct the statement, or migrate it by hand")
    return Coverage(in_text, in_model, lost)


_WITHIN = "function definition is not allowed here"
"""libclang's message about a function that is defined within another one."""


def problems(context: UnitContext) -> list[ccode.SyntaxProblem]:
    """The diagnostics that are not about missing declarations; syntax errors among them become findings RS101."""
    found: list[ccode.SyntaxProblem] = []
    said: set[tuple[int, str]] = set()  # the same of two braces that are missing at the end
    for diagnostic in context.parsed.diagnostics:
        start = diagnostic.offset
        if start < 0 or diagnostic.about_missing or (start, diagnostic.message) in said:
            continue
        said.add((start, diagnostic.message))
        place = context.source.place(start, start)
        fatal = (diagnostic.syntax or _of_a_number(context, diagnostic)) and not _before_a_cut(context, start)
        found.append(ccode.SyntaxProblem(message=diagnostic.message, fatal=fatal or None, **place))
        if _is_error_directive(context, start):
            message = f"#error: {diagnostic.message.strip(chr(34))}"
            context.find("RS101", Severity.error, message, start, None, "define the macro that the text needs with -D")
        elif diagnostic.message == _WITHIN:
            message = "a nested function, which GNU C accepts and C++ does not, is copied as text"
            context.find("RS101", Severity.error, message, start, None, "move it before the function that contains it")
        elif fatal:
            context.find("RS101", Severity.error, f"syntax error: {diagnostic.message}", start, None, "correct the source text")
    return found


_THROUGH_NUMBER = re.compile(rb"\*\s*[0-9]")


def _of_a_number(context: UnitContext, diagnostic: Diagnostic) -> bool:
    """Whether a number is used as a pointer: what stood before `*` was ended by a macro with a semicolon."""
    said = diagnostic.message.startswith("indirection requires pointer operand")
    return said and _THROUGH_NUMBER.match(context.source.parsed, diagnostic.offset) is not None


def _before_a_cut(context: UnitContext, offset: int) -> bool:
    """Whether a diagnostic is caused by a cut of this reader (RS104) in the same statement, and not by the text."""
    data = context.source.parsed
    return any(
        start <= offset < end or (offset < start and not set(data[offset:start]) & set(b";{}"))
        for start, end in context.parsed.cut
    )


def _is_error_directive(context: UnitContext, offset: int) -> bool:
    data = context.source.parsed
    start = data.rfind(b"\n", 0, offset) + 1
    return re.match(rb"\s*(?:#|%:)\s*error\b", data[start : offset + 40]) is not None


def _is_there(context: UnitContext, header: str) -> bool:
    """Whether a header exists beside the file or in a folder for headers, though libclang has not read it."""
    folders = (os.path.dirname(os.path.abspath(context.source.path)), *context.include_dirs)
    return any(os.path.isfile(os.path.join(folder, header)) for folder in folders)


def notes(context: UnitContext, includes: list[ccode.Include], conditionals: list[ccode.PreprocessorConditional]) -> None:
    """Findings about the unit as a whole: headers nobody knows, text that was not compiled, depth, encoding."""
    for include in includes:
        known = include.resolvedPath or context.api.header_kind(str(include.header))
        if not known and not _is_there(context, str(include.header)):  # in a circle of includes (RS114) none is read
            message = f"the header {include.header} was not found: names that it declares are inferred from their uses"
            start, end, fix = int(include.startOffset), int(include.endOffset), "give its folder with -I"
            context.find("RS103", Severity.warning, message, start, end, fix, header=str(include.header))
    for start, end in context.parsed.cut[:20]:
        context.find(
            "RS104",
            Severity.warning,
            "nested too deep, declared too often, or macros that expand to too much text: copied as text from here on",
            start,
            end,
            "split the expression, the statement or the macro, or keep one of the declarations",
        )
    if context.source.encoding != "UTF-8":
        context.find("RS105", Severity.info, f"the file is not UTF-8; RoboSMi reads it as {context.source.encoding}", 0, None)
    for start, end in context.parsed.skipped:
        message = f"lines {context.source.line(start)} to {context.source.line(end)} are not compiled and not in the model"
        context.find("RS106", Severity.info, message, start, end)
