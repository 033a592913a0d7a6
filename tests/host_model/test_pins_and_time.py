"""propeller.h and simpletools.h: pins, time, timed inputs and outputs, waves, cogs.

What is expected is what the sources do: libsimpletools, Simple-Libraries 1cc167c10; propeller.h and cog.h, propgcc b280e7a77.
"""

from __future__ import annotations

from itertools import pairwise

import pytest

from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.host_model.bench import run, said
from tests.tools import require_tools


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def seen(statements: str, milliseconds: float = 500, devices: tuple[DeviceUse, ...] = (), before: str = "") -> PinTrace:
    """The trace of a main with these statements."""
    found = run(f"#include <simpletools.h>\n{before}\nint main() {{ {statements} while (1) pause(100); }}", milliseconds, devices)
    assert found.status == "running", found.cause
    return found.trace


def levels(trace: PinTrace, pin: str) -> list[int | str]:
    return [level for _, level in trace.levels(pin)]


def test_high_low_and_input_set_latch_and_direction() -> None:  # high.c, low.c, input.c
    trace = seen(
        "high(5); pause(20); low(5); pause(10); input(5); pause(5); set_direction(5, 1); high(5); input(5); set_direction(5, 1);"
    )
    assert levels(trace, "P5") == [1, 0, "z", 0, 1, "z", 1]  # the latch is kept while the pin is an input
    assert trace.pulses("P5")[0][1] == pytest.approx(20_000, rel=0.01)


def test_toggle_reverse_and_the_registers_of_the_cog() -> None:  # toggle.c (makes an output), reverse.c, getOutput.c
    calls = ("toggle(5)", "toggle(5)", "get_direction(5)", "get_output(5)", "reverse(5)", "get_direction(5)", "reverse(6)")
    assert "".join(said("".join(f'print("%d ", {call});' for call in calls), 10)) == "1010001"


def test_input_returns_the_state_of_the_pin() -> None:  # input.c, getState.c
    use = DeviceUse("levels", {"pin": "P3"}, {"points": [[0, 1], [15, 0]]})
    assert said('print("%d%d ", input(3), get_state(3)); pause(20); print("%d%d ", input(3), get_state(4));', 100, [use]) == [
        "11",
        "00",
    ]


def test_ranges_of_pins_in_either_order() -> None:  # setOutputs.c: the pattern is not cut to the range
    trace = seen(
        "set_directions(6, 4, 0b111); set_outputs(4, 6, 0b101); pause(1); set_outputs(6, 4, 0b1010); set_directions(7, 7, 1);"
    )
    assert [levels(trace, pin)[-1] for pin in ("P4", "P5", "P6", "P7")] == [0, 1, 0, 1]
    uses = [DeviceUse("levels", {"pin": f"P{pin}"}, {"points": [[0, level]]}) for pin, level in ((0, 1), (1, 0), (2, 1))]
    assert said('print("%d %d", get_states(2, 0), get_states(0, 1));', 10, uses) == ["5", "1"]


def test_the_registers_are_what_is_read_and_written() -> None:  # cog.h: registers of the cog, pins are the OR of all cogs
    before = "void other(void *p) { DIRA = 2; OUTA = 2; while (1) pause(1); }"
    trace = seen(
        "OUTA |= 1 << 4; DIRA |= 1 << 4; OUTA ^= 1 << 4; OUTA = 0; cog_run(other, 40); pause(1); DIRA |= 2; OUTA &= ~2; "
        "pause(1);",
        before=before,
    )
    assert levels(trace, "P4") == [1, 0]
    assert levels(trace, "P1") == [0, 1]
    assert said('print("%d ", INA & 1); DIRA = 1; OUTA = 1; print("%d %d", INA & 1, CNT - CNT < 1000 || 1);', 10)[:2] == [
        "0",
        "1",
    ]


def test_time_goes_by_the_counter() -> None:  # propeller.h: 80 MHz; pause.c counts by st_pauseTicks
    words = said(
        'unsigned t = CNT; pause(7); unsigned took = CNT - t; print("%d %d ", took / 8000, CLKFREQ); t = CNT; waitcnt(t + '
        "CLKFREQ / 100); "
        'print("%d ", (CNT - t) / 8000); set_pause_dt(8000); t = CNT; pause(10); print("%d ", (CNT - t) / 8000); '
        'mark(); print("%d ", timeout(1000)); pause(20); print("%d ", timeout(1000)); t = CNT; mark(); wait(3000); '
        'print("%d", (CNT - t) / 8000);'
    )
    assert words == ["70", "80000000", "100", "10", "0", "1", "30"]


def test_waitcnt_with_a_target_that_is_past_waits_until_the_counter_comes_round() -> None:
    assert seen("waitcnt(CNT - 100); high(5);", 53_600).levels("P5") == []
    assert seen("waitcnt(CNT - 100); high(5);", 53_800).levels("P5")[0][0] == pytest.approx(2**32 / 80, rel=0.0001)


