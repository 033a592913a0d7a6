"""RS312: C constructs without an equivalent in C++ that no small edit mends, reported with their places before compiling.

Constructs visible in the tokens are found there, since the parser's model leaves out some of them; others are found in the
model. What an edit can mend is in `language_gap` and the modules that it lists.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from itertools import chain

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.lexer import Token, closing, tokens
from robosmi.transformations.m2m.language import old_c
from robosmi.transformations.m2m.language.designated_lists import list_holders, positional
from robosmi.transformations.m2m.language.early_functions import left_early
from robosmi.transformations.m2m.language.empty_types import empty_types
from robosmi.transformations.m2m.language.nested_types import RECORDS
from robosmi.transformations.m2m.language.unprototyped_pointers import untold_pointers
from robosmi.transformations.m2m.language.unterminated_literals import without_zero
from robosmi.transformations.m2m.language.void_arithmetic import in_macros
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import of_use, type_of
from robosmi.transformations.queries.innermost import Innermost
from robosmi.transformations.queries.macros.tokens import name_tokens

Form = tuple[int, str, str]
"""Offset of the first byte, message, suggested fix."""
_TYPES = RECORDS | {"enum"}
_OPENING, _CLOSING = frozenset("([{"), {")": "(", "]": "[", "}": "{"}
_BEFORE = "define the type before, and use its name here"


def remarks(view: CodeView, data: bytes, path: str) -> Iterator[Finding]:
    """The findings of RS312 for a unit.

    Args:
        view: the unit.
        data: its bytes.
        path: the unit's file as the user knows it.
    """
    if view.unit.language != "C":
        return
    for element, message in _unmended(view, data):
        place = Location(path, element.line, element.column)
        yield Finding("RS312", Severity.warning, message, place, fix="write it in C++ in the sketch, or rewrite it in the source")
    for offset, message, advice in cpp_incompatibilities(view, data):
        line = data.count(b"\n", 0, offset) + 1
        yield Finding("RS312", Severity.warning, message, Location(path, line, offset - data.rfind(b"\n", 0, offset)), fix=advice)


def cpp_incompatibilities(view: CodeView, data: bytes) -> list[Form]:
    """The constructs of a unit that C++ refuses, in text order.

    Args:
        view: the unit.
        data: its bytes.
    """
    words = [word for word in tokens(data) if word[0] not in ("comment", "directive")]
    found = [*_words_of_c(data), *_types_in_place(words), *_late_enumerations(words)]
    found += [*_hidden_types(view), *_pointer_sizes(words)]
    for each in empty_types(view, data):
        if each.parameters is None:
            message = f"the type '{each.typedef.name}' does not list the parameters of its functions, but they have some"
            found.append((int(each.typedef.startOffset), message, "write the types of the parameters in its definition"))
    for start, message in untold_pointers(view):
        found.append((start, message, "write the types of the parameters in its declaration"))
    for start, message in in_macros(view):
        found.append((start, message, "write `(char *)` before the values in the macro"))
    for function in left_early(view, data):
        message = f"'{function.name}' runs before main, before the target starts its clock: a wait in it never ends"
        found.append((int(function.startOffset), message, "call it at the beginning of main"))
    found += _uses_of_main(view)
    found += [*_rows_of_parameters(view, data), *_flexible_values(view), *_record_casts(view)]
    return sorted(set(found))


def _uses_of_main(view: CodeView) -> Iterator[Form]:
    """Calls of main and references to it: C++ forbids them, and a sketch has no function of that name."""
    uses = [call for call in view.calls if call.calleeName == "main"]
    named = [each for each in view.of_kind(ccode.NameReference) if each.name == "main"]
    for use in (*uses, *(each for each in named if isinstance(each.target, ccode.Function))):
        message = "the program uses main as a function, which C++ forbids: in the sketch its statements are in setup() and loop()"
        yield int(use.startOffset), message, "move the statements of main to a function of their own, and let main call it"


_ONLY_IN_C: Mapping[str, tuple[str, str]] = {
    "_Atomic": ("C++ has no types of C's kind that are atomic (_Atomic)", "declare it volatile, and use it with interrupts off"),
    "_Generic": ("C++ has no choice by type (_Generic)", "write the branch that you need, or a function for each type"),
    "_Thread_local": ("C++ has no variables of that kind (_Thread_local)", "write an array with an element for each core"),
}
"""Keyword of C that C++ does not have -> what is wrong, and what to do."""


def _words_of_c(data: bytes) -> Iterator[Form]:
    """Uses of keywords that C++ does not have, and that no other text replaces."""
    for start, _, name in name_tokens(data):
        if name in _ONLY_IN_C:
            yield (start, *_ONLY_IN_C[name])


def _types_in_place(words: Sequence[Token]) -> Iterator[Form]:
    """Types defined inside parentheses, or in the return type of a function."""
    opened: list[str] = []
    for number, (_, start, _, text) in enumerate(words):
        if text in _TYPES and (brace := _definition(words, number)):
            if opened and opened[-1] == "(":
                yield start, "C++ does not allow the definition of a type within parentheses", _BEFORE
            elif not opened and _gives(words, closing(words, brace) + 1):
                yield start, "C++ does not allow the definition of a type as a function's return type", _BEFORE
        if text in _OPENING:
            opened.append(text)
        elif text in _CLOSING and opened:
            opened.pop()


def _definition(words: Sequence[Token], number: int) -> int:
    """The index of the opening brace if a type is defined after the given keyword; 0 if it is only named."""
    behind = number + 1 + (number + 1 < len(words) and words[number + 1][0] == "name")
    return behind if behind < len(words) and words[behind][3] == "{" else 0


def _gives(words: Sequence[Token], number: int) -> bool:
    """Whether a function's name and parameter list follow."""
    while number < len(words) and words[number][3] in ("*", "const"):
        number += 1
    return number + 1 < len(words) and words[number][0] == "name" and words[number + 1][3] == "("


