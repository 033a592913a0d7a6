"""For how long a program drives a line that it shares with a device."""

from __future__ import annotations

from collections.abc import Iterable

from robosmi.verify.simulation import PinChange, PinTrace, Wave
from robosmi.verify.traces.activity import HELD, ActivityEvent
from robosmi.verify.traces.alignment import alike
from robosmi.verify.traces.comparison import DIFFERENT, compare
from robosmi.verify.traces.driven_lines import DRIVEN_LOW, LET_GO, NO_MORE, let_go_levels, level_durations, pulse_lengths


def held(lengths: Iterable[tuple[float, int, float]], until_us: float = 0.0) -> list[tuple[float, int, float]]:
    """The trace of a line that is driven to a level at some times, each for so many microseconds, and then released."""
    changes = [c for at, level, us in lengths for c in (PinChange(at, "D4", level), PinChange(at + us, "D4", "z"))]
    trace = PinTrace("e", "running", until_us or changes[-1].at_us + 2_000.0, tuple(changes), (), (), ())
    return [(event.at_us, int(event.value[0]), float(event.value[1])) for event in level_durations(trace, "D4")]


def let_go(*changes: tuple[float, int | str]) -> list[str]:
    """The trace of a line that the program releases: microseconds and levels."""
    trace = PinTrace("e", "running", 9_000_000.0, tuple(PinChange(at, "D4", level) for at, level in changes), (), (), ())
    return [str(event) for event in let_go_levels(trace, "D4")]


def test_a_line_that_is_driven_high_later_was_let_go_all_the_same() -> None:
    asked: list[tuple[float, int | str]] = [(0.0, "z"), (1000.0, 0), (51_000.0, "z"), (131_000.0, 0), (181_000.0, "z")]
    seen = [LET_GO, DRIVEN_LOW, LET_GO, DRIVEN_LOW, LET_GO]
    assert let_go(*asked) == seen
    assert let_go(*asked, (261_000.0, 1), (300_000.0, 0), (400_000.0, "z")) == seen
    assert let_go(*asked, (261_000.0, 0), (261_050.0, 1)) == seen


def test_an_output_is_not_let_go() -> None:
    assert let_go((0.0, "z"), (1000.0, 0)) == [LET_GO]
    assert let_go((0.0, "z"), (1000.0, 0), (1500.0, "z"), (1500.1, 0), (51_000.0, 1)) == [LET_GO]  # by pinMode, for a moment
    assert let_go((0.0, "z"), (1000.0, 0), (51_000.0, 1), (131_000.0, 0), (181_000.0, "z")) == [LET_GO]


def test_a_line_that_is_first_let_go_at_the_end_may_be_an_output_in_another_run() -> None:
    def seen(let_go_us: float) -> list[ActivityEvent]:
        changes = (PinChange(0.0, "D4", "z"), PinChange(1000.0, "D4", 0), PinChange(let_go_us, "D4", "z"))
        return let_go_levels(PinTrace("e", "running", 6_000_000.0, changes, (), (), ()), "D4")

    early, late, beyond = seen(3_000_000.0), seen(5_900_000.0), seen(6_000_001.0)[:1]
    assert [str(event) for event in late] == [str(event) for event in early] == [LET_GO, DRIVEN_LOW, LET_GO]
    for one, other in ((late, beyond), (beyond, late)):
        assert compare("line", one, other, [one], 6_000.0).difference is None
    assert compare("line", beyond, early, [beyond], 6_000.0).status == DIFFERENT


def test_a_sensor_that_is_charged_again_and_again_tells_one_length() -> None:
    assert held((at * 2000.0, 1, 230 + at % 7) for at in range(100)) == [(0.0, 1, 231)]


def test_a_single_one_that_an_interrupt_stretches_is_not_seen() -> None:
    assert len(held((at * 2000.0, 1, 900 if at == 50 else 230) for at in range(100))) == 1


def test_another_length_is_seen() -> None:
    assert [us for _, _, us in held((at * 2000.0, 1, 230 if at < 50 else 1200) for at in range(100))] == [230, 1200]


def test_a_sensor_that_is_asked_now_and_then_tells_each() -> None:
    assert held([(500_000, 0, 18_200), (2_700_000, 0, 18_200)]) == [(500_000, 0, 18_200)]
    assert [us for _, _, us in held([(500_000, 0, 18_200), (2_700_000, 0, 9_100)])] == [18_200, 9_100]


