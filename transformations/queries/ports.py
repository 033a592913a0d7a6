"""The ports of a program: the places in its text that say which pin something is on.

A port is a constant, a macro, an enumerator or a literal whose value reaches a pin parameter of a platform function,
directly or through parameters of the program's own functions; or a pin that a function uses by convention, which no text
says. Values are `pin_uses`' business; what a port becomes on the target is the plan's.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from robosmi.metamodels import ccode, platform
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.pin_uses import PinUse, pin_number, pin_uses
from robosmi.transformations.queries.values import passed_arguments


@dataclass
class Port:
    """A port of the program.

    Attributes:
        name: the constant's name, or `P12` for a bare pin.
        origin: declaration, literal or convention.
        element: what holds the value; for a convention the first call.
        pin: its number on the source board, or None where the text does not say one.
        what: what the platform says is connected there, empty where it says nothing.
        uses: the pin uses.
    """

    name: str
    origin: str
    element: ccode.Located
    pin: int | None
    what: str = ""
    uses: list[PinUse] = field(default_factory=list)

    @property
    def directions(self) -> set[str]:
        """in, out, both: what the uses do with the pin; `unknown` is left out."""
        return {use.direction for use in self.uses} - {"unknown"}


def ports(views: Sequence[CodeView]) -> list[Port]:
    """The ports of a program, in the order of their first use.

    Args:
        views: a view of each of its units.
    """
    found: dict[object, Port] = {}
    for use in pin_uses(views):
        if use.origin == "convention":
            name = f"P{use.pin}"
            found.setdefault(("convention", use.pin), Port(name, "convention", use.call, use.pin, use.expression)).uses.append(
                use
            )
            continue
        for element in _holders(use.argument, set()):
            if isinstance(element, ccode.IntegerLiteral):
                key: object = ("literal", id(element))
                number = pin_number(int(element.value))
                if number < 0:
                    continue
                port = found.setdefault(key, Port(f"P{number}", "literal", element, number))
            else:
                port = found.setdefault(id(element), Port(_name(element), "declaration", element, _value(element)))
            if use not in port.uses and (port.pin is None or use.pin in (port.pin, None)):
                port.uses.append(use)
    return list(found.values())


def convention_of(port: Port, source: platform.Platform) -> platform.PinConvention | None:
    """The element of the platform model that a convention's port stands for."""
    called = {use.function for use in port.uses}
    for header in source.headers:
        for function in header.functions:
            for convention in function.conventions if function.name in called else ():
                if convention.pin == port.pin:
                    return convention
    return None


def _holders(expression: ccode.Expression | None, seen: set[int]) -> Iterator[ccode.Located]:
    """The declarations and literals that give an expression its value."""
    if expression is None or id(expression) in seen:
        return
    seen.add(id(expression))
    if isinstance(expression, ccode.IntegerLiteral):
        yield expression
    elif isinstance(expression, ccode.Cast):
        yield from _holders(expression.operand, seen)
    elif isinstance(expression, ccode.NameReference):
        target = expression.target
        if isinstance(target, ccode.Parameter):
            for argument in passed_arguments(target):
                yield from _holders(argument, seen)
        elif isinstance(target, ccode.Variable):
            yield from _variable(target, seen)
        elif isinstance(target, ccode.EnumerationLiteral):
            yield target
        elif target is None and (macro := _macro(expression)) is not None:
            yield macro
    # Sums, elements of arrays and the like hold no pin in one place; their uses are reported as they are.


def _variable(variable: ccode.Variable, seen: set[int]) -> Iterator[ccode.Located]:
    initial = variable.initializer
    if isinstance(initial, ccode.NameReference):
        yield from _holders(initial, seen)
    elif initial is not None and variable.valueType is not None and not variable.valueType.arrayDims:
        yield variable


def _macro(reference: ccode.NameReference) -> ccode.Macro | None:
    from robosmi.query import ancestor_of_kind

    unit = ancestor_of_kind(reference, ccode.SourceUnit)
    if unit is None:
        return None
    return next((m for m in unit.macros if m.name == reference.name and not m.functionLike), None)


def _name(element: ccode.Located) -> str:
    return str(getattr(element, "name", ""))


def _value(element: ccode.Located) -> int | None:
    number = _number(element)
    return None if number is None else pin_number(number)


def _number(element: ccode.Located) -> int | None:
    if isinstance(element, ccode.EnumerationLiteral):
        return int(element.value)
    if isinstance(element, ccode.Variable) and isinstance(element.initializer, ccode.IntegerLiteral):
        return int(element.initializer.value)
    if isinstance(element, ccode.Macro):
        text = element.body.strip().strip("()").strip()
        return int(text) if text.isdigit() else None
    return None
