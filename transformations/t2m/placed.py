"""What a reader tells of a drawing: connectors (`End`), placed parts (`Placed`), what is known of a part (`KnownPart`).

The hardware model is made of them by `drawing.CircuitBuilder`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import NamedTuple

from msgspec import Struct

from robosmi.transformations.knowledge.drawn_boards import DrawnBoard
from robosmi.transformations.knowledge.part import Part


class End(NamedTuple):
    """A connector of a placed part: the part's identity, the connector's."""

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
    """A part of a drawing with what is known of it.

    Attributes:
        part: its description, with a role where one is known.
        board: the board that it is drawn as, if any.
        numbered: whether its pins bear numbers alone, RX and TX too.
        by_bus: it joins connectors only where a bus of its own does (breadboards, headers): only those in use become elements.
        defined: whether the catalogue or the drawing defines it.
        leaders: for each listed connector that it joins to others, the one that stands for all of them.
        own: it is of the person's own making, so that names tell nothing of what it does.
        by_name: the board is told by the part's name or chip, its pins by their labels, and not by the tool's own id.
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
        """The connector, or the name of the strip, that stands for all that the part joins to a connector."""
        return self.leaders.get(connector) or self.part.bus_of(connector) or connector

    def has(self, connector: str) -> bool:
        """Whether it has a connector of that identity; a part that nothing defines may have any."""
        return not self.defined or self.part.has(connector) or (self.board is not None and connector in self.board.pins)
