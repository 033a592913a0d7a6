"""time.h, sys/time.h and sys/unistd.h: ticks, the time of day, waiting. Semantics of the sources of propgcc b280e7a77."""

from __future__ import annotations

import pytest

from tests.adapters.bench import Uno, proves

SAY = "void say(int32_t number) { Serial.print(number); Serial.print(' '); }"
CLOCKS = ["time.h/clock", "time.h/time", "time.h/difftime", "sys/time.h/gettimeofday", "sys/time.h/settimeofday"]


@proves(*CLOCKS)
def clocks_tell_ticks_and_seconds(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); timeval now, later; clock_t begun = c_clock(); delay(30);
  say((c_clock() - begun) / (CLOCKS_PER_SEC / 1000));
  say(CLK_TCK == CLOCKS_PER_SEC); delay(1000); say(gettimeofday(&now, 0)); say(now.tv_sec); say(now.tv_usec / 1000); time_t t = 9;
  say(c_time(&t)); say(t); say(c_time(0)); now.tv_sec = 4000000000UL; now.tv_usec = 5; say(settimeofday(&now, NULL)); delay(1250);
  gettimeofday(&later, NULL); say(later.tv_sec - now.tv_sec); say(later.tv_usec / 1000); say(c_time(&t) == 4000000001UL);
  say((int32_t)(c_difftime(10, 4000000000UL) / 1e6)); say((int32_t)c_difftime(t, now.tv_sec)); }}
void loop() {{}}
"""
    used = [*CLOCKS, "time.h/CLOCKS_PER_SEC", "time.h/CLK_TCK", "time.h/time_t", "time.h/clock_t"]
    told = [int(each) for each in uno.run(program, used, 2500).text.split()]
    assert told[:3] == [30, 1, 0]
    assert told[3] == 1
    assert told[4] == pytest.approx(30, abs=3)
    assert told[5:8] == [1, 1, 1]
    assert told[8:10] == [0, 1]
    assert told[10] == pytest.approx(250, abs=2)
    assert told[11:] == [1, -4000, 1]


@proves("sys/unistd.h/sleep", "sys/unistd.h/usleep")
def programs_sleep_seconds_and_microseconds(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); pinMode(7, OUTPUT); digitalWrite(7, HIGH); say(sleep(2)); digitalWrite(7, LOW);
  delay(5); digitalWrite(7, HIGH); int32_t r = usleep(300); digitalWrite(7, LOW); say(r); delay(5);
  digitalWrite(7, HIGH); usleep(45678);
  digitalWrite(7, LOW); }}
void loop() {{}}
"""
    trace = uno.run(program, ["sys/unistd.h/sleep", "sys/unistd.h/usleep"], 2200)
    assert trace.text == "0 0 "
    widths = [width for _, width in trace.pulses("D7")]
    assert widths[0] == pytest.approx(2_000_000, rel=0.001)
    assert widths[1] == pytest.approx(300, abs=16)  # with the time of digitalWrite
    assert widths[2] == pytest.approx(45678, abs=16)
