"""Assigns open ports to free connections, by the similarity of their names and by what the program uses the port for.

This is an assignment, not a list of guesses: a port is bound to a connection only if each is the other's single best match, so
that two ports never share a pin and one of two like components is never picked at random. Without evidence by name or library,
a port and a component are bound if neither fits anything else and such ports are usually on such components. The evidence for a
pair is computed in `port_evidence`.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from robosmi.metamodels import migration
from robosmi.transformations.m2m.port_evidence import Fit, Seat, fit, may_meet

NAME_CONFIDENCE = 0.9
"""Confidence of a binding by name alone, or by a role that fits one free component only."""
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
    """
    waiting, left, first = list(seats), list(free), True
    while True:
        fits = {(i, k): f for i, s in enumerate(waiting) for k, c in enumerate(left) if (f := fit(s, c)) is not None}
        pairs = [(i, k) for (i, k), f in fits.items() if f.points > 0 and _best(fits, i, k)]
        pairs = [p for p in pairs if _confidence(fits[p], first) >= limit]
        pins = [left[k].pin for _, k in pairs]
        pairs = [(i, k) for i, k in pairs if left[k].pin is None or pins.count(left[k].pin) == 1]  # several parts on one pin
        left_over = not pairs and complete and limit <= LEFT_CONFIDENCE
        if left_over:
            pairs = [(i, k) for i, k in fits if _only(fits, waiting, left, i, k)]
            fits.update({(i, k): Fit(1.0, (_usual(waiting[i]), *fits[i, k].reasons), False) for i, k in pairs})
        if not pairs:
            break
        for i, k in pairs:
            _bind(waiting[i].binding, left[k], fits[i, k], first and not left_over)
        taken = [left[k] for _, k in pairs]
        whole = [left[k].component for i, k in pairs if waiting[i].split and left[k].component is not None]
        waiting = [s for i, s in enumerate(waiting) if i not in {p[0] for p in pairs}]
        left = [
            c
            for c in left
            if c not in taken and c.component not in whole and (c.pin is None or c.pin not in [t.pin for t in taken])
        ]
        first = False
    for seat in waiting:
        rank(seat, left)


def rank(seat: Seat, free: Sequence[migration.Connection]) -> None:
    """Set a port's options, best first: connections with evidence for them, or else all that are possible."""
    fits = [(found, connection) for connection in free if (found := fit(seat, connection)) is not None]
    ranked = sorted(fits, key=lambda pair: -pair[0].points)
    for found, connection in [pair for pair in ranked if pair[0].points > 0] or ranked:
        seat.binding.options.append(
            migration.Option(
                label=connection.name, score=0.5 if found.points > 0 else 0.1,
                reasons=list(found.reasons) or ["fits in direction only"],
            )
        )  # fmt: skip


def _best(fits: dict[tuple[int, int], Fit], i: int, k: int) -> bool:
    """Whether a port and a connection are each other's single best match."""
    points = fits[i, k].points
    return all(f.points < points for (a, b), f in fits.items() if (a == i) != (b == k))


def _only(
    fits: Mapping[tuple[int, int], Fit], seats: Sequence[Seat], free: Sequence[migration.Connection], i: int, k: int
) -> bool:
    """Whether a port is usually on such a component, and neither of them could be matched with any other that is left."""
    component = free[k].component
    if not may_meet(seats[i], free[k]) or sum(c.component is component for c in free) > 1:
        return False
    rivals = [(a, b) for a, b in fits if (a == i) != (b == k)]
    return not any(may_meet(seats[a], free[b]) is not False for a, b in rivals)


def _usual(seat: Seat) -> str:
    return f"such a port is usually on: {', '.join(sorted(seat.usual or [seat.role]))}"


def _confidence(found: Fit, first: bool) -> float:
    if not first:
        return LEFT_CONFIDENCE
    return BOTH_CONFIDENCE if found.role and len(found.reasons) > 1 else NAME_CONFIDENCE


def _bind(binding: migration.PortBinding, connection: migration.Connection, found: Fit, first: bool) -> None:
    binding.connection, binding.pin = connection, connection.pin
    binding.choice, binding.open = connection.name, False
    binding.confidence, binding.chosenBy = _confidence(found, first), migration.ChosenBy.rule
    binding.evidence.extend([*found.reasons, "no other free component fits as well, and no other port"])