def _late_enumerations(words: Sequence[Token]) -> Iterator[Form]:
    """Enumerations used before their definition in the same file."""
    named: dict[str, int] = {}
    for number, (_, start, _, text) in enumerate(words[:-2]):
        if text != "enum" or words[number + 1][0] != "name":
            continue
        tag = words[number + 1][3]
        if words[number + 2][3] != "{":
            named.setdefault(tag, start)
        elif tag in named:
            yield named[tag], f"the enumeration '{tag}' is used before it is defined", "define it before"
        else:
            named[tag] = -1
    return


def _hidden_types(view: CodeView) -> Iterator[Form]:
    """Variables with the name of their own type."""
    variables: Iterator[ccode.Variable | ccode.Parameter] = chain(view.of_kind(ccode.Variable), view.of_kind(ccode.Parameter))
    for variable in variables:
        words = variable.valueType.spelling.replace("*", " ").split() if variable.valueType is not None else []
        if variable.name and variable.name in words and not _TYPES.intersection(words):
            message = f"the variable has the name of its type, '{variable.name}'"
            yield int(variable.startOffset), message, "give the variable another name"


def _pointer_sizes(words: Sequence[Token]) -> Iterator[Form]:
    """Static assertions on the size of a pointer, which differs on the target."""
    for number, (_, start, _, text) in enumerate(words):
        if text not in ("_Static_assert", "static_assert") or number + 1 >= len(words):
            continue
        inner = [word[3] for word in words[number + 2 : closing(words, number + 1)]]
        sized = " ".join(inner)
        if re.search(r"sizeof \( [\w ]*\*", sized):
            message = "an assertion tests the size of a pointer, which differs on the target"
            yield start, message, "remove the assertion, or change it to the target's size"


_SIZES = re.compile(rb"\[([^\]]*)\]")
_NAME = re.compile(r"[A-Za-z_]\w*")
_POINTER_TO_ROWS = re.compile(rb"\(\*\w+\)\[([A-Za-z_]\w*)\]")


