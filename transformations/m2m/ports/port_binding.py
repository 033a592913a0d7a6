"""Binds each port of the source program to a connection of the target (paper, Listing 3: `leftQTI` becomes 10).

A user's choice counts first, then the place of ports wired on the source board itself (console, EEPROM), then the evidence that
names and uses give, which `port_evidence` computes. What none of these decides stays open with its options. The drawing alone
never tells which of two like components is left and which is right.

Open ports are assigned to free connections together, not guessed one by one: a port is bound to a connection only if each is the
other's single best match, so that two ports never share a pin and one of two like components is never picked at random. Without
evidence by name or library, a port and a component are bound if neither fits anything else and such ports are usually on such
components.
"""

from __future__ import annotations

import heapq
from collections import Counter, defaultdict
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from robosmi.base.quantities import quantity
from robosmi.diagnostics import Location
from robosmi.errors import TooLargeError, UsageError, did_you_mean, placed
from robosmi.metamodels import ccode, migration, platform
from robosmi.model.elements.strict import enum_literal
from robosmi.transformations.knowledge.api_facts import PinParameter
from robosmi.transformations.knowledge.platforms.board_pins import pins_by_name
from robosmi.transformations.knowledge.platforms.platform_api import ApiIndex
from robosmi.transformations.m2m.choices.stored_choices import UserChoice, explain
from robosmi.transformations.m2m.ports.port_evidence import (
    Fit,
    Seat,
    fit,
    may_meet,
    number_for,
    remarks_for,
    remarks_of_own,
)
from robosmi.transformations.queries.circuits.component_kinds import kinds_of, misleading_title, tone_kinds
from robosmi.transformations.queries.circuits.former_titles import former_name
from robosmi.transformations.queries.code import ValuesOf, argument_numbers
from robosmi.transformations.queries.flows.value_flows import PinArgument
from robosmi.transformations.queries.plans.binding_edits import referred, trace_binding
from robosmi.transformations.queries.plans.port_pins import CONSOLE, NOT_WIRED, WITHOUT_PIN
from robosmi.transformations.queries.ports.ports import Port, ProgramPorts, convention_of
from robosmi.transformations.queries.ports.split_wires import wires_of
from robosmi.transformations.queries.values import Values

_SIGNALS = {"in": "read", "out": "write"}
_ANOTHER_PROGRAM = "remove it there, or give each program its own folder with its project file"


class UserPins(Struct, frozen=True):
    """The pins that one source of choices (a flag, the project file) assigns to ports.

    Attributes:
        pins: port name -> pin: a label, a connection's name, or `none`.
        places: port name -> the place of the choice, for messages; without choices that are in no file.
    """

    pins: Mapping[str, str]
    places: Mapping[str, Location] = {}


class _Pin(Struct, frozen=True):
    """The pin chosen for a port, and the place of the choice for messages."""

    name: str
    place: Location | None = None


