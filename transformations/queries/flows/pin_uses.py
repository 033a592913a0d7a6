"""Which pins a program uses: one entry for each call of a platform function and pin, with how the text gives the pin.

Which parameters are pins, and which pins a function uses by convention, is data of the platform (`pins.json`); `values`
computes the values of arguments. Register masks, bodies of macros and other files' calls are no pin uses.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct

from robosmi.metamodels import ccode
from robosmi.model.elements.strict import Element
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.api_facts import Convention, PinParameter
from robosmi.transformations.knowledge.platforms.board_pins import CHANNEL
from robosmi.transformations.queries.code import CalledFunction, CodeView
from robosmi.transformations.queries.expression_text import expression_text
from robosmi.transformations.queries.expression_type import cut_values
from robosmi.transformations.queries.values import RUNTIME, Value, Values


class PinUse(Struct, frozen=True):
    """A pin that a call uses.

    Attributes:
        pin: its number on the source board, None where only the running program knows it.
        expression: the argument; for a convention its own words.
        origin: literal, constant, array, runtime or convention.
        function: the platform's function.
        direction: in, out, both or unknown, seen from the board.
        line: of the call.
        call: the call, or the register.
        argument: the argument, None for a convention.
    """

    pin: int | None
    expression: str
    origin: str
    function: str
    direction: str
    line: int
    call: ccode.Expression
    argument: ccode.Expression | None = None

    def to_json(self) -> dict[str, Any]:
        """The contract's form."""
        return {
            "pin": self.pin,
            "expression": self.expression,
            "origin": self.origin,
            "function": self.function,
            "direction": self.direction,
            "line": self.line,
        }


_HALF = 1 << 31
_PINS = 127
"""No board has a pin of a greater number."""


def pin_number(value: int) -> int:
    """The value of a 32-bit signed pin parameter that is given a number."""
    return (value + _HALF) % (2 * _HALF) - _HALF


class CutNumbers:
    """What types narrower than int leave of the numbers of pins that are stored in them.

    Args:
        views: a view of each of the program's units.
        sources: path of a unit -> its bytes.
    """

    def __init__(self, views: Sequence[CodeView], sources: Mapping[str, bytes]) -> None:
        self._views = {id(view.unit): view for view in views}
        self._kinds = cut_values(views, sources)

    def left(self, expression: ccode.Located) -> list[int | None] | None:
        """The numbers that are left of an expression's values, None for one that is not known; None if surely all are left.

        A literal whose type does not hold the pins of every target is cut, too, as its number may be changed.
        """
        if id(expression) not in self._kinds:
            return None
        kind = self._kinds[id(expression)]
        if isinstance(expression, ccode.IntegerLiteral):
            number = int(expression.value)
            return None if kind.left(number) == number and kind.left(_PINS) == _PINS else [kind.left(number)]
        view = self._views[id(ancestor_of_kind(expression, ccode.SourceUnit))]
        numbers = [value.number for value in view.values.of(expression)]
        left = [None if number is None else kind.left(number) for number in numbers]
        last = view.api.ports - 1
        return None if left == numbers and (None not in numbers or kind.left(last) == last) else left


def pin_uses(views: Sequence[CodeView]) -> list[PinUse]:
    """The pins that a program uses, by unit and line.

    Args:
        views: a view of each of its units.
    """
    return [use for view in views for use in pin_uses_of(view, views)]


def pin_uses_of(view: CodeView, views: Iterable[CodeView]) -> list[PinUse]:
    """The pins that a unit uses, by line; two entries with the same function, pin, direction and line are one.

    Where the pin is not known, the argument tells them apart.

    Args:
        view: the unit.
        views: a view of each unit of the program, since any may set up what a convention is used for.
    """
    values = view.values
    called = {name for v in views for name in v.called()}
    found: dict[tuple[str, int | str | None, str, int], PinUse] = {}
    for function in [*view.functions_of("platform", "posix"), *view.unknown()]:
        facts = view.api.pins(function.name, function.header)
        if facts is None:
            continue
        for call in function.calls:
            for parameter in facts.parameters:
                for use in _argument_uses(function, call, parameter, values):
                    found.setdefault((use.function, use.expression if use.pin is None else use.pin, use.direction, use.line), use)
        for convention in facts.conventions:
            if convention.set_by is None or convention.set_by not in called:
                use_or_none = _convention_use(function, convention, values)
                if use_or_none is not None:
                    found.setdefault((function.name, use_or_none.pin, use_or_none.direction, use_or_none.line), use_or_none)
    return sorted(found.values(), key=lambda u: (u.line, int(u.call.startOffset)))


def macro_pin_uses(view: CodeView) -> list[PinUse]:
    """The pins used by calls that a unit's macro uses expand to, in text order.

    Args:
        view: the unit.
    """
    found: list[PinUse] = []
    for function in view.called().values():
        facts = view.api.pins(function.name, function.header) if function.entry is not None else None
        for call in function.made if facts is not None else ():
            for parameter in facts.parameters if facts is not None else ():
                found += _argument_uses(function, call, parameter, view.values)
    return sorted(found, key=lambda use: int(use.call.startOffset))


