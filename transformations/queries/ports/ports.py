"""The ports of a program: the pin numbers of the source board that it uses, their names, and what it does with them.

A port is a number, wherever the text contains it: as a constant, a bare literal, an array element, a value of a counting loop,
a bit of a register. What a library uses by convention, without a number in the text, is a port of its own named after its role.
`port_flows` finds which numbers go where; the plan decides what a port becomes on the target.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence

from msgspec import Struct

from robosmi.metamodels import ccode, platform
from robosmi.query import ancestor_of_kind
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.flows.pin_uses import PinUse, pin_number, pin_uses, pin_values
from robosmi.transformations.queries.flows.value_flows import Flow, PortPlace
from robosmi.transformations.queries.ports.expanded_calls import ExpandedCalls
from robosmi.transformations.queries.ports.port_masks import PortMasks
from robosmi.transformations.queries.ports.register_bits import register_bits
from robosmi.transformations.queries.reached_values import ReachedValues
from robosmi.transformations.queries.values import Value, Values


class Port(Struct):
    """A port of the program.

    Attributes:
        name: of the first constant that holds it, `P12` for a bare number, the role of a convention.
        origin: declaration, literal, runtime, given or convention.
        element: what holds the number; else the first call or register.
        pin: its number on the source board, None where it has none there (a channel of a converter).
        names: further names by which it may be called.
        what: what the platform says is connected there, empty where it says nothing.
        uses: the pin uses.
        conventional: what the adapters of the target declare for it.
    """

    name: str
    origin: str
    element: ccode.Located
    pin: int | None
    names: list[str] = []
    what: str = ""
    uses: list[PinUse] = []
    conventional: platform.ConventionalPort | None = None

    @property
    def directions(self) -> set[str]:
        """in, out, both: what the uses do with the pin; `unknown` is left out."""
        return {use.direction for use in self.uses} - {"unknown"}


class FlowPorts(Struct):
    """A flow with the numbers of the ports that go through it.

    Attributes:
        flow: the flow.
        numbers: the ports that the text can send through it.
        anything: whether a number may come that the text does not say.
        values: the values of each of the flow's arguments, in their order; empty in the body of a macro.
        made: position of an argument in a macro's body -> the calls that the macro expands to where it is
            used, with the numbers that they may pass.
        written: the numbers of the other expressions whose values come in, before they are made those of pins.
    """

    flow: Flow
    numbers: list[int]
    anything: bool
    values: list[list[Value]]
    made: Mapping[int, Sequence[tuple[ccode.Call, Collection[int | None]]]] = {}
    written: Collection[int] = ()

    @property
    def calls(self) -> Iterator[ccode.Call]:
        """The calls that the flow reaches, first those in the text, then those that macros expand to."""
        yield from (argument.call for argument in self.flow.arguments if argument.call is not None)
        yield from (call for calls in self.made.values() for call, _ in calls)

    @property
    def moved(self) -> bool:
        """Whether the numbers of the flow can be changed, where they are written, to pins of the target."""
        return not self.flow.kept and not self.flow.computed


class ProgramPorts(Struct):
    """The ports of a program and how their numbers flow.

    Attributes:
        ports: in the order of their first use.
        flows: those that send a port somewhere.
        anything: whether any port may be reached, so that the user may bind any number.
        unasked: conventional ports of the source that nothing uses on the target; the user may bind them all the same.
        shared: names that declarations of several ports have, each with the ports' numbers; they name no port.
    """

    ports: list[Port]
    flows: list[FlowPorts]
    anything: bool
    unasked: list[Port] = []
    shared: Mapping[str, Sequence[int]] = {}


def program_ports(views: Sequence[CodeView], flows: Sequence[Flow]) -> ProgramPorts:
    """The ports of a program.

    Args:
        views: a view of each of its units.
        flows: its flows of port numbers.
    """
    values = {view.unit.path: view.values for view in views}
    reached = {view.unit.path: view.reached_values for view in views}
    count = next((view.api.ports for view in views), 0)
    made = ExpandedCalls(views)
    through = [_flow_ports(flow, values, reached, count, made) for flow in flows]
    masks = PortMasks(views)
    bits = [use for view in views for use in register_bits(view, masks)]
    if views and views[0].api.board is not None:
        from robosmi.transformations.queries.ports.register_idioms import port_uses  # of boards whose pins have registers

        bits += port_uses(views)
    found: dict[int, Port] = {}
    called = views[0].api.port_name if views else "P{}".format
    for number, element in _reached(through, [use for use in bits if use.pin is not None and use.pin < count]):
        found.setdefault(number, Port(called(number), "runtime", element, number))
    shared = _name(found, through, called)
    anything = any(f.anything for f in through) or any(use.pin is None for use in bits)
    _use(found, [*pin_uses(views), *bits, *_in_macros(through)], through)
    own = list(found.values())
    return ProgramPorts([*own, *give_numbers(own, _conventional(views), called)], through, anything, shared=shared)


def give_numbers(own: Sequence[Port], conventional: Sequence[Port], called: Callable[[int], str]) -> list[Port]:
    """Add its number as a further name to each conventional port whose number nothing else of the program uses.

    Args:
        own: the ports whose numbers are written in the text.
        conventional: the ports of conventions, which are returned.
        called: the name of a number.
    """
    numbers = [port.pin for port in (*own, *conventional)]
    for port in conventional:
        if port.pin is not None and numbers.count(port.pin) == 1 and called(port.pin) not in port.names:
            port.names.append(called(port.pin))
    return list(conventional)


def _flow_ports(
    flow: Flow, values: Mapping[str, Values], reached: Mapping[str, ReachedValues], count: int, macros: ExpandedCalls
) -> FlowPorts:
    mine: list[list[Value]] = []
    made: dict[int, list[tuple[ccode.Call, set[int | None]]]] = {}
    unknown = False
    for position, argument in enumerate(flow.arguments):
        known: list[Value] = []
        if argument.unplaced:
            unknown = True
        elif (passed := argument.given) is not None:
            known = pin_values(argument.parameter, passed, argument.argument, values[argument.unit.path])
            unknown |= any(value.number is None for value in known)
        else:
            made[position] = [(c, _given_by(c, argument.parameter, values[v.unit.path])) for v, c in macros.of(argument)]
            unknown |= not made[position] or any(None in given for _, given in made[position])
        mine.append([v if v.number is None else Value(pin_number(v.number), v.origin) for v in known])
    numbers = {v.number for each in mine for v in each if v.number is not None}
    numbers |= {number for calls in made.values() for _, given in calls for number in given if number is not None}
    if unknown or not flow.kept:
        numbers |= {place.value for place in flow.places}
    anything = False
    written: list[int | None] = []
    if unknown:
        meant = _meaning(flow)
        written = [v.number for unit, one in flow.given for v in reached[unit.path].of(one)]
        given = [meant(number) for number in written]
        computed = [meant(v.number) for unit, one in flow.calculated for v in reached[unit.path].of(_result(one))]
        stepped = [(reached[each.unit.path], each.argument) for each in flow.arguments if flow.calculated]
        used = [meant(v.number) for known, one in stepped for v in known.passed(one)]
        numbers |= {pin_number(number) for number in (*given, *computed, *used) if number is not None}
        anything = flow.computed or None in computed or not numbers
    anything |= any(argument.mixed for argument in flow.arguments)
    known_numbers = sorted(n for n in numbers if 0 <= n < count)
    return FlowPorts(flow, known_numbers, anything, mine, made, {number for number in written if number is not None})


def _meaning(flow: Flow) -> Callable[[int | None], int | None]:
    """What a number in a flow is as that of a pin, where its functions take numbers of something else."""
    parameters = [argument.parameter for argument in flow.arguments]
    if not all(parameter.numbering for parameter in parameters):
        return lambda number: number
    return lambda number: None if number is None else parameters[0].pin_of(number)


def _given_by(call: ccode.Call, parameter: PinParameter, values: Values) -> set[int | None]:
    """The numbers that an expanded call may have for a pin; None is among them if the text does not give all."""
    arguments = list(call.arguments)
    given = arguments[parameter.position] if parameter.position < len(arguments) else None
    known = pin_values(parameter, arguments, given, values)
    return {None if value.number is None else pin_number(value.number) for value in known}


def _result(expression: ccode.Located) -> ccode.Located | None:
    """The expression that has the computed value: the assigned or counted variable, else the expression itself."""
    if isinstance(expression, ccode.Assignment):
        return expression.left
    if isinstance(expression, ccode.Unary) and expression.operator in ("++", "--"):
        return expression.operand
    return expression


def _reached(through: Sequence[FlowPorts], bits: Sequence[PinUse]) -> Iterator[tuple[int, ccode.Located]]:
    """Each port number with the element that holds it first, from the flows in text order, then from bits of registers."""
    for each in through:
        for number in each.numbers:
            yield number, _where(each, number)
    yield from ((use.pin, use.call) for use in bits if use.pin is not None)


def _where(each: FlowPorts, number: int) -> ccode.Located:
    """The element that holds a number in a flow, else a call that it reaches, else any call or place of the flow."""
    holders: list[ccode.Located] = [place.element for place in each.flow.places if place.value == number]
    made = [(call, numbers) for calls in each.made.values() for call, numbers in calls]
    reached: list[ccode.Located] = [call for call, numbers in made if number in numbers]
    return (holders or reached or list[ccode.Located](each.calls) or [place.element for place in each.flow.places])[0]


def _name(found: Mapping[int, Port], through: Sequence[FlowPorts], called: Callable[[int], str]) -> dict[str, list[int]]:
    """Name the ports as the program does; a name of several ports is qualified with its function.

    Returns:
        The names that several ports have all the same, in blocks of one function or in several files, with their numbers.
    """
    places = [place for each in through for place in each.flow.places if place.value in found]
    meant: dict[str, set[int]] = {}
    for place in places:
        if place.name:
            meant.setdefault(place.name, set()).add(place.value)
    numbers: dict[str, set[int]] = {}
    for place in places:
        if name := _full_name(place, meant):
            numbers.setdefault(name, set()).add(place.value)
    shared = {name: sorted(several) for name, several in numbers.items() if len(several) > 1}
    shared |= {name: sorted(several) for name, several in meant.items() if len(several) > 1}
    named: set[tuple[int | None, str]] = set()
    for place in places:
        port = found[place.value]
        name = _full_name(place, meant)
        if not name or name in shared:
            port.origin = "literal" if port.origin == "runtime" else port.origin
        elif port.origin != "declaration":
            port.origin, port.element, port.name = "declaration", place.element, name
            port.names = [called(place.value)]
        elif name != port.name and (port.pin, name) not in named and name not in port.names[-1:]:
            named.add((port.pin, name))
            port.names.insert(len(port.names) - 1, name)

    for each in through:
        for argument, known in zip(each.flow.arguments, each.values, strict=True):
            number = known[0].number if len(known) == 1 else None
            reached = found.get(number) if number is not None else None
            holder = _constant(argument.argument)
            taken = holder is not None and (holder[0] in shared or any(holder[0] == port.name for port in found.values()))
            if reached is not None and holder is not None and reached.origin != "declaration" and not taken:
                reached.origin, reached.element = "declaration", holder[1]
                reached.name, reached.names = holder[0], [called(number)] if number is not None else []
    return shared


def _constant(argument: ccode.Expression | None) -> tuple[str, ccode.Located] | None:
    """The macro or constant whose name is given for a pin; its value may not be written as a number anywhere."""
    if not isinstance(argument, ccode.NameReference):
        return None
    target: ccode.Declaration | None = argument.target
    if isinstance(target, ccode.Variable) and target.initializer is not None:
        return str(target.name), target
    unit = ancestor_of_kind(argument, ccode.SourceUnit)
    units = list(unit.program.units) if unit is not None and unit.program is not None else []
    macros = [m for u in units for m in u.macros if m.name == argument.name and not m.functionLike]
    around = argument.eContainer()
    expanded = isinstance(around, ccode.Call) and around.viaMacro
    return (str(macros[0].name), macros[0]) if target is None and macros and not expanded else None


def _full_name(place: PortPlace, meant: Mapping[str, set[int]]) -> str:
    """The name that a place gives its port; of several ports qualified with its function, empty where none is."""
    if not place.name or len(meant[place.name]) == 1:
        return place.name
    return f"{place.within}.{place.name}" if place.within else ""


def _use(found: Mapping[int, Port], uses: Sequence[PinUse], through: Sequence[FlowPorts]) -> None:
    """Add its uses to each port; a use with an unknown pin is added to all ports of its flow."""
    known = {number: set(port.uses) for number, port in found.items()}
    flows = {id(a.argument): each for each in through for a in each.flow.arguments if a.argument is not None}
    for use in uses:
        if use.origin == "convention":
            continue
        flow = flows.get(id(use.argument)) if use.argument is not None else None
        numbers = [use.pin] if use.pin is not None else flow.numbers if flow is not None else []
        for number in numbers:
            if number in found and use not in known[number]:
                known[number].add(use)
                found[number].uses.append(use)


def _in_macros(through: Sequence[FlowPorts]) -> Iterator[PinUse]:
    """The uses of pins in bodies of macros: one for each number of the flow, with a call that it reaches if one is known."""
    for each in through:
        for position, argument in enumerate(each.flow.arguments):
            if argument.given is None:
                made = each.made.get(position, [])
                for number in each.numbers:
                    reached = [call for call, numbers in made if number in numbers] or [call for call, _ in made]
                    call = reached[0] if reached else ccode.Call(calleeName=argument.function)
                    yield PinUse(number, "", "literal", argument.function, argument.parameter.direction, 0, call)


def _conventional(views: Sequence[CodeView]) -> list[Port]:
    """The ports that functions use by convention, without an argument: one for each role."""
    found: dict[str, Port] = {}
    for use in pin_uses(views):
        if use.origin != "convention":
            continue
        name = role_name(use, views)
        port = found.setdefault(name, Port(name, "convention", use.call, use.pin, what=use.expression))
        port.uses.append(use)
    return list(found.values())


def role_name(use: PinUse, views: Sequence[CodeView]) -> str:
    """The name of a convention's port for users, such as `abdrive.left_servo`."""
    for view in views:
        known = str(view.api.settings.get("ports", {}).get("names", {}).get(use.expression, ""))
        if known:
            return known
        function = view.called().get(use.function)
        if function is not None and function.header:
            words = "".join(c if c.isalnum() else " " for c in use.expression).split()
            return f"{function.header.removesuffix('.h')}.{'_'.join(word.lower() for word in words)}"
    return views[0].api.port_name(use.pin) if views and use.pin is not None else ""


def convention_of(port: Port, source: platform.Platform) -> platform.PinConvention | None:
    """The element of the platform model that describes a conventional port."""
    called = {use.function for use in port.uses}
    for header in source.headers:
        for function in header.functions:
            for convention in function.conventions if function.name in called else ():
                if convention.pin == port.pin:
                    return convention
    return None
