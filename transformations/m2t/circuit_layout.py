"""Places for the boxes and lines of a circuit's picture: columns by their distance from a board, so that no line has to pass
a column, each sorted by what its boxes are connected to. Lengths in pixels of the SVG. What boxes mean is not known here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

_ROW, _HEAD, _GAP, _MARGIN = 18, 40, 22, 20
_CHANNEL = 150
_LETTER = 7.2


@dataclass(frozen=True, slots=True)
class Place:
    """A row of a box, by their numbers."""

    box: int
    row: int


@dataclass(slots=True)
class PartRow:
    """A connector in a box: its name, and the tag of the supply that it is on. Places are filled by `placed`."""

    number: int
    text: str
    tag: str = ""
    tag_colour: str = ""
    y: float = 0
    left: float = 0
    right: float = 0
    tag_x: float = 0
    tag_width: float = 0


@dataclass(slots=True)
class Box:
    """A component: title, subtitle, fill and column (0 is left). Places are filled by `placed`."""

    number: int
    title: str
    subtitle: str
    fill: str
    column: int
    rows: list[PartRow] = field(default_factory=list)
    x: float = 0
    y: float = 0
    width: float = 0
    height: float = 0


@dataclass(slots=True)
class DrawnLink:
    """A line between two rows. Its path is filled by `placed`."""

    one: Place
    other: Place
    colour: str
    text: str
    path: str = ""


def placed(boxes: Sequence[Box], links: Sequence[DrawnLink], footer: bool) -> tuple[int, int]:
    """Give all boxes, rows and links their places.

    Args:
        boxes: by number.
        links: lines between their rows.
        footer: whether a line of text comes below.

    Returns:
        Width and height of the whole.
    """
    near: dict[int, list[float]] = {}
    left = float(_MARGIN)
    bottom = 0.0
    columns: list[list[Box]] = [[] for _ in range(max((box.column for box in boxes), default=0) + 1)]
    for box in boxes:
        columns[box.column].append(box)
    rightwards: dict[int, list[tuple[Place, Place]]] = {}  # by the column where they begin
    for link in links:
        for one, other in ((link.one, link.other), (link.other, link.one)):
            if boxes[one.box].column < boxes[other.box].column:
                rightwards.setdefault(boxes[one.box].column, []).append((one, other))
    for column, mine in enumerate(columns):
        mine.sort(key=lambda box: (sum(near[box.number]) / len(near[box.number]) if box.number in near else 1e9, box.number))
        width = max((_width(box) for box in mine), default=0.0)
        top = float(_MARGIN)
        for box in mine:
            height = _HEAD + _ROW * len(box.rows) + 6
            if column > 1 and box.number in near:  # level with what it hangs on
                top = max(top, sum(near[box.number]) / len(near[box.number]) - height / 2)
            box.x, box.y, box.width, box.height = left, top, width, height
            for row in box.rows:
                row.y = top + _HEAD + _ROW * row.number + 6
                row.left, row.right = left, left + width
                row.tag_width = len(row.tag) * 7 + 14
                row.tag_x = left + width - row.tag_width - 8
            top += box.height + _GAP
        bottom = max(bottom, top)
        for one, other in rightwards.get(column, ()):
            near.setdefault(other.box, []).append(boxes[one.box].rows[one.row].y)
        left += width + _CHANNEL
    for link in links:
        link.path = _path(boxes, link)
    return round(left - _CHANNEL + _MARGIN) if boxes else 200, round(bottom + (_MARGIN if footer else 0)) or 60


def _width(box: Box) -> float:
    rows = max((len(row.text) * _LETTER + (len(row.tag) * 7 + 30 if row.tag else 20) for row in box.rows), default=0.0)
    return max(rows, len(box.title) * 8 + 16, len(box.subtitle) * 6 + 16, 90)


def _path(boxes: Sequence[Box], link: DrawnLink) -> str:
    one, other = (boxes[place.box] for place in (link.one, link.other))
    start, end = one.rows[link.one.row], other.rows[link.other.row]
    if one.column == other.column:  # out and back on the same side
        side, bend = start.right, 60
        return f"M{side:g},{start.y:g} C{side + bend:g},{start.y:g} {side + bend:g},{end.y:g} {side:g},{end.y:g}"
    if one.column > other.column:
        start, end = end, start
    middle = (start.right + end.left) / 2
    return f"M{start.right:g},{start.y:g} C{middle:g},{start.y:g} {middle:g},{end.y:g} {end.left:g},{end.y:g}"
