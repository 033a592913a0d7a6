"""Draws two programs' events as SVG: for each channel a lane of the source above one of the target, with a common time axis.

It shows the events that are compared (see `activity`), not single edges. A text is shown only where there is room for it; each
event also has its text as a tooltip. The picture needs no other file, no script and no particular font.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from xml.sax.saxutils import escape

from robosmi.verify.traces.activity import BURST, IDLE, LEVEL, PULSES, WAVE, ActivityEvent
from robosmi.verify.traces.driven_lines import LET_GO

WIDTH = 1000
_LEFT, _RIGHT, _TOP = 210, 16, 64
_LANE, _GAP, _AXIS = 26, 14, 40
_LETTER = 6.6
"""Upper bound of a letter's width in pixels in common sans-serif fonts of 11 pixels."""
_COLOURS = ("#1b5e9b", "#a8500b")
_LONGEST_LABEL = 30


def trace_svg(
    title: str,
    channels: Mapping[str, tuple[Sequence[ActivityEvent], Sequence[ActivityEvent]]],
    horizon_ms: float,
    difference: tuple[float, str, str] | None = None,
) -> str:
    """The picture.

    Args:
        title: the first line.
        channels: name -> the events of the source and those of the target; those on which nothing happens are left out.
        horizon_ms: the end of the time axis, in milliseconds.
        difference: when the two differ first in milliseconds, on which channel, and how; None if they do not.
    """
    shown = {name: pair for name, pair in channels.items() if any(event != IDLE for side in pair for event in side)}
    height = _TOP + len(shown) * (2 * _LANE + _GAP) + _AXIS
    body: list[str] = [_text(12, 22, title, "font-weight='bold'", WIDTH - 24)]
    body += [
        _text(x, 44, side, f"fill='{colour}'") for x, side, colour in ((12, "source", _COLOURS[0]), (72, "target", _COLOURS[1]))
    ]
    if not shown:
        body.append(_text(_LEFT, 44, "no change on any channel"))
    for number, (name, pair) in enumerate(shown.items()):
        top = _TOP + number * (2 * _LANE + _GAP)
        body.append(_text(12, top + _LANE + 4, name, "", _LEFT - 20))
        for side, events in enumerate(pair):
            lane = _Lane(top + side * _LANE, horizon_ms, _COLOURS[side])
            body += lane.drawn(events)
    body += _axis(horizon_ms, height)
    if difference is not None:
        body += _marked(difference, horizon_ms, height)
    head = f"<svg xmlns='http://www.w3.org/2000/svg' width='{WIDTH}' height='{height}' viewBox='0 0 {WIDTH} {height}'"
    style = "font-family='sans-serif' font-size='11' fill='#222'"
    return "\n".join([f"{head} {style}>", f"<rect width='{WIDTH}' height='{height}' fill='white'/>", *body, "</svg>", ""])


def _x(at_ms: float, horizon_ms: float) -> float:
    return _LEFT + (WIDTH - _LEFT - _RIGHT) * min(1.0, max(0.0, at_ms / horizon_ms))


def _fitting(text: str, width: float) -> str:
    """As much of a text as fits into a width."""
    most = int(width / _LETTER)
    return text if len(text) <= most else text[: most - 1] + "\N{HORIZONTAL ELLIPSIS}" if most > 1 else ""


def _text(x: float, y: float, text: str, style: str = "", width: float = math.inf) -> str:
    shown = text if width == math.inf else _fitting(text, width)
    more = f"<title>{_xml(text)}</title>" if shown != text else ""
    return f"<text x='{x:.1f}' y='{y:.1f}' {style}>{_xml(shown)}{more}</text>"


def _xml(text: str) -> str:
    """A text for XML, with U+FFFD for characters that XML cannot represent."""
    return escape("".join(c if c in "\t\n" or c >= " " else "\N{REPLACEMENT CHARACTER}" for c in text))


