"""Declarations in the style of old C that C++ refuses, each with the edit that mends it.

These are empty parameter lists, parameters declared after the list (K&R), implicit int, and functions that end without returning
their value. Each rule finds elements and names the rule of `m2m.partition.text_changes` that changes their text. Conversions of
values are in `language_gap`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache

from robosmi.metamodels import ccode
from robosmi.query import all_of_kind, ancestor_of_kind
from robosmi.transformations.knowledge.replacements import Replacement
from robosmi.transformations.m2m.language.text_change import Change
from robosmi.transformations.queries.block_braces import is_torn
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_type import FunctionType, declared_with_others, type_of
from robosmi.transformations.queries.macros.tokens import name_tokens
from robosmi.transformations.queries.programs.main_program import exits
from robosmi.transformations.queries.signature_text import declared_parameters, nothing

_QUALIFIERS = re.compile(r"(?:\b(?:static|const|volatile|extern|register|auto|inline)\b|\s)*")


def empty_lists(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Declarations `f()`, which leave the parameters unspecified in C and mean none in C++."""
    units = view.program.units
    others = (d for u in units if u is not view.unit for d in u.declarations if isinstance(d, ccode.Function) and d.definition)
    defined = {d.name: d for d in others if d.storage.name != "staticStorage"}
    defined |= {d.name: d for d in view.unit.declarations if isinstance(d, ccode.Function) and d.definition}
    for function in view.of_kind(ccode.Function):
        if function.parameters or function.variadic or function.name == "main" or not re.search(r"\(\s*\)$", function.signature):
            continue
        known = defined.get(function.name)
        if known is not None and known.parameters and not function.definition:
            yield Change(function, "empty-parentheses", declared_parameters(known), "in C++ an empty list means no parameters")
        elif any(c.arguments for f in (function, known) if f is not None for c in f.calls):
            yield Change(function, "empty-parentheses", "...", "it is called with arguments that it does not take")


