"""Ports that a program reaches by bits of registers (`OUTA |= 1 << 5`): which of them the text says, and what is done there.

Which registers have a bit for each port is data of the platform.
"""

from __future__ import annotations

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.flows.pin_uses import PinUse
from robosmi.transformations.queries.own_headers import own_macro
from robosmi.transformations.queries.ports.port_masks import WORD, PortMasks, union

_ALL = (1 << WORD) - 1
"""All bits of a register."""
_WRITES = ("=", "|=", "^=", "&=")


def register_bits(view: CodeView, masks: PortMasks) -> list[PinUse]:
    """The ports that a program uses as bits of registers, in text order.

    Where the text does not tell the bit, the use has no pin. A bit without a port, because the register has fewer bits than the
    mask, is a use of that number.

    Args:
        view: the unit.
        masks: the masks of the program.
    """
    registers: dict[str, str] = view.api.settings.get("ports", {}).get("registers", {})
    whole = (1 << view.api.ports) - 1
    found: dict[tuple[int | None, str, int], PinUse] = {}
    for reference in view.of_kind(ccode.NameReference):
        direction = registers.get(str(reference.name))
        if direction is None or isinstance(reference.target, (ccode.Variable, ccode.Parameter)) or _put_back(reference):
            continue
        if own_macro(view.unit, str(reference.name)) is not None:
            continue
        _add(found, _bits(reference, masks, whole), reference, str(reference.name), direction)
    for call in view.of_kind(ccode.Call):
        name, arguments = str(call.calleeName or ""), list(call.arguments)
        own = call.callee is not None and call.callee.definition
        meanings = [] if own else list(view.api.meaning(name).get("parameters", []))
        for argument in (a for a, meaning in zip(arguments, meanings, strict=False) if meaning == "mask"):
            _add(found, masks.bits(argument), call, name, "in")
    return sorted(found.values(), key=lambda u: (u.line, int(u.call.startOffset)))


def sets_bits(reference: ccode.Expression) -> bool:
    """Whether a register is assigned a value that may set bits of it."""
    parent = reference.eContainer()
    return isinstance(parent, ccode.Assignment) and parent.left is reference and parent.operator != "&="


def _add(
    found: dict[tuple[int | None, str, int], PinUse], mask: int | None, place: ccode.Expression, name: str, direction: str
) -> None:
    numbers = [None] if mask is None else [bit for bit in range(mask.bit_length()) if mask >> bit & 1]
    for number in numbers:
        use = PinUse(number, expression_text(place), "register", name, direction, int(place.line), place)
        found.setdefault((number, name, use.line), use)


def _bits(reference: ccode.NameReference, masks: PortMasks, whole: int) -> int | None:
    """The bits that one use of a register changes or reads; None if they are not known."""
    parent = reference.eContainer()
    if not isinstance(parent, ccode.Assignment) or parent.left is not reference:
        return _looked_at(reference, masks, 0, set())
    operator = str(parent.operator)
    mask = _changed(masks, parent.right, reference, whole if operator == "&=" else 0) if operator in _WRITES else None
    return mask if mask is None or mask >= 0 else mask & whole


def _looked_at(value: Element | None, masks: PortMasks, shifted: int, seen: set[int]) -> int | None:
    """The bits of a register that are read where its value goes, directly or through variables that keep it.

    Args:
        value: the expression with the register's value.
        masks: the masks of the program.
        shifted: how many bits the value was shifted to the right.
        seen: `id` of each place that was followed before.
    """
    parent = value.eContainer() if value is not None else None
    operator = str(parent.operator) if isinstance(parent, (ccode.Binary, ccode.Unary)) else ""
    if isinstance(parent, ccode.Cast) or operator in ("~", "^", "|"):
        return _looked_at(parent, masks, shifted, seen)
    if isinstance(parent, ccode.Binary) and operator == "&":
        mask = masks.bits(parent.right if parent.left is value else parent.left)
        return None if mask is None else (mask if mask >= 0 else mask & _ALL) << shifted
    if (
        isinstance(parent, ccode.Binary)
        and operator == "%"
        and parent.left is value
        and masks.numbers(parent.right) == frozenset([2])
    ):
        return 1 << shifted
    if isinstance(parent, ccode.Binary) and operator == ">>" and parent.left is value:
        places = masks.numbers(parent.right)
        return None if places is None else union(_looked_at(parent, masks, shifted + n % WORD, seen) for n in places)
    if isinstance(parent, ccode.ExpressionStatement):
        return 0  # nobody looks at what is returned
    takers = _takers(value, parent, masks)
    if not takers or id(parent) in seen:
        return 0 if takers else None
    return union(_looked_at(one, masks, shifted, seen | {id(parent)}) for one in takers)


def _takers(value: Element | None, parent: Element | None, masks: PortMasks) -> list[Element]:
    """The expressions that read a value later: references to what it is stored in, calls that return it."""
    if isinstance(parent, ccode.Variable) and not (parent.valueType is not None and parent.valueType.arrayDims):
        return [reference for reference in parent.references if not _is_written(reference)]
    if isinstance(parent, ccode.Assignment) and str(parent.operator) == "=" and isinstance(parent.left, ccode.NameReference):
        kept = parent.left.target
        return [r for r in kept.references if not _is_written(r)] if isinstance(kept, ccode.Variable) else []
    if isinstance(parent, ccode.Return):
        function = ancestor_of_kind(parent, ccode.Function)
        return list(function.calls) if function is not None else []
    if isinstance(parent, ccode.Call) and parent.callee is not None:
        position = next((i for i, a in enumerate(parent.arguments) if a is value), None)
        parameters = list(parent.callee.parameters)
        return list(parameters[position].references) if position is not None and position < len(parameters) else []
    return []


def _is_written(reference: ccode.NameReference) -> bool:
    container = reference.eContainer()
    return isinstance(container, ccode.Assignment) and container.left is reference


def _put_back(reference: ccode.NameReference) -> bool:
    """Whether a register is only read to write its other bits back to the same register."""
    inner: Element = reference
    outer = reference.eContainer()
    while isinstance(outer, (ccode.Binary, ccode.Cast, ccode.Unary, ccode.ConditionalExpression)):
        inner, outer = outer, outer.eContainer()
    left = outer.left if isinstance(outer, ccode.Assignment) and outer.right is inner and str(outer.operator) == "=" else None
    return isinstance(left, ccode.NameReference) and left.name == reference.name


def _changed(
    masks: PortMasks, expression: ccode.Expression | None, register: ccode.NameReference, cleared: int = 0
) -> int | None:
    """The bits that an assignment changes: of `register | x`, `register & x` and `register ^ x`, those of x only."""
    if isinstance(expression, ccode.ConditionalExpression):
        return union(_changed(masks, way, register, cleared) for way in (expression.whenTrue, expression.whenFalse))
    if isinstance(expression, ccode.Binary) and (operator := str(expression.operator)) in ("|", "^", "&") and not cleared:
        sides = [expression.left, expression.right]
        own = [side for side in sides if isinstance(side, ccode.NameReference) and side.name == register.name]
        if own:
            other = sides[0] if own[0] is sides[1] else sides[1]
            return _mask(masks, other, _ALL if operator == "&" else 0)
        if operator != "&":
            return union(_changed(masks, side, register) for side in sides)
    return _mask(masks, expression, cleared)


def _mask(masks: PortMasks, expression: Element | None, cleared: int = 0) -> int | None:
    """The bits that may be set in an expression, or with `cleared` those that may be clear; None if they are not known."""
    return masks.cleared(expression, cleared) if cleared else masks.bits(expression)
