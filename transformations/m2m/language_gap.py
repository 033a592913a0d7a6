"""C that is no C++: what a compiler of the target's language refuses although C allows it, and the edit that fits each.

A table of rules over the code model. Each finds elements and says which rule of `edit_rules` changes their text; what no
simple edit mends is a finding with its place. Which way a value is converted is read off `queries.expression_type`;
declarations in the manner of old C are in `old_c`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from robosmi.diagnostics import Finding, Location, Severity
from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.m2m import old_c
from robosmi.transformations.m2m.text_change import Change, Rule
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import (
    FunctionType,
    ValueType,
    declared_with_others,
    expectations,
    of_use,
    type_of,
)
from robosmi.transformations.queries.own_headers import included
from robosmi.transformations.queries.source_text import is_header

_NULLS = re.compile(rb"NULL|\(?\s*0[xX]?0*[uUlL]*\s*\)?")


def changes(view: CodeView, data: bytes, functions: Mapping[str, FunctionType], *, cplusplus: bool = True) -> list[Change]:
    """What has to change in a unit.

    Args:
        view: the unit.
        data: its bytes.
        functions: what adapters take and give.
        cplusplus: whether the target's language is C++; in C all stays but what the program nowhere defines.
    """
    if view.unit.language != "C":
        return []
    found: dict[tuple[int, int, str], Change] = {}
    for rule in RULES if cplusplus else (_extern,):
        for change in rule(view, data, functions):
            found.setdefault((change.element.startOffset, change.element.endOffset, change.rule), change)
    return list(found.values())


def _conversions(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    for value, wanted in expectations(view, functions):
        text = data[value.startOffset : value.endOffset]
        null = _NULLS.fullmatch(text) and (wanted.depth or wanted.function)
        if text and not null and (reason := _conversion(value, wanted, functions)):
            yield Change(value, "convert" if _primary(value) else "convert-compound", wanted.spelling, reason)


def _conversion(value: ccode.Expression, wanted: ValueType, functions: Mapping[str, FunctionType]) -> str:
    """Why C++ wants the conversion written, or an empty text."""
    if wanted.function:
        return _function_pointer(value, wanted)
    if isinstance(value, ccode.StringLiteral):
        if wanted.depth == 1 and wanted.base == "char" and not wanted.constant:
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
    if given is None or given.function or given.spelling.replace(" ", "") == wanted.spelling.replace(" ", ""):
        return ""
    if wanted.depth and given.depth:
        return _pointers(given, wanted)
    if wanted.depth and given.arithmetic:
        return "a number is no pointer in C++"
    if given.depth and wanted.arithmetic:
        return "a pointer is no number in C++"
    return ""


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
"""Least and greatest value that surely fits on any target; int has 16 bits on some."""


def _fits(value: ccode.Expression, wanted: ValueType) -> bool:
    """Whether a list may hold a value of the type without a conversion."""
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
    if wanted.base == "void" and wanted.depth == 1:
        return "a pointer to a constant is no such pointer in C++" if given.constant and not wanted.constant else ""
    if given.base == "void":
        return "C++ does not convert void * on its own"
    if (given.base, given.depth) != (wanted.base, wanted.depth):
        return "the pointers are of different types"
    return "a pointer to a constant is no such pointer in C++" if given.constant and not wanted.constant else ""


def _function_pointer(value: ccode.Expression, wanted: ValueType) -> str:
    inner = value.operand if isinstance(value, ccode.Unary) and value.operator == "&" else value
    function = inner.target if isinstance(inner, ccode.NameReference) else None
    if isinstance(function, ccode.Function):
        taken = wanted.spelling.rpartition("(*")[2].partition(")")[2].strip().strip("()")
        wants = [_plain(p) for p in taken.split(",") if _plain(p) not in ("", "void")]
        takes = [_plain(p.valueType.spelling) for p in function.parameters if p.valueType is not None]
        returned = _plain(wanted.spelling.partition("(*")[0])
        gives = _plain(function.returnType.spelling) if function.returnType is not None else ""
        return "the function takes or gives something else than the place wants" if wants != takes or returned != gives else ""
    if isinstance(inner, ccode.Cast) and inner.target is not None:
        return "" if "(*" in inner.target.spelling else "the place wants a pointer to a function"
    if isinstance(inner, ccode.NameReference):
        known = isinstance(inner.target, (ccode.Variable, ccode.Parameter, ccode.Field)) and inner.target.valueType is not None
        plain = known and "(*" not in inner.target.valueType.spelling  # type: ignore[union-attr]
        unknown = isinstance(inner.target, ccode.ExternalSymbol) and inner is not value
        return "the place wants a pointer to a function" if plain or unknown else ""
    return "the place wants a pointer to a function"


def _plain(spelling: str) -> str:
    """A type without blanks and without the name of a parameter."""
    words = re.sub(r"\s+", " ", spelling).strip()
    found = re.fullmatch(r"(.*[*\s])[A-Za-z_]\w*", words)
    keeps = found is None or words.rpartition(" ")[2] in ("int", "char", "long", "short", "unsigned", "float", "double", "void")
    return (words if keeps or found is None else found[1]).replace(" ", "")


def _primary(value: ccode.Expression) -> bool:
    kinds = (ccode.Call, ccode.NameReference, ccode.Member, ccode.Index, ccode.StringLiteral, ccode.IntegerLiteral, ccode.Unary)
    return isinstance(value, kinds)


def _enumerations(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Counting and adding in an enumeration: the sum is a number in C++, which has to be made a value again."""
    for step in view.of_kind(ccode.Unary):
        kind = _enumeration(step.operand, functions) if step.operator in ("++", "--") else ""
        if kind and step.operand is not None and not all_of_kind(step.operand, ccode.Call):
            text = _text(step.operand, data)
            used = not isinstance(step.eContainer(), (ccode.ExpressionStatement, ccode.For))
            made = f"({text} = ({kind})({text} {step.operator[0]} 1))"
            if step.postfix and used:
                made = f"({kind})({made} {'-' if step.operator == '++' else '+'} 1)"
            yield Change(step, "replace", made if used else made[1:-1], "C++ does not count in an enumeration")
    for assignment in view.of_kind(ccode.Assignment):
        kind = _enumeration(assignment.left, functions) if assignment.operator != "=" else ""
        if kind and assignment.left is not None and not all_of_kind(assignment.left, ccode.Call):
            text = f"{_text(assignment.left, data)} = ({kind})({_text(assignment.left, data)} {assignment.operator[:-1]} ("
            yield Change(assignment, "compound-of-enumeration", text, "C++ does not calculate in an enumeration")


