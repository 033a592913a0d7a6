"""Constraints on printf and scanf formats: conversions must be as wide as their arguments on the target.

A function takes a format if the last parameter before "..." is a string. Where int and long are the same on the source, `%d`
and `%ld` are both correct; on a target with a narrower int only one is, and the arguments after it are read from wrong places.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robosmi.diagnostics import Severity
from robosmi.metamodels import ccode
from robosmi.transformations.constraints.code_move import Move, is_narrower, moved, place, the_move
from robosmi.transformations.queries.expression_type import element_type, type_of
from robosmi.validate import Fail

_CONVERSION = re.compile(r"%[-+ #0']*+(\*|\d+)?(?:\.(\*|-?\d+)?)?(hh|h|ll|l|j|z|t|L)?([a-zA-Z%\[])")
_INTEGERS = frozenset("diuxXobc")
_TEXT = re.compile(r"\s*(?:const\s+)?char\s*(?:const\s*)?\*")

calls = moved.context(
    ccode.Call, guard=lambda c: any(isinstance(a, ccode.StringLiteral) for a in c.arguments) and not c.viaMacro and is_narrower()
)


@calls.constraint(
    id="RS316", severity=Severity.warning, location=place,
    advice="cast the argument to the type in the format: (int) for %d, (long) for %ld",
)  # fmt: skip
def NamesWhatIsPassed(call: ccode.Call) -> bool | Fail:
    """Every integer argument is as wide as its conversion in the format says."""
    m = the_move()
    given = _format(m, call)
    if given is None:
        return True
    text, values = given
    wrong = []
    for (letters, wanted), value in zip(_conversions(m, text), values, strict=False):
        bits = _bits(m, value)
        if wanted and bits and bits != wanted:
            wrong.append(f"{letters} takes {wanted} bits, but gets {bits}")
    return not wrong or Fail(f"{call.calleeName}: on the target {'; '.join(wrong)}")


def _format(m: Move, call: ccode.Call) -> tuple[str, list[ccode.Expression]] | None:
    """A call's format text and the arguments for it; None if the function takes no format or it is not a literal."""
    function = call.callee
    position = -1
    if function is not None and function.variadic and function.parameters:
        last = function.parameters[len(function.parameters) - 1].valueType
        if last is not None and (last.canonical or last.spelling).replace("const", "").split() == ["char", "*"]:
            position = len(function.parameters) - 1
    elif call.calleeName in m.signatures:
        taken = m.signatures[call.calleeName]
        if len(taken) > 1 and taken[-1] == "..." and _TEXT.match(taken[-2]):
            position = len(taken) - 2
    arguments: list[ccode.Expression] = list(call.arguments)
    text = arguments[position] if 0 <= position < len(arguments) else None
    if not isinstance(text, ccode.StringLiteral):
        return None
    return str(text.text), arguments[position + 1 :]


def _conversions(m: Move, text: str) -> Iterator[tuple[str, int]]:
    """The arguments that a format expects, as (conversion, bits on the target); the bits are 0 for anything but an integer."""
    for found in _CONVERSION.finditer(text):
        width, precision, length, letter = found.groups()
        if letter == "%":
            continue
        if "*" in (width, precision):
            yield from (("*", m.there.int_bits) for part in (width, precision) if part == "*")
        bits = {"l": m.there.long_bits, "ll": 64, "j": 64, "z": m.there.pointer_bits, "t": m.there.pointer_bits}
        yield found[0], bits.get(length or "", m.there.int_bits) if letter in _INTEGERS else 0


def _bits(m: Move, value: ccode.Expression) -> int:
    """The bits of an integer argument, or of the integer that a pointer argument points to; 0 for anything else."""
    number = m.numbers.of(value)
    if number is not None:
        return 0 if number.real else max(number.bits, m.there.int_bits)
    pointed = m.numbers.typed(element_type(type_of(value, m.numbers.functions)))
    return pointed.bits if pointed is not None and not pointed.real and pointed.bits >= m.there.int_bits else 0
