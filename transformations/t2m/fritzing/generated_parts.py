"""Parts that Fritzing makes up: what a generated id says where no definition does (pin headers, generic ICs, stripboards)."""

from __future__ import annotations

from robosmi.transformations.knowledge.part import Part, PartConnector
from robosmi.transformations.knowledge.part_names import PartNames, names

TOOL = "fritzing"
"""The drawing tool as boards, the catalogue and rules name it."""


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
