"""Texts that say how numbers are printed and read: what has to change in them when what is passed has another width.

Functions of the standard library with a format, and the program's own that hand theirs on to one. A width that is not in the
text (`%d` for 32 bits) is put in; what is passed in fewer bits than the text names is converted. Adapters of the platform know
what they are given and need nothing of this. Source: ISO/IEC 9899:1999, 7.19.6.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from robosmi.transformations.queries.numbers import Machine, Number
from robosmi.transformations.queries.typed import TypedExpression

_PRINTED = re.compile(r"%[-+ #0']*(\*|\d+)?(?:\.(\*|-?\d+)?)?(hh|h|ll|l|j|z|t|L)?([a-zA-Z%])")
_READ = re.compile(r"%(\*)?\d*(hh|h|ll|l|j|z|t|L)?([a-zA-Z%]|\[\^?\]?[^\]]*\])")
_NUMBERS = frozenset("diuxXo")
Conversion = tuple[str, str, int]
"""Length as written, letter (`*` for a width that is passed), offset of the letter in the text."""


def has_format(name: str) -> bool:
    """Whether a function of the standard library takes a format."""
    return name.endswith(("printf", "scanf"))


def handing_on(top: Iterable[TypedExpression]) -> set[str]:
    """The program's functions that hand a format on to the standard library."""
    return {node.name for node in top if node.form == "function" and any(_hands_on(child) for child in node.children)}


def _hands_on(node: TypedExpression) -> bool:
    if node.form == "call" and node.origin == "standard" and node.name.startswith("v") and has_format(node.name):
        return True
    return any(_hands_on(child) for child in node.children)


def conversions(text: str, reads: bool) -> Iterator[Conversion]:
    """What a format names, in the order of what is passed.

    Args:
        text: the format as it is written, quotes included.
        reads: it is one of scanf and its like.
    """
    for found in (_READ if reads else _PRINTED).finditer(text):
        *stars, length, letter = found.groups()
        if letter == "%" or (reads and stars[0]):
            continue
        yield from (("", "*", found.start()) for star in stars if star == "*")
        yield length or "", letter, found.end() - 1


def wanted(
    there: Machine, conversion: Conversion, number: Number | None, wide: Number | None, sure: bool
) -> tuple[bool, Number | None]:
    """Whether the text has to name 32 bits, and what the value has to be converted to.

    Args:
        there: the target.
        conversion: what the text names.
        number: what is passed on the target, as it is promoted; None where that is not known.
        wide: what is passed on the source.
        sure: the value is a constant that is not negative.
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
