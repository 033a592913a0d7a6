"""The description of a part that every drawing tool's reader gives, and the catalogue of parts has: `Part`.

What a part is to the software (its role) is told by `part_roles`, what is known of an id by `parts_catalogue`. Nothing here
belongs to one tool.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from msgspec import Struct

GIVEN = "given by the user"
"""The evidence text of a role that a person assigned."""

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
    """What is known of a part, from the catalogue or from a definition in the drawing.

    Attributes:
        id: identity in the drawing tool's catalogue.
        tool: that tool, in lower case as boards and rules name it; empty where the part belongs to none.
        title: what the tool calls the part (a symbol's or a device's name).
        family: the group that the tool files it under; words of one tool, so nothing but that tool's rules may hang on it.
        tags: the tool's key words.
        description: the tool's sentence about it, in plain text; empty where there is none.
        role: one of `ROLES`; `evidence` says why.
        driver: whether it drives a load of its own, or is a chip between the board and others.
        connectors: by identity, in the part's order.
        buses: connectors that are joined inside the part, by the bus's identity.
        shapes: patterns of further connectors, of which it has too many to list (holes of a breadboard); what the group `bus` of
            a pattern has found is the bus that joins them.
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
        """Whether it has a connector of that identity; a part of which no connector is known may have any."""
        if not self.connectors and not self.shapes:
            return True
        return connector in self.connectors or self._shaped(connector) is not None

    def bus_of(self, connector: str) -> str:
        """The bus that joins a connector of one of the part's shapes to others, or an empty text."""
        found = self._shaped(connector)
        return (found["bus"] or "") if found is not None and "bus" in found.re.groupindex else ""

    def _shaped(self, connector: str) -> re.Match[str] | None:
        return next((found for shape in self.shapes if (found := re.fullmatch(shape, connector)) is not None), None)
