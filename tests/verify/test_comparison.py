"""Comparing events: what counts as the same, what as different, how the first difference is told, when nothing can be said."""

from __future__ import annotations

import pytest

from robosmi.verify.traces.activity import LEVEL, LINE, PULSES, READING, WAVE, ActivityEvent
from robosmi.verify.traces.comparison import ClosedLoop, compare

Told = list[tuple[float, str, tuple[float | str, ...]]]

BLINK: Told = [(0, LEVEL, (0,)), (500, LEVEL, (1,)), (1500, LEVEL, (0,))]
DRIVE: Told = [(0, LEVEL, (0,)), (20, PULSES, (1500.0,)), (800, PULSES, (1560.0,))]
NOTE: Told = [(0, LEVEL, (0,)), (300, WAVE, (534.0, 0.5)), (575, LEVEL, (0,))]
DIMMED: Told = [(0, LEVEL, (0,)), (300, WAVE, (1000.0, 0.996)), (700, LEVEL, (0,))]
TONE: Told = [(0, LEVEL, (0,)), (300, WAVE, (3000.0, 0.5)), (500, LEVEL, (0,))]
LINES: Told = [(100, READING, ("count 7",)), (900, READING, ("volts 2.48",))]
COUNTED: Told = [(100, READING, ("1000 ms, 50.0 cm",)), (900, READING, ("done",))]
COUNTED_AGAIN: Told = [(100, READING, ("1007 ms, 50.0 cm",)), (900, READING, ("done",))]
TEXT: Told = [(100, LINE, ("count 7",)), (900, LINE, ("volts 2.48",))]


def events(told: Told) -> list[ActivityEvent]:
    return [ActivityEvent(at_ms * 1000.0, kind, value) for at_ms, kind, value in told]


def changed(told: Told, number: int, at_ms: float | None = None, value: tuple[float | str, ...] | None = None) -> Told:
    at, kind, old = told[number]
    return [*told[:number], (at if at_ms is None else at_ms, kind, old if value is None else value), *told[number + 1 :]]


@pytest.mark.parametrize("told", [BLINK, DRIVE, TONE, LINES, TEXT])
def test_what_is_the_same_is_the_same(told: Told) -> None:
    result = compare("x", events(told), events(told), [events(told)], 4000)
    assert (result.status, result.difference) == ("same", None)
    assert result.events == 2


@pytest.mark.parametrize(
    ("told", "again", "target", "status"),
    [
        (TONE, changed(TONE, 1, None, (3030.0, 0.5)), changed(TONE, 1, None, (2910.0, 0.5)), "same"),
        (TONE, changed(TONE, 1, None, (3030.0, 0.5)), changed(TONE, 1, None, (2880.0, 0.5)), "different"),
        (TONE, TONE, changed(TONE, 1, None, (2910.0, 0.5)), "different"),
        (COUNTED, COUNTED_AGAIN, changed(COUNTED, 0, None, ("1022 ms, 50.0 cm",)), "same"),
        (COUNTED, COUNTED_AGAIN, changed(COUNTED, 0, None, ("1030 ms, 50.0 cm",)), "different"),
        (COUNTED, COUNTED_AGAIN, changed(COUNTED, 0, None, ("1000 ms, 51.0 cm",)), "different"),
        (COUNTED, COUNTED, changed(COUNTED, 0, None, ("1022 ms, 50.0 cm",)), "different"),
    ],
)  # fmt: skip
def test_what_is_said_may_be_off_by_twice_as_much_as_in_other_runs_of_the_source(
    told: Told, again: Told, target: Told, status: str
) -> None:
    assert compare("x", events(told), events(target), [events(again)], 4000).status == status


