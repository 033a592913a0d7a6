"""Evidence for and against a port being on a connection: directions, kinds of components, names, connectors.

What the program says beside a port (the variable that gets its value, a comment at its line or declaration) decides
nothing: a comment may be older than the code. It only orders the options of a port that stays open.

Words and kinds are those of `queries.circuits.component_kinds`. Which port gets which connection is decided in `port_binding`.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import pairwise

from msgspec import Struct

from robosmi.metamodels import ccode, migration
from robosmi.model.elements.strict import Element
from robosmi.transformations.queries.circuits.component_kinds import (
    EMPTY_WORDS,
    RECEIVES,
    SENDS,
    PortWords,
    component_texts,
    connector_words,
    is_serial,
    kinds_of,
    kinds_of_part,
    known_roles,
    side_of,
    significant_words,
)
from robosmi.transformations.queries.code import unit_of
from robosmi.transformations.queries.flows.pin_uses import PinUse
from robosmi.transformations.queries.plans.port_pins import measures

_NUMBERED = re.compile(r"(r|row|c|col|column)[ _]?(\d+)\Z", re.IGNORECASE)
_BY_NUMBER = ("literal", "runtime", "given")
"""Origins of ports that the program calls by the number of their pin."""
_LAST_NUMBER = re.compile(r"\d+\Z")
_ELEMENT = re.compile(r"(row|col)[a-z]*\[(\d+)\]\Z", re.IGNORECASE)


class Seat(Struct, frozen=True, dict=True):
    """A port that is to be bound to a connection, with what is known about it.

    Attributes:
        binding: its decision, which is open.
        words: its names in the program and the platform.
        parameters: the names of the function parameters that receive it.
        siblings: the names of all parameters of these functions that are ports, and those of the program's declared ports.
        role: the kind of component that the functions expect; empty for any.
        usual: the kinds that such functions are usually used with; empty if unknown.
        split: whether its functions can use a component with a separate wire for each direction.
        uses: where the program uses it.
        own: what boards of the source have at the port themselves; empty if nothing is known.
        unlike: the kinds that the tones of other ports are for, without those that are usual for this one.
    """

    binding: migration.PortBinding
    words: Sequence[str]
    parameters: Sequence[str]
    siblings: Sequence[str]
    role: str
    usual: frozenset[str]
    split: bool = False
    uses: Sequence[PinUse] = ()
    own: str = ""
    unlike: frozenset[str] = frozenset()

    @cached_property
    def remarks(self) -> Sequence[Remark]:
        """What the program says beside the declaration of the port and its first uses, without repetitions."""
        used = (each for use in self.uses[:MOST_USES] for each in _remarks(use))
        return list(dict.fromkeys([*_comments(self.binding.element), *used]))


class Remark(Struct, frozen=True):
    """Words beside the declaration or a use of a port.

    Attributes:
        place: what has them, for a reason.
        words: in lower case, without those that say nothing of a device.
    """

    place: str
    words: frozenset[str]


MOST_USES = 8
"""Uses of a port whose surroundings are read."""


class Fit(Struct, frozen=True):
    """How well a port fits a connection: points (0: only the direction fits), the reasons, and whether the expected kind
    matches.
    """

    points: float
    reasons: tuple[str, ...]
    role: bool


def fit(seat: Seat, connection: migration.Connection) -> Fit | None:
    """How well a port fits a connection; None if direction, kind, side (left, right) or the connector's purpose contradict.

    It is None, too, for a channel of an analog-to-digital converter on a pin without one.
    """
    known = known_roles()
    if connection.pin is not None and not measures(connection.pin, seat.binding):
        return None
    own = connector_words(c.name for c in connection.connectors)
    serial = is_serial(connection)
    if not _same_direction(seat.binding.signal.name, connection, own, serial, known):
        return None
    if seat.split and _only_answers(connection, own, known):
        return None
    mine, theirs = significant_words(seat.words), significant_words(component_texts(connection))
    for group in known.apart:
        if mine & group and theirs & group and not mine & theirs & group:
            return None
    qualifiers = frozenset().union(*known.apart)
    kinds = kinds_of(connection)
    if seat.role and kinds and seat.role not in kinds:
        return None
    purposes = _purposes(own, known) if not serial else set()
    wanted = _purposes(connector_words((*seat.parameters, seat.binding.name)), known)
    numbered = _same_number(seat, connection)
    if (purposes and wanted and not purposes & wanted) or numbered is False:
        return None
    by_role = bool(seat.role) and seat.role in kinds
    by_name = {role for role, words in known.roles.items() if mine & words} & kinds if not by_role else set()
    shared = (mine & theirs) - qualifiers
    reasons = [f"used with functions that expect: {seat.role}"] if by_role else []
    if shared:
        reasons.append(f"both names contain '{', '.join(sorted(shared))}'")
    elif by_name:
        reasons.append(f"its name suggests: {', '.join(sorted(by_name))}")
    points = float(len(shared) or len(by_name))
    if by_role:
        points += 2 if seat.role in kinds_of_part(connection) else 1.5
    if points or _goes_together(seat, connection, known):
        for purpose in sorted(purposes & wanted)[:1]:
            reasons.append(f"its connector has the same purpose: {purpose}")
            points += 1
    if points and numbered:
        reasons.append("its connector has the same number")
        points += 1
    if points and (same := (mine | significant_words(seat.parameters)) & own - SENDS - RECEIVES - EMPTY_WORDS):
        reasons.append(f"its connector's name also contains '{', '.join(sorted(same))}'")
        points += 0.5 * len(same)
    if points and (side := mine & theirs & qualifiers):
        reasons.append(f"both names contain '{', '.join(sorted(side))}'")
        points += 0.5 * len(side)
    return Fit(points, tuple(reasons), by_role)


def remarks_for(seat: Seat, connection: migration.Connection) -> tuple[float, list[str]]:
    """How much the remarks of a port speak for a connection (below 0: against it), and the reasons."""
    points, reasons = _sides(seat, connection)
    if not seat.remarks:
        return points, reasons
    known = known_roles()
    theirs, kinds = significant_words(component_texts(connection)), kinds_of(connection)
    for remark in seat.remarks:
        named = {role for role, words in known.roles.items() if remark.words & words}
        shared = sorted(remark.words & theirs) or sorted(named & kinds)
        if any(remark.words & group and theirs & group and not remark.words & theirs & group for group in known.apart):
            points -= 2
        elif shared:
            points += len(shared)
            reasons.append(f"{remark.place} says '{', '.join(shared)}'")
    return points, reasons


def _sides(seat: Seat, connection: migration.Connection) -> tuple[float, list[str]]:
    """How much the sides speak for a connection, where a letter at the end of a name stands for one (servoL), and the reasons."""
    title = str(connection.component.title) if connection.component is not None else ""
    letter, names = side_of(title), (str(seat.binding.name), *map(str, seat.binding.names))
    mine = {side for name in names if (side := side_of(name))}
    if not letter and not mine:
        return 0.0, []
    mine |= significant_words(seat.words)
    theirs = {letter} if letter else significant_words([title])
    for group in known_roles().apart:
        if mine & group and theirs & group:
            same = sorted(mine & theirs & group)
            return (1.0, [f"both names mean '{same[0]}'"]) if same else (-2.0, [])
    return 0.0, []


def number_for(seat: Seat, connection: migration.Connection) -> str:
    """Why the number at the end of a port's name speaks for a connection; empty if it does not, or if it is the pin's number.

    A port with a name of its own is also called by its pin (P11).
    """
    binding = seat.binding
    names = (binding.name, *binding.names) if binding.origin not in _BY_NUMBER else ()
    found = [(name, int(end[0])) for name in names if (end := _LAST_NUMBER.search(str(name)))]
    mine = {number for name, number in found if name == binding.name or number != binding.sourcePin}
    title = str(connection.component.title) if connection.component is not None else ""
    theirs = _LAST_NUMBER.search(title)
    return f"both names end with {theirs[0]}" if theirs is not None and int(theirs[0]) in mine else ""


def remarks_of_own(seat: Seat) -> float:
    """How much the remarks of a port speak for what boards of the source have there themselves."""
    words = significant_words([seat.own])
    return float(sum(len(remark.words & words) for remark in seat.remarks))


def _remarks(use: PinUse) -> Iterator[Remark]:
    """The variable that gets the value of a use, and the comments at its line or alone on the line above.

    A burst of light is read in the next line: the side of what is read there is the side of the light.
    """
    if (name := _receiver(use.call)) and (words := significant_words([name])):
        yield Remark(f"the variable '{name}'", frozenset(words))
    yield from _comments(use.call)
    if use.direction == "out" and (following := _read_next(use.call)):
        sides = frozenset().union(*known_roles().apart)
        if words := significant_words([following]) & sides:
            yield Remark(f"'{following}', which is read next,", frozenset(words))


def _comments(element: ccode.Located | None) -> Iterator[Remark]:
    """The comments at the line of an element, or else alone on the line above it."""
    unit = unit_of(element) if element is not None else None
    if element is None or unit is None:
        return
    beside = [c for c in unit.comments if c.line == element.line]
    above = [c for c in unit.comments if c.endLine == element.line - 1 and c.column == element.column]
    for comment in beside or above:
        if words := significant_words([comment.text]):
            yield Remark(f"the comment in line {comment.line}", frozenset(words))


def _read_next(call: ccode.Expression) -> str:
    """The variable that gets a value in the statement after a call; empty if there is none."""
    statement: Element | None = call
    while statement is not None and not isinstance(statement, ccode.Statement):
        statement = statement.eContainer()
    block = statement.eContainer() if statement is not None else None
    if not isinstance(block, ccode.Block):
        return ""
    following = next((later for each, later in pairwise(block.statements) if each is statement), None)
    value = following.expression if isinstance(following, ccode.ExpressionStatement) else None
    return _receiver(value.right) if isinstance(value, ccode.Assignment) and value.right is not None else ""


def _receiver(expression: Element) -> str:
    """The name of the variable that gets a value as it is, or negated or converted; empty if there is none."""
    holder = expression.eContainer()
    while isinstance(holder, (ccode.Cast, ccode.Unary)):
        holder = holder.eContainer()
    if isinstance(holder, ccode.Variable):
        return str(holder.name)
    target = holder.left if isinstance(holder, ccode.Assignment) else None
    return str(target.name) if isinstance(target, (ccode.NameReference, ccode.Member)) else ""


def may_meet(seat: Seat, connection: migration.Connection) -> bool | None:
    """Whether a port is usually connected to such a component; None if the kind of either is unknown."""
    kinds = kinds_of(connection)
    expected = frozenset([seat.role]) if seat.role else seat.usual
    return bool(kinds & expected) if kinds and expected else None


def _same_direction(signal: str, connection: migration.Connection, own: set[str], serial: bool, known: PortWords) -> bool:
    """Whether a connection allows the direction in which the program uses a port; connectors of known purpose determine it."""
    if serial or not signal:
        sends, receives = bool(own & SENDS), bool(own & RECEIVES)
        return signal == "bus" or (sends if signal == "read" else receives)
    ways = {known.connectors[purpose][1] for purpose in _purposes(own, known)}
    if _numbers(connection):
        ways = {"bus"}
    there = ways or {connection.signal.name}
    if (signal == "read" and own & RECEIVES) or (signal == "write" and own & SENDS):
        return False
    return signal == "bus" or signal in there or "bus" in there


def _only_answers(connection: migration.Connection, own: set[str], known: PortWords) -> bool:
    """Whether a connection is the output of a component whose requests go to another connection, such as an echo pin."""
    component = connection.component
    every = _purposes(connector_words(c.name for c in component.connectors), known) if component is not None else set()
    ways = {known.connectors[purpose][1] for purpose in _purposes(own, known)}
    return ways == {"read"} and "write" in {known.connectors[purpose][1] for purpose in every}


def _purposes(words: set[str], known: PortWords) -> set[str]:
    return {purpose for purpose, (called, _) in known.connectors.items() if words & called}


def _goes_together(seat: Seat, connection: migration.Connection, known: PortWords) -> bool:
    """Whether a component has connectors for several ports of one function, so that a matching purpose is not a coincidence."""
    component = connection.component
    every = _purposes(connector_words(c.name for c in component.connectors), known) if component is not None else set()
    asked = {frozenset(_purposes(connector_words([name]), known)) for name in seat.siblings} - {frozenset()}
    return sum(bool(purposes & every) for purposes in asked) > 1


def _numbers(connection: migration.Connection) -> tuple[str, int] | None:
    """The row or column of a keypad that a connection leads to, as ("r" or "c", number on the connector); None for others."""
    for connector in connection.connectors:
        if (found := _NUMBERED.match(str(connector.name).strip())) is not None:
            return found[1][0].lower(), int(found[2])
    return None


def _same_number(seat: Seat, connection: migration.Connection) -> bool | None:
    """Whether a port and a connection are the same row or column of a keypad; None if either is no numbered row or column.

    The port is an element of an array counted from 0, such as `rows[2]`. Connectors count from the lowest number that the
    component has for its rows or columns.
    """
    theirs = _numbers(connection)
    element = next((m for name in (seat.binding.name, *seat.binding.names) if (m := _ELEMENT.match(str(name)))), None)
    if theirs is None or element is None:
        return None
    component = connection.component
    named = [_NUMBERED.match(str(c.name).strip()) for c in component.connectors] if component is not None else []
    first = min((int(m[2]) for m in named if m is not None and m[1][0].lower() == theirs[0]), default=1)
    return theirs == (element[1][0].lower(), int(element[2]) + first)
