"""C constructs that a compiler for the target's language (C++) refuses, each with the edit that mends it.

A table of rules over the code model. Each rule finds elements and names the rule of `m2m.partition.text_changes` that changes
their text; what no simple edit mends is reported by `cpp_incompatibilities`. Conversions of values follow from
`queries.expression_type`. Declarations in the style of old C are in `old_c`, variables that several declarations or files share
in `shared_names`.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Collection, Iterator, Mapping
from itertools import chain

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind
from robosmi.transformations.m2m.language import old_c, shared_names, void_arithmetic
from robosmi.transformations.m2m.language.compound_literals import compound_literals
from robosmi.transformations.m2m.language.designated_lists import list_holders, positional
from robosmi.transformations.m2m.language.early_functions import run_in_setup
from robosmi.transformations.m2m.language.empty_types import explicit_parameters
from robosmi.transformations.m2m.language.excess_initialisers import excess_initialisers
from robosmi.transformations.m2m.language.linker_sections import RULE as SECTION, linker_sections
from robosmi.transformations.m2m.language.nested_types import nested_enumerations, nested_tags
from robosmi.transformations.m2m.language.read_only_registers import read_only_registers
from robosmi.transformations.m2m.language.source_assembler import assembler
from robosmi.transformations.m2m.language.text_change import Change, Rule
from robosmi.transformations.m2m.language.unprototyped_pointers import pointer_prototypes
from robosmi.transformations.m2m.language.unterminated_literals import unterminated_literals
from robosmi.transformations.m2m.language.written_conversions import NULLS, conversions, is_primary, plain_type
from robosmi.transformations.m2m.language.written_types import unnamed
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import (
    FunctionType,
    type_of,
)
from robosmi.transformations.queries.numbers import COMPARISONS
from robosmi.transformations.queries.own_headers import included, own_macro
from robosmi.transformations.queries.plans.plan import RUN_IN_SETUP
from robosmi.transformations.queries.programs.main_function import main_of
from robosmi.transformations.queries.signature_text import function_type


def changes(view: CodeView, data: bytes, functions: Mapping[str, FunctionType], *, cplusplus: bool = True) -> list[Change]:
    """The changes of text that a unit needs for the target's language.

    Args:
        view: the unit.
        data: its bytes.
        functions: types of the adapters' functions, by name.
        cplusplus: whether the target's language is C++; in C only undefined variables, read-only registers, inline assembler
            and sections are changed.
    """
    functions = {**_library(view), **functions}
    found: dict[tuple[int, int, str], Change] = {}
    rules = () if view.unit.language != "C" else RULES if cplusplus else shared_names.IN_C
    for rule in (*rules, read_only_registers, assembler, linker_sections):
        for change in rule(view, data, functions):
            found.setdefault((change.element.startOffset, change.element.endOffset, change.rule), change)
    return list(found.values())


def _sizes_of_characters(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """`sizeof 'a'`: a character constant has type int in C and char in C++."""
    for size in view.of_kind(ccode.SizeOf):
        if isinstance(size.operand, ccode.CharacterLiteral):
            yield Change(size, "replace", "sizeof(int32_t)", "a character has the size of an int in C")


def _name_of_main(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """`__func__` in main: on the target main's statements are in functions of other names."""
    main = main_of(view.unit) if b"__func__" in data or b"__FUNCTION__" in data else None
    for literal in all_of_kind(main, ccode.StringLiteral) if main is not None else ():
        if data[literal.startOffset : literal.endOffset] in (b"__func__", b"__FUNCTION__"):
            yield Change(literal, "replace", '"main"', "the statements of main stand in other functions")