def bind_ports(
    found: ProgramPorts,
    api: ApiIndex,
    source: platform.Platform,
    connections: Sequence[migration.Connection],
    board: platform.Board,
    said: Sequence[UserPins],
    limit: float,
    stored: Mapping[str, UserChoice] | None = None,
    split: frozenset[str] = frozenset(),
    usb_console: bool = False,
) -> list[migration.PortBinding]:
    """Make the binding decision for each port of the program.

    Args:
        found: the ports.
        api: what is known of the source platform.
        source: the platform model that the plan refers to.
        connections: the connections of the target board.
        board: the target board.
        said: as persons said; later ones count before earlier ones.
        limit: a rule's choice is taken when its confidence is at least this.
        split: functions that can serve a component with a wire for each direction.
        stored: port -> what the user chose in a stored plan, before `said`; what no longer fits is passed over.
        usb_console: whether the target's console takes no pins.

    Raises:
        UsageError: a name is no port of the program, one port is bound to two pins, or a pin is none of the board.
    """
    ports = list(found.ports)
    pins = _kept(stored or {}, ports, found, api, connections, board)
    for layer in said:
        pins.update(_layer(layer, ports, found, api))
    bindings = [_binding(port, source) for port in ports]
    wrong: list[UsageError] = []
    for port, binding in zip(ports, bindings, strict=True):
        if port.name in pins:
            try:
                with placed(pins[port.name].place):
                    _take(binding, pins[port.name].name, connections, board, usb_console)
            except UsageError as error:
                wrong.append(error)
                continue
            explain(binding, (stored or {}).get(port.name))
    if wrong:
        told = "; ".join(dict.fromkeys(error.message for error in wrong))
        raise UsageError(told, location=wrong[0].location, fix=wrong[0].fix)
    for port, binding in zip(ports, bindings, strict=True):
        if binding.open:
            _on_board(port, binding, api, connections, board, {id(b.pin) for b in bindings if b.pin is not None}, usb_console)
    taken = {id(b.connection) for b in bindings if b.connection is not None} | {id(b.pin) for b in bindings if b.pin is not None}
    free = [c for c in connections if id(c) not in taken and (c.pin is None or id(c.pin) not in taken)]
    for port, binding in zip(ports, bindings, strict=True):
        _split(port, binding, connections, split)
    heard = {id(b.answer) for b in bindings if b.answer is not None}
    free = [c for c in free if id(c) not in heard]
    values: ValuesOf = cache(_values)  # for all ports: many may share a variable
    tones: Mapping[str, int] = api.settings.get("ports", {}).get("tones", {})
    toned = {id(port): tone_kinds(_frequencies(port, tones, values)) for port in ports}
    heard_or_seen = frozenset().union(*toned.values())
    seats = [_seat(p, b, found, api, split, toned[id(p)]) for p, b in zip(ports, bindings, strict=True) if b.open]
    seats = [replace(seat, unlike=heard_or_seen - seat.usual - {seat.role}) for seat in seats]
    for seat in seats:
        seat.binding.role = seat.role
    if not connections:
        for port, binding in zip(ports, bindings, strict=True):
            binding.usualKind = _usual_kind(port, api.settings.get("ports", {}), toned[id(port)])
    assign(seats, free, limit, complete=not found.anything)
    for port, binding in zip(ports, bindings, strict=True):
        if not binding.open:
            _split(port, binding, connections, split)
            seat = _seat(port, binding, found, api, split, toned[id(port)])
            binding.role = seat.role
            rank(seat, _within_reach(binding, bindings, connections))
        binding.mirrored = _is_mirrored(port, api)
        timing: Sequence[str] = api.settings.get("ports", {}).get("discharges", ())
        binding.discharges = any(use.function in timing for use in port.uses)
    return bindings


def _is_mirrored(port: Port, api: ApiIndex) -> bool:
    """Whether the platform says that the servo at a port is mounted the other way round: by its name, or an argument's place."""
    known: Sequence[str] = api.settings.get("ports", {}).get("mirrored", ())
    places = {
        f"{use.function} {position}"
        for use in port.uses
        if isinstance(use.call, ccode.Call)
        for position, argument in enumerate(use.call.arguments)
        if argument is use.argument
    }
    return not places.union((port.name, *port.names)).isdisjoint(known)


def _within_reach(
    binding: migration.PortBinding, bindings: Sequence[migration.PortBinding], connections: Sequence[migration.Connection]
) -> list[migration.Connection]:
    """The connections available to a port: those whose pins no other port is bound to."""
    others = {id(b.pin) for b in bindings if b is not binding and b.pin is not None}
    return [c for c in connections if c.pin is None or id(c.pin) not in others]


def _kept(
    stored: Mapping[str, UserChoice],
    ports: list[Port],
    program: ProgramPorts,
    api: ApiIndex,
    connections: Sequence[migration.Connection],
    board: platform.Board,
) -> dict[str, _Pin]:
    """The pins that a stored plan chose, by port, without those that the program or its hardware no longer has."""
    found: dict[str, _Pin] = {}
    for name, kept in stored.items():
        try:
            layer = _layer(UserPins({name: kept.value}), ports, program, api)
            if kept.value not in WITHOUT_PIN:
                _chosen(kept.value, connections, board)
        except UsageError:
            continue  # `stored_choices.differences` says so
        found |= layer
    return found


def _split(
    port: Port, binding: migration.PortBinding, connections: Sequence[migration.Connection], functions: frozenset[str]
) -> None:
    """If the port's component has a wire for each direction and the functions can use both, bind the second wire for the
    answer.
    """
    component = binding.connection.component if binding.connection is not None else None
    wires = wires_of(component, connections)
    if binding.answer is not None or not wires or not _is_split(port, functions):
        return
    asked, heard = wires["write"].pin, wires["read"].pin
    assert asked is not None
    assert heard is not None
    binding.answer = wires["read"]
    binding.evidence.append(f"trigger on {asked.label}, echo on {heard.label}")


