"""The content of a Wokwi diagram before it is written: parts, wires, and what Wokwi has no part for.

Plain records, made by `m2m/circuits/wokwi_wiring` and written by `m2t/sketch_project`.
"""

from __future__ import annotations

from msgspec import Struct


class DrawnPart(Struct, frozen=True):
    """A part of the diagram: its id, type and attributes."""

    identity: str
    kind: str
    attributes: dict[str, str]


class NotDrawn(Struct, frozen=True):
    """A component that Wokwi has no part for: title, identity in the drawing, part, its board pins, and the reason."""

    title: str
    identity: str
    part: str
    pins: tuple[str, ...]
    why: str


class WokwiWiring:
    """A diagram before it is text.

    Attributes:
        parts: the board first, then in the drawing's order.
        wires: the two ends of each (`uno:13`), and what it carries: `GND`, a voltage, or nothing for a signal.
        not_drawn: what Wokwi has no part for.
        added: supply and ground wires that the source says nothing about.
        loose: parts that have one wire, since the source does not say where their other end goes.
    """

    def __init__(self) -> None:
        self.parts: list[DrawnPart] = []
        self.wires: list[tuple[str, str, str]] = []
        self.not_drawn: list[NotDrawn] = []
        self.added = 0
        self.loose: list[str] = []

    def listed(self) -> list[str]:
        """A line about each part that is not drawn."""
        told = ((p, f" on {', '.join(p.pins)}" if p.pins else "") for p in self.not_drawn)
        return [f"{p.title} ({p.part}){pins}: {p.why}" for p, pins in told]
