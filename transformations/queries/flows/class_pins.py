"""Which arguments of constructors and methods are pins, by the platform, by a library, or by their names."""

from __future__ import annotations

from collections.abc import Sequence

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.classes import Classes, type_name
from robosmi.transformations.queries.library_pins import may_be_pin


def constructor_pins(
    classes: Classes, name: str, view: CodeView, arguments: Sequence[ccode.Expression] = ()
) -> Sequence[PinParameter]:
    """The parameters of a class's constructors that are pins for the platform or for a library; none for an own class.

    Of a class that nobody knows, those are taken for pins whose arguments are called so.
    """
    if classes.is_own(name):
        return ()
    entry = view.resolve(name)
    facts = view.api.pins(name, entry.header if entry is not None else "")
    if facts is not None or entry is not None or view.api.board is None:
        return facts.parameters if facts is not None else ()
    return _called_pins(arguments)


def follows_argument(classes: Classes, made: Element | None, position: int, view: CodeView) -> bool:
    """Whether it is followed what becomes of an argument of a construction."""
    if isinstance(made, ccode.ConstructorCall):
        name, count = str(made.className), len(made.arguments)
    elif isinstance(made, ccode.MemberInitializer):
        field = classes.initialised(made)
        name, count = str(made.name) if field is None else type_name(field.valueType), len(made.arguments)
        if field is not None and count == 1 and not classes.is_visible(name) and not constructor_pins(classes, name, view):
            return True
    else:
        return False
    own = classes.constructors(name, count)
    pins = constructor_pins(classes, name, view, list(made.arguments))
    return bool(own) or any(pin.position == position for pin in pins)


def method_pins(classes: Classes, call: ccode.Call, view: CodeView) -> tuple[str, Sequence[PinParameter]] | None:
    """The name of a method of a class that the reader does not know, and its parameters that are pins; None for any other."""
    callee = call.calleeExpression
    if view.api.board is None or call.callee is not None or not isinstance(callee, ccode.Member):
        return None
    held = callee.object
    target = held.target if isinstance(held, ccode.NameReference) else None
    kind = type_name(target.valueType) if isinstance(target, (ccode.Variable, ccode.Parameter)) else ""
    if not kind or classes.is_own(kind) or view.resolve(kind) is not None:
        return None
    facts = view.api.pins(f"{kind}::{callee.name}", "")
    return str(callee.name), facts.parameters if facts is not None else _called_pins(list(call.arguments))


def _called_pins(arguments: Sequence[ccode.Expression]) -> list[PinParameter]:
    """The arguments that are names of pins, as parameters."""
    return [
        PinParameter(position, str(argument.name), "unknown")
        for position, argument in enumerate(arguments)
        if isinstance(argument, ccode.NameReference) and may_be_pin(str(argument.name))
    ]
