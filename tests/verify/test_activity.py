"""What a pin does as a person sees it: the same events for edges, waves of timers and pulses of either machine."""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence

import pytest
from msgspec.structs import replace

from robosmi.verify.simulation import ConsoleByte, PinChange, PinTrace, Wave
from robosmi.verify.traces.activity import IDLE, LEVEL, WAVE, Sight, activity, console_lines


def trace(
    levels: Iterable[tuple[float, int | str]] = (), waves: Iterable[Wave] = (), text: Iterable[tuple[float, str]] = ()
) -> PinTrace:
    """A trace of four seconds with one pin."""
    changes = tuple(PinChange(at, "D1", level) for at, level in levels)
    console = tuple(ConsoleByte(at, ord(c)) for at, c in text)
    return PinTrace("e", "running", 4_000_000.0, changes, tuple(waves), console, ())


def said(seen: PinTrace, sight: Sight | None = None) -> list[tuple[float, str]]:
    """The events of the pin: milliseconds and words."""
    return [(round(e.at_us / 1000, 1), str(e)) for e in activity(seen, "D1", sight or Sight())]


def square(begin: float, hz: float, count: int) -> list[tuple[float, int]]:
    """Edges of a wave."""
    period = 1e6 / hz
    return [(begin + n * period + half, level) for n in range(count) for half, level in ((0.0, 1), (period / 2, 0))]


def frames(begin: float, widths: Iterable[float]) -> list[tuple[float, int]]:
    """Pulses of a servo, 20 ms apart."""
    return [(begin + n * 20_000 + at, level) for n, width in enumerate(widths) for at, level in ((0.0, 1), (width, 0))]


def test_a_pin_that_is_never_used_is_idle() -> None:
    assert activity(trace(), "D1") == [IDLE]
    assert activity(trace([(10.0, "z"), (20.0, "p"), (30.0, 0)]), "D1") == [IDLE]


