/* datetime.h: seconds since 1970 in a cog, and the calendar by Julian days. Sources: libdatetime (datetime.c, dt_*.c, dte_*.c). */
#include "simpletools.h"
#include "datetime.h"

enum { DAY_SECONDS = 86400 };
static volatile int seconds, second_begun, cog;

void secondctr(void *par) {
  seconds = (int)par;
  for (second_begun = (int)(CNT - (unsigned)host_clock_ahead());;) {
    second_begun += HOST_HZ;  /* when the running second ends, until then */
    host_wait_counter(second_begun);
    seconds++;
  }
}

void dt_run(datetime dt) {
  host_call();
  cog = host_start(secondctr, (void *)dt_toEt(dt), -1) + 1;
}

/* The library stops the cog after its own, which goes on. */
void dt_end() {
  host_call();
  if (cog) host_stop(cog);
  cog = 0;
}

datetime dt_get() {
  host_call();
  return dt_fromEt(seconds);
}

void dt_set(datetime dt) {
  host_call();
  seconds = dt_toEt(dt);
}

int dt_getms() { return (int)(CNT - (second_begun - HOST_HZ)) / HOST_TICKS_PER_MS; }

int dte_toJD(int y, int m, int d) {
  int before_march = m <= 2 ? -1 : 0;
  return 1461 * (y + 4800 + before_march) / 4 + 367 * (m - 2 - 12 * before_march) / 12 - 3 * ((y + 4900 + before_march) / 100) / 4 + d - 32075;
}

int dte_toSPD(int h, int m, int s) { return h * 3600 + m * 60 + s; }

/* Year, month and day in bytes, after Fliegel and Van Flandern (1968). */
int dte_toCal(int jd) {
  int l = jd + 68569, n = 4 * l / 146097;
  l -= (146097 * n + 3) / 4;
  int i = 4000 * (l + 1) / 1461001;
  l -= 1461 * i / 4 - 31;
  int j = 80 * l / 2447, day = l - 2447 * j / 80;
  l = j / 11;
  return (100 * (n - 49) + i + l) << 16 | (j + 2 - 12 * l) << 8 | day;
}

int dte_dateETV(int etv) { return dte_toCal(etv / DAY_SECONDS + _epoch); }

int dte_timeETV(int etv) {
  int left = etv % DAY_SECONDS;
  return (left / 3600) << 16 | (left % 3600 / 60) << 8 | left % 60;
}

int dt_toEt(datetime dt) { return (dte_toJD(dt.y, dt.mo, dt.d) - _epoch) * DAY_SECONDS + dte_toSPD(dt.h, dt.m, dt.s); }

datetime dt_fromEt(int et) {
  int date = dte_dateETV(et), time = dte_timeETV(et);
  return (datetime){date >> 16, date >> 8 & 0xFF, date & 0xFF, time >> 16, time >> 8 & 0xFF, time & 0xFF};
}

void dt_toDateStr(datetime dt, char *s) { sprinti(s, "%02d/%02d/%02d", dt.mo, dt.d, dt.y % 2000 % 1900); }

void dt_toTimeStr(datetime dt, char *s) { sprinti(s, "%02d:%02d:%02d", dt.h, dt.m, dt.s); }

datetime dt_fromDateStr(datetime dt, char *s) {
  sscan(s, "%d/%d/%d", &dt.mo, &dt.d, &dt.y);
  dt.y += dt.y > 38 ? 1900 : 2000;
  return dt;
}

datetime dt_fromTimeStr(datetime dt, char *s) {
  sscan(s, "%d:%d:%d", &dt.h, &dt.m, &dt.s);
  return dt;
}
