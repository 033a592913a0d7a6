"""The picture of two traces: well-formed, everything within it, and no text over another."""

from __future__ import annotations

from itertools import combinations
from xml.etree import ElementTree

import pytest

from robosmi.verify.traces.activity import BURST, IDLE, LEVEL, LINE, PULSES, WAVE, ActivityEvent
from robosmi.verify.traces.trace_picture import WIDTH, trace_svg

SVG = "{http://www.w3.org/2000/svg}"
WIDEST = 6.6  # pixels of a letter


def texts(picture: str) -> list[tuple[float, float, float, str]]:
    """Left and right edge, baseline and content of each text."""
    found = []
    for element in ElementTree.fromstring(picture).iter(f"{SVG}text"):
        x, said = float(element.attrib["x"]), element.text or ""
        wide = len(said) * WIDEST
        left = {"middle": x - wide / 2, "end": x - wide}.get(element.attrib.get("text-anchor", ""), x)
        found.append((left, left + wide, float(element.attrib["y"]), said))
    return found


def many() -> dict[str, tuple[list[ActivityEvent], list[ActivityEvent]]]:
    """Channels of all kinds, crowded."""
    lamp = [IDLE, *(ActivityEvent(n * 7_000.0, LEVEL, (n % 2,)) for n in range(1, 200))]
    servo = [IDLE, *(ActivityEvent(n * 90_000.0, PULSES, (1500.0 + n,)) for n in range(1, 15))]
    tone = [
        IDLE,
        ActivityEvent(100_000.0, WAVE, (440.0, 0.5)),
        ActivityEvent(400_000.0, BURST, (12,)),
        ActivityEvent(9e5, LEVEL, (0,)),
    ]
    said = [ActivityEvent(n * 31_000.0, LINE, (f"line {n} <&> " + "x" * (n % 40),)) for n in range(1, 45)]
    return {"lamp with a very long name that does not fit": (lamp, lamp[:50]), "servo": (servo, servo), "tone": (tone, tone),
            "console": (said, said[::3]), "unused": ([IDLE], [IDLE])}  # fmt: skip


@pytest.mark.parametrize("horizon_ms", [1.5, 1500.0, 24_000.0, 600_000.0])
def test_no_text_stands_over_another_or_beyond_the_edge(horizon_ms: float) -> None:
    picture = trace_svg("a title " * 30, many(), horizon_ms, (733.0, "console", "'a' instead of 'b' " * 12))
    height = float(ElementTree.fromstring(picture).attrib["height"])
    found = texts(picture)
    assert len(found) > 10
    for left, right, y, said in found:
        assert left >= -1, said
        assert right <= WIDTH + 1, said
        assert 0 < y < height
    for (left, right, y, one), (other_left, other_right, other_y, other) in combinations(found, 2):
        apart = abs(y - other_y) >= 11 or right <= other_left + 0.5 or other_right <= left + 0.5
        assert apart, f"{one!r} and {other!r}"


def test_each_side_has_its_lane_and_each_event_its_text() -> None:
    picture = trace_svg("blink", {"lamp": ([IDLE, ActivityEvent(5e5, LEVEL, (1,))], [IDLE])}, 1000.0)
    assert [said for *_, said in texts(picture)][:4] == ["blink", "source", "target", "lamp"]
    lanes = [e.attrib["d"] for e in ElementTree.fromstring(picture).iter(f"{SVG}path") if e.attrib.get("fill") == "none"]
    assert len(lanes) == 2
    assert lanes[0] != lanes[1]
    printed = trace_svg("text", {"console": ([ActivityEvent(5e5, LINE, ("<b>\x00",))], [])}, 1000.0)
    [tip] = [e.text for e in ElementTree.fromstring(printed).iter(f"{SVG}title")]
    assert tip == "500.0 ms: '<b>\\x00'"


def test_where_nothing_happens_the_picture_says_so() -> None:
    assert "no change on any channel" in trace_svg("nothing", {"lamp": ([IDLE], [IDLE])}, 1000.0)
