"""Constraints on numbers in types that no text change widens: pointers, enumerations, long double, library parameters.

Other numbers keep their widths by text changes (`m2m.widths`); these types have the target's width in any case.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.constraints.code_move import Move, move, moved, place, the_move, together
from robosmi.transformations.queries.expression_type import expectations, of_use, parse
from robosmi.transformations.queries.resources.type_sizes import TypeSizes
from robosmi.transformations.queries.signature_text import function_type
from robosmi.validate import Fail

_LONG_DOUBLE = "long double"
_BYTES = frozenset(["memset", "memchr", "strchr", "strrchr"])
"""Standard library functions that convert their int argument to a character (ISO/IEC 9899:1999, 7.21)."""

units = moved.context(ccode.SourceUnit, guard=lambda _: (m := move()) is not None and m.there.pointer_bits < m.here.pointer_bits)

narrower = moved.context(ccode.SourceUnit, guard=lambda _: (m := move()) is not None and m.narrower)
shorter = moved.context(ccode.SourceUnit, guard=lambda _: (m := move()) is not None and _long_double(m)[1] < _long_double(m)[0])


@units.constraint(
    id="RS336",
    severity=Severity.warning,
    location=place,
    advice="store the number in a variable, and pass the variable's address",
)
def KeepsTheNumber(unit: ccode.SourceUnit) -> bool | Fail:
    """No number is stored in a pointer or an enumeration that is too narrow for it on the target."""
    m = the_move()
    found = [*_in_pointers(m, unit), *_in_enumerations(m, unit)]
    said = ", ".join(dict.fromkeys(f"{value} in {what}" for _, value, what in found))
    return not found or together(
        f"numbers do not fit where the target has {m.there.pointer_bits} signed bits: {said}",
        [element for element, _, _ in found],
    )


def _in_pointers(m: Move, unit: ccode.SourceUnit) -> Iterator[tuple[ccode.Located, int, str]]:
    most = 1 << m.there.pointer_bits - 1
    for cast in m.view(unit).of_kind(ccode.Cast):
        kind = of_use(cast.target)
        value = m.ranges.of(cast.operand) if kind is not None and kind.depth and cast.operand is not None else None
        if value is not None and value.single and not value.within(-most, most - 1):
            yield cast, value.low, "a pointer"


def _in_enumerations(m: Move, unit: ccode.SourceUnit) -> Iterator[tuple[ccode.Located, int, str]]:
    for expression, kind in expectations(m.view(unit), {}):
        declared = kind.declaration
        if kind.depth or not isinstance(declared, ccode.Enumeration):
            continue
        values = [int(literal.value) for literal in declared.literals]
        most = max(values, default=0)
        if most >= 1 << m.there.int_bits or min(values, default=0) < 0:
            continue  # it has the bits for its own values, and a sign
        value = m.ranges.of(expression)
        if value is not None and value.single and not value.within(0, max(most, (1 << m.there.int_bits - 1) - 1)):
            yield expression, value.low, f"the enumeration '{declared.name}'" if declared.name else "an enumeration"


@shorter.constraint(
    id="RS338",
    severity=Severity.warning,
    location=place,
    advice="check that about 7 digits are enough, or compute in whole numbers",
)
def KeepsItsPrecision(unit: ccode.SourceUnit) -> bool | Fail:
    """No long double is declared or measured that has fewer digits on the target."""
    m = the_move()
    uses = (use for use in m.view(unit).of_kind(ccode.TypeUse) if _is_long_double(use) and not use.pointerDepth)
    found = list(dict.fromkeys(one for use in uses if isinstance(one := use.eContainer(), ccode.Located)))
    here, there = _long_double(m)
    return not found or together(f"long double has {there} bytes on the target, not {here}: numbers have fewer digits", found)


def _long_double(m: Move) -> tuple[int, int]:
    """The sizes of long double on source and target in bytes."""
    return TypeSizes(m.source).plain[_LONG_DOUBLE], TypeSizes(m.target).plain[_LONG_DOUBLE]


def _is_long_double(use: ccode.TypeUse) -> bool:
    kind = of_use(use)
    return kind is not None and kind.base == _LONG_DOUBLE and not kind.depth


@narrower.constraint(
    id="RS339",
    severity=Severity.warning,
    location=place,
    advice="pass a smaller number, or store it in a variable of 32 bits",
)
def TakesTheNumber(unit: ccode.SourceUnit) -> bool | Fail:
    """No number is passed to a function of the target's own library whose parameter is too narrow for it."""
    found = list(_handed(the_move(), unit))
    said = ", ".join(dict.fromkeys(f"{value} to {name}" for _, value, name in found))
    return not found or together(
        f"numbers are too large for functions of the standard library that take {the_move().there.int_bits} bits on the target, "
        f"which truncate them: {said}",
        [element for element, _, _ in found],
    )


def _handed(m: Move, unit: ccode.SourceUnit) -> Iterator[tuple[ccode.Located, int, str]]:
    """Arguments that the target's library truncates, as (argument, value, function)."""
    view = m.view(unit)
    widened = {str(each.sourceType) for each in m.target.widerNames} if m.fixed else set()
    for name, function in view.called().items():
        entry = function.entry
        if (
            entry is None
            or view.api.kind_of(entry) != "standard"
            or name in m.served | widened | _BYTES
            or "(*" in entry.parameters
        ):
            continue
        kinds = [parse(p) for p in function_type(view.api.signature(name, entry)).parameters]
        for call in (*function.calls, *function.made):
            for argument, kind in zip(call.arguments, kinds, strict=False):
                number = m.there.number(kind.base) if kind is not None and not kind.depth else None
                if number is None or number.real or number.fixed or number.bits > m.there.int_bits:
                    continue
                value = m.ranges.of(argument)
                if value is not None and value.single and not value.within(-(1 << number.bits - 1), number.most):
                    yield argument, value.low, name