def negative_uses_of(view: CodeView) -> list[PinUse]:
    """The uses of a negative pin number by functions with a single pin parameter, macro calls included, in text order.

    A function of several pins may take a negative number for a pin that is not used, such as one line of a serial port.

    Args:
        view: the unit.
    """
    found: list[PinUse] = []
    for function in view.functions_of("platform", "posix"):
        facts = view.api.pins(function.name, function.header)
        parameters = facts.parameters if facts is not None else ()
        for call in (*function.calls, *function.made) if len(parameters) == 1 else ():
            uses = _all_argument_uses(function, call, parameters[0], view.values)
            found += [use for use in uses if use.pin is not None and use.pin < 0]
    return sorted(found, key=lambda use: int(use.call.startOffset))


def names_its_ports(call: ccode.Call, view: CodeView) -> bool:
    """Whether the text gives the pins of a call, whatever other flows its arguments belong to.

    Args:
        call: a call of a platform function.
        view: the unit that contains it.
    """
    function = view.called().get(str(call.calleeName))
    facts = view.api.pins(function.name, function.header) if function is not None else None
    if function is None or facts is None:
        return False
    uses = [use for parameter in facts.parameters for use in _all_argument_uses(function, call, parameter, view.values)]
    return all(use.pin is not None for use in uses)


def _argument_uses(function: CalledFunction, call: ccode.Call, parameter: PinParameter, values: Values) -> Iterator[PinUse]:
    """The pins that an argument of a call uses; a negative number stands for no pin."""
    return (use for use in _all_argument_uses(function, call, parameter, values) if use.pin is None or use.pin >= 0)


def _all_argument_uses(function: CalledFunction, call: ccode.Call, parameter: PinParameter, values: Values) -> Iterator[PinUse]:
    arguments = list(call.arguments)
    if parameter.position >= len(arguments):
        return
    argument = arguments[parameter.position]
    text = expression_text(argument)
    if text in parameter.none:
        return
    for value in pin_values(parameter, arguments, argument, values):
        pin = None if value.number is None else pin_number(value.number)
        yield PinUse(pin, text, value.origin, function.name, parameter.direction, int(call.line), call, argument)


def pin_values(
    parameter: PinParameter, arguments: Sequence[Element], argument: ccode.Expression | None, values: Values
) -> list[Value]:
    """The pins that an argument stands for: each element of an array, all pins of a range or of a row.

    Args:
        parameter: the facts about the parameter.
        arguments: all arguments of the call.
        argument: the argument.
        values: evaluates expressions of the unit.
    """
    if parameter.number is not None:
        elements = values.elements(argument)
        counts = values.of(arguments[parameter.number]) if parameter.number < len(arguments) else []
        if elements is None or len(counts) != 1 or counts[0].number is None:
            return [RUNTIME]
        return elements[: counts[0].number]
    own = values.of(argument)
    if parameter.range_with is not None and parameter.range_with < len(arguments):
        return _range(own, values.of(arguments[parameter.range_with]))
    if parameter.span > 1:
        return [v if v.number is None else Value(v.number + i, v.origin) for v in own for i in range(parameter.span)]
    if parameter.numbering:
        return [v if v.number is None else Value(_numbered(parameter, v.number), v.origin) for v in own]
    return own


def _numbered(parameter: PinParameter, number: int) -> int | None:
    """The pin that a number means; one that means no channel stays as it is, for it is no pin of the board either."""
    pin = parameter.pin_of(number)
    return number if pin is None and parameter.numbering == CHANNEL else pin


def _range(ends: list[Value], starts: list[Value]) -> list[Value]:
    """Every pin between two arguments, in either order."""
    found: list[Value] = []
    for a in ends:
        for b in starts:
            if a.number is None or b.number is None or abs(a.number - b.number) > 63:
                return [RUNTIME]
            origin = a.origin if a.origin != "literal" else b.origin
            low, high = min(a.number, b.number), max(a.number, b.number)
            found += [Value(pin, origin) for pin in range(low, high + 1)]
    return found


def _convention_use(function: CalledFunction, convention: Convention, values: Values) -> PinUse | None:
    for call in (*function.calls, *function.made):
        if _holds(convention.when, call, values):
            return PinUse(
                convention.pin, convention.what, "convention", function.name, convention.direction, int(call.line), call
            )
    return None


def _holds(when: dict[str, int] | None, call: ccode.Call, values: Values) -> bool:
    if when is None:
        return True
    arguments = list(call.arguments)
    if when["index"] >= len(arguments):
        return False
    numbers = [v.number for v in values.of(arguments[when["index"]])]
    if None in numbers:
        return True
    return any(number is not None and _fits(when, number) for number in numbers)


def _fits(when: dict[str, int], number: int) -> bool:
    if "equals" in when:
        return number == when["equals"]
    if "not" in when:
        return number != when["not"]
    return number < when["below"] if "below" in when else True
