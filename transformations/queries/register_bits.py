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

_WRITES = ("=", "|=", "^=", "&=")


def register_bits(view: CodeView, values: Values) -> list[PinUse]:
    """The uses of ports as bits of registers, in text order; of a mask that the text does not say, one use of no known pin.

    Args:
        view: of the unit.
        values: values in the unit.
    """
    registers: dict[str, str] = view.api.settings.get("ports", {}).get("registers", {})
    count = int(view.api.settings.get("ports", {}).get("count", 32))
    found: dict[tuple[int | None, str, int], PinUse] = {}
    for reference in view.of_kind(ccode.NameReference):
        direction = registers.get(str(reference.name))
        if direction is None or isinstance(reference.target, (ccode.Variable, ccode.Parameter)):
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
        mask = _mask(values, parent.right, whole if operator == "&=" else 0) if operator in _WRITES else None
    elif isinstance(parent, ccode.Binary) and str(parent.operator) == "&":
        mask = _mask(values, parent.right if parent.left is reference else parent.left)
    elif isinstance(parent, ccode.Binary) and str(parent.operator) == ">>" and parent.left is reference:
        places = [v.number for v in values.of(parent.right)]
        known = [place for place in places if place is not None and 0 <= place < count]
        mask = sum(1 << place for place in set(known)) if len(known) == len(places) else None
    else:
        mask = None
    if mask is None:
        yield None
        return
    yield from (bit for bit in range(count) if mask >> bit & 1)


def _mask(values: Values, expression: Any, cleared: int = 0) -> int | None:
    """All bits of the values of an expression; with `cleared`, those of its complement. None where a value is not known."""
    found = 0
    for value in values.of(expression):
        if value.number is None:
            return None
        found |= ~value.number & cleared if cleared else value.number
    return found