def _is_split(port: Port, functions: frozenset[str]) -> bool:
    called = {use.function for use in port.uses}
    return bool(called) and called <= functions


def _frequencies(port: Port, tones: Mapping[str, int], values: ValuesOf) -> set[int | None]:
    """Those of the tones at a port; `tones` has the place of the frequency among the arguments of each function."""
    used = (use for use in port.uses if use.function in tones)
    return {number for use in used for number in argument_numbers(use.call, tones[use.function], values)}


def _values(unit: ccode.SourceUnit) -> Values:
    assert unit.program is not None
    return Values(unit.program, unit)


def _seat(
    port: Port, binding: migration.PortBinding, found: ProgramPorts, api: ApiIndex, split: frozenset[str], toned: frozenset[str]
) -> Seat:
    facts = api.settings.get("ports", {})
    given = _arguments(port, found)
    siblings = [p.name for function in {a.function for a in given} for p in _pins(function, api)]
    siblings += [p.name for p in found.ports if p.origin == "declaration"]
    role = _role(port, facts.get("roles", {}), api)
    names = [argument.parameter.name for argument in given]
    usual = toned or _usual(port, facts.get("usual", {}))
    own = facts.get("own", {}).get(api.port_name(port.pin), "") if port.pin is not None else ""
    return Seat(binding, _words(port, api), names, siblings, role, usual, _is_split(port, split), port.uses, own)


def _layer(layer: UserPins, ports: list[Port], program: ProgramPorts, api: ApiIndex) -> dict[str, _Pin]:
    """The pins that one source of choices gives, by port; a pin that the program may compute at run time is added as a port."""
    found: dict[str, tuple[str, str]] = {}
    unknown: dict[str, str] = {}
    for name, pin in layer.pins.items():
        port = next((p for p in ports if name == p.name or name in p.names), None)
        number = api.port_number(name)
        if port is None and number is not None:
            port = next((p for p in ports if p.pin == number and p.origin != "convention"), None)
        if port is None and (port := next((p for p in program.unasked if name == p.name or name in p.names), None)) is not None:
            ports.append(port)
        if port is None and program.anything and number is not None and number < api.ports:
            holder = next((p.element for p in ports), None)
            port = Port(api.port_name(number), "given", holder, number)  # type: ignore[arg-type]
            ports.append(port)
        if port is None:
            known = sorted({alias for p in ports for alias in (p.name, *p.names)})
            if name in program.shared:
                numbers = ", ".join(api.port_name(pin) for pin in program.shared[name])
                with placed(layer.places.get(name)):
                    raise UsageError(f"'{name}' means several ports of the program: {numbers}", fix="bind each by its number")
            unknown[name] = f"'{name}' is no port of the program{did_you_mean(name, known)}"
            continue
        earlier = found.setdefault(port.name, (name, pin))
        if earlier[1] != pin:
            raise UsageError(
                f"the port '{port.name}' is bound to two pins: {earlier[0]} = {earlier[1]} and {name} = {pin}",
                location=layer.places.get(name),
                fix="remove one of them",
            )
    if unknown:
        with placed(layer.places.get(next(iter(unknown))), _ANOTHER_PROGRAM):
            raise UsageError("; ".join(unknown.values()), fix=f"its ports are: {', '.join(p.name for p in ports) or 'none'}")
    return {port: _Pin(pin, layer.places.get(name)) for port, (name, pin) in found.items()}


def _binding(port: Port, source: platform.Platform) -> migration.PortBinding:
    return migration.PortBinding(
        name=port.name,
        names=port.names,
        sourcePin=-1 if port.pin is None else port.pin,
        signal=enum_literal(migration.Signal, signal_of(port)),
        origin=port.origin,
        what=port.what,
        element=port.element,
        convention=convention_of(port, source) if port.origin == "convention" else None,
        conventionalPort=port.conventional,
        open=True,
    )


def _take(
    binding: migration.PortBinding,
    said: str,
    connections: Sequence[migration.Connection],
    board: platform.Board,
    usb_console: bool,
) -> None:
    """Bind a port as the user chose."""
    if said == NOT_WIRED or (said == CONSOLE and usb_console):
        binding.choice = said
    else:
        binding.connection, binding.pin = _chosen(said, connections, board)
        binding.choice = referred(binding)
    binding.open, binding.confidence, binding.chosenBy = False, 1.0, migration.ChosenBy.person
    binding.evidence.append("by flag or in the project file")