def test_waitpeq_and_waitpne() -> None:
    use = DeviceUse("levels", {"pin": "P3"}, {"points": [[0, 0], [20, 1], [50, 0]]})
    trace = seen("waitpeq(1 << 3, 1 << 3); high(5); waitpne(1 << 3, 1 << 3); low(5);", 100, (use,))
    assert [at for at, _ in trace.levels("P5")] == pytest.approx([20_000, 50_000], abs=30)


@pytest.mark.parametrize("state", [0, 1])
def test_pulse_in_measures_the_next_whole_pulse(state: int) -> None:  # pulseIn.c
    points = [[0, state], [10, 1 - state], [30, state], [31.234, 1 - state]]
    use = DeviceUse("levels", {"pin": "P3"}, {"points": points})
    assert said(f'print("%d", pulse_in(3, {state}));', 600, [use]) == ["1234"]


def test_pulse_in_gives_up_after_a_quarter_of_a_second() -> None:
    assert said('unsigned t = CNT; int w = pulse_in(3, 1); print("%d %d", w, (CNT - t) / 80000);') == ["0", "250"]
    use = DeviceUse("levels", {"pin": "P3"}, {"points": [[0, 0], [100, 1]]})
    partial = int(said('print("%d", pulse_in(3, 1));', 600, [use])[0])
    assert partial == pytest.approx(150_000, abs=200)
    assert said('set_io_timeout(CLKFREQ / 100); set_io_dt(8); print("%d", pulse_in(3, 1));', 600, [
        DeviceUse("levels", {"pin": "P3"}, {"points": [[0, 0], [2, 1], [3, 0]]})]) == ["10000"]  # fmt: skip


@pytest.mark.parametrize("us", [10, 1500, 20_000])
def test_pulse_out_inverts_the_latch_and_keeps_the_pin_an_output(us: int) -> None:  # pulseOut.c
    trace = seen(f"low(5); pause(1); pulse_out(5, {us}); pause(30); high(6); pause(1); pulse_out(6, {us});", 300)
    assert [width for _, width in trace.pulses("P5")] == [pytest.approx(us)]
    assert levels(trace, "P5")[-1] == 0
    low = trace.levels("P6")
    assert [level for _, level in low] == [1, 0, 1]
    assert low[2][0] - low[1][0] == pytest.approx(us)


def test_rc_time_measures_the_decay_of_a_capacitor() -> None:  # rcTime.c
    use = DeviceUse("capacitor", {"pin": "P7"}, {"points": [[0, 3000]]})
    words = said('high(7); pause(1); print("%d ", rc_time(7, 1)); unsigned t = CNT; int w = rc_time(7, 0); print("%d %d", '
        'w / 1000, (CNT - t) / 80000);',
                 800, [use])  # fmt: skip
    assert words == ["3000", "250", "250"]


def test_freqout_blocks_and_leaves_an_input() -> None:  # freqout.c
    trace = seen("freqout(4, 100, 3000); high(5); freqout(4, 1, 38000);")
    assert [(wave.pin, round(wave.hz), wave.duty) for wave in trace.waves] == [
        ("P4", 3000, 0.5),
        ("P4", 0, 0),
        ("P4", 38000, 0.5),
        ("P4", 0, 0),
    ]
    assert trace.waves[1].at_us - trace.waves[0].at_us == pytest.approx(100_000, rel=0.001)
    assert trace.waves[3].at_us - trace.waves[2].at_us == pytest.approx(1000, abs=20)
    assert trace.levels("P5")[0][0] == pytest.approx(100_000, rel=0.001)
    assert levels(trace, "P4")[-1] == "z"


def test_a_device_at_the_pin_sees_the_edges_of_a_wave() -> None:
    use = DeviceUse("levels", {"pin": "P4"}, {"points": []})
    trace = seen("freqout(4, 10, 1000);", 50, (use,))
    begins = [at for at, _ in trace.pulses("P4")]
    assert len(begins) == 10
    assert [late - early for early, late in pairwise(begins)] == pytest.approx([1000] * 9, abs=1)


def test_count_counts_rising_edges() -> None:  # count.c
    points = [[turn, turn % 2] for turn in range(60)]
    use = DeviceUse("levels", {"pin": "P3"}, {"points": points})
    assert said('print("%d", count(3, 40));', 100, [use]) == ["20"]


def test_square_waves_go_on_in_the_background_on_two_channels() -> None:  # squareWave.c; a negative pin means off
    trace = seen(
        "square_wave(4, 0, 440); square_wave(5, 1, 2); pause(600); square_wave(-4, 0, 0); pause(100); square_wave_stop();", 1000
    )
    assert [(round(wave.hz), round(wave.at_us / 1e5)) for wave in trace.waves if wave.pin == "P4"] == [(440, 0), (0, 6)]
    assert next(width for _, width in trace.pulses("P5")) == pytest.approx(250_000, rel=0.01)  # slow ones are seen edge by edge
    assert levels(trace, "P5")[-1] == "z"


