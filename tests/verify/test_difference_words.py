"""What is said of a first difference is true of the whole runs: late is not missing, and once more is not never."""

from __future__ import annotations

import pytest

from robosmi.verify.traces.activity import LEVEL, LINE, PULSES, READING, ActivityEvent
from robosmi.verify.traces.comparison import compare

Told = list[tuple[float, float | str]]


def lamp(*times: float) -> list[ActivityEvent]:
    """A lamp that is switched at these times, on at first."""
    return [ActivityEvent(0.0, LEVEL, (0,)), *(ActivityEvent(at * 1000, LEVEL, (1 - n % 2,)) for n, at in enumerate(times))]


def servo(*widths: tuple[float, float, int]) -> list[ActivityEvent]:
    """A servo that is sent pulses: from when on, how wide, for how many frames."""
    pulses = [ActivityEvent(at * 1000, PULSES, (width,), frames=frames) for at, width, frames in widths]
    return [ActivityEvent(0.0, LEVEL, (0,)), *pulses]


def lines(*told: tuple[float, str]) -> list[ActivityEvent]:
    """What is printed: when, and the line."""
    return [ActivityEvent(at * 1000, LINE, (text,)) for at, text in told]


CASES = {
    "late": (lamp(500, 1500), lamp(700, 1700), 500, "switches on 200.0 ms too late"),
    "early": (lamp(700, 1700), lamp(500, 1500), 500, "switches on 200.0 ms too early"),
    "the first of two is not there": (
        lamp(500, 600, 1000, 1100), lamp(1000, 1100), 500,
        "stays off; the original switches on at 500.0 ms",
    ),
    "one more before": (
        lamp(1000, 1100), lamp(500, 600, 1000, 1100), 500,
        "switches on again at 500.0 ms; the original does not",
    ),
    "one more behind": (lamp(1000, 1100), lamp(1000, 1100, 2000), 2000, "switches on again at 2000.0 ms; the original does not"),
    "never": (
        servo((20, 1500, 40)), servo((20, 1500, 40), (900, 1600, 40)), 900,
        "sends pulses of 1600 us at 900.0 ms; the original never does",
    ),
    "short pulses that come late": (
        servo((20, 1500, 40), (900, 1600, 2)), servo((20, 1500, 40), (1300, 1600, 4)),
        900, "sends pulses of 1600 us 400.0 ms too late",
    ),
    "short pulses that come early": (
        servo((20, 1500, 40), (1300, 1600, 4)), servo((20, 1500, 40), (900, 1600, 2)),
        900, "sends pulses of 1600 us 400.0 ms too early",
    ),
    "pulses that are shifted": (
        servo((20, 1500, 40), (900, 1600, 40), (1700, 1500, 40)), servo((20, 1500, 40), (1200, 1600, 40), (2000, 1500, 40)),
        20, "sends pulses of 1500 us for 1180.00 ms; the original for 880.00 ms",
    ),
    "pulses that are not there": (
        servo((20, 1500, 40), (900, 1600, 40), (1700, 1700, 40)), servo((20, 1500, 40), (1700, 1700, 40)),
        900, "missing: the original sends pulses of 1600 us at 900.0 ms",
    ),
    "pulses that are others": (
        servo((20, 1500, 40)), servo((20, 1600, 40)), 20, "sends pulses of 1600 us; the original sends pulses of 1500 us",
    ),
    "a line is lost": (
        lines((100, "a"), (120, "b"), (140, "c")), lines((100, "a"), (140, "c")), 120,
        "missing: the original sends 'b' at 120.0 ms",
    ),
    "a line more": (
        lines((100, "a"), (140, "c")), lines((100, "a"), (120, "b"), (140, "c")),
        120, "sends 'b' at 120.0 ms; the original never does",
    ),
    "the other way round": (
        lines((100, "a"), (120, "b")), lines((100, "b"), (120, "a")), 100,
        "sends 'b' before it sends 'a', not after",
    ),
    "another line": (lines((100, "a"), (120, "b")), lines((100, "a"), (120, "x")), 120, "sends 'x'; the original sends 'b'"),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_what_is_said_is_true(case: str) -> None:
    source, target, at_ms, said = CASES[case]
    found = compare("x", source, target, [source], 4000)
    assert found.difference is not None
    assert found.difference.message.startswith(said), found.difference.message
    assert found.difference.at_ms == at_ms


def test_more_than_one_pulse_is_told_as_many() -> None:
    longer = servo((20, 1500, 40), (900, 1600, 40), (1700, 1700, 40)), servo((20, 1500, 40), (900, 1600, 60), (2000, 1700, 40))
    difference = compare("x", *longer, [longer[0]], 4000).difference
    assert difference is not None
    assert difference.message == "sends pulses of 1600 us for 1100.00 ms; the original for 800.00 ms"


@pytest.mark.parametrize(
    ("one", "other", "same"), [("t nan", "t nan", True), ("t nan", "t 1.00", False), ("t inf", "t nan", False)]
)
def test_measured_values_that_are_no_numbers_are_compared_as_text(one: str, other: str, same: bool) -> None:
    source, target = ([ActivityEvent(100_000.0, READING, (text,))] for text in (one, other))
    assert (compare("x", source, target, [], 4000).status == "same") is same
