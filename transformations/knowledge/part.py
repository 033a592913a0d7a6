"""`Part`: the description of a part, which every drawing tool's reader produces and the catalogue contains.

`part_roles` determines what a part is to the software (its role), `parts_catalogue` looks up ids. Nothing here is specific to
one tool.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from msgspec import Struct

GIVEN = "given by the user"
"""The evidence text of a role that the user assigned."""

ROLES = ("Unknown", "Board", "Input", "Output", "Both", "Passive", "Power", "Decoration")
"""The roles, as the hardware metamodel names them."""

KINDS = ("unknown", "signal", "supply", "ground")
"""What a connector carries, as the hardware metamodel names it."""


class PartConnector(Struct, frozen=True):
    """A connector of a part: identity, name, what it carries (one of `KINDS`)."""

    id: str
    name: str = ""
    kind: str = "unknown"


class Part(Struct, frozen=True):
    """The facts about a part, from the catalogue or from a definition in the drawing.

    Attributes:
        id: identity in the drawing tool's catalogue.
        tool: the drawing tool, in lower case as boards and rules name it; empty if the part belongs to none.
        title: the tool's name of the part (of a symbol or device).
        family: the tool's group of the part; in words of one tool, so only rules of that tool may depend on it.
        tags: the tool's key words.
        description: the tool's description as a plain sentence; empty if there is none.
        role: one of `ROLES`; `evidence` has the reason.
        driver: whether it drives a load of its own, or is a chip between the board and others.
        connectors: the connectors by identity, in the part's order.
        buses: identity of a bus -> the connectors that it joins inside the part.
        shapes: regular expressions for connectors that are too many to list (holes of a breadboard); the text matched by the
            group `bus` identifies the bus that joins them.
        source: where the facts come from, for messages.
    """

    id: str
    title: str = ""
    family: str = ""
    tags: tuple[str, ...] = ()
    role: str = "Unknown"
    evidence: str = ""
    driver: bool = False
    connectors: Mapping[str, PartConnector] = {}
    buses: Mapping[str, tuple[str, ...]] = {}
    properties: Mapping[str, str] = {}
    source: str = ""
    tool: str = ""
    description: str = ""
    shapes: tuple[str, ...] = ()

    def has(self, connector: str) -> bool:
        """Whether the part has a connector of that identity; always true for a part without known connectors."""
        if not self.connectors and not self.shapes:
            return True
        return connector in self.connectors or self._shaped(connector) is not None

    def bus_of(self, connector: str) -> str:
        """The bus that joins a connector of one of the part's shapes to others, or an empty text."""
        found = self._shaped(connector)
        return (found["bus"] or "") if found is not None and "bus" in found.re.groupindex else ""

    def _shaped(self, connector: str) -> re.Match[str] | None:
        return next((found for shape in self.shapes if (found := re.fullmatch(shape, connector)) is not None), None)
