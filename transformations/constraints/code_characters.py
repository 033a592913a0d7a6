"""Constraints on plain char if its signedness differs between source and target: comparisons, shifts, values.

Text is not affected: comparing with an ASCII character, or passing a value on as a character, works the same on both.
"""

from __future__ import annotations

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.constraints.code_move import Move, move, moved, place, the_move, together
from robosmi.transformations.queries.expression_type import of_use, type_of
from robosmi.transformations.queries.numbers import COMPARISONS
from robosmi.validate import Fail


def is_resigned() -> bool:
    """Whether the signedness of plain char changes with the platform and the text is not changed to keep it."""
    m = move()
    return m is not None and m.here.char_signed != m.there.char_signed and not m.fixed


units = moved.context(ccode.SourceUnit, guard=lambda _: is_resigned())
comparisons = moved.context(ccode.Binary, guard=lambda b: b.operator in COMPARISONS and is_resigned())


@comparisons.constraint(
    id="RS317", severity=Severity.warning, location=place,
    advice="declare it as uint8_t or int8_t, or as int if it can be -1",
)  # fmt: skip
def ComparesAsBefore(b: ccode.Binary) -> bool | Fail:
    """No plain char is compared with a number that is in its range on only one of the platforms."""
    m = the_move()
    for one, other in ((b.left, b.right), (b.right, b.left)):
        if _is_char(m, one) and (value := m.ranges.of(other)) is not None and value.single and value.given:
            if value.low == 0 and b.operator in ("==", "!="):
                return True
            sign = value.low < 0 or (value.low == 0 and ((b.operator in ("<", ">=")) == (one is b.left)))
            if sign or value.low > 0x7F:
                here, there = ("signed" if x.char_signed else "unsigned" for x in (m.here, m.there))
                return Fail(
                    f"a char is compared with {value.low}: char is {here} on {m.source.name} and {there} on {m.target.name}"
                )
    return True


@units.critique(id="RS318", info=True, location=place, advice="declare bytes as uint8_t")
def CountsAsBefore(unit: ccode.SourceUnit) -> bool | Fail:
    """No plain char is shifted, or assigned a value that is in its range on only one of the platforms."""
    m = the_move()
    view = m.view(unit)
    some = [b.left for b in view.of_kind(ccode.Binary) if b.operator in ("<<", ">>") and _may_be_high(m, b.left)]
    some += [
        v.initializer
        for v in view.of_kind(ccode.Variable)
        if v.initializer is not None and (kind := of_use(v.valueType)) is not None and kind.base == "char" and not kind.depth
        and _is_out(m, v.initializer)
    ]  # fmt: skip
    some += [a.right for a in view.of_kind(ccode.Assignment) if a.operator == "=" and _is_out(m, a.right) and _is_char(m, a.left)]
    found = sorted((e for e in some if e is not None), key=lambda e: e.startOffset)
    return not found or together(f"{quantity(len(found), 'plain char')} may have values above 127 or below 0", found)


def _may_be_high(m: Move, expression: ccode.Expression | None) -> bool:
    if not _is_char(m, expression):
        return False
    value = m.ranges.of(expression)
    return value is None or not value.within(0, 0x7F)


def _is_out(m: Move, expression: ccode.Expression | None) -> bool:
    if isinstance(expression, ccode.CharacterLiteral):
        return False
    value = m.ranges.of(expression)
    return value is not None and value.single and value.given and not value.within(0, 0x7F)


def _is_char(m: Move, expression: ccode.Expression | None) -> bool:
    if not isinstance(expression, (ccode.NameReference, ccode.Index, ccode.Member, ccode.Unary, ccode.Call)):
        return False
    if isinstance(expression, ccode.Unary) and expression.operator != "*":
        return False
    if isinstance(expression, ccode.Call) and expression.calleeName in m.adapted:
        return False  # an adapter gives what the source's function gave
    kind = type_of(expression, m.numbers.functions)
    return kind is not None and kind.base == "char" and not kind.depth
