"""A part definition (`.fzp`) as a `Part` of the catalogue: for definitions in a sketch and in folders of parts.

The role is left open: the catalogue's rules, not the file, decide what a part is for the software.
"""

from __future__ import annotations

from lxml import etree

from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import PartNames, connector_kind
from robosmi.transformations.t2m.fritzing.generated_parts import TOOL
from robosmi.transformations.t2m.guarded_xml import parse_xml


def parse_part(data: bytes, path: str, name: str, known: PartNames) -> Part | None:
    """The part that a definition describes, or None if it is no part definition.

    Args:
        data: the bytes of the `.fzp`.
        path: the file that holds it, for messages.
        name: its name in that file, for messages.
        known: lists of names, for what a connector's name says.

    Raises:
        SourceError: it is no well-formed XML.
    """
    return part_of(parse_xml(data, path, name), f"the definition '{name}' in the drawing", known)


def part_of(root: etree._Element, source: str, known: PartNames) -> Part | None:
    """The part that a parsed definition describes, or None if it is no part definition.

    Args:
        root: the root of the definition.
        source: where it comes from, for messages.
        known: lists of names, for what a connector's name says.
    """
    part_id = root.get("moduleId", "")
    if root.tag != "module" or not part_id:
        return None
    properties = {p.get("name", "").strip(): (p.text or "").strip() for p in root.iterfind("properties/property")}
    family = next((value for key, value in properties.items() if key.lower() == "family"), "")
    connectors: dict[str, PartConnector] = {}
    for connector in root.iterfind("connectors/connector"):
        identity, label = connector.get("id", ""), connector.get("name", "").strip()
        connectors[identity] = PartConnector(identity, label, connector_kind(label, known))
    buses: dict[str, tuple[str, ...]] = {}
    for bus in root.iterfind("buses/bus"):
        members = [m.get("connectorId", "") for m in bus.iterfind("nodeMember")]
        buses[bus.get("id", "")] = buses.get(bus.get("id", ""), ()) + tuple(m for m in members if m in connectors)
    return Part(
        id=part_id,
        title=(root.findtext("title") or "").strip(),
        family=family.removeprefix("//obsolete//").strip(),
        tags=tuple(tag.text.strip() for tag in root.iterfind("tags/tag") if tag.text and tag.text.strip()),
        connectors=connectors,
        buses=buses,
        properties={key: value for key, value in properties.items() if key and value and key.lower() != "family"},
        source=source,
        tool=TOOL,
    )