def bind_as_chosen(
    binding: migration.PortBinding, said: str, connections: Sequence[migration.Connection], board: platform.Board
) -> None:
    """Set the reference of a stored binding to what the user chose; an empty text leaves the port unbound.

    Args:
        binding: the binding.
        said: a pin's label, a connection's name, `none`, or `console`.
        connections: the connections of the target board.
        board: the target board.

    Raises:
        UsageError: it is neither a pin of the board, nor a connection, nor `none`, nor `console`.
    """
    bound = (None, None) if said in ("", *WITHOUT_PIN) else _chosen(said, connections, board)
    binding.connection, binding.pin = bound
    binding.choice = referred(binding) or said
    trace_binding(binding)


def _chosen(
    said: str, connections: Sequence[migration.Connection], board: platform.Board
) -> tuple[migration.Connection | None, platform.Pin | None]:
    """The connection that the user's choice names, or the pin if no connection is there."""
    named = [c for c in connections if c.name == said] or [c for c in connections if former_name(c) == said]
    if named:
        return named[0], named[0].pin
    pin = pins_by_name(board).get(said)
    on_pin = [c for c in connections if pin is not None and c.pin is not None and c.pin.label == pin.label]
    if on_pin:
        return on_pin[0], on_pin[0].pin
    if pin is None:
        if not connections:
            raise UsageError(
                f"'{said}' is neither a pin of {board.title} nor a mapping, since no drawing is given"
                f"{did_you_mean(said, [*(p.label for p in board.pins), NOT_WIRED])}",
                fix=f'add --hardware FILE (or hardware = "FILE" under [migrate] in robosmi.toml), or use a label such as '
                f"{board.pins[0].label}, or {NOT_WIRED}",
            )
        names = [c.name for c in connections] + [p.label for p in board.pins] + [NOT_WIRED]
        raise UsageError(
            f"'{said}' is neither a pin of {board.title} nor a mapping{did_you_mean(said, names)}",
            fix=f"use a label such as {board.pins[0].label}, {NOT_WIRED}"
            + f", or one of: {', '.join(c.name for c in connections)}",
        )
    return None, pin


def _on_board(
    port: Port,
    binding: migration.PortBinding,
    api: ApiIndex,
    connections: Sequence[migration.Connection],
    board: platform.Board,
    taken: set[int],
    usb_console: bool,
) -> None:
    """Bind a port that is wired on the source board to its counterpart on the target board, if there is one."""
    known = api.settings.get("ports", {}).get("board", {}).get(api.port_name(port.pin)) if port.pin is not None else None
    if known is None or (port.origin != "convention" and any(use.function not in known["functions"] for use in port.uses)):
        return
    binding.what = binding.what or str(known["what"])
    if known["pin"] == NOT_WIRED:
        binding.choice = NOT_WIRED
    elif usb_console and _is_console(port, known):
        binding.choice = CONSOLE
    else:
        pin = next((p for p in board.pins if known["pin"] in (p.label, *p.aliases)), None)
        if pin is None or id(pin) in taken:
            return
        binding.connection = next((c for c in connections if c.pin is pin), None)
        binding.pin = pin
        binding.choice = binding.connection.name if binding.connection is not None else pin.label
    binding.open, binding.confidence, binding.chosenBy = False, 0.95, migration.ChosenBy.rule
    binding.evidence.append(f"wired on the board of the source: {known['what']}")


def _is_console(port: Port, known: Mapping[str, Any]) -> bool:
    """Whether a port of the source board's console is given only to functions that can take USB in its place."""
    return bool(port.uses) and {use.function for use in port.uses} <= {*known.get("console", ())}


def signal_of(port: Port) -> str:
    """The direction in which the program uses a port: read, write, or bus for both."""
    directions = port.directions
    return _SIGNALS[next(iter(directions))] if len(directions) == 1 and directions <= set(_SIGNALS) else "bus"


def _words(port: Port, api: ApiIndex) -> list[str]:
    """The names of a port in the program and its platform, and the libraries whose functions receive it."""
    if port.origin == "convention":
        return [port.what]
    headers = {entry.header.rpartition(".")[0] for use in port.uses for entry in api.entries(use.function)}
    return [port.name, *port.names, port.what, *sorted(headers)]


