"""Ports that a program reaches by bits of registers (`OUTA |= 1 << 5`): which of them the text says, and what is done there.

Which registers have a bit for each port is data of the platform.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from robosmi.metamodels import ccode
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.pin_uses import PinUse
from robosmi.transformations.queries.values import Values

_WORD = 64
_ALL = (1 << 32) - 1
"""All bits of a register."""
_WRITES = ("=", "|=", "^=", "&=")


def register_bits(view: CodeView, values: Values) -> list[PinUse]:
    """The uses of ports as bits of registers, in text order; of a mask that the text does not say, one use of no known pin.

    A bit that no port has, because the mask is wider than the register, is a use of that number.

    Args:
        view: of the unit.
        values: values in the unit.
    """
    registers: dict[str, str] = view.api.settings.get("ports", {}).get("registers", {})
    count = view.api.ports
    found: dict[tuple[int | None, str, int], PinUse] = {}
    for reference in view.of_kind(ccode.NameReference):
        direction = registers.get(str(reference.name))
        if direction is None or isinstance(reference.target, (ccode.Variable, ccode.Parameter)) or _put_back(reference):
            continue
        for bit in _bits(reference, values, count):
            use = PinUse(
                bit, expression_text(reference), "register", str(reference.name), direction, int(reference.line), reference
            )
            found.setdefault((bit, use.function, use.line), use)
    return sorted(found.values(), key=lambda u: (u.line, int(u.call.startOffset)))


def _bits(reference: Any, values: Values, count: int) -> Iterator[int | None]:
    """The bits of one use of a register."""
    whole = (1 << count) - 1
    parent: Any = reference.eContainer()
    if isinstance(parent, ccode.Assignment) and parent.left is reference:
        operator = str(parent.operator)
        mask = _changed(values, parent.right, reference, whole if operator == "&=" else 0) if operator in _WRITES else None
    elif isinstance(parent, ccode.Binary) and str(parent.operator) == "&":
        mask = _mask(values, parent.right if parent.left is reference else parent.left)
    elif isinstance(parent, ccode.Binary) and str(parent.operator) == ">>" and parent.left is reference:
        places = [v.number for v in values.of(parent.right)]
        known = [place for place in places if place is not None and 0 <= place < _WORD]
        mask = sum(1 << place for place in set(known)) if len(known) == len(places) else None
    else:
        mask = None
    if mask is None:
        yield None
        return
    mask = mask if mask >= 0 else mask & whole
    yield from (bit for bit in range(mask.bit_length()) if mask >> bit & 1)


def _put_back(reference: Any) -> bool:
    """Whether a use of a register only gives back to the same register the bits that an assignment leaves alone."""
    inner, outer = reference, reference.eContainer()
    while isinstance(outer, (ccode.Binary, ccode.Cast, ccode.Unary)):
        inner, outer = outer, outer.eContainer()
    left = outer.left if isinstance(outer, ccode.Assignment) and outer.right is inner and str(outer.operator) == "=" else None
    return isinstance(left, ccode.NameReference) and left.name == reference.name


def _changed(values: Values, expression: Any, register: Any, cleared: int = 0) -> int | None:
    """The bits that an assignment changes: of what is put back with `|`, `&` or `^`, those of the other side."""
    operator = str(expression.operator) if isinstance(expression, ccode.Binary) else ""
    if operator in ("|", "^", "&") and not cleared:
        sides = [expression.left, expression.right]
        own = [side for side in sides if isinstance(side, ccode.NameReference) and side.name == register.name]
        if own:
            other = sides[0] if own[0] is sides[1] else sides[1]
            return _mask(values, other, _ALL if operator == "&" else 0)
        if operator != "&":
            found = [_changed(values, side, register) for side in sides]
            return None if None in found else (found[0] or 0) | (found[1] or 0)
    return _mask(values, expression, cleared)


def _mask(values: Values, expression: Any, cleared: int = 0) -> int | None:
    """All bits of the values of an expression; with `cleared`, those of its complement. None where a value is not known."""
    found = 0
    for value in values.of(expression):
        if value.number is None:
            return None
        found |= ~value.number & cleared if cleared else value.number
    return found
