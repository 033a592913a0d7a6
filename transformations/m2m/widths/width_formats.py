"""Formats of printf and scanf: what has to change in them if the arguments have other widths on the target.

This covers functions of the standard library with a format, and the program's functions that pass theirs on to one. A missing
length (`%d` for 32 bits) is inserted; an argument narrower than the format says is cast. The platform's adapters know the
widths of their arguments and need no changes. Source: ISO/IEC 9899:1999, 7.19.6.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from robosmi.transformations.queries.numbers import Machine, Number
from robosmi.transformations.queries.typed import TypedExpression

_PRINTED = re.compile(r"%[-+ #0']*+(\*|\d+)?(?:\.(\*|-?\d+)?)?(hh|h|ll|l|j|z|t|L)?([a-zA-Z%])")
_READ = re.compile(r"%(\*)?\d*(hh|h|ll|l|j|z|t|L)?([a-zA-Z%]|\[\^?\]?[^\]]*\])")
_NUMBERS = frozenset("diuxXo")
Conversion = tuple[str, str, int]
"""A conversion specification: length as written, letter (`*` for a width passed as an argument), offset of the letter."""


def has_format(name: str) -> bool:
    """Whether a function of the standard library takes a format."""
    return name.endswith(("printf", "scanf"))


def handing_on(top: Iterable[TypedExpression]) -> set[str]:
    """The program's functions that pass a format on to the standard library; one with a deduced result is typed as a lambda."""
    return {node.name for node in top if node.form in ("function", "lambda") and any(_hands_on(child) for child in node.children)}


def _hands_on(node: TypedExpression) -> bool:
    if node.form == "call" and node.origin == "standard" and node.name.startswith("v") and has_format(node.name):
        return True
    return any(_hands_on(child) for child in node.children)


def conversions(text: str, reads: bool) -> Iterator[Conversion]:
    """The conversion specifications of a format, in the order of their arguments.

    Args:
        text: the string literal as written, including its quotes.
        reads: whether it is a format of scanf and its relatives.
    """
    for found in (_READ if reads else _PRINTED).finditer(text):
        *stars, length, letter = found.groups()
        if letter == "%" or (reads and stars[0]):
            continue
        yield from (("", "*", found.start()) for star in stars if star == "*")
        yield length or "", letter, found.end() - 1


def required_length(
    there: Machine, conversion: Conversion, number: Number | None, wide: Number | None, sure: bool
) -> tuple[bool, Number | None]:
    """Whether a conversion needs the length `l` inserted, and the type that its argument has to be cast to (None: no cast).

    Args:
        there: the target's integer types.
        conversion: the conversion specification.
        number: the argument's promoted type on the target; None if unknown.
        wide: the argument's type on the source.
        sure: the argument is a non-negative constant.
    """
    length, letter, _ = conversion
    if number is None or number.real or wide is None:
        return False, None
    if letter in ("*", "c"):
        return False, there.integer if number.bits > there.int_bits else None
    if letter not in _NUMBERS:
        return False, None
    if length in ("h", "hh"):
        return False, Number(there.int_bits, letter in "di") if number.bits > there.int_bits else None
    if length in ("z", "t"):  # the target's are narrower, and what is passed is written with its width there
        return False, Number(there.pointer_bits, letter in "di") if number.bits > there.pointer_bits else None
    if length in ("ll", "j"):
        return False, Number(64, wide.signed) if number.bits < 64 else None
    if number.bits > there.int_bits:
        return not length and number.bits == there.long_bits, None
    if length == "l":
        return False, Number(there.long_bits, wide.signed)
    same = number.signed == (letter in "di") or (sure and number.signed)
    return (False, None) if same else (True, Number(there.long_bits, wide.signed))
