"""Timed inputs while something works in the background: servos, drives, servos with feedback, a clock of milliseconds.

Interrupts come between an edge and the look at it, which is then known to half of their time: 12 us for that of Servo.h (20 to
24 us), 22 us where it meets another one, 32 us with signals of feedback. That is stated as a limit of the adapters, and held
here, where 1 % is less.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno, proves

TIMED = ["simpletools.h/pulse_in", "simpletools.h/rc_time", "simpletools.h/count", "ping.h/ping_cm"]
SHORT, LONG = 300.0, 1900.0
BESIDE_INTERRUPTS, BESIDE_FEEDBACK = 22.0, 32.0
DECAY, CENTIMETRES, HALF_PERIOD = 2500.0, 83.5, 0.11
WHEELS = [
    DeviceUse("wheel", {"servo": "D5", "encoder": "A0"}, {}),
    DeviceUse("wheel", {"servo": "D6", "encoder": "A1"}, {"ticks_per_s_per_us": -0.64}),
]
FEEDBACK = [
    DeviceUse("feedback_servo", {"servo": "D5", "feedback": "A0"}, {}),
    DeviceUse("feedback_servo", {"servo": "D6", "feedback": "A1"}, {"degrees": 10.0}),
]
DRIVE = {"abdrive.left_servo": "5", "abdrive.right_servo": "6", "abdrive.left_encoder": "A0", "abdrive.right_encoder": "A1"}


def pulses(width: float, until: float) -> list[list[float]]:
    """Pulses of one width in microseconds at times that repeat nothing."""
    chance, at, points = random.Random(7), 1.0, list[list[float]]([[0, 0]])
    while at < until:
        at += chance.uniform(1.0, 7.0)
        points += [[round(at, 4), 1], [round(at + width / 1000, 4), 0]]
        at += width / 1000
    return points


def inputs(until: float) -> list[DeviceUse]:
    """A device for each of the timed inputs, until so many milliseconds."""
    square = [[round(number * HALF_PERIOD, 4), number % 2] for number in range(int(until / HALF_PERIOD))]
    return [
        DeviceUse("levels", {"pin": "D2"}, {"points": pulses(SHORT, until)}),
        DeviceUse("levels", {"pin": "D3"}, {"points": pulses(LONG, until)}),
        DeviceUse("capacitor", {"pin": "D4"}, {"points": [[0, DECAY]]}),
        DeviceUse("ranger", {"signal": "D7"}, {"points": [[0, CENTIMETRES]]}),
        DeviceUse("levels", {"pin": "D8"}, {"points": square}),
    ]


def beside(
    uno: Uno, begin: str, go_on: str, uses: Sequence[str], devices: Sequence[DeviceUse], most: float, seconds: float
) -> None:
    """Time all inputs in a loop while something else runs in the background.

    Args:
        uno: the bench.
        begin: statements that start the background activity.
        go_on: statements for each round, with its number `n`.
        uses: the adapters of these statements.
        devices: their devices.
        most: greatest error of a time in microseconds where 1 % is less.
        seconds: duration of the run.
    """
    program = f"""
int32_t n, left, right;
void say(int32_t number) {{ Serial.print(number); Serial.print(' '); }}
void setup() {{ Serial.begin(115200); {begin} }}
void loop() {{ say(pulse_in(2, 1)); say(pulse_in(3, 1)); high(4); pause(1); say(rc_time(4, 1)); say(ping_cm(7)); say(count(8, 4));
  Serial.print('\\n'); n++; {go_on} }}
"""
    used = [*TIMED, "simpletools.h/high", "simpletools.h/pause", *uses]
    trace = uno.run(program, used, seconds * 1000, [*inputs(seconds * 1000), *devices])
    told = [[int(each) for each in line.split()] for line in trace.text.splitlines()[1:-1]]
    assert len(told) > 20 * seconds
    true = {"short pulse": SHORT, "long pulse": LONG, "decay": DECAY}
    beyond = {
        (name, value)
        for line in told
        for (name, width), value in zip(true.items(), line, strict=False)
        if abs(value - width) > max(most, width / 100)
    }
    assert beyond == set()
    assert {line[3] for line in told} <= {int(CENTIMETRES), int(CENTIMETRES) + 1}
    edges = 4 / (2 * HALF_PERIOD)
    assert {line[4] for line in told} <= {int(edges) - 1, int(edges), int(edges) + 1}


CLOCK = ["mstimer.h/mstime_start", "mstimer.h/mstime_get"]


@proves(*TIMED, beside=CLOCK)
def timed_inputs_are_true_beside_a_clock_of_milliseconds(uno: Uno) -> None:
    beside(uno, "mstime_start();", "left += mstime_get();", CLOCK, [], 8, 2)


SERVOS = ["servo.h/servo_set", "servo.h/servo_setramp"]


@proves(*TIMED, beside=SERVOS)
def timed_inputs_are_true_beside_servos_that_move(uno: Uno) -> None:
    begin = "servo_set(9, 1500); servo_set(10, 1200); servo_set(11, 1700); servo_setramp(10, 4); servo_setramp(11, 3);"
    go_on = "servo_set(9, 1500 + n % 50 * 8); servo_set(10, n & 32 ? 1000 : 2000); servo_set(11, n & 32 ? 1000 : 2000);"
    beside(uno, begin, go_on, SERVOS, [], BESIDE_INTERRUPTS, 6)


READING = [f"dht22.h/dht22_{name}" for name in ("read", "getTemp", "getHumidity", "set_timeout_ignore")]


@proves(*READING, beside=SERVOS)
def bits_are_read_right_beside_servos_that_move(uno: Uno) -> None:
    program = """
