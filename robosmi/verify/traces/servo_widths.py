"""The pulse widths sent to a servo: steady widths, and marks that a slowly changing width passes.

A slow ramp has no steady widths: where it would be divided depends on microseconds, and so would a comparison of the parts. But
it passes the same marks on every machine. Other events at a pin are found by `activity`.
"""

from __future__ import annotations

from collections.abc import Sequence
from statistics import median
from typing import NamedTuple

from robosmi.verify.traces.pulses import Pulse

EQUAL_US = 8.0
"""Two frames whose widths differ by less are equal, since interrupts delay edges by this much."""
_SLOW_US = 2 * EQUAL_US
"""Greatest change of the width from frame to frame in a slow change."""
_MARK_US = 20
_MOVES_US = 3.0
_STILL_US = 1.5
_STILL, _LONG = 0.7, 12
"""Next to a slow change a piece is a steady width if this share of its frames is near its median, and it has this many frames."""
_TOLERATED_US = 3.0
_NEUTRAL_US = 1500.0


class ServoWidth(NamedTuple):
    """The pulse width of a servo signal from one time on.

    Attributes:
        at_us: when it is reached.
        width_us: the length of the pulses.
        frames: the number of frames with this width.
        vague_us: the uncertainty of `at_us` if all widths are off by their tolerance.
        barely: whether another run of the same program may lack it.
    """

    at_us: float
    width_us: float
    frames: int
    vague_us: float = 0.0
    barely: bool = False


class _Piece(NamedTuple):
    """Consecutive frames of about the same width, as the indices of the first and the last."""

    first: int
    last: int


def tolerated_us(width_us: float) -> float:
    """The tolerance of a width: 3 us plus 1 % of its distance from neutral."""
    return _TOLERATED_US + 0.01 * abs(width_us - _NEUTRAL_US)


def servo_widths(pulses: Sequence[Pulse], fewest: int) -> list[ServoWidth]:
    """The widths that frames of a servo have one after the other.

    Args:
        pulses: the frames, without a pause.
        fewest: so many frames have to have a width; an interrupt may stretch one, and a fast ramp passes through.
    """
    widths = [pulse.end - pulse.begin for pulse in pulses]
    pieces = _pieces(widths)
    found: list[ServoWidth] = []
    way: list[_Piece] = []
    held = False
    for number, piece in enumerate(pieces):
        into, out = (_step(widths, pieces, at) for at in (number, number + 1))
        if into * out > 0 and _moves(widths, piece):
            way.append(piece)
            continue
        found += _marks(pulses, widths, way, fewest)
        held, way = held and not way, []
        if piece.last - piece.first + 1 < fewest:
            continue
        made = _held(pulses, widths, piece, into, out)
        before = found[-1] if held else made
        if held and not before.barely and not made.barely and abs(made.width_us - before.width_us) <= EQUAL_US:
            shown = made.width_us if made.frames > before.frames else before.width_us
            made = before._replace(width_us=shown, frames=before.frames + made.frames)
            found.pop()
        found.append(made)
        held = True
    return [*found, *_marks(pulses, widths, way, fewest)]


def _pieces(widths: Sequence[float]) -> list[_Piece]:
    found: list[_Piece] = []
    first = 0
    for number in range(1, len(widths) + 1):
        if number == len(widths) or abs(widths[number] - widths[first]) > EQUAL_US:
            found.append(_Piece(first, number - 1))
            first = number
    return found


def _step(widths: Sequence[float], pieces: Sequence[_Piece], number: int) -> float:
    """The change of the width from the piece before; 0 if it is a jump or there is no piece before."""
    if not 0 < number < len(pieces):
        return 0.0
    first, last_before = pieces[number].first, pieces[number].first - 1
    if abs(widths[first] - widths[last_before]) > _SLOW_US:
        return 0.0
    return widths[first] - widths[pieces[number - 1].first]


def _moves(widths: Sequence[float], piece: _Piece) -> bool:
    """Whether the width changes within a piece; a single frame counts as changing."""
    count = piece.last - piece.first + 1
    part = max(1, count // 4)
    begin, end = widths[piece.first : piece.first + part], widths[piece.last + 1 - part : piece.last + 1]
    return count == 1 or abs(median(end) - median(begin)) > _MOVES_US


def _held(pulses: Sequence[Pulse], widths: Sequence[float], piece: _Piece, into: float, out: float) -> ServoWidth:
    """A piece as a steady width. Next to a slow change its begin is uncertain, and it may be marginal."""
    own = widths[piece.first : piece.last + 1]
    middle = median(own)
    vague_us = 0.0
    if into:
        near = EQUAL_US + tolerated_us(middle)
        outer = piece.first
        while outer > 0 and abs(widths[outer - 1] - middle) <= near:
            outer -= 1
        inner = next(number for number, width in enumerate(own, piece.first) if abs(width - middle) <= EQUAL_US / 2)
        vague_us = pulses[inner].begin - pulses[outer].begin
    still = sum(abs(width - middle) <= _STILL_US for width in own) >= _STILL * len(own)
    barely = bool(into or out) and (len(own) < _LONG or not still)
    return ServoWidth(pulses[piece.first].begin, middle, len(own), vague_us, barely)


def _marks(pulses: Sequence[Pulse], widths: Sequence[float], way: Sequence[_Piece], fewest: int) -> list[ServoWidth]:
    """The marks, one every 20 us, that a slow change passes; those near its ends are marginal."""
    if not way:
        return []
    first, last = way[0].first, way[-1].last
    own = widths[first : last + 1]
    up = 1 if widths[last] > widths[first] else -1
    lowest = int(min(own) // _MARK_US + 1) * _MARK_US
    found = []
    for mark in range(lowest, int(max(own)) + 1, _MARK_US)[::up]:
        passed = next((number for number, width in enumerate(own) if up * (width - mark) >= 0), None)
        near = [number for number, width in enumerate(own) if abs(width - mark) <= EQUAL_US / 2]
        if passed is None or len(near) < fewest:
            continue
        band = [number for number, width in enumerate(own) if abs(width - mark) <= tolerated_us(mark)] or [passed]
        vague_us = pulses[first + band[-1]].begin - pulses[first + band[0]].begin
        barely = min(abs(mark - own[0]), abs(mark - own[-1])) < _SLOW_US
        found.append(ServoWidth(pulses[first + passed].begin, float(mark), len(near), vague_us, barely))
    return found