def _arguments(port: Port, found: ProgramPorts) -> list[PinArgument]:
    """The arguments of platform functions that may have the port's number."""
    return [
        argument
        for each in found.flows
        for argument, known in zip(each.flow.arguments, each.values, strict=True)
        if port.pin is not None and port.pin in {value.number for value in known}
    ]


def _pins(function: str, api: ApiIndex) -> list[PinParameter]:
    facts = [api.pins(function, entry.header) for entry in api.entries(function)] or [api.pins(function, "")]
    return [parameter for one in facts if one is not None for parameter in one.parameters]


def _usual(port: Port, usual: Mapping[str, Sequence[str]]) -> frozenset[str]:
    """The kinds of components that the functions receiving a port are usually used with; empty if they disagree."""
    called = {use.function for use in port.uses}
    called = called - set(usual.get("anything", ())) or called
    kinds = [frozenset(usual[function]) for function in called if function in usual]
    return frozenset.intersection(*kinds) if kinds and len(kinds) == len(called) else frozenset()


def _usual_kind(port: Port, facts: Mapping[str, Any], toned: frozenset[str]) -> str:
    """The kind of component that all functions receiving a port are used with, the most frequent one; empty if there is none.

    Args:
        port: the port.
        facts: what the platform's data says of its ports.
        toned: the kinds that its tones are for.
    """
    if toned:
        return min(toned)
    usual: Mapping[str, Sequence[str]] = facts.get("usual") or facts.get("pictured", {})
    said = [usual[function] for function in dict.fromkeys(use.function for use in port.uses) if function in usual]
    return next((kind for kind in said[0] if all(kind in other for other in said)), "") if said else ""


def _role(port: Port, roles: Mapping[str, str], api: ApiIndex) -> str:
    """The kind of component that the functions receiving a port expect; empty if they disagree or expect none."""
    if port.origin == "convention":
        return str(port.conventional.componentRole) if port.conventional is not None else ""
    found = set()
    for use in port.uses:
        headers = [e.header for e in api.entries(use.function)]
        found |= {roles[name] for name in (use.function, *headers) if name in roles}
    return found.pop() if len(found) == 1 else ""


# ---- the assignment by evidence

NAME_CONFIDENCE = 0.9
"""Confidence of a binding by name alone, or by a role that fits one free component only."""
MOST_PAIRS = 50_000
"""Pairs of an open port and a connection that are compared; people draw some dozens of each."""
BOTH_CONFIDENCE = 0.95
"""Confidence of a binding for which both role and name speak."""
LEFT_CONFIDENCE = 0.85
"""Confidence of a binding made because a single component was left after the others were bound."""


def assign(seats: Sequence[Seat], free: Sequence[migration.Connection], limit: float, *, complete: bool = True) -> None:
    """Bind the ports for which the evidence is decisive, and give the others their options, best first.

    Args:
        seats: the open ports.
        free: the connections that no port is bound to.
        limit: a binding is made when its confidence is at least this.
        complete: whether no other port can be reached; else nothing is bound because it is left over.

    Raises:
        SourceError: there are more pairs of a port and a connection than any program has.
    """
    if len(seats) * len(free) > MOST_PAIRS:
        raise TooLargeError(
            f"{quantity(len(seats), 'open port')} and {quantity(len(free), 'connection')} are too many to match",
            location=_drawing(free[0]),
            fix="take what the program does not use out of the drawing, or bind the ports in robosmi.toml",
        )
    waiting, left, first = list(seats), list(free), True
    while True:
        fits = {(i, k): f for i, s in enumerate(waiting) for k, c in enumerate(left) if (f := fit(s, c)) is not None}
        best = _single_bests(fits)
        pairs = [(i, k) for (i, k), f in fits.items() if f.points > 0 and (i, k) in best]
        pairs = [p for p in pairs if _confidence(fits[p], first) >= limit and not misleading_title(left[p[1]])]
        pins = [left[k].pin for _, k in pairs]
        pairs = [(i, k) for i, k in pairs if left[k].pin is None or pins.count(left[k].pin) == 1]  # several parts on one pin
        left_over = not pairs and complete and limit <= LEFT_CONFIDENCE
        if left_over:
            pairs = [(i, k) for i, k in _only_pairs(fits, waiting, left) if not misleading_title(left[k])]
            fits.update({(i, k): Fit(1.0, (_usual_components(waiting[i]), *fits[i, k].reasons), False) for i, k in pairs})
        if not pairs:
            break
        for i, k in pairs:
            _bind(waiting[i].binding, left[k], fits[i, k], first and not left_over)
        taken = {left[k] for _, k in pairs}
        whole = {left[k].component for i, k in pairs if waiting[i].split and left[k].component is not None}
        used, seated = {connection.pin for connection in taken}, {i for i, _ in pairs}
        waiting = [s for i, s in enumerate(waiting) if i not in seated]
        left = [c for c in left if c not in taken and c.component not in whole and (c.pin is None or c.pin not in used)]
        first = False
    for seat in waiting:
        rank(seat, left)


