"""Layout of a circuit's picture: positions of its boxes, their pins and the lines between them.

The boards of a group are in the middle, the others left and right of them in columns by their distance. A box stands on the side
of the pins that it is wired to and, if it can, level with them; pins that lead to a board face it. A column that is too long is
folded into strips. No line leads from one group to another, and groups are packed so that the whole is about as high as wide.
Lengths are pixels of the SVG. What boxes mean is not known here; lines are led by `circuit_routes`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from math import sqrt

from msgspec import Struct

from robosmi.transformations.m2t.circuits.circuit_routes import LineEnd, routed

HEAD = -1
"""Stands for the head of a box instead of the number of a row."""
SYMBOL_WIDTH, SYMBOL_HEIGHT = 64, 48
HEAD_HEIGHT, PITCH = 40, 16
_GAP, _MARGIN, _MARK, _FOOT, _APART = 24, 20, 15, 16, 50
_GRID = 8
_EDGE, _LEAD, _CORE = 8, 12, 76
_LEAST_LIMIT = 1_400
_FONT, _SMALL = 12, 10
_NARROW, _WIDE = frozenset("iljIftr.,:;'|!()[]/ "), frozenset("mwMW@%—")
_IDEOGRAPHS = 0x2E80
_NUMBER = re.compile(r"\.\d+$")
"""By which the connectors of one name are told apart: GND.2."""


class Place(Struct, frozen=True):
    """A row of a box, given by both numbers; the row `HEAD` is the head of the box."""

    box: int
    row: int


class PartRow(Struct):
    """A connector in a box.

    Attributes:
        number: its number in the box.
        text: its name.
        tag, tag_colour: the net or the connectors that it is on, if no line tells it.
        mark_colour, mark_text: a finding about it.
        rail: whether it is on a supply or ground.
        colour: of its net.
        plain: whether its name is not written, since the part has no first and second end.
        pin, ports, net: the board's pin, the ports of the source on it, and the net.
        partners: the rows that it is wired to.
        slot: its place at the board's outline: the side, and the number from the top; none if it has no fixed place.
        side: -1 at the left edge, 1 at the right. `placed` sets it where there is no slot, and what follows.
        x, y: the pin. text_x: the outer end of its name. tag_x: the left edge of its tag.
        lead: where the line from the pin to the symbol ends.
    """

    number: int
    text: str
    tag: str = ""
    tag_colour: str = ""
    mark_colour: str = ""
    mark_text: str = ""
    rail: bool = False
    colour: str = "#444444"
    plain: bool = False
    pin: str = ""
    ports: str = ""
    net: str = ""
    partners: list[Place] = []
    slot: tuple[int, int] | None = None
    side: int = 0
    x: float = 0
    y: float = 0
    text_x: float = 0
    tag_x: float = 0
    tag_width: float = 0
    lead: float = 0

    @property
    def label(self) -> str:
        """The name where it is written: not where the tag says the same."""
        same = _NUMBER.sub("", self.text).casefold() == self.tag.casefold()
        return "" if self.plain or same else self.text


class IdlePin(Struct):
    """A pin of a board's outline that nothing is wired to. `placed` sets the positions."""

    text: str
    side: int
    slot: int
    x: float = 0
    y: float = 0
    text_x: float = 0


class DrawnMark(Struct):
    """A line below the rows of a box about a finding: the text drawn, the full message, the colour. `placed` sets `y`."""

    text: str
    message: str
    colour: str
    y: float = 0


class Box(Struct):
    """A component: title, subtitle, fill, column (the least is in the middle), group, marks, and the colour of its edge.

    `symbol` is what it is drawn as, `paint` the colour of that; `slots` is the number of pins at either edge of a board's
    outline, and `idle` are those that nothing is wired to. `placed` sets the side of the middle (-1 left, 1 right), the strip (a
    column that is too long is folded into several), the positions, the height of the body, and the left edge of the symbol.
    """

    number: int
    title: str
    subtitle: str
    fill: str
    column: int
    group: int = 0
    symbol: str = "part"
    paint: str = "#888888"
    about: str = ""
    slots: int = 0
    idle: list[IdlePin] = []
    rows: list[PartRow] = []
    marks: list[DrawnMark] = []
    edge: str = "#c8c8c8"
    side: int = 0
    strip: int = 0
    x: float = 0
    y: float = 0
    width: float = 0
    height: float = 0
    body: float = 0
    symbol_x: float = 0

    @property
    def is_board(self) -> bool:
        """Whether it is drawn as a board, with its pins at its edges."""
        return self.symbol == "board"

    @property
    def is_carrier(self) -> bool:
        """Whether the symbol is drawn on a carrier, since it has more pins at an edge than fit at the symbol."""
        return not self.is_board and self.body > SYMBOL_HEIGHT + PITCH