class _Lane:
    """One side of a channel.

    Args:
        top: its upper edge.
        horizon_ms: the end of the time axis.
        colour: of its lines.
    """

    def __init__(self, top: float, horizon_ms: float, colour: str) -> None:
        self.top, self.horizon, self.colour = top, horizon_ms, colour
        self.low, self.high = top + _LANE - 5.0, top + 5.0

    def drawn(self, events: Sequence[ActivityEvent]) -> Iterator[str]:
        """The SVG elements of the lane: lines and boxes for durations, marks for printed lines, and texts where there is room."""
        if not events or events[0].kind not in (LEVEL, PULSES, WAVE, BURST):
            yield from self._printed(events)
            return
        path, joined = "", False
        for number, event in enumerate(events):
            begin = _x(event.at_us / 1000, self.horizon)
            end = _x(events[number + 1].at_us / 1000 if number + 1 < len(events) else self.horizon, self.horizon)
            if event.kind == LEVEL:
                y = self.high if event.value[0] in (1, LET_GO) else self.low
                path += f"{'L' if joined else 'M'}{begin:.1f} {y:.1f} L{max(begin, end):.1f} {y:.1f} "
            else:
                yield self._box(event, begin, max(end, begin + 1))
            joined = event.kind == LEVEL
        yield f"<path d='{path}' fill='none' stroke='{self.colour}' stroke-width='1.5'/>"

    def _box(self, event: ActivityEvent, begin: float, end: float) -> str:
        text = _xml(f"{event} from {event.at_us / 1000:.1f} ms")
        box = (
            f"<rect x='{begin:.1f}' y='{self.high:.1f}' width='{end - begin:.1f}' height='{self.low - self.high:.1f}' "
            f"fill='{self.colour}' fill-opacity='0.15' stroke='{self.colour}'><title>{text}</title></rect>"
        )
        shown = _fitting(str(event), end - begin - 6)
        return box + (_text(begin + 3, self.top + _LANE / 2 + 4, shown) if len(shown) > 3 else "")

    def _printed(self, events: Sequence[ActivityEvent]) -> Iterator[str]:
        """A mark for each printed line, with as much of its text as fits before the next shown text."""
        free = -math.inf
        for number, event in enumerate(events):
            x = _x(event.at_us / 1000, self.horizon)
            text = f"{event.at_us / 1000:.1f} ms: {event}"
            yield (
                f"<path d='M{x:.1f} {self.high:.1f} V{self.low:.1f}' stroke='{self.colour}' stroke-width='1.5'>"
                f"<title>{_xml(text)}</title></path>"
            )
            after = _x(events[number + 1].at_us / 1000, self.horizon) if number + 1 < len(events) else WIDTH - _RIGHT
            room = min(max(after - x, 40.0 if x >= free else 0.0), WIDTH - _RIGHT - x) - 6
            shown = _fitting(str(event)[:_LONGEST_LABEL], room) if x >= free else ""
            if len(shown) > 3:
                free = x + 3 + len(shown) * _LETTER + 6
                yield _text(x + 3, self.top + _LANE / 2 + 4, shown)


def _axis(horizon_ms: float, height: float) -> Iterator[str]:
    """The time axis in round steps."""
    step = 10.0 ** math.floor(math.log10(horizon_ms / 4))
    step = next(s for s in (step, 2 * step, 5 * step, 10 * step) if horizon_ms / s <= 10)
    y = height - _AXIS + 6
    yield f"<path d='M{_LEFT} {y} H{WIDTH - _RIGHT}' stroke='#888'/>"
    for number in range(int(horizon_ms / step) + 1):
        x = _x(number * step, horizon_ms)
        yield f"<path d='M{x:.1f} {_TOP - 4} V{y + 4}' stroke='#888' stroke-opacity='0.3'/>"
        if x < WIDTH - _RIGHT - 40:
            yield _text(x, y + 18, f"{number * step:g}", "text-anchor='middle'")
    yield _text(WIDTH - _RIGHT, y + 18, "ms", "text-anchor='end'")


def _marked(difference: tuple[float, str, str], horizon_ms: float, height: float) -> Iterator[str]:
    """A line at the first difference, and what it is beside the legend."""
    at_ms, channel, message = difference
    x = _x(at_ms, horizon_ms)
    yield f"<path d='M{x:.1f} {_TOP - 8} V{height - _AXIS + 6}' stroke='#c00' stroke-dasharray='4 3'/>"
    yield _text(140, 44, f"first difference at {at_ms:.1f} ms, {channel}: {message}", "fill='#c00'", WIDTH - 140 - _RIGHT)
