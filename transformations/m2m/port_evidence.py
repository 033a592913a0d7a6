"""What speaks for a port being on a connection, and what against it: directions, kinds of components, names, connectors.

Words for kinds and connectors are data (`parts/port_roles.toml`). Who gets what is decided in `port_assignment`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from robosmi import resources
from robosmi.metamodels import migration
from robosmi.project import read_data

_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_EMPTY_WORDS = frozenset(
    ["port", "pin", "basic", "on", "of", "the", "to", "in", "out", "pulse", "signal", "sig", "read", "write", "board"]
)
_SENDS, _RECEIVES = frozenset(["tx", "txd", "txo", "dout", "sout"]), frozenset(["rx", "rxd", "rxi", "din", "sin"])
"""Connectors by which a component sends to the board, and those by which it receives from it."""
_NUMBERED = re.compile(r"(r|row|c|col|column)[ _]?(\d+)\Z", re.IGNORECASE)
_ELEMENT = re.compile(r"(row|col)[a-z]*\[(\d+)\]\Z", re.IGNORECASE)
SERIAL = "serial device"
"""The kind of what has the connectors of a serial line."""


class Seat(NamedTuple):
    """A port that looks for its connection.

    Attributes:
        binding: its decision, open.
        words: what the program and its platform call it.
        parameters: what the functions call the parameter that is given it.
        siblings: what they call all of their parameters that are ports, and what the program calls its ports.
        role: the kind of component that the functions expect, empty for any.
        usual: the kinds that such functions are usually used with, empty where nothing is known.
    """

    binding: migration.PortBinding
    words: Sequence[str]
    parameters: Sequence[str]
    siblings: Sequence[str]
    role: str
    usual: frozenset[str]


class Fit(NamedTuple):
    """How a port fits a connection: points (0: in direction only), what speaks for it, whether the functions expect its kind."""

    points: float
    reasons: tuple[str, ...]
    role: bool


class PortWords(NamedTuple):
    """The data: kind of component -> its words; groups of words of which one excludes the others; purpose of a connector -> words
    and what the board does there."""

    roles: dict[str, frozenset[str]]
    apart: tuple[frozenset[str], ...]
    connectors: dict[str, tuple[frozenset[str], str]]


def fit(seat: Seat, connection: migration.Connection) -> Fit | None:
    """How a port fits a connection; None where direction, role, side or the connector's purpose speak against it."""
    known = known_roles()
    own = _texts(c.name for c in connection.connectors)
    serial = _is_serial(connection)
    if not _same_direction(seat.binding.signal.name, connection, own, serial, known):
        return None
    mine, theirs = _said(seat.words), _said(component_texts(connection))
    for group in known.apart:
        if mine & group and theirs & group and not mine & theirs & group:
            return None
    qualifiers = frozenset().union(*known.apart)
    kinds = kinds_of(connection)
    if seat.role and kinds and seat.role not in kinds:
        return None
    purposes = _purposes(own, known) if not serial else set()
    wanted = _purposes(_texts((*seat.parameters, seat.binding.name)), known)
    numbered = _same_number(seat, connection)
    if (purposes and wanted and not purposes & wanted) or numbered is False:
        return None
    by_role = bool(seat.role) and seat.role in kinds
    by_name = {role for role, words in known.roles.items() if mine & words} & kinds if not by_role else set()
    shared = (mine & theirs) - qualifiers
    reasons = [f"the functions it is given to expect: {seat.role}"] if by_role else []
    if shared:
        reasons.append(f"shares '{', '.join(sorted(shared))}' with the port's name")
    elif by_name:
        reasons.append(f"its name means: {', '.join(sorted(by_name))}")
    points = 2.0 * by_role + len(shared) + (len(by_name) if not shared else 0)
    if points or _goes_together(seat, connection, known):
        for purpose in sorted(purposes & wanted)[:1]:
            reasons.append(f"its connector is for the same: {purpose}")
            points += 1
    if points and numbered:
        reasons.append("its connector has the number of the element")
        points += 1
    if points and (same := (mine | _said(seat.parameters)) & own - _SENDS - _RECEIVES - _EMPTY_WORDS):
        reasons.append(f"its connector is called '{', '.join(sorted(same))}', too")
        points += 0.5 * len(same)
    if points and (side := mine & theirs & qualifiers):
        reasons.append(f"both are called '{', '.join(sorted(side))}'")
        points += 0.5 * len(side)
    return Fit(points, tuple(reasons), by_role)


def may_meet(seat: Seat, connection: migration.Connection) -> bool | None:
    """Whether a port is usually connected to such a component; None where nothing speaks for or against it."""
    kinds = kinds_of(connection)
    expected = frozenset([seat.role]) if seat.role else seat.usual
    return bool(kinds & expected) if kinds and expected else None


def kinds_of(connection: migration.Connection) -> set[str]:
    """The kinds that a component may be of, by its words and its connectors."""
    theirs = _said(component_texts(connection))
    kinds = {role for role, words in known_roles().roles.items() if theirs & words}
    return kinds | ({SERIAL} if _is_serial(connection) else set())