def test_a_first_one_is_seen_although_others_follow_much_later() -> None:
    later = [(1_442_000.0 + at * 30_000, 1, 1050.0) for at in range(9)]
    assert held([(0.0, 1, 1010.0), *later]) == [(0.0, 1, 1010.0), (1010.0, 1, NO_MORE), (1_442_000.0, 1, 1050.0)]
    assert [us for _, _, us in held([(0.0, 1, 500.0), *later])] == [500.0, NO_MORE, 1050.0]


def test_where_a_line_is_no_longer_held_is_seen() -> None:
    blinks = [(at * 200_000.0, 1, 100_000.0) for at in range(10)]
    assert held(blinks, 2_300_000.0) == [(0.0, 1, 100_000.0)]
    assert held(blinks, 6_000_000.0) == [(0.0, 1, 100_000.0), (1_900_000.0, 1, NO_MORE)]
    again = [(at * 200_000.0 + 4_000_000.0, 1, 100_000.0) for at in range(5)]
    assert [us for _, _, us in held([*blinks, *again])] == [100_000.0, NO_MORE, 100_000.0]
    assert ActivityEvent(0.0, HELD, (1, NO_MORE)).does() == "no longer drives high"


def test_what_lasts_less_than_a_tenth_of_a_millisecond_is_not_looked_at() -> None:
    assert held((at * 2000.0, 1, 15) for at in range(100)) == []


def test_lengths_are_the_same_within_a_tenth_of_a_millisecond_and_five_per_cent() -> None:
    def length(us: float, level: int = 1) -> ActivityEvent:
        return ActivityEvent(0.0, HELD, (level, us))

    assert alike(length(230), length(330))
    assert not alike(length(230), length(360))
    assert alike(length(18_000), length(18_900))
    assert not alike(length(18_000), length(18_000, 0))
    assert str(length(230)) == "held high for 230 us"


def pulses(*made: tuple[float, float]) -> list[str]:
    """What is seen of pulses at a pin where one function makes them: when each begins, and how long it is."""
    changes = [c for at, us in made for c in (PinChange(at, "D4", 1), PinChange(at + us, "D4", 0))]
    trace = PinTrace("e", "running", 9_000_000.0, (PinChange(0.0, "D4", 0), *changes), (), (), ())
    return [str(event) for event in pulse_lengths(trace, "D4")]


def tone(begin_us: float, hz: float, count: int) -> list[tuple[float, float]]:
    """The pulses of a tone, the last one cut off."""
    period = 1e6 / hz
    return [*((begin_us + at * period, period / 2) for at in range(count)), (begin_us + count * period, period / 5)]


ROW = [(100_000.0 + at * 20_000.0, 100.0 * (at + 1)) for at in range(8)]


def test_pulses_beside_a_tone_are_those_that_are_seen_without_it() -> None:
    alone = pulses(*ROW)
    assert alone[:3] == [f"pulses high for {us}.0 us" for us in (200, 300, 400)]
    assert pulses(*ROW, *tone(760_000, 440, 200)) == alone
    assert pulses(*tone(10_000, 2000, 20), *ROW, *tone(760_000, 440, 40)) == alone
    assert pulses(*((at, 1.3 * us) for at, us in ROW), *tone(760_000, 440, 200))[0] == "pulses high for 260.0 us"


def test_pulses_for_half_of_the_time_are_a_tone_only_where_they_are_as_even() -> None:
    assert pulses((100_000, 500), (101_000, 900), (102_700, 500)) != []
    assert pulses(*tone(100_000, 1000, 3)) == []


def test_a_pulse_directly_after_a_tone_is_seen_whoever_makes_the_tone() -> None:
    made = tone(1_000.0, 1000.0, 100)
    pulse = (101_020.0, 1_500.0)
    assert pulses(*made, pulse) == pulses(pulse) == ["pulses high for 1500.0 us"]


def test_a_tone_of_one_period_is_a_pulse_whoever_makes_it() -> None:
    waves = (Wave(1_000.0, "P", 1000.0, 0.5), Wave(2_016.0, "P", 0.0, 0.0))
    by_timer = PinTrace("", "done", 3e6, (PinChange(1_000.0, "P", 0), PinChange(2_016.0, "P", "z")), waves, (), ())
    by_edges = PinTrace("", "done", 3e6, (PinChange(1_500.0, "P", 1), PinChange(2_000.0, "P", 0)), (), (), ())
    assert [str(event) for event in pulse_lengths(by_timer, "P")] == [str(event) for event in pulse_lengths(by_edges, "P")]
    assert pulse_lengths(by_edges, "P")
