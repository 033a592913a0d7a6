"""The records by which a reader describes a drawing: connectors (`End`), placed parts (`Placed`), known parts (`KnownPart`).

`drawing.CircuitBuilder` makes the hardware model of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from msgspec import Struct

from robosmi.transformations.knowledge.drawn_boards import DrawnBoard
from robosmi.transformations.knowledge.part import Part


class End(NamedTuple):
    """A connector of a placed part: the part's identity and the connector's."""

    component: str
    connector: str


class Placed(Struct, frozen=True):
    """A part that is placed in a drawing, as the drawing has it.

    Attributes:
        identity: the tool's own identity of it, unique in the drawing; it becomes `#model_index`.
        part_id: the part's id in the tool's catalogue, as given to `know`.
        title: its label in the drawing.
        properties: its own properties.
        used: the connectors that the drawing connects, in any order; those that its part lacks are left out, and said (RS208).
        mentioned: further connectors that the drawing names; they count where nothing defines the part.
        names: names that the drawing gives to connectors of this placement, by connector.
        line: its line in the file, for findings.
        hint: name of the file that its missing definition was in, or empty.
        symbol: whether it only names a net, so that nothing needs to be known of it.
        listed_as: its id in the tool's catalogue, where `part_id` tells of one variant of it; empty: `part_id`.
    """

    identity: str
    part_id: str
    title: str = ""
    properties: Mapping[str, str] = {}
    used: Iterable[str] = ()
    mentioned: Iterable[str] = ()
    names: Mapping[str, str] = {}
    line: int | None = None
    hint: str = ""
    symbol: bool = False
    listed_as: str = ""


class KnownPart(Struct, frozen=True):
    """What is known about a part of a drawing.

    Attributes:
        part: its description, with a role where one is known.
        board: the board that it is drawn as, if any.
        numbered: whether its pin labels are plain numbers, RX and TX included.
        by_bus: whether it only joins connectors by its buses (breadboards, headers): only used ones become elements.
        defined: whether the catalogue or the drawing defines it.
        leaders: connector that it joins to others -> the representative of all of them.
        own: whether the user has made it, so that names say nothing about what it does.
        by_name: whether the board was recognised by the part's name or chip and its pins by labels, not by the tool's id.
    """

    part: Part
    board: DrawnBoard | None
    numbered: bool
    by_bus: bool
    defined: bool
    leaders: dict[str, str]
    own: bool = False
    by_name: bool = False

    def leader(self, connector: str) -> str:
        """The representative (a connector or the name of a strip) of all connectors that the part joins to this one."""
        return self.leaders.get(connector) or self.part.bus_of(connector) or connector

    def has(self, connector: str) -> bool:
        """Whether the part has a connector of that identity; an undefined part may have any."""
        return not self.defined or self.part.has(connector) or (self.board is not None and connector in self.board.pins)
