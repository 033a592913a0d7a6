"""A part definition (`.fzp`) as a `Part` of the catalogue: for definitions in a sketch and in folders of parts.

The role is left open: the catalogue's rules, not the file, decide what a part is for the software.

Parts that Fritzing makes up (pin headers, generic ICs, stripboards) have no definition: their generated id says what they are.
"""

from __future__ import annotations

from lxml import etree

from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import PartNames, connector_kind, names
from robosmi.transformations.t2m.guarded_xml import parse_xml

TOOL = "fritzing"
"""The drawing tool as boards, the catalogue and rules name it."""


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


def generated_part(part_id: str, known: PartNames | None = None) -> Part | None:
    """The part that a generated id stands for (pin headers, generic ICs, stripboards), or None.

    The number of connectors is the first whole number between underscores (Fritzing's `TextUtils::getPinsAndSpacing`);
    boards of holes have none of their own, the drawing has those that it uses.
    """
    for shape in (known or names()).generated:
        if shape.tool not in ("", TOOL):
            continue
        holes = any(text in part_id for text in shape.contains)
        if not holes and not part_id.startswith(shape.prefixes):
            continue
        count = 0 if holes else next((int(piece) for piece in part_id.split("_") if piece.isdecimal() and len(piece) < 4), 0)
        if count or holes:
            connectors = {f"connector{i}": PartConnector(f"connector{i}", f"pin {i + 1}", "unknown") for i in range(count)}
            return Part(part_id, shape.title, shape.family, connectors=connectors, source="the part's generated id", tool=TOOL)
    return None
