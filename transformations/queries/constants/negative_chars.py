"""The variables, parameters and functions of plain char that take negative values, where the program looks at their sign.

A char that is only printed, stored in another one or compared with a letter is the same with and without a sign.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import all_contents, ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.expression_type import ValueType, of_use, type_of
from robosmi.transformations.queries.numbers import COMPARISONS

_CHAR = frozenset(["char", "const char", "volatile char", "static char"])


def negative_chars(views: Sequence[CodeView], results: Mapping[str, tuple[int, int]]) -> list[ccode.Declaration]:
    """Find them.

    Args:
        views: a view of each unit of the program.
        results: name of a function or method -> the least and the greatest value that it returns.
    """
    found: dict[int, ccode.Declaration] = {}
    for view in views:
        holders: list[ccode.Variable | ccode.Parameter] = [*view.of_kind(ccode.Variable), *view.of_kind(ccode.Parameter)]
        for holder in holders:
            if not _is_char(holder.valueType):
                continue
            if any(_negative(each, results) for each in _given(holder)) or any(map(_asks_for_sign, holder.references)):
                found.setdefault(id(holder), holder)
        for back in view.of_kind(ccode.Return):
            function = ancestor_of_kind(back, ccode.Function)
            if function is not None and _is_char(function.returnType) and _negative(back.value, results):
                found.setdefault(id(function), function)
        for call in view.of_kind(ccode.Call):
            parameters = list(call.callee.parameters) if call.callee is not None and call.callee.definition else []
            for parameter, argument in zip(parameters, call.arguments, strict=False):
                if _is_char(parameter.valueType) and _negative(argument, results):
                    found.setdefault(id(parameter), parameter)
    return [each for each in found.values() if _is_looked_at(each, set())]


def as_characters(holder: ccode.Declaration) -> Iterator[ccode.Expression]:
    """The uses that take another overload for a type that is not plain char: those that print it, or add it to a text."""
    for use in _uses(holder):
        outer = use.eContainer()
        if isinstance(outer, (ccode.Binary, ccode.Assignment)):
            taken = _is_text(outer.right if outer.left is use else outer.left)
        else:
            printed = isinstance(outer, ccode.Call) and str(outer.calleeName) in _PRINTS
            taken = printed or isinstance(outer, ccode.ConstructorCall)
        if taken:
            yield use


def _is_text(expression: ccode.Expression | None) -> bool:
    kind = type_of(expression, {})
    return kind is not None and not kind.depth and kind.base == "String"


def _uses(holder: ccode.Declaration) -> Iterator[ccode.Expression]:
    """The expressions that have the value of a variable, of an element of it, or of a function's call."""
    for use in holder.calls if isinstance(holder, ccode.Function) else holder.references:
        at: ccode.Expression = use
        outer = at.eContainer()
        while isinstance(outer, ccode.Index) and outer.array is at:
            at, outer = outer, outer.eContainer()
        yield at


def _is_looked_at(holder: ccode.Declaration, seen: set[int]) -> bool:
    """Whether a use of a char has another result for a negative value than for the positive one with its bits."""
    if id(holder) in seen:
        return False
    seen.add(id(holder))
    return any(_is_seen(use, seen) for use in _uses(holder))


def _is_seen(use: ccode.Expression, seen: set[int]) -> bool:
    outer = use.eContainer()
    if isinstance(outer, ccode.Binary):
        other = outer.right if outer.left is use else outer.left
        if outer.operator in ("==", "!="):
            return not _is_small(other)
        if _is_text(other):
            return False
        return outer.operator not in ("&&", "||", ",") and not _is_one_of_two_bounds(outer, use)
    if isinstance(outer, ccode.Assignment):
        if outer.left is use:
            return outer.operator not in ("=", "+=", "-=", "|=", "&=", "^=", "<<=", "*=")
        target = outer.left.array if isinstance(outer.left, ccode.Index) else outer.left
        kept = target.target if isinstance(target, ccode.NameReference) else None
        return _takes_sign(type_of(outer.left, {}), kept, seen)
    if isinstance(outer, (ccode.Variable, ccode.Field)):
        return _takes_sign(of_use(outer.valueType), outer, seen)
    if isinstance(outer, ccode.Return):
        function = ancestor_of_kind(outer, ccode.Function)
        return function is None or _takes_sign(of_use(function.returnType), function, seen)
    if isinstance(outer, ccode.Call):
        return _is_seen_by(outer, use, seen)
    if isinstance(outer, ccode.Cast):
        return _takes_sign(of_use(outer.target), None, seen)
    if isinstance(outer, ccode.Switch):
        cases = (each for each in all_contents(outer) if isinstance(each, ccode.Case))
        return not all(_is_small(each.constant) for each in cases)
    if isinstance(outer, ccode.Unary):
        return outer.operator not in ("!", "&", "++", "--")
    return isinstance(outer, (ccode.Index, ccode.ConditionalExpression))