def _is_serial(connection: migration.Connection) -> bool:
    """Whether a connector is one of a component's serial line."""
    component = connection.component
    every = [_texts([c.name]) for c in component.connectors] if component is not None else []
    own = _texts(c.name for c in connection.connectors)
    return any(w & _SENDS for w in every) and any(w & _RECEIVES for w in every) and bool(own & (_SENDS | _RECEIVES))


def _same_direction(signal: str, connection: migration.Connection, own: set[str], serial: bool, known: PortWords) -> bool:
    """Whether what the program does with a port can be done at a connection; connectors of known purpose say it themselves."""
    if serial or not signal:
        sends, receives = bool(own & _SENDS), bool(own & _RECEIVES)
        return signal == "bus" or (sends if signal == "read" else receives)
    ways = {known.connectors[purpose][1] for purpose in _purposes(own, known)}
    if _numbers(connection):
        ways = {"bus"}
    there = ways or {connection.signal.name}
    if (signal == "read" and own & _RECEIVES) or (signal == "write" and own & _SENDS):
        return False
    return signal == "bus" or signal in there or "bus" in there


def _purposes(words: set[str], known: PortWords) -> set[str]:
    return {purpose for purpose, (called, _) in known.connectors.items() if words & called}


def _goes_together(seat: Seat, connection: migration.Connection, known: PortWords) -> bool:
    """Whether a component has connectors for several ports of one function, so that one purpose is no chance."""
    component = connection.component
    every = _purposes(_texts(c.name for c in component.connectors), known) if component is not None else set()
    asked = {frozenset(_purposes(_texts([name]), known)) for name in seat.siblings} - {frozenset()}
    return sum(bool(purposes & every) for purposes in asked) > 1


def _numbers(connection: migration.Connection) -> tuple[str, int] | None:
    """Row or column of a keypad, and its number from 1."""
    for connector in connection.connectors:
        if (found := _NUMBERED.match(str(connector.name).strip())) is not None:
            return found[1][0].lower(), int(found[2])
    return None


def _same_number(seat: Seat, connection: migration.Connection) -> bool | None:
    """Whether an element of an array of rows or columns has the number of the connector, which counts from 1; None for others.

    A component whose connectors count from 0 says it by one with that number.
    """
    theirs = _numbers(connection)
    element = next((m for name in (seat.binding.name, *seat.binding.names) if (m := _ELEMENT.match(str(name)))), None)
    if theirs is None or element is None:
        return None
    component = connection.component
    named = [_NUMBERED.match(str(c.name).strip()) for c in component.connectors] if component is not None else []
    first = min((int(m[2]) for m in named if m is not None and m[1][0].lower() == theirs[0]), default=1)
    return theirs == (element[1][0].lower(), int(element[2]) + first)


def _said(texts: Iterable[str]) -> set[str]:
    return {word for text in texts for word in name_words(text)}


def _texts(texts: Iterable[str]) -> set[str]:
    """The words of what connectors and parameters are called, single letters too, without `pin`."""
    words = {word.lower() for text in texts for word in _WORDS.findall(str(text))}
    return words | {inner for word in words if (inner := word.removeprefix("pin").removesuffix("pin"))}


def name_words(name: str) -> set[str]:
    """The words of a name, lower case, without those that say nothing of the device."""
    words = {w.lower() for w in _WORDS.findall(name) if not w.isdigit() and len(w) > 1}
    return {part for word in words for part in _apart(word)} - _EMPTY_WORDS


def _apart(word: str) -> Sequence[str]:
    """The known words that a word is put together of (`pinbutton`, `redled`), else the word itself."""
    vocabulary = _vocabulary()
    if word in vocabulary:
        return (word,)
    parts: dict[int, tuple[str, ...]] = {0: ()}
    for end in range(1, len(word) + 1):
        for start in sorted(parts):
            if start < end and word[start:end] in vocabulary:
                parts.setdefault(end, (*parts[start], word[start:end]))
    return parts.get(len(word), (word,))


def _vocabulary() -> frozenset[str]:
    known = known_roles()
    words = frozenset().union(*known.roles.values(), *known.apart, ["pin", "port", "sensor"])
    return frozenset(word for word in words if len(word) > 2)


def component_texts(connection: migration.Connection) -> list[str]:
    """What a component is called: by its title, its part's title, its family."""
    component = connection.component
    if component is None:
        return []
    return [component.title, component.partTitle, component.family]


def known_roles() -> PortWords:
    """The words of kinds, sides and connectors."""
    path = resources.find("platform_repo", "parts/port_roles.toml")
    return _known_roles(path, path.stat().st_mtime_ns)


@lru_cache(maxsize=2)
def _known_roles(path: Path, _: int) -> PortWords:
    data = read_data(path)
    return PortWords(
        {role: frozenset(words) for role, words in data["roles"].items()},
        tuple(map(frozenset, data["apart"])),
        {purpose: (frozenset(entry["words"]), entry["board"]) for purpose, entry in data["connectors"].items()},
    )