@pytest.mark.parametrize(
    ("told", "target", "status"),
    [
        (BLINK, changed(changed(BLINK, 1, 540), 2, 1540), "same"),
        (BLINK, changed(changed(BLINK, 1, 560), 2, 1560), "different"),
        (BLINK, changed(BLINK, 2, 1509), "same"),
        (BLINK, changed(BLINK, 2, 1480), "different"),
        (BLINK, BLINK[:2], "different"),
        (BLINK, [*BLINK, (2000, LEVEL, (1,))], "different"),
        (BLINK, [*BLINK, (3990, LEVEL, (1,))], "same"),
        (BLINK, BLINK[:1], "different"),
        (DRIVE, changed(DRIVE, 2, None, (1562.0,)), "same"),
        (DRIVE, changed(DRIVE, 2, None, (1565.0,)), "different"),
        (DRIVE, changed(DRIVE, 2, None, (1440.0,)), "different"),
        (DRIVE, changed(DRIVE, 2, 820), "same"),
        (DRIVE, changed(DRIVE, 2, 880), "different"),
        (TONE, changed(TONE, 1, None, (3030.0, 0.5)), "same"),
        (TONE, changed(TONE, 1, None, (3100.0, 0.5)), "different"),
        (TONE, changed(TONE, 1, None, (3000.0, 0.6)), "different"),
        (TONE, changed(TONE, 2, 503), "different"),
        (NOTE, changed(NOTE, 2, 571.4), "same"),
        (NOTE, changed(NOTE, 2, 568), "different"),
        (DIMMED, [DIMMED[0], (300, LEVEL, (1,)), *DIMMED[2:]], "same"),
        (DIMMED, [DIMMED[0], (300, LEVEL, (0,)), *DIMMED[2:]], "different"),
        (TEXT, changed(TEXT, 0, None, ("count 8",)), "different"),
        (LINES, changed(LINES, 0, None, ("count 8",)), "same"),
        (LINES, changed(LINES, 0, None, ("count 9",)), "different"),
        (LINES, changed(LINES, 1, None, ("volts 2.49",)), "same"),
        (LINES, changed(LINES, 1, None, ("volt 2.48",)), "different"),
        (LINES, changed(LINES, 1, None, ("volts -2.48",)), "different"),
    ],
)
def test_tolerances(told: Told, target: Told, status: str) -> None:
    assert compare("x", events(told), events(target), [events(told)], 4000).status == status


def test_the_first_difference_is_told_in_words() -> None:
    late = compare("LED", events(BLINK), events(changed(BLINK, 1, 700)), [], 4000).difference
    assert late is not None
    assert (late.at_ms, late.channel) == (500, "LED")
    assert late.message.startswith("switches on 200.0 ms too late (tolerance 4")
    short = compare("LED", events(BLINK), events(changed(BLINK, 2, 1480)), [], 4000).difference
    assert short is not None
    assert short.message == "stays on for 980.00 ms; the original for 1000.00 ms"
    missing = compare("LED", events(BLINK), events(BLINK[:1]), [], 4000).difference
    assert missing is not None
    assert missing.message.startswith("stays off; the original switches on at ")
    assert missing.to_json()["target"] is None
    more = compare("LED", events(BLINK[:1]), events(BLINK), [], 4000).difference
    assert more is not None
    assert more.message.endswith("; the original never does")
    other = compare("servo", events(DRIVE), events(changed(DRIVE, 2, None, (1440.0,))), [], 4000).difference
    assert other is not None
    assert other.message == "sends pulses of 1440 us; the original sends pulses of 1560 us"


def test_a_channel_that_the_source_does_not_use_is_not_exercised() -> None:
    assert compare("x", events(BLINK[:1]), events(BLINK[:1]), [], 4000).status == "not-exercised"
    assert compare("x", [], [], [], 4000).status == "not-exercised"


def test_what_the_source_does_not_do_twice_the_same_is_racy() -> None:
    varied = changed(DRIVE, 2, None, (1440.0,))
    assert compare("x", events(DRIVE), events(DRIVE), [events(varied)], 4000).status == "racy"
    assert compare("x", events(BLINK), events(BLINK), [events(BLINK[:1])], 4000).status == "racy"
    assert compare("x", events(BLINK), events(BLINK), [events([*BLINK, (3999, LEVEL, (1,))])], 4000).status == "same"


def test_it_is_told_where_the_source_differs_from_itself() -> None:
    found = compare("x", events(TEXT), events(TEXT), [events(TEXT), events(changed(TEXT, 1, 905, ("volts 2.49",)))], 4000)
    assert str(found.itself) == "'volts 2.48' at 900.0 ms, or 'volts 2.49' at 905.0 ms"
    assert found.itself is not None
    assert found.itself.to_json() == {
        "at_ms": 900.0, "source": {"at_ms": 900.0, "what": "'volts 2.48'"}, "again": {"at_ms": 905.0, "what": "'volts 2.49'"},
    }  # fmt: skip
    more = compare("x", events(BLINK), events(BLINK), [events(BLINK[:2])], 4000).itself
    assert str(more) == "low at 1500.0 ms, or nothing more"


def test_a_difference_before_the_source_differs_from_itself_is_one() -> None:
    varied = changed(DRIVE, 2, None, (1440.0,))
    found = compare("x", events(DRIVE), events(changed(DRIVE, 1, None, (1300.0,))), [events(varied)], 4000)
    assert (found.status, found.difference is not None and found.difference.at_ms) == ("different", 20)
    assert (
        compare("x", events(DRIVE), events(changed(DRIVE, 1, 300)), [events(varied)], 4000).status == "racy"
    )  # times wobble, too
    missing = compare("x", events(DRIVE), events(DRIVE[:1]), [events(varied)], 4000)
    assert missing.difference is not None
    assert missing.difference.message.startswith("missing: the original sends pulses of 1500 us at ")
    near = compare("x", events(DRIVE), events(changed(DRIVE, 2, None, (1300.0,))), [events(varied)], 4000)
    assert near.status == "racy"