def _library(view: CodeView) -> dict[str, FunctionType]:
    """Types of the standard library functions that a unit calls, by name, as their headers declare them."""
    made: dict[str, FunctionType] = {}
    for call in view.calls:
        entry = view.resolve(call.calleeName) if call.calleeName and call.calleeName not in made else None
        if entry is None or entry.kind != "function" or view.api.kind_of(entry) != "standard" or not entry.detail:
            continue
        if (call.callee is None or not call.callee.definition) and "(*" not in entry.parameters:
            made[str(call.calleeName)] = function_type(view.api.signature(call.calleeName, entry))
    return made


def _comparisons(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Comparisons of a pointer with a number, and of pointers to functions of different types: C accepts them, C++ does not."""
    for binary in view.of_kind(ccode.Binary):
        left, right = binary.left, binary.right
        if binary.operator not in COMPARISONS or left is None or right is None:
            continue
        one = _function(left, view)
        two = _function(right, view) if one is not None else None
        if one is not None and two is not None and _signature(one) != _signature(two):
            for value in (left, right):
                yield Change(value, "convert", "void (*)()", "C++ compares no pointers to functions that take other parameters")
        for value, other in ((left, right), (right, left)):
            given, kind = type_of(value, functions), type_of(other, functions)
            plain = isinstance(other, ccode.IntegerLiteral) and not other.value
            if given is None or kind is None or not given.depth or not kind.arithmetic or plain:
                continue
            if not NULLS.fullmatch(data[other.startOffset : other.endOffset]):
                rule = "convert" if is_primary(value) else "convert-compound"
                yield Change(value, rule, kind.spelling, "C++ compares no pointer with a number")


def _function(value: ccode.Expression, view: CodeView) -> ccode.Function | None:
    """The function whose address a value is, resolved through macros of the program; None for any other value."""
    inner = value.operand if isinstance(value, ccode.Unary) and value.operator == "&" else value
    if not isinstance(inner, ccode.NameReference):
        return None
    if isinstance(inner.target, ccode.Function):
        return inner.target
    name, seen = str(inner.name), set[str]()
    while name not in seen and (macro := own_macro(view.unit, name)) is not None and not macro.functionLike:
        seen.add(name)
        name = str(macro.body or "").strip("() &")
    declared = (d for u in (view.unit, *included(view.unit)) for d in u.declarations) if seen else ()
    return next((d for d in declared if isinstance(d, ccode.Function) and d.name == name), None)


def _signature(function: ccode.Function) -> tuple[str, ...]:
    """A key that is equal for functions of one type; a function with unspecified parameters equals no other."""
    taken = [plain_type(p.valueType.spelling) for p in function.parameters if p.valueType is not None]
    gives = plain_type(function.returnType.spelling) if function.returnType is not None else ""
    unsaid = str(function.name) if re.search(r"\(\s*\)$", function.signature) and not function.definition else ""
    return (gives, *taken, "..." * function.variadic, unsaid)


def _enumerations(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Increments and compound assignments of enumeration variables, whose result needs a cast in C++."""
    for step in view.of_kind(ccode.Unary):
        kind = _enumeration(step.operand, functions, data) if step.operator in ("++", "--") else ""
        if kind and step.operand is not None and not all_of_kind(step.operand, ccode.Call):
            text = _text(step.operand, data)
            used = not isinstance(step.eContainer(), (ccode.ExpressionStatement, ccode.For))
            made = f"({text} = ({kind})({text} {step.operator[0]} 1))"
            if step.postfix and used:
                made = f"({kind})({made} {'-' if step.operator == '++' else '+'} 1)"
            yield Change(step, "replace", made if used else made[1:-1], "C++ does not count in an enumeration")
    for assignment in view.of_kind(ccode.Assignment):
        kind = _enumeration(assignment.left, functions, data) if assignment.operator != "=" else ""
        if kind and assignment.left is not None and not all_of_kind(assignment.left, ccode.Call):
            text = f"{_text(assignment.left, data)} = ({kind})({_text(assignment.left, data)} {assignment.operator[:-1]} ("
            yield Change(assignment, "compound-of-enumeration", text, "C++ does not calculate in an enumeration")


def _text(expression: ccode.Expression, data: bytes) -> str:
    return data[expression.startOffset : expression.endOffset].decode("utf-8", errors="replace")


def _enumeration(expression: ccode.Expression | None, functions: Mapping[str, FunctionType], data: bytes) -> str:
    """How the enumeration type of an expression is written; empty for an expression of any other type."""
    kind = type_of(expression, functions)
    if expression is None or kind is None or kind.depth or not isinstance(kind.declaration, ccode.Enumeration):
        return ""
    if unnamed(kind):
        return f"__typeof__({_text(expression, data)})"
    return re.sub(r"\b(?:static|const|volatile|register)\b\s*", "", kind.spelling)


def _tags(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Tags that clash with other type names: they have a name space of their own in C, but not in C++."""
    units = view.program.units
    typedefs = {d.name: d for u in units for d in u.declarations if isinstance(d, ccode.Typedef) and d.aliased is not None}
    words = {word for u in units for d in u.declarations for word in (str(d.name),)}
    tagged: Iterator[ccode.Record | ccode.Enumeration] = chain(view.of_kind(ccode.Record), view.of_kind(ccode.Enumeration))
    for record in tagged:
        typedef = typedefs.get(record.name) if record.name else None
        if typedef is not None and typedef.aliased is not None and not _same(typedef.aliased, record):
            yield Change(record, "rename-tag", _fresh(f"{record.name}_", words), "the name is another type's, too")
        for member in record.fields if isinstance(record, ccode.Record) else ():
            use = member.valueType
            if use is not None and use.declaration is not None and member.name in _type_names(use):
                yield Change(member, "qualify-type", "", "the member has the name of its type")


def _type_names(use: ccode.TypeUse) -> list[str]:
    """The names in a type, without the tags of records and enumerations."""
    words = re.findall(r"[A-Za-z_]\w*", use.spelling)
    return [word for before, word in itertools.pairwise(["", *words]) if before not in ("struct", "union", "enum")]


def _same(aliased: ccode.TypeUse, record: ccode.Record | ccode.Enumeration) -> bool:
    """Whether a typedef only gives a tag's type the same name."""
    return not aliased.pointerDepth and not aliased.arrayDims and aliased.spelling.split()[1:] == [record.name]


def _fresh(wanted: str, taken: Collection[str]) -> str:
    while wanted in taken:
        wanted += "_"
    return wanted


def _designated(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Lists whose values name elements of an array, or leave out members: C++ counts them."""
    for holder in list_holders(view):
        if positional(holder, data):
            yield Change(holder, "positional", "", "C++ gives the values of a list in their order")


RULES: tuple[Rule, ...] = (
    nested_enumerations,
    nested_tags,
    _tags,
    _designated,
    compound_literals,
    unterminated_literals,
    excess_initialisers,
    explicit_parameters,
    pointer_prototypes,
    run_in_setup,
    _enumerations,
    conversions,
    _comparisons,
    *void_arithmetic.RULES,
    _sizes_of_characters,
    _name_of_main,
    *old_c.RULES,
    *shared_names.RULES,
)
TEXT_RULES = frozenset(
    {
        "empty-parentheses",
        "parameters-behind",
        "positional",
        "named-literal",
        "rename-tag",
        "implicit-int",
        "return-at-end",
        "declare-only",
        "declare-static",
        "no-static",
        "define-extern",
        "define-without-extern",
        "define-local",
        "define-in-list",
        "define-behind",
        "shared-behind",
        "left-undefined",
        "missing-arguments",
        "surplus-arguments",
        "share",
        "share-one",
        "words-of-c",
        "words-between",
        "enumeration-before",
        "tag-of-member",
        "one-element",
        "out-of-list",
        "excess-values",
        "inner-block",
        RUN_IN_SETUP,
        SECTION,
        "zero-value",
    }
)
"""Rules that each change a separate part of a declaration, so that several may apply to one."""