class DrawnLink(Struct):
    """A line between two rows or the heads of two boxes, which stands for `wires` wires. `placed` sets path and ends.

    `pins`, `ports` and `net` are the board's pins, the ports of the source, and the net that it belongs to.
    """

    one: Place
    other: Place
    colour: str
    text: str
    wires: int = 1
    pins: str = ""
    ports: str = ""
    net: str = ""
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
    laid = {group: _Group(boxes, mine, inside.get(group, ())) for group, mine in groups.items()}
    sizes = {group: each.arranged() for group, each in laid.items()}
    limit = max((height for _, height in sizes.values()), default=0.0)
    limit = max(limit, sqrt(sum((width + _APART) * (height + _GAP) for width, height in sizes.values())))
    left, top, widest, bottom = float(_MARGIN), float(_MARGIN), 0.0, float(_MARGIN)
    for group, (width, height) in sizes.items():
        if top > _MARGIN and top + height > limit + _MARGIN:
            left, top, widest = left + widest + _APART, float(_MARGIN), 0.0
        laid[group].moved(left, top)
        widest, top = max(widest, width), top + height + _GAP
        bottom = max(bottom, top)
    text = max((text_width(line) + 2 * _MARGIN for line in below), default=0)
    width = max(left + widest + _MARGIN if boxes else 200, text)
    return round(width), round(bottom + _FOOT * len(below))


