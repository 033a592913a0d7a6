"""Layout of a circuit's picture: positions of its boxes and lines.

The boxes of a group are arranged in columns by their distance from its first box, so that no line has to cross a column; each
column is sorted by what its boxes are connected to. A column that is too long is folded into strips, and lines that skip strips
run above them. No line leads from one group to another, and groups are packed so that the whole is about as high as wide.
Lengths are pixels of the SVG. What boxes mean is not known here.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import sqrt

from msgspec import Struct

_ROW, _HEAD, _GAP, _MARGIN, _MARK, _FOOT = 18, 40, 22, 20, 15, 16
_CHANNEL, _BEND, _APART = 150, 60, 50
_LANE, _LANES, _FIRST_LANE, _NEXT_LANE = 36, 6, 14, 5
_LEAST_LIMIT = 1_400
_FONT, _SMALL = 12, 10
_NARROW, _WIDE = frozenset("iljIftr.,:;'|!()[]/ "), frozenset("mwMW@%—")
_IDEOGRAPHS = 0x2E80


HEAD = -1
"""Stands for the head of a box instead of the number of a row."""


class Place(Struct, frozen=True):
    """A row of a box, given by both numbers; the row `HEAD` is the head of the box."""

    box: int
    row: int


class PartRow(Struct):
    """A connector in a box: its name, a tag with the net it is on, and a mark for a finding. `placed` sets the positions."""

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


class DrawnMark(Struct):
    """A line below the rows of a box about a finding: the text drawn, the full message, the colour. `placed` sets `y`."""

    text: str
    message: str
    colour: str
    y: float = 0


class Box(Struct):
    """A component: title, subtitle, fill, column (the least is leftmost), group, marks, and the colour of its edge.

    `placed` sets the positions, the strip (a column that is too long is folded into several) and the top of its group's strips.
    """

    number: int
    title: str
    subtitle: str
    fill: str
    column: int
    group: int = 0
    strip: int = 0
    rows: list[PartRow] = []
    marks: list[DrawnMark] = []
    edge: str = "#444"
    x: float = 0
    y: float = 0
    width: float = 0
    height: float = 0
    top: float = 0


class DrawnLink(Struct):
    """A line between two rows or the heads of two boxes, which stands for `wires` wires. `placed` sets path and ends."""

    one: Place
    other: Place
    colour: str
    text: str
    wires: int = 1
    path: str = ""
    ends: tuple[tuple[float, float], ...] = ()


def placed(boxes: Sequence[Box], links: Sequence[DrawnLink], below: Sequence[str]) -> tuple[int, int]:
    """Set the positions of all boxes, rows and links.

    Args:
        boxes: the boxes, each at the index of its number.
        links: lines between their rows, each within one group.
        below: lines of text below the picture.

    Returns:
        Width and height of the picture.
    """
    groups: dict[int, list[Box]] = {}
    for box in boxes:
        groups.setdefault(box.group, []).append(box)
    inside: dict[int, list[DrawnLink]] = {}
    for link in links:
        inside.setdefault(boxes[link.one.box].group, []).append(link)
    sizes = {group: _columns(boxes, mine, inside.get(group, ())) for group, mine in groups.items()}
    limit = max((height for _, height in sizes.values()), default=0.0)
    limit = max(limit, sqrt(sum((width + _APART) * (height + _GAP) for width, height in sizes.values())))
    left, top, widest, bottom = float(_MARGIN), float(_MARGIN), 0.0, float(_MARGIN)
    for group, (width, height) in sizes.items():
        if top > _MARGIN and top + height > limit + _MARGIN:
            left, top, widest = left + widest + _APART, float(_MARGIN), 0.0
        for box in groups[group]:
            _move(box, left, top)
        widest, top = max(widest, width), top + height + _GAP
        bottom = max(bottom, top)
    for link in links:
        _draw(boxes, link)
    text = max((text_width(line) + 2 * _MARGIN for line in below), default=0)
    width = max(left + widest + _MARGIN if boxes else 200, text)
    return round(width), round(bottom + _FOOT * len(below))


def _columns(boxes: Sequence[Box], mine: Sequence[Box], links: Sequence[DrawnLink]) -> tuple[float, float]:
    """Arrange the boxes of a group, with its left upper corner at (0, 0); returns its width and height."""
    near: dict[int, list[float]] = {}
    columns: dict[int, list[Box]] = {}
    for box in mine:
        columns.setdefault(box.column, []).append(box)
    rightwards: dict[int, list[tuple[Place, Place]]] = {}  # by the column where they begin
    for link in links:
        for one, other in ((link.one, link.other), (link.other, link.one)):
            if boxes[one.box].column < boxes[other.box].column:
                rightwards.setdefault(boxes[one.box].column, []).append((one, other))
    left = bottom = 0.0
    first, strip = min(columns), 0
    area = sum((_width(box) + _CHANNEL) * (_height(box) + _GAP) for box in mine)
    limit = max(_LEAST_LIMIT, sqrt(area), *(_height(box) for box in mine))
    for column, here in sorted(columns.items()):
        here.sort(key=lambda box: (sum(near[box.number]) / len(near[box.number]) if box.number in near else 1e9, box.number))
        folded = sum(_height(box) + _GAP for box in here) > limit
        top, stood = 0.0, list[Box]()
        for box in here:
            height = _height(box)
            if folded and stood and top + height > limit:
                left, strip, top, stood = _end_strip(stood, left), strip + 1, 0.0, []
            if column > first + 1 and not folded and box.number in near:  # level with what it hangs on
                top = max(top, sum(near[box.number]) / len(near[box.number]) - height / 2)
            box.x, box.y, box.height, box.strip = left, top, height, strip
            stood.append(box)
            for row in box.rows:
                row.y = top + _HEAD + _ROW * row.number + 6
                row.tag_width = text_width(row.tag, _SMALL) + 14 if row.tag else 0
            for number, mark in enumerate(box.marks):
                mark.y = top + _HEAD + _ROW * len(box.rows) + _MARK * number + 8
            top += height + _GAP
            bottom = max(bottom, top - _GAP)
        left, strip = _end_strip(stood, left), strip + 1
        for one, other in rightwards.get(column, ()):
            near.setdefault(other.box, []).append(_level(boxes[one.box], one))
    ends = [(boxes[link.one.box].strip, boxes[link.other.box].strip) for link in links]
    if any(abs(one - other) > 1 for one, other in ends):
        bottom += _LANE
        for box in mine:
            _move(box, 0, _LANE)
    return left - _CHANNEL + (_BEND if (strip - 1, strip - 1) in ends else 0), bottom


def _end_strip(stood: Sequence[Box], left: float) -> float:
    """Make the boxes of a finished strip equally wide; returns the left edge of the next strip."""
    width = max(_width(box) for box in stood)
    for box in stood:
        box.width = width
    return left + width + _CHANNEL


def _height(box: Box) -> float:
    return _HEAD + _ROW * len(box.rows) + _MARK * len(box.marks) + 6


def _move(box: Box, right: float, down: float) -> None:
    box.x, box.y, box.top = box.x + right, box.y + down, box.top + down
    for row in box.rows:
        row.y += down
        row.left, row.right = box.x, box.x + box.width
        row.tag_x = row.right - row.tag_width - 8
    for mark in box.marks:
        mark.y += down


def text_width(text: str, size: float = _FONT, bold: bool = False) -> float:
    """Upper bound of a text's width in pixels, in the picture's font (DejaVu Sans, or a narrower one).

    Args:
        text: a single line.
        size: font size in pixels.
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
    """Set the path of a link and its two end points, at the edges of its boxes."""
    one, other = (boxes[place.box] for place in (link.one, link.other))
    start, end = _level(one, link.one), _level(other, link.other)
    if one.strip > other.strip:
        one, other, start, end = other, one, end, start
    left, right = one.x + one.width, other.x
    if one.strip == other.strip:  # out and back on the same side
        right = other.x + other.width
        bend = max(left, right) + _BEND
        link.path = f"M{left:g},{start:g} C{bend:g},{start:g} {bend:g},{end:g} {right:g},{end:g}"
    elif one.strip + 1 == other.strip:
        middle = (left + right) / 2
        link.path = f"M{left:g},{start:g} C{middle:g},{start:g} {middle:g},{end:g} {right:g},{end:g}"
    else:  # over what stands between, each box's lines at a distance of their own
        apart = _FIRST_LANE + _NEXT_LANE * (one.number % _LANES)
        lane, out, back = one.top - _LANE + _NEXT_LANE * (one.number % _LANES), left + apart, right - apart
        corners = [(left, start), (out, start), (out, lane), (back, lane), (back, end), (right, end)]
        link.path = "M" + " L".join(f"{x:g},{y:g}" for x, y in corners)
    link.ends = ((left, start), (right, end))
