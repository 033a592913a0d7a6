"""Sensors, converters, serial lines, lights, clocks: what the libraries' sources do (Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from datetime import date, datetime
from itertools import pairwise

import pytest

from robosmi.verify.original_run import HostBench, run_original
from robosmi.verify.simulation import DeviceUse, PinTrace
from tests.host_model.bench import built, ended, original, run, said
from tests.tools import require_tools

SAY = '#define SAY(value) print("%d ", value)\n'


@pytest.fixture(autouse=True)
def _tools() -> None:
    require_tools("gcc", "objcopy")


def numbers(
    header: str, statements: str, milliseconds: float = 1000, devices: list[DeviceUse] | None = None, before: str = ""
) -> list[int]:
    """The numbers that a main with these statements prints."""
    return [int(word) for word in said(statements, milliseconds, devices or [], SAY + before, header)]


def test_a_dht22_is_asked_and_read() -> None:  # dht22.c
    settings = {"humidity": [[0, 65.2]], "celsius": [[0, 35.1], [400, -10.1]]}
    told = numbers(
        "dht22.h",
        "pause(100); SAY(dht22_read(7)); SAY(dht22_getTemp(CELSIUS)); SAY(dht22_getTemp(FAHRENHEIT)); "
            "SAY(dht22_getTemp(KELVIN)); "
        "SAY(dht22_getHumidity()); unsigned t = CNT; SAY(dht22_read(7)); SAY((CNT - t) / 80000 > 490); "
            "SAY(dht22_getTemp(CELSIUS)); "
        "dht22_set_timeout_ignore(7, 1); t = CNT; dht22_read(7); SAY((CNT - t) / 80000 > 490); SAY(dht22_read(40));",
        2000, [DeviceUse("dht22", {"signal": "P7"}, settings)],
    )  # fmt: skip
    assert told == [1, 351, 951, 3083, 652, 0, 1, -101, 0, 0]  # the checksum of a temperature below 0 is never right
    assert numbers("dht22.h", "SAY(dht22_read(7));") == [0]


def test_keys_of_a_remote_control_are_read() -> None:  # sirc.c
    points = [[10, [4, 1]], [200, [9, 1]], [400, [21, 1]], [600, [106, 11]]]
    told = numbers(
        "sirc.h",
        "SAY(sirc_button(10)); pause(100); SAY(sirc_button(10)); pause(100); SAY(sirc_device(10)); pause(100); "
            "SAY(sirc_code(10, 12)); "
        "sirc_setTimeout(300); pause(100); unsigned t = CNT; SAY(sirc_button(10)); SAY((CNT - t) / 800000); SAY(st_timeout "
            "/ 80000);",
        2000, [DeviceUse("sony_remote", {"signal": "P10"}, {"points": points})],
    )  # fmt: skip
    assert told[:5] == [5, 0, 1, 106 | 11 << 7, -1]
    assert told[5] in (30, 31, 32)
    assert told[6] == 20  # a side effect


def test_a_capacitor_decays_from_where_it_was_charged_last() -> None:
    """The fall that was to come of an earlier charge is void; a charge that has decayed stays so."""
    sense = [DeviceUse("capacitor", {"pin": "P7"}, {"points": [[0, 5000]]})]
    again = "high(7); pause(1); input(7); pause(3); high(7); pause(1); input(7); "
    wait = "waitcnt(CNT + {} * 80); SAY(input(7)); "
    told = numbers("", again + wait.format(4500) + wait.format(1000) + "high(7); low(7); SAY(input(7));", devices=sense)
    assert told == [1, 0, 0]


def test_the_host_model_plays_a_capacitor_as_the_device_does(monkeypatch: pytest.MonkeyPatch) -> None:
    """Charges that are read while they decay, that are renewed or driven away meanwhile, and whose time changes."""
    points = [[20, 700.3], [60, 2500.0], [130, 0.004], [160, 30_000.0]]
    text = (
        '#include "simpletools.h"\nint main() { for (int i = 0; i < 60; i++) { high(7); pause(1); input(7); int n = 0; '
        "while (input(7) && n < 150) { waitcnt(CNT + 800 + 37 * i); n++; } if (i % 7 == 3) low(7); if (i % 5 == 2) input(7); "
        'print("%d %d\\n", n, input(7)); set_direction(6, i & 1); } }'
    )
    devices = [DeviceUse("capacitor", {"pin": "P7"}, {"points": points})]
    answers: list[bytes] = []
    answer = HostBench.answer

    def counted(bench: HostBench, value: int = 0) -> bytes:
        answers.append(answer(bench, value))
        return answers[-1]

    monkeypatch.setattr(HostBench, "answer", counted)
    with built(text) as program:
        played = run_original(program, 800_000, devices)
        assert len(answers) < 5
        monkeypatch.delattr(HostBench, "emulates_capacitor")
        asked = run_original(program, 800_000, devices)
    assert played.status == asked.status == "finished"
    assert played.trace == asked.trace
    assert len({line.split()[0] for line in played.trace.text.splitlines()}) > 10


def test_echoes_of_a_ranger_come_and_go_on_time() -> None:
    far = [DeviceUse("ranger", {"signal": "P3"}, {"points": [[0, 100], [500, 200]]})]
    assert numbers("ping.h", "SAY(ping(3)); pause(600); SAY(ping(3));", devices=far) == [5800, 11600]


KEYS = "int rows[2] = {4, 5}, columns[3] = {6, 7, 8}, values[6] = {1, 2, 3, 'A', 'B', 'C'};\n"
KEY_PINS = {"row0": "P4", "row1": "P5", "column0": "P6", "column1": "P7", "column2": "P8"}


def test_keys_that_are_held_are_found() -> None:  # keypad.c
    points = [[0, None], [25, [0, 1]], [75, [1, 2]], [125, [0, 2]]]
    told = numbers(
        "keypad.h",
        "keypad_setup(2, 3, rows, columns, values); for (int i = 0; i < 4; i++) { SAY(keypad_read()); SAY(keypad_readFrom(2)); "
        "SAY(keypad_readFrom('B')); pause(45); }",
        1000, [DeviceUse("keypad", KEY_PINS, {"points": points})], KEYS,
    )  # fmt: skip
    assert told == [-1, -1, -1, 2, -1, -1, ord("C"), ord("C"), ord("C"), 3, 3, -1]


def test_numbers_are_keyed_in() -> None:  # getNumber.c
    points = [[0, None], [10, [0, 1]], [30, None], [40, [0, 1]], [60, None], [70, [0, 0]], [90, None], [100, [1, 1]], [120, None]]
    text = ended(
        f'#include "keypad.h"\n{KEYS}int main() {{ keypad_setup(2, 3, rows, columns, values); int n = keypad_getNumber(); '
        'print("=%d %d", n, keypad_getNumberEndKey()); }',
        1000, [DeviceUse("keypad", KEY_PINS, {"points": points})],
    ).text  # fmt: skip
    assert text == f"221 B =221 {ord('B')}"


def test_only_the_first_changes_of_brief_pins_are_recorded() -> None:
    keypad = DeviceUse("keypad", KEY_PINS, {"points": [[100, [0, 1]], [300, None]]})
    lamp = DeviceUse("sony_remote", {"signal": "P10"}, {"points": []})
    text = (
        f'#include "simpletools.h"\n#include "keypad.h"\n{KEYS}int main() {{ keypad_setup(2, 3, rows, columns, values); '
        "high(10); low(10); high(10); keypad_getNumber(); }"
    )
    with built(text) as program:
        whole, brief = (run_original(program, 500_000, [keypad, lamp], brief=pins) for pins in ((), (*KEY_PINS.values(), "P10")))
    assert whole.trace.text == brief.trace.text == "2"
    assert whole.counts == brief.counts
    assert len(whole.trace.changes) > 5000
    at_keys = [(change.pin, change.level) for change in brief.trace.changes if change.pin != "P10"]
    assert sorted(set(at_keys), key=str) == sorted(at_keys, key=str)
    assert {pin for pin, _ in at_keys} == set(KEY_PINS.values())
    assert whole.trace.levels("P10") == brief.trace.levels("P10")  # where a device looks at them
    assert [level for _, level in brief.trace.levels("P10")] == [1, 0, 1]


@pytest.mark.parametrize(("header", "name"), [("adcDCpropab.h", "adc"), ("abvolts.h", "ad")])
def test_voltages_are_converted_to_12_bits_of_5_volts(header: str, name: str) -> None:  # adcDCpropab.c, abvolts.c
    uses = [
        DeviceUse("voltages", {"pin": f"AD{channel}"}, {"points": [[0, mv]]}) for channel, mv in enumerate((0, 2500, 3300, 6000))
    ]
    told = said(
        f'{name}_init(21, 20, 19, 18); for (int i = 0; i < 4; i++) print("%d %.3f ", {name}_in(i), {name}_volts(i));',
        1000,
        uses,
        headers=header,
    )
    assert told == ["0", "0.000", "2048", "2.500", "2703", "3.300", "4095", "4.999"]


def duty(trace: PinTrace, pin: str, at_ms: float) -> float:
    """The duty cycle at a pin at a time."""
    return next(wave.duty for wave in reversed(trace.waves) if wave.pin == pin and wave.at_us <= at_ms * 1000)


def test_mean_voltages_are_put_out() -> None:  # abvoltsDA.c, daVolts.c
    trace = run(
        '#include <simpletools.h>\n#include "abvolts.h"\nint main() { da_out(0, 64); da_volts(1, 1.65); pause(20); '
            'da_init(5, 3); da_res(10); '
        "da_out(0, 256); da_volts(1, 0.33); pause(20); da_volts(1, 5.0); while (1) pause(20); }", 100,
    ).trace  # fmt: skip
    assert [duty(trace, "P26", 10), duty(trace, "P27", 10)] == pytest.approx([0.25, 0.5], abs=0.001)
    assert [duty(trace, "P5", 30), duty(trace, "P3", 30)] == pytest.approx([0.25, 0.1], abs=0.001)
    assert duty(trace, "P3", 50) == pytest.approx(1, abs=0.001)


def test_a_scale_for_voltages_is_measured_and_kept() -> None:  # daCalibrate.c, getScale.c
    uses = [DeviceUse("voltages", {"pin": pin}, {"points": [[0, 3400]]}) for pin in ("AD0", "AD1")]
    trace = run(
        '#include <simpletools.h>\n#include "abvolts.h"\nint main() { da_setupScale(); da_volts(0, 1.0); while (1) pause(20); }',
        500,
        uses,
    ).trace
    assert duty(trace, "P26", 499) == pytest.approx(3.3 / 3.4 / 3.3, abs=0.004)
    assert len(trace.stored) == 16


def test_two_channels_have_mean_voltages() -> None:  # dac2ch.c
    trace = run(
        '#include <simpletools.h>\n#include "dac2ch.h"\nint main() { dac2ch *a = dac2ch_start(8), *b = dac2ch_start(10); '
            'dac2ch_set(a, 5, 0, 64); '
        "dac2ch_set(b, 6, 1, 512); pause(10); dac2ch_set(a, 5, 0, -1); dac2ch_set(b, 3, 1, 768); pause(10); "
            "dac2ch_stop(b); while (1) pause(9); }", 40,
    ).trace  # fmt: skip
    assert [duty(trace, "P5", 9), duty(trace, "P6", 9), duty(trace, "P3", 19)] == pytest.approx([0.25, 0.5, 0.75])
    assert [trace.levels(pin)[-1][1] for pin in ("P3", "P5", "P6")] == ["z"] * 3


def test_two_pins_get_pulses_in_a_common_cycle() -> None:  # pwm2ch.c
    trace = run(
        '#include <simpletools.h>\n#include "pwm2ch.h"\nint main() { pwm2ch *d = pwm2ch_start(2000); pwm2ch_set(d, 5, 0, 500); '
        "pwm2ch_set(d, 6, 1, 1500); pause(21); pwm2ch_set(d, 7, 0, 100); pwm2ch_set(d, 6, 1, -1); pause(20); "
            "pwm2ch_stop(d); pause(20); }", 100,
    ).trace  # fmt: skip
    starts = [at for at, _ in trace.pulses("P5")]
    assert [late - early for early, late in pairwise(starts)] == pytest.approx([2000] * (len(starts) - 1))
    assert [width for _, width in trace.pulses("P5")] == pytest.approx([500] * 10)
    assert [width for _, width in trace.pulses("P6")] == pytest.approx([1500] * 10)
    assert [width for _, width in trace.pulses("P7")] == pytest.approx([100] * 10)
    assert [trace.levels(pin)[-1][1] for pin in ("P5", "P6", "P7")] == ["z"] * 3


def test_milliseconds_are_counted() -> None:  # mstimer.c
    told = numbers(
        "mstimer.h",
        "mstime_set(7); SAY(mstime_get()); mstime_start(); pause(25); SAY(mstime_get()); mstime_set(1000); pause(20); "
        "SAY(mstime_get()); "
        "mstime_stop(); pause(10); SAY(mstime_get()); mstime_reset(); SAY(mstime_get());",
    )
    assert told[0] == 7
    assert told[1:4] == pytest.approx([32, 1020, 1020], abs=1)
    assert told[4] == 0


def test_clocks_know_the_calendar() -> None:  # datetime.c, dt_*.c, dte_*.c
    days = [(1970, 1, 1), (2000, 2, 29), (2026, 11, 22), (2037, 12, 31)]
    known = "".join(
        f"SAY(dte_toJD({y}, {m}, {d})); SAY(dte_toCal(dte_toJD({y}, {m}, {d})) == ({y} << 16 | {m} << 8 | {d})); "
        for y, m, d in days
    )
    before = 'char s[12]; void tell() { dt_toDateStr(dt_get(), s); print("%s ", s); dt_toTimeStr(dt_get(), s); print("%s ", s); }'
    told = said(
        'datetime none = {0, 0, 0, 0, 0, 0}; datetime dt = dt_fromTimeStr(dt_fromDateStr(none, "12/31/99"), "23:59:58"); '
            'SAY(dt_toEt(dt)); '
        'SAY(dt_fromEt(951868799).d); SAY(dte_timeETV(45296)); dt_run(dt); pause(2300); SAY(dt_getms()); tell(); '
            'dt_set(dt_fromDateStr(dt_get(), '
        f'"02/28/28")); pause(900); tell(); {known} cogstop(1);', 5000, before=SAY + before, headers="datetime.h",
    )  # fmt: skip
    last = int((datetime(1999, 12, 31, 23, 59, 58) - datetime(1970, 1, 1)).total_seconds())
    assert told[:3] == [str(last), "29", str(12 << 16 | 34 << 8 | 56)]
    assert int(told[3]) == pytest.approx(300, abs=3)
    assert told[4:8] == ["01/01/00", "00:00:00", "02/28/28", "00:00:01"]
    assert [int(each) for each in told[8::2]] == [(date(*day) - date(1970, 1, 1)).days + 2440588 for day in days]
    assert told[9::2] == ["1"] * 4


def test_bytes_go_both_ways_on_a_serial_line_with_buffers() -> None:  # fdserial.c, fdserial_utils.c
    use = DeviceUse("serial_line", {"receive": "P10", "transmit": "P11"}, {"baud": 9600, "points": [[600, "hello"]]})
    trace = ended(
        f'#include <simpletools.h>\n#include "fdserial.h"\n{SAY}int main() {{ unsigned t = CNT; fdserial *s = '
            f'fdserial_open(10, 11, 0, 9600); '
        "SAY((CNT - t) / 80000); SAY(fdserial_txChar(s, 'A')); fdserial_txChar(s, 200); t = CNT; SAY(fdserial_rxTime(s, "
            "20)); SAY((CNT - t) / 80000); "
        "SAY(fdserial_rxCheck(s)); SAY(fdserial_rxPeek(s)); SAY(fdserial_rxReady(s)); SAY(fdserial_rxChar(s)); pause(20); "
            "SAY(fdserial_rxReady(s)); "
        "SAY(fdserial_rxCount(s)); SAY(fdserial_rxPeek(s)); SAY(fdserial_rxCheck(s)); SAY(fdserial_rxTime(s, 20)); "
            "fdserial_rxFlush(s); "
        "SAY(fdserial_rxCount(s)); fdserial_close(s); }", 2000, [use],
    )  # fmt: skip
    told = [int(word) for word in trace.text.split()]
    assert told[0] == pytest.approx(500, abs=2)
    assert told[1:3] == [-1, -1]
    assert told[3] == pytest.approx(21, abs=1)
    assert told[4:] == [-1, 0, 0, ord("h"), 1, 4, ord("e"), ord("e"), ord("l"), 0]
    assert [(event.what, event.value) for event in trace.device_events if event.device == 0] == [
        ("byte", ord("A")),
        ("byte", 200),
    ]


def test_the_console_is_a_serial_line_too() -> None:
    trace = ended(
        '#include <simpletools.h>\n#include "fdserial.h"\nint main() { fdserial *s = fdserial_open(31, 30, 0, 9600); '
            'dprint(s, "abc%d\\n", 5); '
        "fdserial_txFlush(s); high(8); int c = fdserial_rxChar(s); fdserial_txChar(s, c); fdserial_close(s); }", 2000,
        [DeviceUse("typing", {}, {"points": [[800, "x"]]})],
    )  # fmt: skip
    assert trace.text == "abc5\rx"
    assert trace.levels("P8")[0][0] == pytest.approx(500_000 + 4 * 10 / 9600 * 1e6, abs=1500)


def test_lights_get_their_colours_bit_by_bit() -> None:  # ws2812*.c
    trace = run(
        '#include <simpletools.h>\n#include "ws2812.h"\nuint32_t colors[3] = {COLOR_ORANGE, COLOR(1, 2, 3), COLOR_BLACK};\n'
        "int main() { ws2812 *a = ws2812_open(), *b = ws2812b_open(); ws2812_set(a, 6, colors, 2); pause(2); ws2812_set(b, "
            "7, colors, 1); "
        "ws2812_set(b, 7, colors + 1, 1); pause(3); ws2812_close(b); while (1) pause(9); }", 20,
    ).trace  # fmt: skip

    def sent(pin: str, split_us: float) -> list[int]:
        bits = "".join("1" if width > split_us else "0" for _, width in trace.pulses(pin))
        return [int(bits[at : at + 24], 2) for at in range(0, len(bits), 24)]

    assert sent("P6", 0.6) == [0x60FF00, 0x020103]  # green goes first
    assert sent("P7", 0.4) == [0x60FF00, 0x020103]
    assert {round(width, 3) for _, width in trace.pulses("P6")} == {0.35, 0.7}
    rises = [at for at, _ in trace.pulses("P7")]
    assert rises[24] - rises[23] > 300


def test_a_wheel_of_colours() -> None:  # ws2812_wheel.c
    told = said('int p[] = {0, 10, 85, 100, 170, 255}; for (int i = 0; i < 6; i++) print("%x %x ", ws2812_wheel(p[i]), '
        'ws2812_wheel_dim(p[i], 64));',
                headers="ws2812.h")  # fmt: skip
    assert [int(word, 16) for word in told[::2]] == [0xFF0000, 0xE11E00, 0x00FF00, 0x00D22D, 0x0000FF, 0xFF0000]
    assert int(told[3], 16) == (225 * 64 // 255) << 16 | (30 * 64 // 255) << 8


# simplei2c.c, i2c_out.c, i2c_in.c: the answer counts acknowledged bytes
def test_the_bus_reaches_devices_by_their_address() -> None:
    use = DeviceUse("registers", {}, {"address": 0x1D, "content": list(range(64))})
    told = numbers(
        "",
        "unsigned char d[4] = {9, 8, 7, 6}; i2c *b = i2c_newbus(3, 4, 0); SAY(i2c_busy(b, 0x1D)); SAY(i2c_busy(b, 0x22) != 0); "
        "SAY(i2c_in(b, 0x1D, 16, 1, d, 3)); SAY(d[0]); SAY(d[2]); SAY(i2c_out(b, 0x1D, 32, 1, d, 2)); SAY(i2c_in(b, 0x1D, "
            "32, 1, d, -2)); "
        "SAY(d[0]); SAY(d[1]); SAY(i2c_out(b, 0x22, 0, 1, d, 2));",
        1000, [use],
    )  # fmt: skip
    assert told == [0, 1, 5, 16, 18, 4, 4, 17, 16, 0]


TWO_BUSES = """
#include "simpletools.h"
i2c *bus;
int stack[100];
volatile int asked;

