"""Constraints on numbers that exceed a narrower int of the target: declarations, literals, sums, products, shifts, sizes.

A warning is about a value that is known statically and does not fit; expressions whose values come from inputs get one remark
per file. Expressions that are computed in 32 bits on the target anyway (long, results of adapters), and values that are
truncated on purpose, are not mentioned.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeGuard

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.constraints.code_move import Move, is_narrower, move, moved, place, the_move, together
from robosmi.transformations.queries.expression_type import of_use
from robosmi.transformations.queries.names import named_type
from robosmi.transformations.queries.numbers import COMPARISONS, Number
from robosmi.validate import Fail

if TYPE_CHECKING:
    from robosmi.transformations.queries.constants.ranges import Range

ARITHMETIC = frozenset(["+", "-", "*", "<<"])
_CUT = ARITHMETIC | {"&", "|", "^"}
_LARGE = 256  # a factor, or what a shift multiplies with, that takes a value of two digits beyond 16 bits

units = moved.context(ccode.SourceUnit, guard=lambda _: is_narrower())
sizes = moved.context(ccode.SourceUnit, guard=lambda _: (m := move()) is not None and m.narrower)
literals = moved.context(ccode.IntegerLiteral, guard=lambda x: x.value > 0x7FFF and is_narrower())
macros = moved.context(ccode.NameReference, guard=lambda r: r.target is None and is_narrower() and _is_far(r))
enumerators = moved.context(
    ccode.NameReference,
    guard=lambda r: isinstance(r.target, ccode.EnumerationLiteral) and r.target.value > 0x7FFF and is_narrower(),
)
operations = moved.context(ccode.Binary, guard=lambda b: (b.operator in ARITHMETIC or b.operator == ">>") and is_narrower())


@units.critique(id="RS310", info=True, location=place, advice="use int32_t where values may exceed 16 bits")
def IsDeclaredInt(unit: ccode.SourceUnit) -> bool | Fail:
    """No variable, parameter or result of type int gets narrower."""
    m = the_move()
    narrow = [
        t.eContainer()
        for t in m.view(unit).of_kind(ccode.TypeUse)
        if t.bits == m.here.int_bits and t.pointerDepth == 0 and _says_int(t.canonical or t.spelling) and not _is_fixed(m, t)
    ]  # fmt: skip
    return not narrow or together(
        f"int has {m.here.int_bits} bits on {m.source.name} and {m.there.int_bits} on {m.target.name}: "
        f"{len(narrow)} declaration(s) of type int are unchanged",
        [x for x in narrow if isinstance(x, ccode.Located)],
    )


def _is_fixed(m: Move, use: ccode.TypeUse) -> bool:
    """Whether a type that is int on the source is spelled as one of fixed width (int32_t)."""
    if _says_int(use.spelling):
        return False
    kind = of_use(use)
    number = m.there.number(kind.base) if kind is not None else None
    return number is not None and number.fixed


def _says_int(spelling: str) -> bool:
    words = set(spelling.replace("const", " ").replace("volatile", " ").split())
    return bool(words) and words <= {"int", "signed", "unsigned"}


def _is_far(reference: ccode.NameReference) -> bool:
    """Whether a macro's value does not fit into 16 bits."""
    value = the_move().ranges.of(reference) if reference.name in the_move().numbers.macros else None
    return value is not None and not value.within(-0x8000, 0x7FFF)


@macros.constraint(
    id="RS313", severity=Severity.warning, location=place, advice="compute in 32 bits: add L to a number in the macro's text"
)
def ExpandsWithinInt(reference: ccode.NameReference) -> bool | Fail:
    """The value of a macro fits the target's int in which it is computed."""
    m = the_move()
    value, number = m.ranges.of(reference), m.numbers.of(reference)
    narrow = value is not None and number is not None and number.bits == m.there.int_bits
    if not narrow or value is None or number is None or value.within(number.least, number.most) or _is_cut(m, reference):
        return True
    return Fail(f"'{reference.name}' stands for {value.low}, but the target computes it in {number.bits} bits")