def rank(seat: Seat, free: Sequence[migration.Connection]) -> None:
    """Set a port's options, best first: connections with evidence for them, or else all that are possible."""
    fits = [(found, connection) for connection in free if (found := fit(seat, connection)) is not None]
    fits = [pair for pair in fits if pair[0].points > 0] or fits
    options = []
    if seat.own and fits and not any(found.points > 0 for found, _ in fits):
        unwired = migration.Option(label=NOT_WIRED, score=0.3, reasons=[f"not connected: {seat.own}"])
        options.append(((0.0, False, -remarks_of_own(seat), False, False), unwired))
    for found, connection in fits:
        meets, (remarks, reasons) = may_meet(seat, connection), remarks_for(seat, connection)
        number = number_for(seat, connection)
        usual = [_usual_components(seat)] if meets and not found.points else []
        said = [*found.reasons, *reasons, *filter(None, [number]), *usual]
        score = 0.5 if found.points > 0 else 0.3 if meets or remarks > 0 or number else 0.1
        option = migration.Option(
            label=connection.name, score=score,
            reasons=[*(said or ["weak match: only input/output agrees"]), *filter(None, [misleading_title(connection)])],
        )  # fmt: skip
        unfit = meets is False or bool(kinds_of(connection) & seat.unlike)
        options.append(((-found.points, unfit, -remarks, not meets, not number), option))
    seat.binding.options.extend(option for _, option in sorted(options, key=lambda pair: pair[0]))


def _single_bests(fits: Mapping[tuple[int, int], Fit]) -> set[tuple[int, int]]:
    """The pairs of a port and a connection that are each other's single best match."""
    ports: defaultdict[int, list[float]] = defaultdict(list)
    connections: defaultdict[int, list[float]] = defaultdict(list)
    for (i, k), found in fits.items():
        ports[i].append(found.points)
        connections[k].append(found.points)
    best = [{key: heapq.nlargest(2, [*points, -1.0]) for key, points in side.items()} for side in (ports, connections)]

    def is_single(points: float, two: list[float]) -> bool:
        return two[0] == points > two[1]

    return {(i, k) for (i, k), f in fits.items() if is_single(f.points, best[0][i]) and is_single(f.points, best[1][k])}


def _only_pairs(
    fits: Mapping[tuple[int, int], Fit], seats: Sequence[Seat], free: Sequence[migration.Connection]
) -> list[tuple[int, int]]:
    """The pairs of which the port is usually on such a component, and neither could be matched with any other that is left."""
    met = {(i, k): may_meet(seats[i], free[k]) for i, k in fits}
    ports = Counter(i for (i, _), may in met.items() if may is not False)
    connections = Counter(k for (_, k), may in met.items() if may is not False)
    components = Counter(c.component for c in free)
    return [
        (i, k)
        for (i, k), may in met.items()
        if may and components[free[k].component] == 1 and ports[i] == 1 and connections[k] == 1
    ]


def _drawing(connection: migration.Connection) -> Location | None:
    circuit = connection.component.circuit if connection.component is not None else None
    return Location(circuit.path) if circuit is not None else None


def _usual_components(seat: Seat) -> str:
    return f"usual parts: {', '.join(sorted(seat.usual or [seat.role]))}"


def _confidence(found: Fit, first: bool) -> float:
    if not first:
        return LEFT_CONFIDENCE
    return BOTH_CONFIDENCE if found.role and len(found.reasons) > 1 else NAME_CONFIDENCE


def _bind(binding: migration.PortBinding, connection: migration.Connection, found: Fit, first: bool) -> None:
    binding.connection, binding.pin = connection, connection.pin
    binding.choice, binding.open = connection.name, False
    binding.confidence, binding.chosenBy = _confidence(found, first), migration.ChosenBy.rule
    binding.evidence.extend([*found.reasons, "best match both ways"])