def test_a_trace_is_not_read_again_for_each_activity(monkeypatch: pytest.MonkeyPatch) -> None:
    """A display that is multiplexed for a minute has thousands of them: verify took minutes to read its trace."""
    asked: list[str] = []
    levels = PinTrace.levels

    def counted(seen: PinTrace, pin: str) -> Sequence[tuple[float, int | str]]:
        asked.append(pin)
        return levels(seen, pin)

    monkeypatch.setattr(PinTrace, "levels", counted)

    def times(blinks: int) -> int:
        asked.clear()
        activity(trace([(at + up, 1 - up // 1000) for at in range(0, 90_000 * blinks, 90_000) for up in (0, 1000)]), "D1")
        return len(asked)

    assert times(40) == times(4)


def test_levels_are_levels_and_letting_go_is_low() -> None:
    seen = trace([(100_000, 1), (600_000, 0), (1_000_000, 1), (1_500_000, "z")])
    assert said(seen) == [(0, "low"), (100, "high"), (600, "low"), (1000, "high"), (1500, "low")]


def test_a_tone_is_one_event_whoever_makes_it() -> None:
    by_hand = trace(square(100_000, 1000, 500))
    by_timer = trace((), [Wave(100_000.0, "D1", 1000.0, 0.5), Wave(600_000.0, "D1", 0.0, 0.0)])
    assert said(by_hand) == said(by_timer) == [(0, "low"), (100, "1000 Hz"), (600, "low")]


def test_tones_that_follow_each_other_are_two_though_an_interrupt_delays_an_edge() -> None:
    first, second = square(100_000, 3000, 1500), square(600_300, 3500, 875)
    first[2 * 1492] = (first[2 * 1492][0] + 6.0, 1)
    second[2 * 4] = (second[2 * 4][0] + 6.0, 1)
    assert [(round(ms), what.split(" Hz")[0]) for ms, what in said(trace([*first, *second]))] == [
        (0, "low"), (100, "3000"), (600, "3500"), (850, "low"),
    ]  # fmt: skip


def test_bursts_of_a_carrier_with_short_pauses_are_one_activity() -> None:
    bursts = [edge for n in range(20) for edge in square(100_000 + n * 25_000, 38_000, 38)]
    assert [what for _, what in said(trace(bursts))] == ["low", "38000 Hz", "low"]
    apart = [edge for n in range(4) for edge in square(100_000 + n * 200_000, 38_000, 38)]
    assert [what for _, what in said(trace(apart))] == ["low", *["38000 Hz", "low"] * 4]


def test_edges_that_interrupts_delay_are_still_one_tone() -> None:
    edges = [(at + (9.0 if number % 70 < 2 else 0.0), level) for number, (at, level) in enumerate(square(100_000, 38_000, 4000))]
    (_, tone, *_) = activity(trace(edges), "D1")
    assert tone.kind == "wave"
    assert float(tone.value[0]) == pytest.approx(38_000, rel=0.005)
    assert len(activity(trace(edges), "D1")) == 3


def test_two_notes_without_a_pause_are_two_events() -> None:
    both = square(100_000, 440, 200) + square(100_000 + 200 * 1e6 / 440, 880, 200)
    assert [what.split(" ")[0].split(".")[0] for _, what in said(trace(both))] in (
        ["low", "440", "880", "low"],
        ["low", "440", "879", "low"],
    )


def test_a_servos_frames_are_their_width_and_ramps_are_not_seen() -> None:
    widths = [1500.0] * 10 + [1520, 1540, 1560] + [1580.0] * 10
    seen = trace(frames(100_000, widths))
    assert said(seen) == [(0, "low"), (100, "pulses of 1500 us"), (360, "pulses of 1580 us"), (541.6, "low")]
    jitter = [1500.0 + (5 if n % 7 == 0 else 0) for n in range(30)]
    assert [what for _, what in said(trace(frames(100_000, jitter)))][1] == "pulses of 1500 us"
    assert len(said(trace(frames(100_000, [*[1500.0] * 10, 1530.0, *[1500.0] * 10])))) == 3


def test_what_goes_on_at_the_end_of_the_run_has_no_end() -> None:
    assert said(trace(frames(3_000_000, [1500.0] * 49))) == [(0, "low"), (3000, "pulses of 1500 us")]
    assert [what for _, what in said(trace(square(3_000_000, 1000, 1000)))] == ["low", "1000 Hz"]


def test_a_program_that_has_ended_will_not_go_on() -> None:
    ended = replace(trace(square(100_000, 1000, 100), (), [(200_000.0, "x")]), state="done", simulated_us=200_500.0)
    assert [what for _, what in said(ended)] == ["low", "1000 Hz", "low"]
    assert [e.value for e in console_lines(ended)] == [("x",)]
    assert console_lines(replace(ended, state="running")) == []


def test_a_pin_that_a_program_leaves_high_when_it_ends_stays_high() -> None:
    left = replace(trace([(1000.0, 1)]), state="done", simulated_us=1_001_000.0)
    assert said(left) == [(0, "low"), (1, "high")]
    let_go = replace(trace([(1000.0, 1), (1_001_000.0, 0)]), state="done", simulated_us=1_001_000.0)
    assert said(let_go) == [(0, "low"), (1, "high"), (1001, "low")]


def test_a_wave_before_a_pin_that_is_left_high_ends_though_the_program_ended_at_once() -> None:
    blinks = [*square(0.0, 25, 8), (320_000.0, 1)]
    original = replace(trace(blinks), state="done", simulated_us=320_000.0, rests_until_us=3_000_000.0)
    assert said(original) == said(replace(trace(blinks), simulated_us=3_000_000.0)) == [(0, "low"), (0, "25 Hz"), (320, "high")]


def test_the_last_pulse_of_pwm_is_part_of_it_whole_or_cut_off() -> None:
    """Its width goes up from 10 % to 90 %, by median it is a tone."""
    widths = [width for width in (200, 600, 1000, 1400, 1800) for _ in range(25)]
    whole = [(number * 2000 + at, level) for number, width in enumerate(widths) for at, level in ((0.0, 1), (width, 0))]
    assert said(trace(whole)) == said(trace([*whole[:-1], (whole[-2][0] + 7.0, 0)])) == [(0, "low"), (0, "500 Hz"), (250, "low")]


def test_pulses_of_no_steady_period_are_a_burst_of_so_many() -> None:
    edges: list[tuple[float, int]] = []
    at = 100_000.0
    for number in range(16):
        edges += [(at, 1), (at + 5, 0)]
        at += (10, 25, 60, 140)[number % 4]
    assert [what for _, what in said(trace(edges))] == ["low", "16 pulses", "low"]


def test_what_is_printed_is_lines_with_the_time_of_their_end() -> None:
    text = [(1000.0, "a"), (2000.0, "b"), (3000.0, "\r"), (3100.0, "\n"), (5000.0, "c"), (900_000.0, "d"), (901_000.0, "\n")]
    assert [(e.at_us, e.value[0]) for e in console_lines(trace(text=text))] == [(3000.0, "ab"), (5000.0, "c"), (901_000.0, "d")]


def test_a_wave_that_interrupts_stretch_here_and_there_is_one_wave() -> None:
    periods = [26.0] * 400 + [50.0, 14.0, 41.0, 16.0, 60.0] + [26.0] * 400 + [37.0] + [26.0] * 300
    ups = [1000.0 + sum(periods[:number]) for number in range(len(periods))]
    levels = [each for up in ups for each in ((up, 1), (up + 10, 0))]
    found = activity(trace([*levels, (900_000.0, 0)]), "D1")
    assert [event.kind for event in found] == [LEVEL, WAVE, LEVEL]
    assert found[1].value[0] == pytest.approx(1e6 / 26, rel=0.01)


def test_a_carriers_burst_that_interrupts_stretch_at_its_end_is_no_pause() -> None:
    """A few stretched periods may look like a wave of their own, and be followed by a pause between two bursts."""
    burst, stretched = [26.0] * 37 + [2_000.0], [26.0] * 28 + [31.0, 32.0, 31.0, 31.0, 60.0, 26.0, 50.0, 26.0, 2_000.0]
    periods = burst * 20 + stretched + burst * 20
    ups = [1000.0 + sum(periods[:number]) for number in range(len(periods))]
    found = said(trace([*[each for up in ups for each in ((up, 1), (up + 10, 0))], (900_000.0, 0)]))
    assert len(found) == 3, found
    other = [26.0] * 400 + [40.0] * 39 + [26.0] * 400  # as short as that, and yet another tone
    ups = [1000.0 + sum(other[:number]) for number in range(len(other))]
    assert len(said(trace([each for up in ups for each in ((up, 1), (up + 10, 0))]))) > 3


def stretched_bursts(seed: int, bursts: int, within: float = 0.12) -> list[tuple[float, int]]:
    """Edges of a carrier in bursts, some delayed by interrupts, after which the next period is shorter by as much."""
    chance, at, edges = random.Random(seed), 1000.0, list[tuple[float, int]]()
    for _ in range(bursts):
        owed = 0.0
        for _ in range(38):
            edges += [(at, 1), (at + 10, 0)]
            late = chance.uniform(8, 25) if chance.random() < within else 0.0
            at, owed = at + 26.3 + late - min(owed, 13.0), late
        at += 1_550.0
    return edges


@pytest.mark.parametrize("seed", range(4))
def test_a_carrier_that_interrupts_stretch_at_random_is_one_wave(seed: int) -> None:
    """Servos' frames meet some periods in a row, at the begin, in the middle and at the end of any burst."""
    edges = [*stretched_bursts(seed, 120), (2_000_000.0, 0)]
    found = said(trace(edges))
    assert len(found) == 3, found


def test_a_few_slow_pulses_of_no_period_after_a_tone_are_seen() -> None:
    """No interrupt stretches a period of a millisecond by a large part: these are the program's own."""
    ups, at = [100_000 + 1000.0 * number for number in range(200)], 300_000.0
    for gap in (1400.0, 600.0, 1900.0, 500.0, 1500.0, 800.0):
        ups.append(at)
        at += gap
    assert len(said(trace([edge for up in ups for edge in ((up, 1), (up + 300, 0))]))) > 3


def test_the_last_step_of_a_ramp_is_no_width_of_its_own() -> None:
    for last in ([1408.0, 1400.63, 1399.81], [1408.0, 1400.0, 1400.0], [1355.0, 1347.0, 1344.0]):
        widths = [1430.0, 1419.0, *last, *[round(last[-1])] * 20]
        assert said(trace(frames(100_000, widths)))[-2][1] == f"pulses of {round(last[-1])} us"


def test_notes_that_follow_one_another_at_once_are_waves_of_their_own() -> None:
    def note(begin: float, period: float) -> list[PinChange]:
        return [PinChange(begin + period * (n + half / 2), "D4", 1 - half) for n in range(200) for half in (0, 1)]

    changes = (*note(0.0, 716.0), *note(200 * 716.0 + 11_000, 902.0))
    trace = PinTrace("e", "running", 1_000_000.0, changes, (), (), ())
    waves = [event.value[0] for event in activity(trace, "D4") if event.kind == WAVE]
    assert waves == pytest.approx([1396.6, 1108.6], rel=0.005)


def test_a_tone_of_few_periods_is_the_same_by_a_timer_and_by_edges() -> None:
    for periods in (1, 2, 3):
        edges = trace(square(100_500, 1000, periods))
        timer = trace((), [Wave(100_000.0, "D1", 1000.0, 0.5), Wave(100_020.0 + 1000 * periods, "D1", 0.0, 0.0)])
        levels = [(100.5 + number / 2, "low" if number % 2 else "high") for number in range(2 * periods)]
        assert said(timer) == said(edges) == [(0, "low"), *levels]


def test_the_cut_off_last_pulse_of_a_short_tone_may_be_missing() -> None:
    timer = trace((), [Wave(100_000.0, "D1", 1000.0, 0.5), Wave(101_700.0, "D1", 0.0, 0.0)])
    assert [event.barely for event in activity(timer, "D1")] == [False, False, False, True, False]


def test_short_waves_of_a_timer_that_follow_one_another_are_waves() -> None:
    fade = [Wave(100_000.0 + 2_000 * n, "D1", 490.0, duty) for n, duty in enumerate((0.3, 0.5, 0.7))]
    assert [what for _, what in said(trace((), fade))] == ["low", "490 Hz, 30 % high", "490 Hz", "490 Hz, 70 % high"]


def test_a_pulse_near_a_tone_is_seen_whoever_makes_the_tone() -> None:
    waves = [Wave(100_000.0, "D1", 1000.0, 0.5), Wave(300_000.0, "D1", 0.0, 0.0)]
    tone = square(100_000, 1000, 200)
    for begin, length in ((300_020, 1_500), (330_000, 1_500), (330_000, 200), (60_000, 1_500), (60_000, 200)):
        pulse = [(float(begin), 1), (float(begin + length), 0)]
        by_edges, by_timer = (trace(sorted([*edges, *pulse]), made) for edges, made in ((tone, []), ([], waves)))
        assert said(by_edges) == said(by_timer)
        assert (round(begin / 1000, 1), "high") in said(by_edges)


def test_a_pulse_between_two_equal_tones_is_seen() -> None:
    tones = [*square(100_000, 1000, 200), *square(350_000, 1000, 200)]
    waves = [Wave(at, "D1", hz, 0.5 if hz else 0.0) for at, hz in ((1e5, 1000.0), (3e5, 0.0), (3.5e5, 1000.0), (5.5e5, 0.0))]
    pulse = [(330_000.0, 1), (331_500.0, 0)]
    expected = [(0, "low"), (100, "1000 Hz"), (330, "high"), (331.5, "low"), (350, "1000 Hz"), (550, "low")]
    assert said(trace(sorted([*tones, *pulse]))) == said(trace(pulse, waves)) == expected


def test_pulses_of_a_tone_that_interrupts_stretch_or_cut_off_are_no_pulses_of_their_own() -> None:
    tone = square(100_000, 1000, 200)
    tone[201] = (tone[201][0] + 90, 0)
    tone[-1] = (tone[-1][0] - 400, 0)
    assert [what for _, what in said(trace(tone))] == ["low", "1000 Hz", "low"]


def test_frames_of_a_servo_are_frames_whoever_makes_them() -> None:
    widths = [1_000.0] * 50 + [2_000.0] * 50
    by_timer = [Wave(100_000.0, "D1", 50.0, 0.05), Wave(1_090_700.0, "D1", 50.0, 0.1), Wave(2_100_000.0, "D1", 0.0, 0.0)]
    assert said(trace((), by_timer))[:3] == said(trace(frames(100_000, widths)))[:3]
    assert [what for _, what in said(trace((), by_timer))] == ["low", "pulses of 1000 us", "pulses of 2000 us", "low"]