int32_t n;
void setup() { Serial.begin(115200); servo_set(9, 1500); servo_set(10, 1200); servo_set(11, 1700); servo_setramp(10, 4);
  dht22_set_timeout_ignore(7, 1); }
void loop() { servo_set(9, 1500 + n % 50 * 8); servo_set(10, n & 32 ? 1000 : 2000); Serial.print(dht22_read(7) + 0);
  Serial.print(' '); Serial.print(dht22_getTemp(0)); Serial.print(' '); Serial.println(dht22_getHumidity()); pause(n++ % 20); }
"""
    settings = {"humidity": [[0, 51.1]], "celsius": [[0, 21.0]]}
    used = [*READING, *SERVOS, "simpletools.h/pause"]
    trace = uno.run(program, used, 5000, [DeviceUse("dht22", {"signal": "D7"}, settings)])
    told = trace.text.splitlines()[:-1]
    assert len(told) > 55
    assert set(told) == {"1 210 511"}


QUIET = ["ws2812.h/ws2812b_open", "ws2812.h/ws2812_set", "fdserial.h/fdserial_open", "fdserial.h/fdserial_txChar"]


@proves(*QUIET, beside=["servo.h/servo_set"])
def servos_keep_their_widths_beside_lights_and_serial_lines(uno: Uno) -> None:
    """Bits of both are made with interrupts off, at times without an edge of a servo's pulse."""
    program = """
uint32_t colours[20]; ws2812_t *lights; fdserial *line; int32_t n;
void setup() { servo_set(9, 1500); servo_set(10, 1200); servo_set(11, 1700); lights = ws2812b_open();
  line = fdserial_open(-1, 3, 0, 38400); }
void loop() { for (auto &colour : colours) colour = 0x102030 + n % 99; ws2812_set(lights, 4, colours, 20);
  fdserial_txChar(line, 0x33); pause(n++ % 9); }
"""
    trace = uno.run(program, [*QUIET, "servo.h/servo_set", "simpletools.h/pause"], 2500)
    for pin, width in (("D9", 1500.0), ("D10", 1200.0), ("D11", 1700.0)):
        widths = [high for _, high in trace.pulses(pin)]
        assert len(widths) > 115
        assert [high for high in widths if abs(high - width) > width / 100] == []
    bit = 1e6 / 38400
    sent = [high for _, high in trace.pulses("D3") if high < 2.5 * bit]
    assert len(sent) > 200
    assert [high for high in sent if abs(high - 2 * bit) > 1] == []
    bits = "".join("1" if high > 0.6 else "0" for _, high in trace.pulses("D4"))
    pictures = [bits[at : at + 480] for at in range(0, len(bits) - 479, 480)]
    assert len(pictures) > 200
    assert pictures == [f"{0x201030 + number % 99:024b}" * 20 for number in range(len(pictures))]


DRIVING = [f"abdrive.h/drive_{name}" for name in ("goto", "gotoMode", "getTicks", "speed")]


@proves(*TIMED, beside=DRIVING)
def timed_inputs_are_true_while_a_drive_drives(uno: Uno) -> None:
    begin = "drive_gotoMode(0); drive_goto(900, 800);"
    go_on = "drive_getTicks(&left, &right); if (n % 60 == 59) drive_speed(n % 4 * 30, 60 - n % 5 * 10);"
    beside(replace(uno, ports=DRIVE), begin, go_on, DRIVING, WHEELS, BESIDE_INTERRUPTS, 6)


TURNING = [f"servo360.h/servo360_{name}" for name in ("connect", "speed", "angle")]


@proves(*TIMED, beside=TURNING)
def timed_inputs_are_true_beside_servos_with_feedback(uno: Uno) -> None:
    begin = "servo360_connect(5, A0); servo360_connect(6, A1); servo360_speed(5, 180);"
    go_on = "if (n % 30 == 0) servo360_angle(6, n * 3);"
    beside(uno, begin, go_on, TURNING, FEEDBACK, BESIDE_FEEDBACK, 6)