def _is_seen_by(call: ccode.Call, use: ccode.Expression, seen: set[int]) -> bool:
    name = str(call.calleeName)
    if name in _PRINTS or name.startswith(("is", "to")):
        return False
    member = call.calleeExpression
    if isinstance(member, ccode.Member) and name == "write":
        kind = type_of(member.object, {})
        return kind is not None and kind.base == "Servo"
    at = next((number for number, given in enumerate(call.arguments) if given is use), None)
    callee = call.callee
    if at is None or callee is None or at >= len(callee.parameters):
        return at is not None
    parameter = callee.parameters[at]
    return _takes_sign(of_use(parameter.valueType), parameter if callee.definition else None, seen)


def _takes_sign(kind: ValueType | None, holder: Element | None, seen: set[int]) -> bool:
    """Whether what a char is given to keeps more than its bits, or looks at their sign itself."""
    if kind is None:
        return True
    if isinstance(holder, (ccode.Variable, ccode.Parameter, ccode.Function)) and kind.base == "char":
        return _is_looked_at(holder, seen)
    return kind.base not in _BYTES


def _is_small(value: ccode.Expression | None) -> bool:
    """Whether a value is a constant that a char has with and without a sign."""
    return isinstance(value, (ccode.CharacterLiteral, ccode.IntegerLiteral)) and 0 <= int(value.value) < 128


def _is_one_of_two_bounds(comparison: ccode.Binary, use: ccode.Expression) -> bool:
    """Whether a comparison is half of `'0' <= c && c <= '9'`, which no negative value and no large one fulfils."""
    both = comparison.eContainer()
    if not isinstance(both, ccode.Binary) or both.operator != "&&" or comparison.operator not in _OPPOSITES:
        return False
    ways = set()
    for half in (both.left, both.right):
        if not isinstance(half, ccode.Binary) or half.operator not in _OPPOSITES:
            return False
        turned = not _is_small(half.right)
        one, other = (half.right, half.left) if turned else (half.left, half.right)
        if not _is_small(other) or expression_text(one) != expression_text(use):
            return False
        ways.add((half.operator in ("<", "<=")) != turned)
    return len(ways) == 2


_PRINTS = frozenset(["print", "println", "concat", "String"])
"""Functions that do something else with a number than with a character."""
_BYTES = frozenset(["char", "signed char", "unsigned char", "uint8_t", "int8_t", "byte", "bool", "boolean", "String"])
_OPPOSITES = frozenset(["<", "<=", ">", ">="])


def _is_char(use: ccode.TypeUse | None) -> bool:
    return use is not None and not use.pointerDepth and " ".join(str(use.spelling).split()) in _CHAR


def _given(holder: ccode.Variable | ccode.Parameter) -> Iterator[ccode.Expression | None]:
    """What a variable, or an element of it, is given."""
    if isinstance(holder, ccode.Variable):
        initial = holder.initializer
        yield from initial.elements if isinstance(initial, ccode.InitializerList) else [initial]
    for reference in holder.references:
        at: ccode.Expression = reference
        outer = at.eContainer()
        while isinstance(outer, ccode.Index) and outer.array is at:
            at, outer = outer, outer.eContainer()
        if isinstance(outer, ccode.Assignment) and outer.left is at:
            yield outer.right


def _negative(value: ccode.Expression | None, results: Mapping[str, tuple[int, int]]) -> bool:
    """Whether a value is negative at times: something with a minus, or what a function returns."""
    if isinstance(value, ccode.Unary):
        return value.operator == "-" and not isinstance(value.operand, ccode.FloatingLiteral)
    if isinstance(value, ccode.ConditionalExpression):
        return _negative(value.whenTrue, results) or _negative(value.whenFalse, results)
    if isinstance(value, ccode.Cast):
        return _negative(value.operand, results)
    return isinstance(value, ccode.Call) and results.get(str(value.calleeName), (0, 0))[0] < 0


def _asks_for_sign(reference: ccode.NameReference) -> bool:
    """Whether a name, or an element of an array, is compared with a negative number, or with zero by `<` or its like."""
    at: ccode.Expression = reference
    outer = at.eContainer()
    while isinstance(outer, ccode.Index) and outer.array is at:
        at, outer = outer, outer.eContainer()
    if not isinstance(outer, ccode.Binary) or outer.operator not in COMPARISONS:
        return False
    other = outer.right if outer.left is at else outer.left
    if isinstance(other, ccode.Unary) and other.operator == "-":
        return True
    below = "<" if outer.left is at else ">"
    return isinstance(other, ccode.IntegerLiteral) and int(other.value) == 0 and outer.operator in (below, _OPPOSITE[below])


_OPPOSITE = {"<": ">=", ">": "<="}