void ask(void *unused) {
  for (unsigned char byte;; asked += byte == 7) i2c_in(bus, 0x69, 0x28, 1, &byte, 1);
}

int main() {
  unsigned char set = 0x1F;
  bus = i2c_newbus(5, 4, 0);
  i2c_out(bus, 0x69, 0x20, 1, &set, 1);
  cogstart(ask, 0, stack, sizeof stack);
  for (int n = 0; n < 20; n++) {
    ee_putInt(0x01020304 * n, 32768 + 4 * n);
    if (ee_getInt(32768 + 4 * n) != 0x01020304 * n) print("%d is lost", n);
  }
  print(asked > 100 ? "asked" : "not asked");
}
"""


def test_two_buses_at_other_pins_do_not_meet() -> None:  # a cog asks a sensor while main writes the EEPROM
    use = DeviceUse("registers", {}, {"address": 0x69, "content": [0] * 0x28 + [7]})
    seen = run(TWO_BUSES, 1000, [use]).trace
    assert seen.text == "asked"
    assert [event.value for event in seen.device_events if event.device == 0] == [[0x20, 0x1F]]


def test_another_memory_on_other_pins_may_have_the_address_of_the_boards_own() -> None:
    text = """
#include "simpletools.h"
int main() {
  unsigned char out[] = {7, 8}, in[2];
  i2c *bus = i2c_newbus(10, 11, 0);
  i2c_out(bus, 0x50, 0x8000, 2, out, 2);
  while (i2c_busy(bus, 0x50)) pause(1);
  ee_putByte(9, 0x8000);
  i2c_in(bus, 0x50, 0x8000, 2, in, 2);
  print("%d %d %d", in[0], in[1], ee_getByte(0x8000));
}"""
    memory = [DeviceUse("eeprom", {}, {"address": 0x50})]
    with original(text) as program:
        trace = program.with_store_bytes(0).run(500_000, memory).trace  # no port of it is on the board's own memory
        shared = program.run(500_000, memory).trace  # it may be: then what the scenario connects takes the place of that memory
    assert trace.text == "7 8 9"
    assert [event.value for event in trace.device_events] == [[0x8000, 7], [0x8001, 8]]
    assert [(each.address, each.byte) for each in trace.stored] == [(0x8000, 9)]
    assert shared.text == "9 8 9"


def test_the_board_has_an_eeprom_that_is_busy_while_it_writes() -> None:  # eeprom_*.c
    told = said(
        'unsigned t = CNT; ee_putInt(-123456, 32768); print("%d ", (CNT - t) / 80000 >= 5); print("%d ", '
        "ee_getInt(32768)); ee_putByte(200, 40000); "
        'print("%d ", ee_getByte(40000)); ee_putFloat32(1.5, 5000); print("%f ", ee_getFloat32(5000)); unsigned char '
        "s[200], r[200]; "
        'for (int i = 0; i < 200; i++) s[i] = i; ee_putStr(s, 200, 32700); ee_getStr(r, 200, 32700); print("%d %d", '
        "memcmp(s, r, 200), ee_getByte(9));",
        2000,
    )
    assert told == ["1", "-123456", "200", "1.500000", "0", "255"]


def sensor(data_out: str) -> DeviceUse:
    """An accelerometer that holds (500, -250, 866), converter values and an identity."""
    content = [0] * 128
    content[0x0F] = 0x33
    content[0x27] = 0x08
    for register, value in ((0x08, 700), (0x0A, -1016), (0x0C, 40), (0x28, 500), (0x2A, -250), (0x2C, 866)):
        content[register : register + 2] = (value << 4 & 0xFFFF).to_bytes(2, "little")
    return DeviceUse(
        "serial_registers", {"select": "P5", "clock": "P6", "data_in": "P7", "data_out": data_out}, {"content": content}
    )


def test_accelerations_are_read_over_three_wires() -> None:  # liblis3dh
    told = numbers(
        "lis3dh.h",
        "int x, y, z, m; lis3dh *d = lis3dh_init(6, 7, 5); SAY(lis3dh_getWhoAmI(d)); SAY(lis3dh_getRange(d)); "
            "SAY(lis3dh_getResolution(d)); "
        "SAY(lis3dh_accel(d, &x, &y, &z)); SAY(x); SAY(y); SAY(z); SAY(lis3dh_getAccel_mg(d, 2)); SAY(lis3dh_tilt(d, &x, "
            "&y, &z, &m)); SAY(x); "
        "SAY(y); SAY(z); SAY(m); lis3dh_setRange(d, 16); lis3dh_setResolution(d, 10); SAY(lis3dh_getRange(d)); "
            "SAY(lis3dh_getResolution(d)); "
        "SAY(lis3dh_accel_mg(d, &x, &y, &z)); SAY(x); SAY(y); SAY(z); SAY(lis3dh_getAccel(d, 3)); lis3dh_setResolution(d, 8); "
        "SAY(lis3dh_getAccel_mg(d, 1)); lis3dh_setResolution(d, 12); lis3dh_setRange(d, 2); SAY(lis3dh_tiltConfig(d, 101)); "
        "SAY(lis3dh_tiltConfig(d, 50)); lis3dh_shutdown(d); lis3dh_writeByte(d, 0x27, 0); SAY(lis3dh_accel(d, &x, &y, &z));",
        2000, [sensor("P7")],
    )  # fmt: skip
    assert told[:8] == [0x33, 2, 12, 1, 500, -250, 866, -250]
    assert told[8:13] == [1, 29, -14, 32, 30]
    assert told[13:21] == [16, 10, 1, 125 * 48, -63 * 48, 216 * 48, 216, 31 * 192]
    assert told[21:] == [0, 1, 0]


def test_voltages_and_temperatures_are_read_over_four_wires() -> None:  # liblis3dh
    told = numbers(
        "lis3dh.h",
        "int a, b, c; lis3dh_t *d = lis3dh_init4wire(6, 7, 8, 5); lis3dh_adc(d, &a, &b, &c); SAY(a); SAY(b); SAY(c); "
            "SAY(lis3dh_getADC(d, 2)); "
        "lis3dh_adc_mV(d, &a, &b, &c); SAY(a); SAY(b); SAY(c); SAY(lis3dh_getADC_mV(d, 1)); SAY(lis3dh_tempRaw(d)); "
            "lis3dh_tempCal_C(d, 21); "
        "SAY(lis3dh_temp_C(d)); SAY(lis3dh_temp_F(d)); lis3dh_tempCal_F(d, 86); SAY(lis3dh_temp_C(d)); "
            "lis3dh_setADCmode(d, 0, 1); "
        "SAY(lis3dh_readByte(d, 0x1F)); SAY(lis3dh_getSPImode(d)); lis3dh_setSPImode(d, 3); SAY(lis3dh_getSPImode(d)); "
            "SAY(lis3dh_readByte(d, 0x23)); "
        "lis3dh_setBDUmode(d, 1); SAY(lis3dh_readByte(d, 0x23));",
        4000, [sensor("P8")],
    )  # fmt: skip
    first = (700 - 1400) * 7800 // -3432
    assert told[:8] == [700, -1016, 40, -1016, first, 900 + 800 * 3048 // 4064, 900 + 800 * 1992 // 4064, first]
    assert told[8:12] == [12, 21, 69, 31]  # six readings are divided by five; tempCal_F rounds up too often
    assert told[12:] == [0x40, 4, 3, 0x89, 0x09]


def test_clocks_of_the_c_library() -> None:
    told = said(
        'struct timeval v; sleep(1); usleep(500000); gettimeofday(&v, 0); print("%d %d %d %d", time(0), v.tv_sec, '
            'v.tv_usec / 100000, clock() / 8000000);',
        3000, headers="time.h sys/time.h unistd.h",
    )  # fmt: skip
    assert told == ["1", "1", "5", "15"]


def test_the_calendar_of_the_c_library() -> None:
    """The same calls as on the target: its adapters for time.h are judged by them."""
    program = (
        "struct tm now, *then; char text[40]; time_t t; now.tm_sec = 5; now.tm_min = 14; now.tm_hour = 18; now.tm_mday = 22; "
        'now.tm_mon = 10; now.tm_year = 125; t = mktime(&now); then = localtime(&t); print("%d %d %d %d ", t, then->tm_yday, '
        'then->tm_wday, then->tm_isdst); print("%d ", strftime(text, 40, "%A|%e|%I|%j|%V|%G|%p", then)); print("%s ", text); '
        'print("%s", ctime(&t)); t = 951782400; print("%s", asctime(gmtime(&t))); print("%d", strftime(text, 4, "%Y", then));'
    )
    told = said(program, 3000, headers="time.h")
    assert told[:4] == ["1763835245", "325", "6", "-1"]
    assert told[4:6] == ["29", "Saturday|22|06|326|47|2025|PM"]
    assert told[6:] == ["Sat", "Nov", "22", "18:14:05", "2025", "Tue", "Feb", "29", "00:00:00", "2000", "0"]