class _Group:
    """Boxes that signals connect, and their links."""

    def __init__(self, boxes: Sequence[Box], mine: Sequence[Box], links: Sequence[DrawnLink]) -> None:
        self.boxes, self.mine, self.links = boxes, mine, links
        self.first = min(box.column for box in mine)
        self.paths: list[list[tuple[float, float]]] = []

    def arranged(self) -> tuple[float, float]:
        """Arrange the boxes with the left upper corner at (0, 0); returns width and height."""
        self._choose_sides()
        for box in self.mine:
            _measure(box)
        strips = self._strips()
        ends = self._ends()
        keys = [(link.one, link.colour) for link in self.links]
        top = min(box.y for box in self.mine)
        bottom = max(box.y + box.height for box in self.mine)
        made = routed(ends, keys, sorted(strips), top, bottom)
        for _ in strips:
            if made.clash is None:
                break
            for box in (b for strip, here in strips.items() if (strip > made.clash) == (made.clash >= 0) for b in here):
                _shift(box, 0, _GRID / 2)
            ends = self._ends()
            made = routed(ends, keys, sorted(strips), top, bottom + _GRID)
        left = made.width(min(strips) - 1)
        for strip in sorted(strips):
            for box in strips[strip]:
                box.width = max(each.width for each in strips[strip])
                _set_across(box, left)
            left += strips[strip][0].width + made.width(strip)
        edges = {strip: (here[0].x, here[0].x + here[0].width) for strip, here in strips.items()}
        self.paths = made.paths(edges)
        down = -made.top
        for box in self.mine:
            _shift(box, 0, down)
        self.paths = [[(x, y + down) for x, y in path] for path in self.paths]
        return left, made.bottom - made.top

    def moved(self, right: float, down: float) -> None:
        """Move everything, and write the paths."""
        for box in self.mine:
            _shift(box, right, down)
        for link, points in zip(self.links, self.paths, strict=True):
            here = [(x + right, y + down) for x, y in points]
            link.path = "M" + " L".join(f"{x:g},{y:g}" for x, y in here)
            link.ends = (here[0], here[-1])

    # ---- sides

    def _choose_sides(self) -> None:
        load = {-1: 0.0, 1: 0.0}
        bundled = any(link.one.row == HEAD for link in self.links)
        for box in self.mine:
            for row in box.rows:
                row.side = row.slot[0] if row.slot is not None else 0
        for box in sorted((b for b in self.mine if b.column > self.first), key=lambda b: (b.column, b.number)):
            votes = 0
            for row in box.rows:
                for place in row.partners:
                    near = self.boxes[place.box]
                    if near.column < box.column:
                        votes += near.side if near.column > self.first else near.rows[place.row].side
            if self.first > 0:
                box.side = 1
            elif votes and (box.column > self.first + 1 or not bundled):
                box.side = 1 if votes > 0 else -1
            else:
                box.side = 1 if load[1] <= load[-1] else -1
            load[box.side] += HEAD_HEIGHT + SYMBOL_HEIGHT
        for box in self.mine:
            self._choose_row_sides(box)

    def _choose_row_sides(self, box: Box) -> None:
        free = [row for row in box.rows if row.slot is None]
        if box.column == self.first:
            for row in free:
                sides = [self.boxes[place.box].side for place in row.partners if self.boxes[place.box].side]
                row.side = sides[0] if sides else 1 if row.partners else 0
            for row in (each for each in free if not each.side):
                count = sum(each.side for each in box.rows)
                row.side = 1 if count < 0 else -1
            return
        for row in free:
            near = [self.boxes[place.box].column for place in row.partners]
            outward = min(near) > box.column if near else len(box.rows) > 3
            row.side = box.side if outward else -box.side
        if len(free) == 2 and free[0].side == free[1].side and not all(row.partners for row in free):  # one wire at either end
            second = free[0] if not free[0].partners else free[1]
            second.side = -second.side

    # ---- strips

    def _strips(self) -> dict[int, list[Box]]:
        """The boxes of each strip, with their positions from top to bottom; the strips are numbered from left to right."""
        area = sum((box.width + _APART) * (box.height + _GAP) for box in self.mine)
        limit = max(_LEAST_LIMIT, sqrt(area), *(box.height for box in self.mine))
        strips: dict[int, list[Box]] = {}
        count = {-1: 0, 1: 0}
        columns: dict[tuple[int, int], list[Box]] = {}
        for box in self.mine:
            columns.setdefault((box.column, box.side), []).append(box)
        for (_, side), here in sorted(columns.items()):
            levels = {box.number: self._level_of_partners(box) for box in here}
            here.sort(key=lambda box: (levels[box.number], box.number))
            folded = side != 0 and sum(box.height + _GAP for box in here) > limit
            stood: list[list[Box]] = [[]]
            top = 0.0
            for box in here:
                if folded and stood[-1] and top + box.height > limit:
                    stood.append([])
                    top = 0.0
                stood[-1].append(box)
                top += box.height + _GAP
            for boxes in stood:
                count[side or 1] += 1 if side else 0
                strip = side * count[side] if side else 0
                strips[strip] = boxes
                self._stand(boxes, level=bool(side) and not folded)
                for box in boxes:
                    box.strip = strip
        return strips

    def _level_of_partners(self, box: Box) -> float:
        """The mean height of the pins that a box hangs on; its rows are sorted by theirs."""
        nearer = {row.number: self._nearer(box, row) for row in box.rows}
        if box.column > self.first:
            order = sorted(box.rows, key=lambda row: (_mean(nearer[row.number]), row.number))
            _set_down(box, order)
        return _mean([y for each in nearer.values() for y in each])

    def _nearer(self, box: Box, row: PartRow) -> list[float]:
        found = [self.boxes[place.box] for place in row.partners]
        return [near.rows[place.row].y for near, place in zip(found, row.partners, strict=True) if near.column < box.column]

    def _stand(self, boxes: Sequence[Box], *, level: bool) -> None:
        """Set the heights of the boxes of a strip, in their order, each as near to what it hangs on as the others let it."""
        blocks: list[tuple[float, float, list[Box]]] = []  # wanted top, height, boxes
        for box in boxes:
            wanted = [y - row.y + box.y for row in box.rows for y in self._nearer(box, row)] if level else []
            here = (_mean(wanted) if wanted else 0.0 if not blocks else blocks[-1][0] + blocks[-1][1], box.height + _GAP, [box])
            while blocks and blocks[-1][0] + blocks[-1][1] > here[0]:
                top, height, before = blocks.pop()
                count, more = len(before), len(here[2])
                here = ((top * count + (here[0] - height) * more) / (count + more), height + here[1], [*before, *here[2]])
            blocks.append(here)
        for top, _, here_boxes in blocks:
            y = round(top / _GRID) * _GRID
            for box in here_boxes:
                _shift(box, 0, y - box.y)
                y += int(box.height + _GAP)

    def _ends(self) -> list[tuple[LineEnd, LineEnd]]:
        heads: dict[tuple[int, int], list[Place]] = {}
        return [
            (self._end(link.one, link.other, link.one, heads), self._end(link.other, link.one, link.one, heads))
            for link in self.links
        ]

    def _end(self, place: Place, other: Place, trunk: Place, heads: dict[tuple[int, int], list[Place]]) -> LineEnd:
        """An end of a line; lines of several trunks end one below the other at a head."""
        box = self.boxes[place.box]
        if place.row != HEAD:
            return LineEnd(box.strip, box.rows[place.row].side, box.rows[place.row].y)
        face = 1 if self.boxes[other.box].strip >= box.strip else -1
        here = heads.setdefault((place.box, face), [])
        if trunk not in here:
            here.append(trunk)
        room = int(box.height - HEAD_HEIGHT) // _GRID
        return LineEnd(box.strip, face, box.y + HEAD_HEIGHT / 2 + _GRID * (here.index(trunk) % room))


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else 1e9


