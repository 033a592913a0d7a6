"""Places for the boxes and lines of a circuit's picture: columns by their distance from a board, so that no line has to pass
a column, each sorted by what its boxes are connected to. Lengths in pixels of the SVG. What boxes mean is not known here.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

_ROW, _HEAD, _GAP, _MARGIN, _MARK, _FOOT = 18, 40, 22, 20, 15, 16
_CHANNEL = 150
_FONT, _SMALL = 12, 10
_NARROW, _WIDE = frozenset("iljIftr.,:;'|!()[]/ "), frozenset("mwMW@%—")
_IDEOGRAPHS = 0x2E80


HEAD = -1
"""The row of a place that is no row."""


@dataclass(frozen=True, slots=True)
class Place:
    """A row of a box, by their numbers; `HEAD` in place of a row is the head of the box."""

    box: int
    row: int


@dataclass(slots=True)
class PartRow:
    """A connector in a box: its name, a tag with what it is on, the mark of what is wrong there. `placed` fills the places."""

    number: int
    text: str
    tag: str = ""
    tag_colour: str = ""
    mark_colour: str = ""
    mark_text: str = ""
    y: float = 0
    left: float = 0
    right: float = 0
    tag_x: float = 0
    tag_width: float = 0


@dataclass(slots=True)
class DrawnMark:
    """A line below the rows of a box: what is wrong, as it is drawn; the whole sentence; its colour. `placed` fills the place."""

    text: str
    message: str
    colour: str
    y: float = 0


@dataclass(slots=True)
class Box:
    """A component: title, subtitle, fill, column (0 is left), marks and the colour of its edge. `placed` fills the places."""

    number: int
    title: str
    subtitle: str
    fill: str
    column: int
    rows: list[PartRow] = field(default_factory=list)
    marks: list[DrawnMark] = field(default_factory=list)
    edge: str = "#444"
    x: float = 0
    y: float = 0
    width: float = 0
    height: float = 0


@dataclass(slots=True)
class DrawnLink:
    """A line between two rows, or the heads of two boxes; `wires` are how many it stands for. `placed` fills path and ends."""

    one: Place
    other: Place
    colour: str
    text: str
    wires: int = 1
    path: str = ""
    ends: tuple[tuple[float, float], ...] = ()


def placed(boxes: Sequence[Box], links: Sequence[DrawnLink], below: Sequence[str]) -> tuple[int, int]:
    """Give all boxes, rows and links their places.

    Args:
        boxes: by number.
        links: lines between their rows.
        below: lines of text that come below.

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
            height = _HEAD + _ROW * len(box.rows) + _MARK * len(box.marks) + 6
            if column > 1 and box.number in near:  # level with what it hangs on
                top = max(top, sum(near[box.number]) / len(near[box.number]) - height / 2)
            box.x, box.y, box.width, box.height = left, top, width, height
            for row in box.rows:
                row.y = top + _HEAD + _ROW * row.number + 6
                row.left, row.right = left, left + width
                row.tag_width = text_width(row.tag, _SMALL) + 14 if row.tag else 0
                row.tag_x = left + width - row.tag_width - 8
            for number, mark in enumerate(box.marks):
                mark.y = top + _HEAD + _ROW * len(box.rows) + _MARK * number + 8
            top += box.height + _GAP
        bottom = max(bottom, top)
        for one, other in rightwards.get(column, ()):
            near.setdefault(other.box, []).append(_level(boxes[one.box], one))
        left += width + _CHANNEL
    for link in links:
        _draw(boxes, link)
    text = max((text_width(line) + 2 * _MARGIN for line in below), default=0)
    width = max(left - _CHANNEL + _MARGIN if boxes else 200, text)
    return round(width), round(bottom + _FOOT * len(below)) or 60


def text_width(text: str, size: float = _FONT, bold: bool = False) -> float:
    """How wide a text is at most in the picture's font (DejaVu Sans, or one that is narrower).

    Args:
        text: on one line.
        size: of the font, in pixels.
        bold: whether it is bold.
    """
    units = sum(
        0.45 if c in _NARROW else 1.0 if c in _WIDE or ord(c) >= _IDEOGRAPHS else 0.7 if not c.islower() else 0.64 for c in text
    )
    return units * size * (1.1 if bold else 1.0)


def _width(box: Box) -> float:
    rows = max((text_width(row.text) + (text_width(row.tag, _SMALL) + 40 if row.tag else 20) for row in box.rows), default=0.0)
    marks = max((text_width(mark.text, _SMALL) + 20 for mark in box.marks), default=0.0)
    return max(rows, marks, text_width(box.title, bold=True) + 16, text_width(box.subtitle, _SMALL) + 16, 90)


def _level(box: Box, place: Place) -> float:
    return box.rows[place.row].y if place.row != HEAD else box.y + _HEAD / 2


def _draw(boxes: Sequence[Box], link: DrawnLink) -> None:
    """The path of a link and the two points where it ends, at the edges of its boxes."""
    one, other = (boxes[place.box] for place in (link.one, link.other))
    start, end = _level(one, link.one), _level(other, link.other)
    if one.column == other.column:  # out and back on the same side
        left, right = one.x + one.width, other.x + other.width
        bend = max(left, right) + 60
        link.path = f"M{left:g},{start:g} C{bend:g},{start:g} {bend:g},{end:g} {right:g},{end:g}"
    else:
        if one.column > other.column:
            one, other, start, end = other, one, end, start
        left, right = one.x + one.width, other.x
        middle = (left + right) / 2
        link.path = f"M{left:g},{start:g} C{middle:g},{start:g} {middle:g},{end:g} {right:g},{end:g}"
    link.ends = ((left, start), (right, end))
