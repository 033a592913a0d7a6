"""Measures what calls of adapters cost in cycles of an Uno's processor, against plain Arduino code for the same purpose.

`python -m tests.adapters.cost` prints the table. All calls have pins that the compiler knows and are compiled into two programs
with the core; the simulator gives the times of a marked pin, so nothing depends on the machine. The functions are the most used
ones of the Simple Libraries' utilities (simpletools.h, simpletext.h) in the labelled programs, and all others of one pin, as far
as Arduino has calls for the same. `input` makes a pin an input and reads it; the plain code for it only reads.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import NamedTuple

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno

BOUND = 1.2
"""How many times the plain code's cycles a call may take."""
CYCLES = 16
"""Cycles in a microsecond."""


class Call(NamedTuple):
    """A call of an adapter beside plain Arduino code.

    Attributes:
        call: a statement that calls the adapter, with a known pin.
        plain: what an Arduino program has for the same purpose.
        before: what comes before each of them, unmeasured.
        waits: whether it waits, so that interrupts have to stay on.
        header: the header of the adapter.
        asks: whether it asks which pins the program drives, which each call that drives a pin then has to note. It is measured in
            a program with others like it; there, a call that ends the wave of a timer costs a quarter more than plain code.
    """

    call: str
    plain: str
    before: str = ""
    waits: bool = False
    header: str = "simpletools.h"
    asks: bool = False


CALLS: Mapping[str, Call] = {
    "pause": Call("pause(1)", "delay(1)", waits=True),
    "print": Call('print("ready\\n")', 'Serial.print("ready\\r\\n"); Serial.flush()', waits=True, header="simpletext.h"),
    "input": Call("sink = input(7)", "sink = digitalRead(7)"),
    "freqout": Call("freqout(8, 1, 3000)", "tone(8, 3000); delay(1); noTone(8)", waits=True),
    "high": Call("high(8)", "digitalWrite(8, HIGH)"),
    "high, pin with PWM": Call("high(9)", "digitalWrite(9, HIGH)"),
    "low": Call("low(8)", "digitalWrite(8, LOW)"),
    "low, pin with PWM": Call("low(9)", "digitalWrite(9, LOW)"),
    "rc_time": Call(
        "sink = rc_time(2, 1)",
        "pinMode(2, INPUT); uint32_t from = micros(); while (digitalRead(2)) {} sink = micros() - from",
        "while (digitalRead(2)) {} while (!digitalRead(2)) {}",
        waits=True,
    ),
    "pulse_in": Call("sink = pulse_in(2, 1)", "sink = pulseIn(2, HIGH)", "while (digitalRead(2)) {}", waits=True),
    "pulse_out": Call("pulse_out(8, 10)", "digitalWrite(8, HIGH); delayMicroseconds(10); digitalWrite(8, LOW)", waits=True),
    "dac_ctr": Call("dac_ctr(6, 0, 100)", "analogWrite(6, 100)", "dac_ctr(6, 0, 50)"),
    "square_wave": Call("square_wave(8, 0, 3000)", "tone(8, 3000)"),
    "shift_out": Call("shift_out(4, 5, MSBFIRST, 8, 0xA5)", "shiftOut(4, 5, MSBFIRST, 0xA5)"),
    "shift_in": Call("sink = shift_in(4, 5, MSBPRE, 8)", "sink = shiftIn(4, 5, MSBFIRST)"),
    "toggle": Call("toggle(8)", "digitalWrite(8, !digitalRead(8))"),
    "reverse": Call("reverse(4)", "pinMode(4, OUTPUT)", asks=True),
    "get_state": Call("sink = get_state(7)", "sink = digitalRead(7)"),
    "get_output": Call("sink = get_output(8)", "sink = digitalRead(8)"),
    "get_direction": Call("sink = get_direction(8)", "sink = digitalRead(8)", asks=True),
    "set_output": Call("set_output(8, 1)", "digitalWrite(8, HIGH)"),
    "set_direction": Call("set_direction(8, 1)", "pinMode(8, OUTPUT)"),
}
"""Name of a function, with what is special about its call -> the call."""
PROGRAM = """
volatile uint32_t sink;
#define MARK PINB = _BV(5)
%s
void setup() {
  Serial.begin(115200);
  pinMode(13, OUTPUT);
  delay(2);
  %s
}
void loop() {}
"""


class Cost(NamedTuple):
    """The cycles of a call, and those of the plain code."""

    cycles: int
    plain: int

    @property
    def ratio(self) -> float:
        """How many times the plain code's cycles the call takes."""
        return self.cycles / self.plain


@cache
def costs() -> dict[str, Cost]:
    """The costs of all calls: name -> cost."""
    found = [_costs({name: call for name, call in CALLS.items() if call.asks is asks}) for asks in (False, True)]
    return {name: cost for each in found for name, cost in each.items()}


def _costs(calls: Mapping[str, Call]) -> dict[str, Cost]:
    """The costs of calls in one program."""
    statements = [("", "", False)]
    for call in calls.values():
        statements += [(call.before, call.call, call.waits), (call.before, call.plain, call.waits)]
    functions, order = "", ""
    for number, (before, statement, waits) in enumerate(statements):
        begin, end = ("", "") if waits else ("noInterrupts(); ", " interrupts();")
        code = f"{before}; {begin}MARK; {statement}; MARK;{end}"
        functions += f"__attribute__((noinline)) void call{number}() {{ {code} }}\n"
        order += f"call{number}(); Serial.flush(); "
    uses = dict.fromkeys(f"{call.header}/{name.partition(',')[0]}" for name, call in calls.items())
    wave = DeviceUse("levels", {"pin": "D2"}, {"points": [[at, at // 2 % 2] for at in range(0, 400, 2)]})
    trace = Uno().run(PROGRAM % (functions, order), list(uses), 400, [wave])
    nothing, *cycles = [round(width * CYCLES) for _, width in trace.pulses("D13")]
    pairs = zip(cycles[::2], cycles[1::2], strict=True)
    return {name: Cost(call - nothing, plain - nothing) for name, (call, plain) in zip(calls, pairs, strict=True)}


if __name__ == "__main__":
    for name, cost in costs().items():
        print(f"{name:20} {cost.cycles:7} {cost.plain:7} {cost.ratio:6.2f}")