@macros.constraint(
    id="RS311", severity=Severity.warning, location=place, advice="declare the other side, a variable or parameter, as int32_t"
)
def StandsForWhatFits(reference: ccode.NameReference) -> bool | Fail:
    """A macro's value is stored in, or compared with, a type that can hold it on the target."""
    return _fits(reference)


@enumerators.constraint(
    id="RS311", severity=Severity.warning, location=place, advice="declare the other side, a variable or parameter, as int32_t"
)
def CountsWhatFits(reference: ccode.NameReference) -> bool | Fail:
    """An enumerator's value is stored in, or compared with, a type that can hold it on the target."""
    return _fits(reference)


@literals.constraint(
    id="RS311", severity=Severity.warning, location=place, advice="declare the other side, a variable or parameter, as int32_t"
)
def FitsWhereItGoes(literal: ccode.IntegerLiteral) -> bool | Fail:
    """A literal is stored in, or compared with, a type that can hold it on the target."""
    return _fits(literal)


def _fits(one: ccode.NameReference | ccode.IntegerLiteral) -> bool | Fail:
    m = the_move()
    top: ccode.Expression = one
    parent = top.eContainer()
    while _hands_on(parent, top):
        top, parent = parent, parent.eContainer()
    goes = _goes(m, top, parent)
    value = m.ranges.of(top)
    if goes is None or value is None or value.within(goes[0].least, goes[0].most):
        return True
    if id(top) in m.told:
        return True  # by another number in the same expression
    m.told.add(id(top))
    return Fail(f"{_shown(value, one, top)} does not fit into {goes[1]} of {goes[0].bits} bits on the target")


def _hands_on(parent: Element | None, one: ccode.Expression) -> TypeGuard[ccode.Expression]:
    if isinstance(parent, ccode.Unary):
        return parent.operator in ("+", "-")
    if isinstance(parent, ccode.Binary):
        return parent.operator in ("+", "-", "*", "/", "%")
    return isinstance(parent, ccode.ConditionalExpression) and parent.condition is not one


def _goes(m: Move, top: ccode.Expression, parent: Element | None) -> tuple[Number, str] | None:
    """The target's int type that a value is stored in or compared with, and how messages call it; None for any other place."""
    number, called = None, ""
    if isinstance(parent, ccode.InitializerList):
        parent = parent.eContainer()
    if isinstance(parent, ccode.Variable):
        number, called = m.numbers.declared(parent.valueType), f"'{parent.name}'"
    elif (
        isinstance(parent, ccode.Assignment)
        and parent.right is top
        and parent.operator in ("=", "+=", "-=", "*=", "|=", "&=", "^=")
    ):
        number, called = m.numbers.of(parent.left), "the variable"
    elif isinstance(parent, ccode.Cast):
        number, called = m.numbers.of(parent), "the type of the cast"
    elif isinstance(parent, ccode.Call) and parent.callee is not None and parent.callee.definition:
        position = next((i for i, a in enumerate(parent.arguments) if a is top), -1)
        taken = parent.callee.parameters
        if 0 <= position < len(taken):
            number, called = m.numbers.declared(taken[position].valueType), f"the parameter '{taken[position].name}'"
    elif isinstance(parent, ccode.Binary) and parent.operator in COMPARISONS:
        other = parent.left if parent.right is top else parent.right
        known = m.ranges.of(other)
        if known is None or not known.given:
            number, called = m.numbers.of(other), "the int of the comparison"
    narrow = number is not None and not number.real and number.bits == m.there.int_bits and not number.fixed
    return (number, called) if narrow and number is not None else None


def _shown(value: Range, one: ccode.NameReference | ccode.IntegerLiteral, top: ccode.Expression) -> str:
    if top is one:
        return str(one.text) if isinstance(one, ccode.IntegerLiteral) else f"'{one.name}', {value.low},"
    return f"the value {value.low}" if value.single else f"a value of up to {max(abs(value.low), abs(value.high))}"


