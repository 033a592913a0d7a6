"""time.h, sys/time.h and sys/unistd.h: ticks, the time of day, waiting. Semantics of the sources of propgcc b280e7a77."""

from __future__ import annotations

from datetime import UTC, datetime

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


CALENDAR = [f"time.h/{name}" for name in ("gmtime", "gmtime_r", "localtime", "localtime_r", "mktime", "asctime", "ctime")]
MOMENTS = [
    0,
    59,
    951_782_399,
    951_868_799,
    951_868_800,
    1_325_375_999,
    1_330_560_000,
    1_763_835_245,
    4_102_444_799,
    4_107_542_400,
]


@proves(*CALENDAR)
def seconds_since_1970_are_times_of_the_calendar_and_back(uno: Uno) -> None:
    program = f"""{SAY}
time_t moments[] = {{{", ".join(f"{moment}UL" for moment in MOMENTS)}}};
void all(const struct tm *t) {{ say(t->tm_sec); say(t->tm_min); say(t->tm_hour); say(t->tm_mday); say(t->tm_mon); say(t->tm_year);
  say(t->tm_wday); say(t->tm_yday); say(t->tm_isdst); }}
void setup() {{ Serial.begin(115200); struct tm own, early; early.tm_mday = 1; early.tm_year = 69;
  early.tm_hour = early.tm_mon = 0;
  for (auto &moment : moments) {{ all(c_gmtime(&moment)); Serial.print(c_mktime(c_gmtime_r(&moment, &own))); Serial.print(' ');
    say(c_localtime(&moment)->tm_isdst); say(c_localtime_r(&moment, &own)->tm_mday + own.tm_isdst);
    Serial.print(c_asctime(&own)); Serial.print(c_ctime(&moment)); }}
  Serial.println(c_mktime(&early) + 1); }}
void loop() {{}}
"""
    lines = uno.run(program, CALENDAR, 800).text.splitlines()
    for number, moment in enumerate(MOMENTS):
        when = datetime.fromtimestamp(moment, UTC)
        date = [when.second, when.minute, when.hour, when.day, when.month - 1, when.year - 1900]
        days = [when.isoweekday() % 7, when.timetuple().tm_yday - 1, 0]
        text = when.strftime("%a %b %d %H:%M:%S %Y")
        told = [*map(int, lines[2 * number].rsplit(" ", 5)[0].split())]
        made = moment - 86400 if when.year == 2100 else moment  # the library counts the day that 2100 lacks from its begin on
        assert told == [*date, *days, made, -1, when.day - 1]
        assert lines[2 * number][-len(text) :] == text
        assert lines[2 * number + 1] == text
    assert lines[-1] == "0"


@proves("time.h/strftime")
def times_are_written_by_a_format(uno: Uno) -> None:
    letters = "aAbBhcDxFrRTXdegGHIjmMSuUVwWyYnt%pzZ"
    days = [951_782_399, 1_104_537_600, 1_230_768_000, 1_262_347_200, 1_763_835_245]
    program = f"""
time_t moments[] = {{{", ".join(f"{moment}UL" for moment in days)}}};
void setup() {{ Serial.begin(115200); char text[60], format[] = "<%?>"; struct tm *t;
  for (auto &moment : moments) {{ t = c_gmtime(&moment);
    for (const char *letter = "{letters}"; *letter; letter++) {{ format[2] = *letter;
      Serial.print(c_strftime(text, 60, format, t)); Serial.print(text); }}
    Serial.print('|'); }}
  Serial.print(c_strftime(text, 9, "%D", t)); Serial.print(text); Serial.print(c_strftime(text, 8, "%D", t));
  Serial.print(c_strftime(text, 60, "%q%", t)); Serial.print(text); }}
void loop() {{}}
"""
    told = uno.run(program, ["time.h/strftime", "time.h/gmtime", "time.h/time_t"], 800).text.split("|")
    for moment, text in zip(days, told, strict=False):
        when = datetime.fromtimestamp(moment, UTC)
        formats = {letter: f"%{letter}" for letter in letters} | {"c": "%a %b %d %X %Y", "z": "", "Z": ""}
        written = [f"<{when.strftime(formats[letter])}>" for letter in letters]
        assert text.replace("\r\n", "\n") == "".join(f"{len(each)}{each}" for each in written)
    assert told[-1] == "811/22/2501q"
