"""Constraints on numbers that a program keeps in types which are no numbers: pointers and enumerations have fewer bits there.

Widths of numbers are kept by changes of text (`m2m.widths`); a pointer and an enumeration have the target's width in any case.
"""

from __future__ import annotations

from collections.abc import Iterator

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.constraints.code_move import Move, move, moved, place, the_move, together
from robosmi.transformations.queries.expression_type import expectations, of_use
from robosmi.typed import distinct
from robosmi.validate import Fail

units = moved.context(ccode.SourceUnit, guard=lambda _: (m := move()) is not None and m.there.pointer_bits < m.here.pointer_bits)


@units.constraint(
    id="RS336", severity=Severity.warning, location=place, advice="keep the number in a variable, and give the variable's address"
)
def KeepsTheNumber(unit: ccode.SourceUnit) -> bool | Fail:
    """No number is kept in a pointer or an enumeration that has not the bits for it on the target."""
    m = the_move()
    found = [*_in_pointers(m, unit), *_in_enumerations(m, unit)]
    said = ", ".join(distinct(f"{value} in {what}" for _, value, what in found))
    return not found or together(
        f"numbers are kept where the target has {m.there.pointer_bits} bits with a sign, and they do not fit: {said}",
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