def _text(expression: ccode.Expression, data: bytes) -> str:
    return data[expression.startOffset : expression.endOffset].decode("utf-8", errors="replace")


def _enumeration(expression: ccode.Expression | None, functions: Mapping[str, FunctionType]) -> str:
    """How the enumeration is written that an expression is of, empty for any other type."""
    kind = type_of(expression, functions)
    plain = kind is not None and kind.depth == 0 and isinstance(kind.declaration, ccode.Enumeration)
    return re.sub(r"\b(?:static|const|volatile|register)\b\s*", "", kind.spelling) if plain and kind is not None else ""


def _shared(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """A variable that a header declares without extern: one for all files in C, one for each in C++."""
    unit = view.unit
    units = [u for u in unit.program.units if not is_header(u)] if is_header(unit) and unit.program is not None else []
    defined = {
        d.name
        for u in units
        for d in u.declarations
        if isinstance(d, ccode.Variable) and d.storage.name == "unspecified" and d.name
    }
    for variable in unit.declarations if units else ():
        if not isinstance(variable, ccode.Variable) or variable.storage.name != "unspecified" or variable.initialised:
            continue
        if variable.name in defined:
            yield Change(variable, "declare-only", "", "a file of the program defines it")
        elif len(units) > 1 and not (variable.valueType is not None and variable.valueType.constant):
            yield Change(variable, "share", "", "all files that include the header share it")


def _constants_of_others(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """A constant that other files use: in C++ it belongs to its own file alone, unless it is said to be extern."""
    unit = view.unit
    if is_header(unit) or unit.program is None:
        return
    seen = {id(u) for u in (unit, *included(unit))}
    wanted: dict[str, bool] = {}
    for other in unit.program.units:
        for declared in other.declarations:
            if isinstance(declared, ccode.Variable) and declared.storage.name == "externStorage":
                wanted[declared.name] = wanted.get(declared.name, False) or id(other) in seen
    for variable in unit.declarations:
        use = variable.valueType if isinstance(variable, ccode.Variable) else None
        if use is None or not isinstance(variable, ccode.Variable) or variable.storage.name != "unspecified":
            continue
        if use.constant and not use.pointerDepth and wanted.get(variable.name) is False:
            yield Change(variable, "declare-only", "", "another file uses the constant")


def _tentative(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Globals that are declared twice: all but one become mere declarations."""
    by_name: dict[str, list[ccode.Variable]] = {}
    for declaration in view.unit.declarations:
        if (
            isinstance(declaration, ccode.Variable)
            and declaration.storage.name in ("unspecified", "staticStorage")
            and declaration.name
        ):
            by_name.setdefault(declaration.name, []).append(declaration)
    for variables in by_name.values():
        kept = next((v for v in variables if v.initialised), variables[0])
        for variable in variables if len(variables) > 1 else ():
            if variable is not kept and not declared_with_others(variable):
                rule = "declare-only" if variable.storage.name == "unspecified" else "take-out"
                yield Change(variable, rule, "", "the variable is declared a second time")


def _extern(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Variables that the program declares and defines nowhere: their declaration becomes the definition."""
    program = view.unit.program
    defined = (
        {
            d.name
            for u in program.units
            for d in u.declarations
            if isinstance(d, ccode.Variable) and d.storage.name != "externStorage"
        }
        if program is not None
        else set()
    )
    seen: set[str] = set()
    for declaration in view.unit.declarations:
        if not isinstance(declaration, ccode.Variable) or declaration.name in defined or declaration.name in seen:
            continue
        if declaration.storage.name == "externStorage" and not declaration.initialised and not declared_with_others(declaration):
            seen.add(declaration.name)
            yield Change(declaration, "define-extern", declaration.name, "the program defines it nowhere")


RULES: tuple[Rule, ...] = (_enumerations, _conversions, *old_c.RULES, _tentative, _shared, _extern, _constants_of_others)
TEXT_RULES = frozenset(
    {
        "empty-parentheses",
        "parameters-behind",
        "implicit-int",
        "return-at-end",
        "declare-only",
        "define-extern",
        "share",
        "zero-value",
    }
)
"""Rules that each change a place of their own in a declaration, so that several may apply to one."""


def remarks(view: CodeView, data: bytes, path: str) -> Iterator[Finding]:
    """RS312: what no simple edit mends.

    Args:
        view: the unit.
        data: its bytes.
        path: the unit's file as the user knows it.
    """
    if view.unit.language != "C":
        return
    for element, message in _unmended(view, data):
        place = Location(path, element.line, element.column)
        yield Finding("RS312", Severity.warning, message, place, fix="write it in C++ in the sketch, or otherwise in the source")


def _unmended(view: CodeView, data: bytes) -> Iterator[tuple[ccode.Located, str]]:
    for value in (*view.of_kind(ccode.UnknownExpression), *view.of_kind(ccode.InitializerList)):
        text = data[value.startOffset : value.endOffset].decode("latin-1")
        if re.search(r"[{,]\s*\[[^\]]*\]\s*=(?!=)", text):
            yield value, "a list that names the elements of an array by their index is no C++"
        elif re.search(r"[{,]\s*\.\w+\s*=(?!=)", text):
            yield value, "a list that names members is C++ only where it names them in their order"
    for literal in view.of_kind(ccode.StringLiteral):
        variable = literal.eContainer()
        use = variable.valueType if isinstance(variable, ccode.Variable) else None
        if use is not None and use.arrayDims.strip("[] ") == str(len(literal.text)) and use.pointerDepth == 0:
            yield literal, "the array has no room for the zero byte at the end of its text"
    for variable in view.of_kind(ccode.Variable):
        kind = of_use(variable.valueType)
        if kind is not None and "restrict" in kind.spelling:
            yield variable, "'restrict' is no word of C++"
