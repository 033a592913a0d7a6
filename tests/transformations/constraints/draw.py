"""Writes the small drawings of `drawings/` from their table: `python -m tests.transformations.constraints.draw`.

The drawings are files like any other; the table keeps them short to read, and a test holds the two together.
"""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

from robosmi.transformations.knowledge.parts_catalogue import Catalogue

FOLDER = Path(__file__).parent / "drawings"
_END = tuple[str, str]  # model index, connector id


def drawings() -> dict[str, str]:
    """The name of each drawing, and its text."""
    table = tomllib.loads((FOLDER / "drawings.toml").read_text(encoding="utf-8"))
    return {drawing["name"]: _text(drawing, table["modules"]) for drawing in table["drawing"]}


def _text(drawing: dict[str, Any], modules: dict[str, str]) -> str:
    ends = [tuple(end.partition(" ")[::2] for end in wire.split(" -- ")) for wire in drawing["wires"]]
    titles = list(dict.fromkeys([title for wire in ends for title, _ in wire] + drawing.get("parts", [])))
    index = {title: str(number) for number, title in enumerate(titles, 1)}
    module = {title: modules[title.partition("_")[0]] for title in titles}
    joined: dict[str, list[tuple[str, _END]]] = {title: [] for title in titles}
    wires = []
    for number, wire in enumerate(ends, 100):
        places = [(title, _connector(module[title], name)) for title, name in wire]
        wires.append((str(number), [(index[title], connector) for title, connector in places]))
        for end, (title, connector) in enumerate(places):
            joined[title].append((connector, (str(number), f"connector{end}")))
    volts = drawing.get("voltage", {})
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<!-- {drawing['why']} -->",
        '<module fritzingVersion="0.9.6b">',
        "  <instances>",
    ]
    for title in titles:
        lines += _instance(module[title], index[title], title, joined[title], volts.get(title))
    for wire_index, places in wires:
        lines += _instance("WireModuleID", wire_index, f"Wire{wire_index}", [(f"connector{n}", p) for n, p in enumerate(places)])
    return "\n".join([*lines, "  </instances>", "</module>", ""])


def _connector(module: str, name: str) -> str:
    part = Catalogue().find(module)
    assert part is not None, module
    return next(c.id for c in part.connectors.values() if c.name == name)


def _instance(module: str, index: str, title: str, joined: list[tuple[str, _END]], volts: str | None = None) -> list[str]:
    lines = [f'    <instance moduleIdRef={quoteattr(module)} modelIndex="{index}" path="">']
    if volts is not None:
        lines.append(f'      <property name="voltage" value="{volts}"/>')
    lines += [
        f"      <title>{title}</title>",
        '      <views><breadboardView layer="breadboard"><geometry z="1" x="0" y="0"/><connectors>',
    ]
    for connector in dict.fromkeys(c for c, _ in joined):
        others = [
            f'<connect connectorId="{c}" modelIndex="{i}" layer="breadboard"/>' for own, (i, c) in joined if own == connector
        ]
        lines.append(
            f'        <connector connectorId="{connector}" layer="breadboard"><connects>{"".join(others)}</connects></connector>'
        )
    return [*lines, "      </connectors></breadboardView></views>", "    </instance>"]


if __name__ == "__main__":
    for name, text in drawings().items():
        (FOLDER / f"{name}.fz").write_text(text, encoding="utf-8")
