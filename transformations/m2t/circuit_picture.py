"""A circuit as a picture (SVG) that a person can hold beside the robot: boards left, then what is wired to them, then what is
behind that; a line for each connection of a signal net, a coloured tag for each connector on a supply or ground.

What is drawn is computed here, `circuit_layout` places it, the templates write it. Graphviz may place it instead.
"""

from __future__ import annotations

import subprocess
from collections import deque
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

from robosmi.generate import Gen
from robosmi.metamodels import hardware
from robosmi.transformations.m2t.circuit_layout import Box, DrawnLink, PartRow, Place, placed
from robosmi.transformations.queries.circuit_walk import natural_key, pins_of

_FILLS = {
    "Board": "#cfe3f5", "Input": "#d9f0d3", "Output": "#fde3c8", "Both": "#e9dcf2", "Passive": "#eeeeee", "Power": "#f8d0d0",
    "Unknown": "#fff6b8",
}  # fmt: skip
_LINES = ("#1f77b4", "#d62728", "#2ca02c", "#9467bd", "#ff7f0e", "#8c564b", "#e377c2", "#17becf", "#7f7f00", "#003f5c")
_LETTERS = 36
_SECONDS = 20
MOST_FOR_DOT = 500
"""Boxes and links that Graphviz is given; its time grows with their square, and a larger picture is looked at in parts."""


@dataclass
class Picture:
    """What is to be drawn: boxes with rows, links between rows, and titles of what is connected to nothing."""

    title: str
    boxes: list[Box] = field(default_factory=list)
    links: list[DrawnLink] = field(default_factory=list)
    loose: list[str] = field(default_factory=list)


def circuit_picture(circuit: hardware.Circuit) -> Picture:
    """The picture of a circuit, without places."""
    picture = Picture(_short(circuit.name, 80))
    rows: dict[hardware.Connector, Place] = {}
    shown = [c for c in circuit.components if c.role is not hardware.Role.Decoration and not _only_joins(c)]
    far = _distances(shown)
    for component in sorted(shown, key=lambda c: (far[c], natural_key(c.elementId))):
        box = _box(component, len(picture.boxes), far[component], rows)
        if box.rows:
            picture.boxes.append(box)
        else:
            picture.loose.append(_short(component.title or component.partTitle or f"#{component.elementId}"))
    for number, net in enumerate(circuit.nets):
        if net.rail:
            continue
        ends = list(dict.fromkeys(rows[c] for c in net.connectors if c in rows))
        ends.sort(key=lambda place: (picture.boxes[place.box].column, place.box, place.row))
        colour = _LINES[number % len(_LINES)]
        for other in ends[1:]:
            names = " - ".join(f"{picture.boxes[e.box].title} {picture.boxes[e.box].rows[e.row].text}" for e in (ends[0], other))
            picture.links.append(DrawnLink(ends[0], other, colour, names))
    return picture


def picture_svg(picture: Picture) -> str:
    """The picture as SVG, with the layout of this package."""
    width, height = placed(picture.boxes, picture.links, bool(picture.loose))
    return Gen().text(
        "circuit/picture.svg.j2",
        title=picture.title,
        width=width,
        height=height,
        boxes=picture.boxes,
        links=picture.links,
        loose=", ".join(picture.loose),
    )


def picture_dot(picture: Picture) -> str:
    """The picture in the language of Graphviz."""
    loose = ", ".join(picture.loose)
    return Gen().text("circuit/picture.dot.j2", title=picture.title, boxes=picture.boxes, links=picture.links, loose=loose)


def svg(circuit: hardware.Circuit, dot: str | None = None) -> str:
    """The picture of a circuit as SVG.

    Args:
        circuit: what to draw.
        dot: the program `dot` of Graphviz, which places things better; None for the layout of this package, which is also
            taken for more than `MOST_FOR_DOT` boxes and links, and where `dot` fails or takes too long.
    """
    picture = circuit_picture(circuit)
    if dot is not None and len(picture.boxes) + len(picture.links) <= MOST_FOR_DOT:
        try:
            source = picture_dot(picture).encode()
            done = subprocess.run([dot, "-Tsvg"], input=source, capture_output=True, timeout=_SECONDS, check=False)
            drawn = done.stdout.decode()
        except (OSError, subprocess.TimeoutExpired, UnicodeError):
            return picture_svg(picture)
        if done.returncode == 0 and "<svg" in drawn:
            return drawn
    return picture_svg(picture)


def _distances(components: Sequence[hardware.Component]) -> dict[hardware.Component, int]:
    """How many signal nets lie between a board and each component; 1 for what no net leads to."""
    known = set(components)
    boards = [c for c in components if c.role is hardware.Role.Board]
    found = dict.fromkeys(boards, 0)
    seen: set[int] = set()
    todo = deque(boards)
    while todo:
        component = todo.popleft()
        for net in (c.net for c in component.connectors if c.net is not None):
            if net.rail or id(net) in seen:
                continue
            seen.add(id(net))
            for other in (c.component for c in net.connectors):
                if other is not None and other in known and other not in found:
                    found[other] = found[component] + 1
                    todo.append(other)
    return {component: found.get(component, 1) for component in components}


def _box(component: hardware.Component, number: int, column: int, rows: dict[hardware.Connector, Place]) -> Box:
    about = " · ".join(filter(None, (component.partTitle, component.role.name + (", driver" if component.driver else ""))))
    values = [p.value for p in component.properties if p.name in ("resistance", "capacitance", "voltage", "color") and p.value]
    box = Box(
        number,
        _short(component.title or component.partTitle or f"#{component.elementId}"),
        _short(" · ".join([about, *values[:1]]), 48),
        _FILLS[component.role.name],
        column,
    )
    for text, connectors in _groups(component):
        net = connectors[0].net
        for connector in connectors:
            rows[connector] = Place(number, len(box.rows))
        tag = (net.voltage or "supply") if net is not None and net.rail else ""
        box.rows.append(PartRow(len(box.rows), _short(text, 24), _short(tag, 10), _tag_colour(tag)))
    return box


def _groups(component: hardware.Component) -> Iterable[tuple[str, Sequence[hardware.Connector]]]:
    """The connected connectors, those of one name in one net together; a board's pins first, in their order."""
    found: dict[tuple[str, int], list[hardware.Connector]] = {}
    pins = [c for connectors in pins_of(component).values() for c in connectors]
    same = {id(c.net): c.pin for c in reversed(pins)}  # ICSP MOSI of a board is its D11
    others = [c for c in component.connectors if not c.pin]
    for connector in (*pins, *others):
        if connector.net is not None and any(c.component is not component for c in connector.net.connectors):
            text = connector.pin or same.get(id(connector.net)) or connector.name or connector.connectorId
            found.setdefault((text, id(connector.net)), []).append(connector)
    return [(text, connectors) for (text, _), connectors in found.items()]


def _only_joins(component: hardware.Component) -> bool:
    """Whether it is a breadboard or its like: its nets are drawn, not itself."""
    return component.role is hardware.Role.Passive and len(component.connectors) > 4


def _tag_colour(tag: str) -> str:
    if tag == "GND":
        return "#333333"
    return {"": "", "5V": "#c0392b", "3V3": "#d35400", "3.3V": "#d35400"}.get(tag.lstrip("+"), "#8e44ad")


def _short(text: str, letters: int = _LETTERS) -> str:
    """A text on one line, without what no XML may hold, cut where it is too long."""
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return line if len(line) <= letters else line[: letters - 1] + "…"
