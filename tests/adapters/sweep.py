"""Measures how interrupts of servos distort timed echoes and decays, over distances, decay times and numbers of servos.

`python -m tests.adapters.sweep [SECONDS]` simulates a program that times both in a loop beside 0 to 8 servos, for so many
seconds at each value (4 by default), and prints for each number of servos the number of readings and the worst one.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence

from robosmi.verify.simulation import DeviceUse
from tests.adapters.bench import Uno

DISTANCES = [3.5, 8.5, 16.5, 33.5, 65.5, 120.5, 240.5, 300.5]
"""Centimetres, each in the middle of the range that a whole number stands for."""
DECAYS = [100, 250, 500, 800, 1200, 2500, 6000, 15000]
"""Decay times in microseconds."""
SERVOS = [8, 9, 10, 11, 12, 13, 5, 6]
USED = ["servo.h/servo_set", "ping.h/ping_cm", *(f"simpletools.h/{name}" for name in ("high", "pause", "rc_time"))]


def told(servos: Sequence[int], seconds: float) -> list[tuple[float, int, int]]:
    """What a program reads beside servos: (milliseconds when it began, decay, centimetres).

    Args:
        servos: pins of servos, each one with a width of its own that changes all the time.
        seconds: for how long each distance and each decay holds.
    """
    moving = " ".join(f"servo_set({pin}, 1000 + (n * {7 + 2 * turn} + {131 * turn}) % 1000);" for turn, pin in enumerate(servos))
    program = f"""
int32_t n;
void setup() {{ Serial.begin(115200); }}
void loop() {{ n++; {moving} uint32_t at = millis(); high(4); pause(1); int32_t us = rc_time(4, 1); int32_t cm = ping_cm(7);
  Serial.print(at); Serial.print(' '); Serial.print(us); Serial.print(' '); Serial.println(cm); pause(n % 7); }}
"""
    steps = range(len(DECAYS))
    devices = [
        DeviceUse("capacitor", {"pin": "D4"}, {"points": [[step * seconds * 1000, DECAYS[step]] for step in steps]}),
        DeviceUse("ranger", {"signal": "D7"}, {"points": [[step * seconds * 1000, DISTANCES[step]] for step in steps]}),
    ]
    trace = Uno().run(program, USED, len(DECAYS) * seconds * 1000, devices)
    lines = [line.split() for line in trace.text.splitlines()[:-1]]
    return [(float(at), int(us), int(cm)) for at, us, cm in lines]


def main(seconds: float = 4) -> None:
    """Print a row for each number of servos."""
    print("servos  readings  beyond max(1 %, 8 us)  worst us (of)  centimetres off: readings")
    for number in range(9):
        off, far, worst, readings = Counter[int](), 0, (0.0, 0), 0
        for at, us, cm in told(SERVOS[:number], seconds):
            step, into = divmod(at, seconds * 1000)
            if into > seconds * 1000 - 100:
                continue  # the values change next
            decay = DECAYS[int(step)]
            readings += 1
            far += abs(us - decay) > max(8, decay / 100)
            worst = max(worst, (abs(us - decay), decay))
            off[cm - int(DISTANCES[int(step)])] += 1
        print(f"{number}  {readings}  {far}  {worst[0]:.0f} ({worst[1]})  {dict(sorted(off.items()))}", flush=True)


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