def _measure(box: Box) -> None:
    """Set width and height of a box, and where its rows are from its top, in their order."""
    for row in box.rows:
        row.tag_width = text_width(row.tag, _SMALL) + 14 if row.tag else 0
    left, right = (_edge_width(box, side) for side in (-1, 1))
    core = _CORE if box.is_board else SYMBOL_WIDTH
    marks = max((text_width(mark.text, _SMALL) + 20 for mark in box.marks), default=0.0)
    titles = max(text_width(box.title, bold=True), text_width(box.subtitle, _SMALL)) + 2 * _EDGE
    box.width = float(round(max(left + core + right, marks, titles) + 0.5))
    _set_down(box, box.rows)
    box.height = HEAD_HEIGHT + box.body + (_MARK * len(box.marks) + _EDGE if box.marks else 0 if box.is_board else _EDGE)
    box.height = -(-box.height // _GRID) * _GRID


def _edge_width(box: Box, side: int) -> float:
    """The width of names and tags at one edge of a box."""
    rows = [row for row in box.rows if row.side == side]
    if box.is_board:
        idle = [text_width(pin.text, _SMALL) for pin in box.idle if pin.side == side]
        return _EDGE + 6 + max([*idle, *(text_width(row.label, _SMALL) + 6 + row.tag_width for row in rows)], default=0.0)
    if not rows:
        return 0.0
    return _EDGE + _tags_width(rows) + max(text_width(row.label, _SMALL) for row in rows) + _LEAD


def _tags_width(rows: Iterable[PartRow]) -> float:
    widest = max((row.tag_width for row in rows), default=0.0)
    return widest + 6 if widest else 0.0


def _set_down(box: Box, order: Iterable[PartRow]) -> None:
    """Set the heights of the rows of a box, relative to its top, and the height of its body."""
    rows = list(order)
    sides = {side: [row for row in rows if row.side == side] for side in (-1, 1)}
    if box.is_board:
        more = {side: [row for row in here if row.slot is None] for side, here in sides.items()}
        count = box.slots + max(map(len, more.values()), default=0)
        box.body = PITCH * max(count, 3) + 16
        for row in (each for each in rows if each.slot is not None):
            row.y = box.y + HEAD_HEIGHT + 16 + PITCH * (row.slot[1] if row.slot is not None else 0)
        for here in more.values():
            for number, row in enumerate(here, box.slots):
                row.y = box.y + HEAD_HEIGHT + 16 + PITCH * number
        for pin in box.idle:
            pin.y = box.y + HEAD_HEIGHT + 16 + PITCH * pin.slot
    else:
        box.body = max(SYMBOL_HEIGHT, PITCH * max(map(len, sides.values())) + PITCH)
        for here in sides.values():
            for number, row in enumerate(here):
                row.y = box.y + HEAD_HEIGHT + box.body / 2 + PITCH * (number - (len(here) - 1) / 2)
    for number, mark in enumerate(box.marks):
        mark.y = box.y + HEAD_HEIGHT + box.body + 10 + _MARK * number


def _set_across(box: Box, left: float) -> None:
    """Set where a box and its rows are from left to right."""
    first, last = (_edge_width(box, side) for side in (-1, 1))
    core = _CORE if box.is_board else SYMBOL_WIDTH
    box.x = left
    box.symbol_x = left + first + (box.width - first - core - last) / 2
    for side, edge in ((-1, left), (1, left + box.width)):
        rows = [row for row in box.rows if row.side == side]
        tags = 0.0 if box.is_board else _tags_width(rows)
        for row in rows:
            name = text_width(row.label, _SMALL) + 6 if box.is_board and row.label else 0.0
            row.x, row.text_x = edge, edge - side * (_EDGE + tags)
            row.tag_x = edge + _EDGE + name if side < 0 else edge - _EDGE - name - row.tag_width
            row.lead = box.symbol_x + SYMBOL_WIDTH / 2 * (1 + side if box.is_carrier else 1)
        for pin in (each for each in box.idle if each.side == side):
            pin.x, pin.text_x = edge, edge - side * _EDGE


def _shift(box: Box, right: float, down: float) -> None:
    box.x, box.y, box.symbol_x = box.x + right, box.y + down, box.symbol_x + right
    for row in box.rows:
        row.x, row.y, row.text_x, row.tag_x, row.lead = (
            row.x + right, row.y + down, row.text_x + right, row.tag_x + right, row.lead + right,
        )  # fmt: skip
    for pin in box.idle:
        pin.x, pin.y, pin.text_x = pin.x + right, pin.y + down, pin.text_x + right
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