def test_pwm_and_duty_in_the_background() -> None:  # pwm.c, dac.c
    trace = seen(
        "pwm_start(10000); pwm_set(4, 0, 2500); pwm_set(5, 1, 7500); pause(95); pwm_stop(); dac_ctr(26, 0, 64); pause(50); "
        "dac_ctr_stop();",
        300,
    )
    assert [width for _, width in trace.pulses("P4")][:8] == pytest.approx([2500] * 8, abs=1)
    assert [width for _, width in trace.pulses("P5")][:8] == pytest.approx([7500] * 8, abs=1)
    assert [(wave.pin, wave.duty) for wave in trace.waves] == [("P26", 0.25), ("P26", 0)]


@pytest.mark.parametrize(("mode", "value"), [("MSBFIRST", 0b10110010), ("LSBFIRST", 0b01001101)])
def test_shift_out_clocks_bits(mode: str, value: int) -> None:  # shiftOut.c: data before the clock's pulse
    trace = seen(f"shift_out(2, 3, {mode}, 8, 0b10110010);", 10)
    data, bits = trace.levels("P2"), []
    for rise, _ in trace.pulses("P3"):
        bits.append([level for at, level in data if at <= rise][-1])
    assert int("".join(map(str, bits)), 2) == value


@pytest.mark.parametrize(("mode", "value"), [("MSBPRE", 0x80 | 0x7), ("MSBPOST", 0x0F)])
def test_shift_in_samples_before_or_after_the_clocks_pulse(mode: str, value: int) -> None:  # shiftIn.c
    device = DeviceUse(
        "serial_registers", {"select": "P9", "clock": "P3", "data_in": "P4", "data_out": "P2"}, {"content": [0x0F], "step": True}
    )
    # the device gives the next bit at the falling edge: read before the pulse, the first one is the bit that was given last
    words = said(f'high(9); low(9); shift_out(4, 3, MSBFIRST, 8, 0x80); print("%d", shift_in(2, 3, {mode}, 8));', 50, [device])
    assert words == [str(0x0F if mode == "MSBPRE" else 0x1E)]
    assert value  # the register holds 0x0F: read after the pulse, each bit is the one that follows


def test_cogs_run_side_by_side_and_are_eight() -> None:  # cogrun.c, cogend.c, cognum.c
    before = "volatile int n; void other(void *p) { n++; while (1) pause(100); }\nvoid once(void *p) { n++; }"
    words = said(
        'int *c[8]; for (int i = 0; i < 8; i++) c[i] = cog_run(other, 20); pause(5); print("%d %d %d ", n, c[6] != 0, c[7] '
        "== 0); "
        'print("%d ", cog_num(c[0])); for (int i = 0; i < 7; i++) cog_end(c[i]); cog_run(once, 10); pause(5); print("%d '
        '%d", n, cogid());',
        before=before,
    )
    assert words == ["7", "1", "1", "1", "8", "0"]


def test_locks_are_eight() -> None:
    calls = (
        "locknew()",
        "locknew()",
        "lockset(0)",
        "lockset(0)",
        "lockclr(0)",
        "lockclr(0)",
        *["locknew()"] * 7,
        "(lockret(3), locknew())",
    )
    words = said("".join(f'print("%d ", {call});' for call in calls))
    assert words == ["0", "1", "0", "-1", "-1", "0", "2", "3", "4", "5", "6", "7", "-1", "3"]


def test_counters_of_the_cog_are_simulated() -> None:
    trace = seen("CTRA = 4 << 26 | 6; FRQA = 1; PHSA = 0; DIRA |= 1 << 6; PHSA = -80000; pause(5);", 50)
    assert [width for _, width in trace.pulses("P6")] == [pytest.approx(1000)]
    use = DeviceUse("levels", {"pin": "P3"}, {"points": [[0, 0], [10, 1], [13, 0]]})
    assert said('CTRB = 8 << 26 | 3; FRQB = 1; PHSB = 0; pause(20); print("%d", PHSB / 80);', 100, [use]) == ["3000"]


def test_threads_are_cogs() -> None:  # propgcc, lib/pthread
    before = """#include <pthread.h>
pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
pthread_cond_t ready;
int shared;
void *add(void *p) { for (int i = 0; i < 50; i++) { pthread_mutex_lock(&lock); int n = shared; pause(1); shared = n + 1;
  pthread_mutex_unlock(&lock); } return (void *)((int)p * 2); }
void *wait_for_it(void *p) { pthread_mutex_lock(&lock); pthread_cond_wait(&ready, &lock); shared = -1;
  pthread_mutex_unlock(&lock); pthread_exit((void *)7); return 0; }
"""
    words = said(
        "pthread_t a, b; void *x, *y; pthread_create(&a, 0, add, (void *)4); pthread_create(&b, 0, add, (void *)5); "
        "pthread_join(a, &x); "
        'pthread_join(b, &y); print("%d %d %d ", (int)x, (int)y, shared); pthread_create(&a, 0, wait_for_it, 0); pause(5); '
        'print("%d ", shared); pthread_cond_signal(&ready); pthread_join(a, &x); print("%d %d", shared, (int)x);',
        before=before,
    )
    assert words == ["8", "10", "100", "100", "-1", "7"]
