"""Which nets distribute a supply or ground, why, and at what voltage.

A net is a rail if it holds a supply or ground pin of a board, a terminal of a supply or of a power symbol, or the connectors
of at least two components that are named like a supply or ground: supplies are not always drawn, and a single name may lie.
The rules are those measured as V2 and V3 on public sketches (docs/method/connector-mapping.md).
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from msgspec import Struct


class Terminal(Struct, frozen=True):
    """A connector as the rules see it: its component's identity, title, role (none where it only steers a supply) and stated
    voltage, its own id, name and kind."""

    component: str
    title: str
    role: str
    volts: str
    connector: str
    name: str
    kind: str


class Rail(Struct, frozen=True):
    """The reason why a net is a rail, and the label of its supply (empty when unknown)."""

    evidence: str
    voltage: str


_SHOWN = 3
_STATED = re.compile(r"[-+]?(\d[\d.]*) ?v\d*|[+]?(\d)v(\d)", re.IGNORECASE)


def rail(terminals: Sequence[Terminal]) -> Rail | None:
    """The rail that a net of these connectors is, or None for a net that carries a signal.

    Args:
        terminals: the net's connectors, in the order in which they are to be named as evidence.
    """
    powered = [t for t in terminals if t.kind in ("supply", "ground")]
    board = [t for t in powered if t.role == "Board"]
    supplies = [t for t in terminals if t.role == "Power"]
    named = [t for t in powered if t.role not in ("Board", "Power")]
    reasons = list(dict.fromkeys(f"{t.name or t.connector} of {_who(t)}" for t in (*board, *supplies)))
    if not reasons and len({t.component for t in named}) > 1:
        reasons = list(dict.fromkeys(f"{t.name} of {_who(t)}" for t in named))
    if not reasons:
        return None
    more = f" and {len(reasons) - _SHOWN} more" if len(reasons) > _SHOWN else ""
    return Rail(", ".join(reasons[:_SHOWN]) + more, _voltage(board, supplies, named))


def _who(terminal: Terminal) -> str:
    return terminal.title or f"#{terminal.component}"


def _voltage(board: Sequence[Terminal], supplies: Sequence[Terminal], named: Sequence[Terminal]) -> str:
    """The label of a rail: from a board, else from supplies, else from names; supply and ground of one rank are both named.

    So a net keeps the label of its source: 5 V of a board stay that even if the ground of a servo is wired to them.
    """
    supplied = False
    for terminals in (board, supplies, named):
        labels = (str(terminal.volts if terminals is supplies else terminal.name).strip() for terminal in terminals)
        label = next((text for text in labels if _STATED.fullmatch(text)), "")
        grounded = any(terminal.kind == "ground" for terminal in terminals)
        if grounded and not supplied:
            return f"{label}/GND" if label else "GND"
        if label:
            return label
        supplied = supplied or any(terminal.kind == "supply" for terminal in terminals)
    return ""