@operations.constraint(
    id="RS313",
    severity=Severity.warning,
    location=place,
    advice="compute in 32 bits: make one operand int32_t, or add L to a number",
)
def StaysWithinInt(b: ccode.Binary) -> bool | Fail:
    """An operation whose result is known to exceed the target's int is not computed in it."""
    m = the_move()
    found = _passes(m, b)
    if found is None or not found[0]:
        return True
    parent = b.eContainer()
    while isinstance(parent, ccode.Unary):
        parent = parent.eContainer()
    outer = _passes(m, parent) if isinstance(parent, ccode.Binary) and parent.operator in ARITHMETIC else None
    return (outer is not None and outer[0]) or Fail(found[1])


@units.critique(id="RS314", info=True, location=place, advice="use int32_t, or cast one operand, where values may exceed 16 bits")
def MayPassInt(unit: ccode.SourceUnit) -> bool | Fail:
    """No sum, product or shift of values from inputs can exceed the target's int."""
    m = the_move()
    view = m.view(unit)
    some: list[ccode.Located] = [b for b in view.of_kind(ccode.Binary) if b.operator in ARITHMETIC and _may_pass(m, b)]
    some += [a for a in view.of_kind(ccode.Assignment) if a.operator[:-1] in ARITHMETIC and _may_leave(m, a)]
    some.sort(key=lambda e: int(e.startOffset))
    return not some or together(
        f"{len(some)} sum(s), product(s) or shift(s) of int may exceed {m.there.int_bits} bits with values that "
        "only the running program knows",
        some,
    )


def _narrow(m: Move, b: ccode.Binary) -> Number | None:
    """The type of an operation if the target computes it in int; else None."""
    number = m.numbers.of(b)
    return number if number is not None and not number.real and number.bits == m.there.int_bits else None


def _passes(m: Move, b: ccode.Binary) -> tuple[bool, str] | None:
    """Whether an operation exceeds the target's int certainly (True) or possibly (False), and the message; None if neither."""
    number = _narrow(m, b)
    if number is None:
        return None
    amount = m.ranges.of(b.right) if b.operator in ("<<", ">>") else None
    if amount is not None and amount.single and amount.low >= number.bits:
        if m.ranges.of(b.left) == (0, 0, True) or (b.operator == ">>" and _fits_already(m, b)):
            return None
        return True, f"a shift by {amount.low} of an int of {number.bits} bits is undefined on the target"
    value = m.ranges.of(b) if b.operator != ">>" else None
    if value is None or value.within(number.least, number.most) or _is_cut(m, b):
        return None
    if b.operator in ("+", "-") and any(
        r is not None and _is_too_far(r, number) for r in (m.ranges.of(b.left), m.ranges.of(b.right))
    ):
        return None  # the operand is what does not fit
    if value.low >= 0 and b.operator == "<<" and value.high < 1 << number.bits and _is_mask(m, b):
        return None
    what = {"*": "product", "+": "sum", "-": "difference", "<<": "shift"}[b.operator]
    if value.single:
        return value.given, f"the {what} is {value.low}, but the target computes it in {number.bits} bits"
    far = value.high if value.high > number.most else value.low
    return value.given, f"the {what} can reach {far}, but the target computes it in {number.bits} bits"


def _is_too_far(value: Range, number: Number) -> bool:
    return not value.within(number.least, number.most)


def _fits_already(m: Move, b: ccode.Binary) -> bool:
    known = m.ranges.of(b.left)
    return known is not None and known.within(-0x8000, 0x7FFF)


def _is_mask(m: Move, b: ccode.Binary) -> bool:
    """Whether an operation whose result uses all 16 bits is only tested or combined with others, such as the bit 1 << 15."""
    parent = b.eContainer()
    return isinstance(parent, ccode.Binary) and parent.operator in ("&", "|", "^") and _narrow(m, parent) is not None


def _may_pass(m: Move, b: ccode.Binary) -> bool:
    number = _narrow(m, b)
    if number is None or _is_cut(m, b):
        return False
    value = m.ranges.of(b)
    if value is not None:
        return not value.given and not value.within(number.least, number.most)
    return _is_far_by(m, b.operator, m.ranges.of(b.left), m.ranges.of(b.right), number)


