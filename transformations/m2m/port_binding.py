"""Port binding: which connection of the target each port of the source becomes (paper Listing 4: `leftQTI` becomes 10).

What a person says counts first. After that a rule compares names: a port whose name shares a word with one component
only, in the right direction, is bound to it with a confidence; below the limit the port stays open with its options.
The drawing alone never says which of two like components is left and which is right.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from robosmi.errors import UsageError, did_you_mean
from robosmi.metamodels import migration, platform
from robosmi.transformations.m2m.text_changes import port_place
from robosmi.transformations.queries.code import CodeView
from robosmi.transformations.queries.ports import Port, convention_of, ports

_SIGNALS = {"in": "read", "out": "write"}
_WORDS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")
_EMPTY_WORDS = {"port", "pin", "left", "right", "basic", "red", "green", "blue", "on", "of", "the"}
NAME_CONFIDENCE = 0.9
"""Confidence of a binding by a name that fits one free component only."""


def bind_ports(
    views: Sequence[CodeView],
    source: platform.Platform,
    connections: Sequence[migration.Connection],
    board: platform.Board,
    said: Mapping[str, str],
    limit: float,
) -> list[migration.PortBinding]:
    """A decision for each port of the program.

    Args:
        views: a view of each unit of the program.
        source: the platform model that the plan refers to.
        connections: the connections of the target board.
        board: the target board.
        said: NAME -> PIN (a label, or a connection's name), as persons said.
        limit: a rule's choice is taken when its confidence is at least this.

    Raises:
        UsageError: a name is no port of the program, or a pin is none of the board.
    """
    found = ports(views)
    known = {port.name for port in found}
    for name in said:
        if name not in known:
            raise UsageError(
                f"'{name}' is no port of the program{did_you_mean(name, known)}",
                fix=f"its ports are: {', '.join(sorted(known)) or 'none'}",
            )
    bindings = [_binding(port, source, connections, board, said.get(port.name)) for port in found]
    taken = {b.connection for b in bindings if b.connection is not None}
    for port, binding in zip(found, bindings, strict=True):
        if binding.open:
            _by_name(port, binding, [c for c in connections if c not in taken], limit)
    return bindings


def _binding(
    port: Port, source: platform.Platform, connections: Sequence[migration.Connection], board: platform.Board, said: str | None
) -> migration.PortBinding:
    binding = migration.PortBinding(
        name=port.name,
        sourcePin=-1 if port.pin is None else port.pin,
        signal=getattr(migration.Signal, signal_of(port)),
        origin=port.origin,
        what=port.what,
        element=port.element,
        convention=convention_of(port, source) if port.origin == "convention" else None,
        open=True,
    )
    if said is None:
        return binding
    if port.origin == "declaration" and port_place(port.element) is None:
        raise UsageError(
            f"the port '{port.name}' cannot be bound: its value is not written as one expression",
            fix="write it as a constant of its own",
        )
    binding.connection, binding.pin = _chosen(said, connections, board)
    binding.choice = binding.connection.name if binding.connection is not None else said
    binding.open, binding.confidence, binding.chosenBy = False, 1.0, migration.ChosenBy.person
    binding.evidence.append("chosen by flag or project file")
    return binding


def _chosen(
    said: str, connections: Sequence[migration.Connection], board: platform.Board
) -> tuple[migration.Connection | None, platform.Pin | None]:
    """The connection or, where none has it, the pin that a person means."""
    named = [c for c in connections if c.name == said]
    on_pin = [c for c in connections if c.pin is not None and said in (c.pin.label, *c.pin.aliases)]
    if named or on_pin:
        connection = (named or on_pin)[0]
        return connection, connection.pin
    pin = next((p for p in board.pins if said in (p.label, *p.aliases)), None)
    if pin is None:
        names = [c.name for c in connections] + [p.label for p in board.pins]
        raise UsageError(
            f"'{said}' is neither a pin of {board.title} nor a mapping{did_you_mean(said, names)}",
            fix=f"use a label such as {board.pins[0].label}, or one of: {', '.join(c.name for c in connections)}",
        )
    return None, pin


def signal_of(port: Port) -> str:
    """read, write or bus: what the program does with the port."""
    directions = port.directions
    return _SIGNALS[next(iter(directions))] if len(directions) == 1 and directions <= set(_SIGNALS) else "bus"


def _by_name(port: Port, binding: migration.PortBinding, free: Sequence[migration.Connection], limit: float) -> None:
    """Bind a port by its name where that is clear; otherwise leave its options."""
    signal = signal_of(port)
    fitting = [c for c in free if signal == "bus" or c.signal.name in (signal, "bus")]
    words = name_words(port.name if port.origin == "declaration" else port.what)
    hits = {c.name: words & component_words(c) for c in fitting}
    ranked = sorted(fitting, key=lambda c: -len(hits[c.name]))
    best = [c for c in ranked if hits[c.name]]
    for connection in best or fitting:
        shared = ", ".join(sorted(hits[connection.name]))
        reasons = [f"shares '{shared}' with the port's name"] if shared else ["fits in direction only"]
        binding.options.append(
            migration.Option(
                label=connection.name,
                score=NAME_CONFIDENCE if shared and len(best) == 1 else 0.5 if shared else 0.1,
                reasons=reasons,
            )
        )
    if len(best) == 1 and limit <= NAME_CONFIDENCE and port_place(port.element) is not None:
        binding.connection, binding.pin = best[0], best[0].pin
        binding.choice, binding.open = best[0].name, False
        binding.confidence, binding.chosenBy = NAME_CONFIDENCE, migration.ChosenBy.rule
        binding.evidence.append(
            f"the only free component that shares '{', '.join(sorted(hits[best[0].name]))}' with the port's name"
        )


def name_words(name: str) -> set[str]:
    """The words of a name, lower case, without those that say nothing of the device."""
    return {w.lower() for w in _WORDS.findall(name) if not w.isdigit() and len(w) > 1} - _EMPTY_WORDS


def component_words(connection: migration.Connection) -> set[str]:
    """The words by which a component may be called in a program: of its title, its part's title and its family."""
    component = connection.component
    if component is None:
        return set()
    return name_words(component.title) | name_words(component.partTitle) | name_words(component.family)