def missing_arguments(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Calls with fewer arguments than their function takes, which compile in C while the prototype is empty."""
    for call in view.of_kind(ccode.Call):
        function = call.callee
        if function is None or not function.definition or call.viaMacro or not data[: call.endOffset].endswith(b")"):
            continue
        lacking = list(function.parameters)[len(call.arguments) :]
        if lacking and all(p.valueType is not None for p in lacking) and function.name == call.calleeName:
            values = ", ".join(nothing(p.valueType.spelling) or "0" for p in lacking if p.valueType is not None)
            before = ", " if call.arguments else ""
            yield Change(call, "missing-arguments", before + values, "it is called without arguments that it takes")


def old_style_parameters(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """K&R definitions, `f(a) int a; {`: the parameters' types have to move into the list."""
    for function in view.of_kind(ccode.Function):
        names = [p.name for p in function.parameters]
        inner = function.signature[function.signature.find("(", function.signature.find(function.name)) + 1 :].removesuffix(")")
        if function.body is not None and names and [w.strip() for w in inner.split(",")] == names:
            yield Change(function, "parameters-behind", declared_parameters(function), "C++ declares parameters in the list only")


def implicit_int(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Declarations without a type, which C reads as int."""
    for element in (*view.of_kind(ccode.Function), *view.of_kind(ccode.Variable)):
        if element.name == "main" or (isinstance(element, ccode.Variable) and declared_with_others(element)):
            continue
        head = data[element.startOffset : element.endOffset].decode("latin-1")
        found = re.search(rf"\b{re.escape(element.name)}\b", head)
        if found is not None and _QUALIFIERS.fullmatch(_without_macros(head[: found.start()], view)) and element.name:
            yield Change(element, "implicit-int", str(found.start()), "C++ wants the type int written")


def _without_macros(head: str, view: CodeView) -> str:
    """The text before a declared name without the platform's attribute macros, which only say where an object is placed."""
    places = set(view.api.settings["parser"].get("attribute_macros", []))
    return re.sub(r"\w+", lambda word: "" if word[0] in places else word[0], head)


def missing_returns(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Functions that may end without returning a value: harmless in C if the value is unused, undefined behaviour in C++."""
    for function in view.of_kind(ccode.Function):
        body, returned = function.body, function.returnType
        if body is None or returned is None or function.name == "main":
            continue
        if not data[body.endOffset - 2 : body.endOffset].endswith((b"}", b"%>")):
            continue
        result = nothing(returned.spelling)
        if result and not _leaves(body.statements[-1] if body.statements else None):
            yield Change(function, "return-at-end", result, "in C++ a function must not end without the value it promises")


def _leaves(statement: ccode.Statement | None) -> bool:
    """Whether control certainly never passes the end of a statement; calls are assumed to return."""
    pending = [statement]
    while pending:
        current = pending.pop()
        if isinstance(current, ccode.Block):
            pending.append(current.statements[-1] if current.statements else None)
        elif isinstance(current, ccode.Label):
            pending.append(current.statement)
        elif isinstance(current, ccode.If):
            pending += [current.thenBranch, current.elseBranch]
        elif isinstance(current, ccode.Loop):
            if not current.endless or any(e.kind != "return" for e in exits(current)):
                return False
        elif not isinstance(current, (ccode.Return, ccode.Goto)):
            return False
    return True


def returns(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """`return;` in a function with a value, and `return value;` in a void function."""
    for leave in view.of_kind(ccode.Return):
        function = ancestor_of_kind(leave, ccode.Function)
        if function is None or function.name == "main" or function.returnType is None:
            continue
        result = nothing(function.returnType.spelling)
        if result and leave.value is None:
            yield Change(leave, "return-with-value", result, "C++ wants the value that the function promises")
        elif (
            not result
            and leave.value is not None
            and ((given := type_of(leave.value, functions)) is None or given.base != "void")
        ):
            yield Change(leave, "return-without-value", "", "the function has no value in C++ either")


def jumped_over(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Locals whose initialization a jump skips, which C++ refuses: the initial value becomes an assignment, which may be
    skipped.
    """
    for variable in _over(view):
        if _assignable(variable):
            yield Change(variable, "assign-behind", variable.name, "C++ jumps over no initial value")


def jumped_over_for_good(view: CodeView) -> Iterator[ccode.Variable]:
    """Locals whose skipped initialization cannot become an assignment: arrays, constants, and those declared with others."""
    return (variable for variable in _over(view) if not _assignable(variable) and variable.storage.name != "staticStorage")


def _assignable(variable: ccode.Variable) -> bool:
    use = variable.valueType
    plain = use is not None and not use.arrayDims and "(" not in use.spelling and not use.constant
    return plain and not declared_with_others(variable) and variable.storage.name != "staticStorage"


def _over(view: CodeView) -> Iterator[ccode.Variable]:
    """Locals whose initialization a jump skips."""
    jumps = _Jumps(view)
    for statement in view.of_kind(ccode.DeclarationStatement):
        scope, function = statement.eContainer(), ancestor_of_kind(statement, ccode.Function)
        initialised = [d for d in statement.declarations if isinstance(d, ccode.Variable) and d.initializer is not None]
        if function is not None and initialised and jumps.over(statement, scope, function):
            yield from initialised


class _Jumps:
    """The jumps of a unit, indexed once by function and block, since a function may have thousands of locals.

    Args:
        view: the unit.
    """

    def __init__(self, view: CodeView) -> None:
        self._first_jump: dict[tuple[ccode.Function, str], int] = {}
        for jump in view.of_kind(ccode.Goto):
            function = ancestor_of_kind(jump, ccode.Function)
            if function is not None:
                key = (function, jump.labelName)
                self._first_jump[key] = min(jump.startOffset, self._first_jump.get(key, jump.startOffset))
        self._entries: dict[ccode.Block, list[tuple[int, str | None]]] = {}

    def over(self, statement: ccode.Statement, scope: object, function: ccode.Function) -> bool:
        """Whether a jump leads from before a statement to after it within the statement's block."""
        if not isinstance(scope, ccode.Block):
            return False
        if scope not in self._entries:
            self._entries[scope] = list(self._entries_of(scope))
        entries = self._entries[scope]
        if isinstance(scope.eContainer(), ccode.Switch):
            return bool(entries) and entries[-1][0] > statement.startOffset
        start = statement.startOffset
        return any(at > start and self._first_jump.get((function, label or ""), start) < start for at, label in reversed(entries))

    def _entries_of(self, block: ccode.Block) -> Iterator[tuple[int, str | None]]:
        """Where jumps may enter a block: the offset of a statement, and the label in it, or None for a case of its switch."""
        if isinstance(block.eContainer(), ccode.Switch):
            yield from ((s.startOffset, None) for s in block.statements if isinstance(s, (ccode.Case, ccode.Default)))
        elif self._first_jump:
            yield from ((s.startOffset, label.name) for s in block.statements for label in all_of_kind(s, ccode.Label))


def zero_constants(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Constants without an initial value, which are zero in C and refused in C++."""
    for variable in view.unit.declarations:
        if not isinstance(variable, ccode.Variable):
            continue
        use = variable.valueType
        if (
            use is None
            or not use.constant
            or use.pointerDepth
            or variable.initialised
            or variable.storage.name == "externStorage"
        ):
            continue
        yield Change(variable, "zero-value", "{}" if use.arrayDims else nothing(use.spelling), "a constant has a value in C++")


_SIZE_WORDS = re.compile(r"(?:static|const|volatile|restrict)\b")
"""Keywords inside the brackets of an array parameter, which do not change its type (C11 6.7.6.3)."""


def sizes_of_parameters(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Array parameters whose size is another parameter or otherwise not constant."""
    names_in = cache(lambda function: {p.name for p in function.parameters} if function is not None else set())
    for parameter in view.of_kind(ccode.Parameter):
        sizes = parameter.valueType.arrayDims if parameter.valueType is not None else ""
        names = names_in(ancestor_of_kind(parameter, ccode.Function))
        first = (sizes or "").partition("]")[0].strip("[ ")
        if names & set(re.findall(r"[A-Za-z_]\w*", first)) or first.startswith("*") or _SIZE_WORDS.match(first):
            yield Change(parameter, "open-size", "", "C++ wants a constant there")


WORDS = {
    "restrict": "__restrict",
    "_Noreturn": "__attribute__((noreturn))",
    "_Static_assert": "static_assert",
    "_Alignas": "alignas",
    "_Alignof": "alignof",
    "auto": "",
}
"""Keywords of C99 and C11 and their equivalents in C++ or GNU C++; empty where none is needed."""
_ONCE = frozenset({"const", "volatile"})
"""Qualifiers that C allows twice in a row (C11 6.7.3) and C++ only once."""


def word_places(data: bytes) -> Iterator[Replacement]:
    """The replacements, as (first byte, byte after the last, new text), of C keywords that have another name in C++."""
    last, before = 0, ""
    for start, end, name in name_tokens(data):
        repeated = name in _ONCE and name == before and not data[last:start].strip()
        if repeated or not WORDS.get(name, name):  # it goes with the blanks behind it
            yield Replacement(start, end + len(data[end:]) - len(data[end:].lstrip(b" \t")), "")
        elif name in WORDS and not data[last:start].endswith(b"["):  # what says the size of a parameter goes as a whole
            yield Replacement(start, end, WORDS[name])
        last, before = end, name


def words_of_c(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Declarations with C keywords that have another name in C++; keywords between declarations are attributed to a neighbour."""
    if not any(word.encode() in data for word in (*WORDS, *_ONCE)):
        return
    found = {start for start, _, _ in word_places(data)}
    elements = []
    for declared in view.unit.declarations:
        divided = isinstance(declared, ccode.Function) and declared.name == "main"
        element = declared.body if divided and isinstance(declared, ccode.Function) else declared
        if element is not None:
            elements.append(element)
    for element in elements:
        within = {start for start in found if element.startOffset <= start < element.endOffset}
        found -= within
        if within:
            yield Change(element, "words-of-c", "", "C++ has another word for it")
    macros = [(int(m.startOffset), int(m.endOffset)) for m in view.unit.macros]
    between = [start for start in sorted(found) if not any(first <= start < end for first, end in macros)]
    if between and elements:  # an assertion, which declares nothing
        yield Change(elements[-1], "words-between", " ".join(str(each) for each in between), "C++ has another word for it")


def hidden_counters(view: CodeView, data: bytes, functions: Mapping[str, FunctionType]) -> Iterator[Change]:
    """Loop bodies that redeclare a name from the loop's head, allowed in C, where the body is a scope of its own."""
    for loop in view.of_kind(ccode.For):
        body, head = loop.body, loop.initial if isinstance(loop.initial, ccode.DeclarationStatement) else loop.declaration
        if head is None or not isinstance(body, ccode.Block) or is_torn(body):
            continue
        inner = {d.name for s in body.statements if isinstance(s, ccode.DeclarationStatement) for d in s.declarations}
        if not inner.isdisjoint(d.name for d in head.declarations if d.name):
            yield Change(body, "inner-block", "", "in C++ the body of a loop declares no name of its head anew")


RULES = (
    empty_lists,
    missing_arguments,
    old_style_parameters,
    implicit_int,
    missing_returns,
    returns,
    jumped_over,
    hidden_counters,
    zero_constants,
    sizes_of_parameters,
    words_of_c,
)
"""The rules, in the order in which their edits come in a function's text."""