def _rows_of_parameters(view: CodeView, data: bytes) -> Iterator[Form]:
    """Variably modified array types in parameters and variables, such as rows whose length is another parameter."""
    names_in = cache(lambda function: {p.name for p in function.parameters if p.name} if function is not None else set())
    for parameter in view.of_kind(ccode.Parameter):
        names = names_in(ancestor_of_kind(parameter, ccode.Function))
        text = data[parameter.startOffset : parameter.endOffset]
        sizes = [size.decode("latin-1") for size in _SIZES.findall(text)]
        rows = sizes if b"(*" in text.replace(b" ", b"") else sizes[1:]
        if any(row.strip() == "*" or not names.isdisjoint(_NAME.findall(row)) for row in rows):
            message = "a parameter sets the length of an array's rows, which C++ does not allow"
            yield int(parameter.startOffset), message, "write the length as a constant, or use a plain pointer and calculate"
    for variable in view.of_kind(ccode.Variable):
        text = data[variable.startOffset : variable.endOffset].partition(b"=")[0].replace(b" ", b"")
        rows_of = _POINTER_TO_ROWS.search(text)
        if rows_of is not None and variable.initialised and _is_local(view, rows_of[1].decode()):
            message = "a variable sets the length of an array's rows, and C++ converts no pointer to it"
            yield int(variable.startOffset), message, "write the length as a constant, or use a plain pointer and calculate"


def _is_local(view: CodeView, name: str) -> bool:
    variables = (*view.of_kind(ccode.Variable), *view.of_kind(ccode.Parameter))
    return any(v.name == name and not isinstance(v.eContainer(), ccode.SourceUnit) for v in variables)


def _flexible_values(view: CodeView) -> Iterator[Form]:
    """Initial values for a flexible array member."""
    for variable in view.of_kind(ccode.Variable):
        kind, given = of_use(variable.valueType), variable.initializer
        record = kind.declaration if kind is not None and not kind.depth else None
        if not isinstance(record, ccode.Record) or not record.fields or given is None:
            continue
        last = record.fields[-1]
        sizes = (last.valueType.arrayDims or "") if last.valueType is not None else ""
        valued = isinstance(given, ccode.UnknownExpression) and f".{last.name}" in (given.text or "")
        if isinstance(given, ccode.InitializerList):
            valued = len(given.elements) >= len(record.fields)
        if re.fullmatch(r"\[\s*+0?\s*+\]", sizes.strip()) and valued:
            message = f"the member '{last.name}' has no size, so C++ takes no values for it"
            yield int(variable.startOffset), message, "give the member a size, or put the values into their own array"


def _record_casts(view: CodeView) -> Iterator[Form]:
    """Casts of a value to a structure or union."""
    for cast in view.of_kind(ccode.Cast):
        kind = of_use(cast.target)
        record = kind is not None and kind.depth == 0 and isinstance(kind.declaration, ccode.Record)
        given = type_of(cast.operand, {})
        same = given is not None and kind is not None and given.declaration is kind.declaration and not given.depth
        if record and not same and cast.operand is not None and not isinstance(cast.operand, ccode.InitializerList):
            yield (
                int(cast.startOffset),
                "C++ does not convert a value to a structure or union",
                "assign the value to a member",
            )


_RECORD_WITHIN = re.compile(rb"\)\s*\{")


def _taken(holder: ccode.Variable | ccode.Cast, data: bytes) -> bool:
    """Whether C++ accepts an initializer list, after it was made positional or as it is."""
    given = holder.operand if isinstance(holder, ccode.Cast) else holder.initializer
    changes = positional(holder, data)
    if changes == [] and given is not None:
        text = data[given.startOffset : given.endOffset]
        return text.startswith(b"{") and _RECORD_WITHIN.search(text) is None
    return bool(changes)


def _unmended(view: CodeView, data: bytes) -> Iterator[tuple[ccode.Located, str]]:
    mended = Innermost(
        (int(holder.startOffset), int(holder.endOffset), 0, True) for holder in list_holders(view) if _taken(holder, data)
    )
    for value in (*view.of_kind(ccode.UnknownExpression), *view.of_kind(ccode.InitializerList)):
        if mended.at(int(value.startOffset)):
            continue
        text = data[value.startOffset : value.endOffset].decode("latin-1")
        if re.search(r"[{,]\s*\[[^\]]*\]\s*=(?!=)", text):
            yield value, "C++ has no lists that name the elements of an array by their index"
        elif re.search(r"[{,]\s*\.\w+\s*=(?!=)", text):
            yield value, "in C++ a list must name members in their order"
    for literal, written in without_zero(view, data):
        if not written:
            yield literal, "the array has no room for the zero byte at the end of its text"
    for variable in old_c.jumped_over_for_good(view):
        yield variable, "C++ rejects a jump over an initial value"
