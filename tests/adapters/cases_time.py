"""mstimer.h and datetime.h. Semantics of the libraries' sources (libmstimer, libdatetime; Simple-Libraries 1cc167c10)."""

from __future__ import annotations

from datetime import date, datetime

import pytest

from tests.adapters.bench import Uno, proves

SAY = "void say(int32_t number) { Serial.print(number); Serial.print(' '); }"
MS = [f"mstimer.h/mstime_{name}" for name in ("start", "get", "set", "reset", "stop")]
DT = [f"datetime.h/dt_{name}" for name in ("run", "set", "get", "end", "getms", "toEt", "fromEt", "toDateStr", "toTimeStr",
                                           "fromDateStr", "fromTimeStr")]  # fmt: skip
DTE = [f"datetime.h/dte_{name}" for name in ("toJD", "toCal", "toSPD", "dateETV", "timeETV")]


@proves(*MS)
def milliseconds_are_counted_from_a_start(uno: Uno) -> None:
    program = f"""{SAY}
void setup() {{ Serial.begin(115200); delay(30); mstime_set(7); say(mstime_get()); say(mstime_start()); delay(25);
  say(mstime_get());
  mstime_set(1000); delay(20); say(mstime_get()); mstime_stop(); delay(10); say(mstime_get()); mstime_reset(); say(mstime_get());
  mstime_start(); delay(5); mstime_reset(); delay(5); say(mstime_get()); }}
void loop() {{}}
"""
    told = [int(each) for each in uno.run(program, MS, 200).text.split()]
    assert told[:2] == [7, 1]
    assert told[2:5] == pytest.approx([25, 1020, 1020], abs=1)
    assert told[5] == 0
    assert told[6] == pytest.approx(5, abs=1)


@proves(*DT, *DTE)
def clocks_go_on_over_the_end_of_a_year_and_know_their_calendar(uno: Uno) -> None:
    days = [(1970, 1, 1), (2000, 2, 29), (2026, 11, 22), (2037, 12, 31)]
    known = "".join(f"know({y}, {m}, {d}); " for y, m, d in days)
    program = f"""{SAY}
char text[12];
void tell() {{ dt_toDateStr(dt_get(), text); Serial.print(text); Serial.print(' '); dt_toTimeStr(dt_get(), text);
  Serial.print(text); Serial.print(' '); }}
void know(int32_t y, int32_t m, int32_t d) {{ int32_t day = dte_toJD(y, m, d), et = (day - 2440588) * 86400 + 45296;
  say(day); say(dte_toCal(day) == (y << 16 | m << 8 | d)); say(dte_dateETV(et) == dte_toCal(day)); say(dte_timeETV(et)); }}
void setup() {{ Serial.begin(115200); datetime dt = dt_fromTimeStr(dt_fromDateStr(datetime(), "12/31/99"), "23:59:58");
  say(dt_toEt(dt)); say(dt_fromEt(951868799).d); say(dte_toSPD(12, 34, 56)); dt_set(dt_fromEt(951868799)); tell(); dt_run(dt);
  delay(2300); say(dt_getms()); tell(); dt_set(dt_fromDateStr(dt_get(), "02/28/28")); delay(900); tell(); dt_end();
  delay(1500); tell();
  {known}}}
void loop() {{}}
"""
    told = uno.run(program, [*DT, *DTE, "datetime.h/datetime"], 4900).text.split()
    last = int((datetime(1999, 12, 31, 23, 59, 58) - datetime(1970, 1, 1)).total_seconds())
    assert told[:5] == [str(last), "29", "45296", "02/29/00", "23:59:59"]
    assert int(told[5]) == pytest.approx(300, abs=3)
    assert told[6:12] == ["01/01/00", "00:00:00", "02/28/28", "00:00:01", "02/28/28", "00:00:01"]
    numbers = [int(each) for each in told[12:]]
    for place, (y, m, d) in enumerate(days):
        julian = (date(y, m, d) - date(1970, 1, 1)).days + 2440588
        assert numbers[4 * place : 4 * place + 4] == [julian, 1, 1, 12 << 16 | 34 << 8 | 56]
