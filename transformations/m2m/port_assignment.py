"""Which open port is on which free connection, weighed by what both are called and for what the program uses the port.

An assignment, not a list of guesses: a port is bound to a connection only where each is the other's single best, so that two
ports never share a pin and one of two like components is never taken. Words for kinds of components are data
(`parts/port_roles.toml`).
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
_EMPTY_WORDS = {"port", "pin", "basic", "on", "of", "the", "to", "in", "out", "pulse", "signal", "sig", "read", "write", "board"}
_SENDS, _RECEIVES = {"tx", "txd", "txo", "dout", "sout"}, {"rx", "rxd", "rxi", "din", "sin"}
"""Connectors by which a component sends to the board, and those by which it receives from it."""
NAME_CONFIDENCE = 0.9
"""Confidence of a binding by a name or by a role that fits one free component only."""
BOTH_CONFIDENCE = 0.95
"""Confidence where role and name say the same."""
LEFT_CONFIDENCE = 0.85
"""Confidence where only one component is left once others are bound."""


class Seat(NamedTuple):
    """A port that looks for its connection.

    Attributes:
        binding: its decision, open.
        words: what the program and its platform call it.
        parameters: what the functions call the parameter that is given it.
        role: the kind of component that the functions expect, empty for any.
    """

    binding: migration.PortBinding
    words: Sequence[str]
    parameters: Sequence[str]
    role: str


class Fit(NamedTuple):
    """How a port fits a connection: points (0: in direction only) and what speaks for it."""

    points: float
    reasons: tuple[str, ...]
    role: bool


def assign(seats: Sequence[Seat], free: Sequence[migration.Connection], limit: float) -> None:
    """Bind what the evidence decides, and give each of the others its options, best first.

    Args:
        seats: the open ports.
        free: the connections that no port is bound to.
        limit: a binding is made when its confidence is at least this.
    """
    waiting, left, first = list(seats), list(free), True
    while True:
        fits = {(i, k): f for i, s in enumerate(waiting) for k, c in enumerate(left) if (f := fit(s, c)) is not None}
        pairs = [(i, k) for (i, k), f in fits.items() if f.points > 0 and _best(fits, i, k)]
        pairs = [p for p in pairs if _confidence(fits[p], first) >= limit]
        pins = [left[k].pin for _, k in pairs]
        pairs = [(i, k) for i, k in pairs if left[k].pin is None or pins.count(left[k].pin) == 1]  # several parts on one pin
        if not pairs:
            break
        for i, k in pairs:
            _bind(waiting[i].binding, left[k], fits[i, k], first)
        waiting = [s for i, s in enumerate(waiting) if i not in {p[0] for p in pairs}]
        taken = [left[k] for _, k in pairs]
        left = [c for c in left if c not in taken and (c.pin is None or c.pin not in [t.pin for t in taken])]
        first = False
    for i, seat in enumerate(waiting):
        ranked = sorted(((f, left[k]) for (j, k), f in fits.items() if j == i), key=lambda pair: -pair[0].points)
        wanted = [pair for pair in ranked if pair[0].points > 0] or ranked
        for found, connection in wanted:
            seat.binding.options.append(
                migration.Option(
                    label=connection.name, score=0.5 if found.points > 0 else 0.1,
                    reasons=list(found.reasons) or ["fits in direction only"],
                )
            )  # fmt: skip


def _best(fits: dict[tuple[int, int], Fit], i: int, k: int) -> bool:
    """Whether a port and a connection are each other's single best."""
    points = fits[i, k].points
    return all(f.points < points for (a, b), f in fits.items() if (a == i) != (b == k))


def _confidence(found: Fit, first: bool) -> float:
    if not first:
        return LEFT_CONFIDENCE
    return BOTH_CONFIDENCE if found.role and len(found.reasons) > 1 else NAME_CONFIDENCE


def _bind(binding: migration.PortBinding, connection: migration.Connection, found: Fit, first: bool) -> None:
    binding.connection, binding.pin = connection, connection.pin
    binding.choice, binding.open = connection.name, False
    binding.confidence, binding.chosenBy = _confidence(found, first), migration.ChosenBy.rule
    binding.evidence.extend([*found.reasons, "no other free component fits as well, and no other port"])


def fit(seat: Seat, connection: migration.Connection) -> Fit | None:
    """How a port fits a connection; None where direction, role or side speak against it."""
    signal = seat.binding.signal.name
    if signal != "bus" and connection.signal.name not in (signal, "bus"):
        return None
    mine, theirs = _said(seat.words), _said(component_texts(connection))
    connectors = _said(c.name for c in connection.connectors)
    if (signal == "read" and connectors & _RECEIVES) or (signal == "write" and connectors & _SENDS):
        return None
    words, groups = known_roles()
    for group in groups:
        if mine & group and theirs & group and not mine & theirs & group:
            return None
    qualifiers = frozenset().union(*groups)
    theirs_roles = {role for role, known in words.items() if theirs & known}
    if seat.role and theirs_roles and seat.role not in theirs_roles:
        return None
    by_role = bool(seat.role) and seat.role in theirs_roles
    by_name = {role for role, known in words.items() if mine & known} & theirs_roles if not by_role else set()
    shared = (mine & theirs) - qualifiers
    reasons = [f"the functions it is given to expect: {seat.role}"] if by_role else []
    if shared:
        reasons.append(f"shares '{', '.join(sorted(shared))}' with the port's name")
    elif by_name:
        reasons.append(f"its name means: {', '.join(sorted(by_name))}")
    points = 2.0 * by_role + len(shared) + (len(by_name) if not shared else 0)
    if points and (same := (mine | _said(seat.parameters)) & connectors - _SENDS - _RECEIVES):
        reasons.append(f"its connector is called '{', '.join(sorted(same))}', too")
        points += 0.5 * len(same)
    if points and (side := mine & theirs & qualifiers):
        reasons.append(f"both are called '{', '.join(sorted(side))}'")
        points += 0.5 * len(side)
    return Fit(points, tuple(reasons), by_role)


def _said(texts: Iterable[str]) -> set[str]:
    return {word for text in texts for word in name_words(text)}


def name_words(name: str) -> set[str]:
    """The words of a name, lower case, without those that say nothing of the device."""
    return {w.lower() for w in _WORDS.findall(name) if not w.isdigit() and len(w) > 1} - _EMPTY_WORDS


def component_texts(connection: migration.Connection) -> list[str]:
    """What a component is called: by its title, its part's title, its family."""
    component = connection.component
    if component is None:
        return []
    return [component.title, component.partTitle, component.family]


def known_roles() -> tuple[dict[str, frozenset[str]], tuple[frozenset[str], ...]]:
    """Kind of component -> the words it goes by; and groups of words of which one excludes the others (left, right)."""
    path = resources.find("platform_repo", "parts/port_roles.toml")
    return _known_roles(path, path.stat().st_mtime_ns)


@lru_cache(maxsize=2)
def _known_roles(path: Path, _: int) -> tuple[dict[str, frozenset[str]], tuple[frozenset[str], ...]]:
    data = read_data(path)
    return {role: frozenset(words) for role, words in data["roles"].items()}, tuple(map(frozenset, data["apart"]))