COUNTS: Told = [(100, LINE, ("loops 10",)), (200, LINE, ("tl 0",)), (300, LINE, ("loops 20",)), (400, LINE, ("tl 16",))]


@pytest.mark.parametrize(
    ("target", "status"),
    [
        (COUNTS, "racy"),
        (changed(COUNTS, 2, None, ("loops 90",)), "racy"),  # of a number that wobbles nothing is known
        (changed(COUNTS, 3, None, ("tl 0",)), "different"),
        (changed(COUNTS, 3, None, ("tr 16",)), "racy"),  # the program may have gone another way
        (changed(COUNTS, 3, 900), "racy"),
    ],
)
def test_a_line_that_never_changes_is_compared_beside_lines_that_do(target: Told, status: str) -> None:
    varied = changed(changed(COUNTS, 0, None, ("loops 11",)), 2, None, ("loops 22",))
    found = compare("x", events(COUNTS), events(target), [events(varied)], 4000)
    assert found.status == status
    assert found.itself is not None
    if found.difference is not None:
        assert found.difference.at_ms == 400
        assert found.difference.message.startswith("sends 'tl 0'; the original sends 'tl 16' in each run")


def test_times_may_be_off_by_twice_what_the_source_is_off_from_itself() -> None:
    """A lamp that is on while a button is held lasts as long as a person holds it, and the looks in between."""
    varied = changed(BLINK, 2, 1530)
    late = changed(BLINK, 2, 1555)
    assert compare("x", events(BLINK), events(late), [events(BLINK)], 4000).status == "different"
    assert compare("x", events(BLINK), events(late), [events(varied)], 4000).status == "same"
    assert compare("x", events(BLINK), events(changed(BLINK, 2, 1650)), [events(varied)], 4000).status == "different"


def test_what_the_source_does_after_the_end_is_neither_compared_nor_counted() -> None:
    early = compare("x", events(BLINK), events(BLINK[:2]), [events(BLINK)], 1000)
    assert (early.status, early.events) == ("same", 1)
    assert compare("x", events(BLINK), events(BLINK[:1]), [events(BLINK)], 200).status == "not-exercised"
    assert compare("x", events(TEXT), events(TEXT[:1]), [events(TEXT)], 500).events == 1


@pytest.mark.parametrize(
    ("since_ms", "late_ms", "status"), [(300, 360, "same"), (300, 480, "different"), (900, 360, "different")]
)
def test_what_waits_for_a_wheel_may_end_as_much_later_as_its_last_step_takes(
    since_ms: float, late_ms: float, status: str
) -> None:
    late = changed(changed(BLINK, 1, 500 + late_ms), 2, 1500 + late_ms)
    assert compare("x", events(BLINK), events(late), [events(BLINK)], 4000, ClosedLoop(since_ms, 370)).status == status


def counted(lines: int, last: str) -> list[ActivityEvent]:
    said = ["begin", *["no"] * lines, last]
    return [ActivityEvent(1000.0 + at * 2_000_000.0 / lines, LINE, (each,)) for at, each in enumerate(said)]


@pytest.mark.parametrize(
    ("target", "status"),
    [
        (counted(90, "90"), "racy"),
        (counted(120, "120"), "racy"),
        ([ActivityEvent(1000.0, LINE, ("start",)), *counted(90, "90")[1:]], "different"),
    ],
)
def test_how_often_a_source_says_the_same_in_a_row_is_not_sure_where_its_runs_differ_in_it(
    target: list[ActivityEvent], status: str
) -> None:
    assert compare("console", counted(100, "100"), target, [counted(96, "96"), counted(104, "104")], 4000).status == status


@pytest.mark.parametrize(("theirs", "status"), [(120.5, "same"), (126.0, "same"), (140.0, "different")])
def test_a_wave_of_single_edges_may_be_off_by_twice_what_the_steps_of_the_source_make_of_it(theirs: float, status: str) -> None:
    def steps(hz: float, ended_ms: float) -> list[ActivityEvent]:
        wave = ActivityEvent(100_000.0, WAVE, (hz, 0.5), pulses=int(hz * (ended_ms - 100) / 1000))
        return [ActivityEvent(0.0, LEVEL, (0,)), wave, ActivityEvent(1000 * ended_ms, LEVEL, (0,))]

    source, varied = steps(123.4, 1100.0), [steps(120.6, 1123.0), steps(124.8, 1089.0)]
    assert compare("coil", source, steps(theirs, 1100.0), varied, 3000.0).status == status
