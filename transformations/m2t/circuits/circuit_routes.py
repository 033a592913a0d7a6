"""Orthogonal lines between pins at the edges of strips: in channels between the strips, and in lanes above and below all.

All lines of one trunk (lines from one pin) share a track in a channel. The order of the tracks is searched so that few lines
cross; two trunks never lie on one another. A line between pins of one channel needs no lane. Lengths are pixels of the SVG.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from itertools import combinations

from msgspec import Struct

_TRACK, _BESIDE, _LANE = 7, 20, 7
_SEARCHED = 80
_OVERLAP = 1_000
Point = tuple[float, float]


class LineEnd(Struct, frozen=True):
    """An end of a line: the strip, the edge of it (-1 left, 1 right), and the height."""

    strip: int
    face: int
    y: float


class _Trunk(Struct):
    """The part of a line's tree in one channel: heights of the pins at its left and right edge, and what it spans."""

    left: set[float]
    right: set[float]
    top: float = 1e9
    bottom: float = -1e9

    def reach(self, y: float) -> None:
        self.top, self.bottom = min(self.top, y), max(self.bottom, y)


class Routes:
    """The lines of a group, whose strips may still be moved from left to right."""

    def __init__(self, ends: Sequence[tuple[LineEnd, LineEnd]], keys: Sequence[Hashable], top: float, bottom: float) -> None:
        self.ends, self.keys, self.top, self.bottom = ends, keys, top, bottom
        self.lanes: dict[Hashable, float] = {}
        self.tracks: dict[int, list[Hashable]] = {}
        self._inner: frozenset[int] = frozenset()
        self._clashes: dict[int, bool] = {}

    @property
    def clash(self) -> int | None:
        """The first channel in which two trunks would lie on one another, whatever their order."""
        return min((channel for channel, wrong in self._clashes.items() if wrong), default=None)

    def width(self, channel: int) -> float:
        """The width of the channel at the right of a strip; nothing if it is an outer one that no line uses."""
        count = len(self.tracks.get(channel, ()))
        return 2 * _BESIDE + _TRACK * max(count - 1, 0) if count or channel in self._inner else 0.0

    def paths(self, edges: Mapping[int, tuple[float, float]]) -> list[list[Point]]:
        """The corners of each line.

        Args:
            edges: left and right edge of each strip.
        """
        found = []
        for (one, other), key in zip(self.ends, self.keys, strict=True):
            (here, x), (there, a) = self._at(one, key, edges), self._at(other, key, edges)
            start, end = edges[one.strip][one.face > 0], edges[other.strip][other.face > 0]
            corners = [(start, one.y), (x, one.y)]
            if here != there:
                corners += [(x, self.lanes[key]), (a, self.lanes[key])]
            found.append(_straightened([*corners, (a, other.y), (end, other.y)]))
        return found

    def _at(self, end: LineEnd, key: Hashable, edges: Mapping[int, tuple[float, float]]) -> tuple[int, float]:
        """The channel of an end, and where the track of its trunk is in it."""
        channel = _channel(end, sorted(edges))
        at = _BESIDE + _TRACK * self.tracks[channel].index(key)
        after = min((strip for strip in edges if strip > channel), default=None)
        return channel, edges[channel][1] + at if channel in edges else edges[after or 0][0] - self.width(channel) + at


def routed(
    ends: Sequence[tuple[LineEnd, LineEnd]], keys: Sequence[Hashable], strips: Sequence[int], top: float, bottom: float
) -> Routes:
    """Lead the lines.

    Args:
        ends: of each line.
        keys: of each line, the trunk that it belongs to.
        strips: the strips from left to right.
        top: of all strips.
        bottom: of all strips.
    """
    made = Routes(ends, keys, top, bottom)
    made._inner = frozenset(strips[:-1])
    channels: dict[int, dict[Hashable, _Trunk]] = {}
    crossing: dict[Hashable, list[float]] = {}
    for (one, other), key in zip(ends, keys, strict=True):
        if _channel(one, strips) != _channel(other, strips):
            crossing.setdefault(key, []).extend((one.y, other.y))
    middle = (top + bottom) / 2
    for key, heights in crossing.items():
        if sum(heights) / len(heights) <= middle:
            made.top -= _LANE
            made.lanes[key] = made.top
        else:
            made.bottom += _LANE
            made.lanes[key] = made.bottom
    if made.top < top:
        made.top -= _LANE
    if made.bottom > bottom:
        made.bottom += _LANE
    for (one, other), key in zip(ends, keys, strict=True):
        far = _channel(one, strips) != _channel(other, strips)
        for end in (one, other):
            trunk = channels.setdefault(_channel(end, strips), {}).setdefault(key, _Trunk(set(), set()))
            (trunk.left if end.face > 0 else trunk.right).add(end.y)
            trunk.reach(end.y)
            if far:
                trunk.reach(made.lanes[key])
    for channel, trunks in channels.items():
        order = _ordered(trunks)
        made.tracks[channel] = order
        pairs = combinations((trunks[key] for key in order), 2)
        made._clashes[channel] = any(one.right & other.left for one, other in pairs)
    return made


def _channel(end: LineEnd, strips: Sequence[int]) -> int:
    """The channel at an end, called by the strip at its left; the leftmost by a number below all strips."""
    return end.strip if end.face > 0 else end.strip - 1


def _ordered(trunks: Mapping[Hashable, _Trunk]) -> list[Hashable]:
    """The trunks of a channel from left to right."""
    order = sorted(trunks, key=lambda key: _slope(trunks[key]))
    if len(order) > _SEARCHED:
        return order
    cost = {(a, b): _crossings(trunks[a], trunks[b]) for a in order for b in order if a is not b}
    for _ in range(len(order)):
        moved = False
        for key in list(order):
            rest = [each for each in order if each != key]
            costs = [sum(cost[each, key] for each in rest)]  # after all others
            for each in reversed(rest):
                costs.append(costs[-1] - cost[each, key] + cost[key, each])
            costs.reverse()  # by its index
            best, now = min(range(len(costs)), key=costs.__getitem__), order.index(key)
            if costs[best] < costs[now]:
                order, moved = [*rest[:best], key, *rest[best:]], True
        if not moved:
            break
    return order


def _slope(trunk: _Trunk) -> tuple[bool, float]:
    """Order without search: what goes up first, from the top; then what goes down, from the bottom."""
    start = min(trunk.left, default=trunk.top)
    falls = trunk.bottom - start > start - trunk.top
    return falls, -start if falls else start


def _crossings(one: _Trunk, other: _Trunk) -> int:
    """How often two trunks cross when the first has the track at the left."""
    over = sum(other.top <= y <= other.bottom for y in one.right) + sum(one.top <= y <= one.bottom for y in other.left)
    return over + _OVERLAP * len(one.right & other.left)


def _straightened(corners: Sequence[Point]) -> list[Point]:
    """The corners without those that are none."""
    kept: list[Point] = []
    for point in corners:
        if kept and point == kept[-1]:
            continue
        if len(kept) > 1 and any(a[axis] == b[axis] == point[axis] for a, b in [kept[-2:]] for axis in (0, 1)):
            kept.pop()
        kept.append(point)
    return kept