def _may_leave(m: Move, a: ccode.Assignment) -> bool:
    """Whether a compound assignment may exceed the range of its variable."""
    number, wide = m.numbers.of(a.left), m.numbers.of(a.right)
    if number is None or number.real or number.fixed or number.bits != m.there.int_bits or (wide is not None and wide.real):
        return False
    return _is_far_by(m, a.operator[:-1], None, m.ranges.of(a.right), number)


def _is_far_by(m: Move, operator: str, left: Range | None, right: Range | None, number: Number) -> bool:
    """Whether an operation with an operand of unknown value may exceed a type.

    An added or multiplied constant below 256, and a shift by less than 8, are assumed to be harmless.
    """
    if operator in ("+", "-"):
        small = left if left is not None else right
        return small is None or max(abs(small.low), abs(small.high)) >= _LARGE
    if operator == "<<":
        return (right is not None and right.single and 8 <= right.low < number.bits) or (right is None and left is not None)
    factor = left or right
    return factor is not None and factor.given and max(abs(factor.low), abs(factor.high)) >= _LARGE


def _is_cut(m: Move, expression: ccode.Located) -> bool:
    """Whether only the low bits of a value are used: a mask, or an assignment or cast to a narrow type, discards the others."""
    for one, parent in _upwards(expression):
        if isinstance(parent, ccode.Binary) and parent.operator in _CUT:
            if parent.operator == "&":
                other = m.ranges.of(parent.left if parent.right is one else parent.right)
                if other is not None and other.within(0, 0xFFFF):
                    return True
            if parent.operator == "<<" and parent.right is one:
                return False
            continue
        if isinstance(parent, ccode.Unary) and parent.operator in ("~", "-", "+"):
            continue
        if isinstance(parent, ccode.Cast):
            number = m.numbers.of(parent)
        elif isinstance(parent, ccode.Variable):
            number = m.numbers.declared(parent.valueType)
        elif (
            isinstance(parent, ccode.Assignment)
            and parent.right is one
            and parent.operator in ("=", "|=", "&=", "^=", "+=", "-=")
        ):
            number = m.numbers.of(parent.left)
        else:
            return False
        return number is not None and not number.real and number.fixed and number.bits <= m.there.int_bits
    return False


def _upwards(expression: Element) -> Iterator[tuple[Element, Element]]:
    one, parent = expression, expression.eContainer()
    while parent is not None:
        yield one, parent
        one, parent = parent, parent.eContainer()


@sizes.critique(id="RS315", info=True, location=place, advice="check what uses the number of bytes: a file, a message, a memory")
def KeepsItsSize(unit: ccode.SourceUnit) -> bool | Fail:
    """No `sizeof` of a type that is smaller on the target is used in computations."""
    m = the_move()
    some = [s for s in m.view(unit).of_kind(ccode.SizeOf) if _shrinks(m, s) and not _is_measure(m, s)]
    return not some or together(f"{len(some)} size(s) of types that have fewer bytes on the target", some)


def _shrinks(m: Move, size: ccode.SizeOf) -> bool:
    kind = of_use(size.measured if size.measured is not None else named_type(size.operand))
    if kind is None or kind.function:
        return False
    if kind.depth and not kind.array:
        return m.there.pointer_bits < m.here.pointer_bits
    if isinstance(kind.declaration, ccode.Enumeration):
        most = max((int(literal.value) for literal in kind.declaration.literals), default=0)
        return m.narrower and most <= 2**m.there.int_bits - 1
    here, there = m.here.number(kind.base), m.there.number(kind.base)
    if m.fixed and _says_int(kind.base):
        return False
    return here is not None and there is not None and there.bits < here.bits


def _is_measure(m: Move, size: ccode.SizeOf) -> bool:
    """Whether a size counts array elements or is passed to a function that is not variadic, such as one that copies memory.

    Such a size stays right if the type gets smaller; a variadic function such as printf may show it.
    """
    parent = size.eContainer()
    while isinstance(parent, (ccode.Binary, ccode.Cast)):
        if isinstance(parent, ccode.Binary) and parent.operator == "/":
            return True
        parent = parent.eContainer()
    if not isinstance(parent, ccode.Call):
        return False
    prints = parent.callee.variadic if parent.callee is not None else m.signatures.get(parent.calleeName, [""])[-1:] == ["..."]
    return not prints
