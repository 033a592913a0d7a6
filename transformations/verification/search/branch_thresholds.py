"""Where a program goes another way while one number grows: a voltage, a number that is typed, how long a button is held.

A run tells for each comparison in the program how far apart its two sides were (`OriginalRun.compared`). Where this changes its
sign between two values, it says not only that a border lies between them but also about where, as in search-based testing (the
branch distance of Korel and Tracey): a border behind a calculation takes two or three runs instead of ten. Ways that hang on no
comparison are halved.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import pairwise

from msgspec import Struct

from robosmi.transformations.verification.original_side import Place

Compared = Mapping[int, tuple[float, float]]
_ROUNDED = 1.001
_NEAR = 0.45
"""So many widths of a bracket beside the place that is guessed the next value is tried, so that two of them enclose it."""


class Look(Struct, frozen=True):
    """What a run with one value tells.

    Attributes:
        way: all that tells which way the program goes: what it shows, the edges of its flow that it takes, and for each
            comparison the signs of the least and of the greatest difference of its sides.
        told: the edges and the signs alone, of which each may be new.
        compared: how far apart the two sides of each comparison were, at the least and at the most.
    """

    way: frozenset[Place]
    told: frozenset[Place]
    compared: Compared


def look_of(shown: frozenset[Place], edges: frozenset[int], compared: Compared) -> Look:
    """What a run tells.

    Args:
        shown: what the program shows at its pins and on its console, as goals have it.
        edges: which edges of its flow it has taken.
        compared: how far apart the two sides of each comparison were.
    """
    taken: frozenset[Place] = frozenset((edge,) for edge in edges)
    signs: set[Place] = {(place, _sign(end)) for place, ends in compared.items() for end in ends}
    ends: set[Place] = {(place, _sign(least), _sign(most)) for place, (least, most) in compared.items()}
    return Look(shown | taken | ends, taken | signs, compared)


class Fineness(Struct, frozen=True):
    """How finely a border is sought: in multiples of a step, until two values are this near, or this part of themselves."""

    step: float
    near: float
    part: float = 0.0

    def width(self, value: float) -> float:
        """How near to one another two values are to be, by the greater one."""
        return max(self.step, self.near, self.part * value)


class Turn(Struct, frozen=True):
    """Two near values between which a program goes another way, and what tells that (`Look.way`)."""

    low: float
    high: float
    apart: frozenset[Place]

    @property
    def is_visible(self) -> bool:
        """Whether the program shows something else or takes another edge, beside the signs of its comparisons."""
        return any(len(place) == 1 or isinstance(place[0], str) for place in self.apart)


def branch_thresholds(
    values: Iterable[float],
    look: Callable[[float], Look | None],
    fine: Fineness,
    most_looks: int,
    most_found: int,
) -> list[Turn]:
    """Pairs of near values between which the program goes another way.

    Args:
        values: those that are looked at first.
        look: a run with a value; None ends the search.
        fine: how near to one another the two values are to be.
        most_looks: how often to look beyond the first values.
        most_found: how many pairs to look for.
    """
    known: dict[float, Look] = {}
    for value in sorted(set(values)):
        seen = look(value)
        if seen is None:
            return []
        known[value] = seen
    closed: set[tuple[float, float]] = set()
    for number in range(most_looks):
        pair = next((pair for pair in _open(known, fine) if pair not in closed), None)
        if pair is None or len(_narrow(known, fine)) >= most_found:
            break
        between = _between(*pair, known, fine, number % 3 == 2)
        if between is None:
            closed.add(pair)
            continue
        seen = look(between)
        if seen is None:
            break
        known[between] = seen
    found = [Turn(low, high, known[low].way ^ known[high].way) for low, high in _narrow(known, fine)]
    return _decisive(found)[:most_found]


def _decisive(turns: Sequence[Turn]) -> list[Turn]:
    """The pairs without those at one side of a value at which both sides of a comparison are equal.

    That is where the comparison decides nothing, as far as the program does the same in both.
    """
    kept: list[Turn] = []
    for turn in turns:
        if kept and kept[-1].high == turn.low:
            if turn.is_visible and not kept[-1].is_visible:
                kept[-1] = turn
                continue
            if not turn.is_visible:
                continue
        kept.append(turn)
    return kept


def _turning(known: Mapping[float, Look]) -> list[tuple[float, float]]:
    return [(low, high) for low, high in pairwise(sorted(known)) if known[low].way != known[high].way]


def _open(known: Mapping[float, Look], fine: Fineness) -> list[tuple[float, float]]:
    """The pairs that are too far apart, those of the nearest values first, so that each border that is begun is found."""
    wide = [(low, high) for low, high in _turning(known) if high - low > fine.width(high) * _ROUNDED]
    return sorted(wide, key=lambda pair: pair[1] - pair[0])


def _narrow(known: Mapping[float, Look], fine: Fineness) -> list[tuple[float, float]]:
    return [(low, high) for low, high in _turning(known) if high - low <= fine.width(high) * _ROUNDED]


def _between(low: float, high: float, known: Mapping[float, Look], fine: Fineness, halve: bool) -> float | None:
    """The value to look at next between two others; None if there is none."""
    guess = None if halve else _guess(low, high, known[low].compared, known[high].compared)
    value = (low + high) / 2
    if guess is not None:
        value = guess + (_NEAR if guess - low < high - guess else -_NEAR) * fine.width(high)
    for each in (value, (low + high) / 2):
        rounded = round(each / fine.step) * fine.step
        if low < rounded < high:
            return rounded
    return None


def _guess(low: float, high: float, at_low: Compared, at_high: Compared) -> float | None:
    """Where the first comparison that turns between two values would do so if its sides came nearer to one another evenly."""
    for place in sorted(at_low.keys() & at_high.keys()):
        for begin, end in zip(at_low[place], at_high[place], strict=True):
            if _sign(begin) != _sign(end):
                return low + (high - low) * begin / (begin - end)
    return None


def _sign(number: float) -> int:
    return (number > 0) - (number < 0)
