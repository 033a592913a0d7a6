/* A clock over the end of a year that is a leap year. */
#include "simpletools.h"
#include "datetime.h"

int main() {
  char s[12];
  datetime dt = {2016, 12, 31, 23, 59, 58};
  dt_run(dt);
  pause(900);
  int ms = dt_getms();
  print("%d\n", ms > 880 && ms < 1920);
  pause(1600);
  dt = dt_get();
  dt_toDateStr(dt, s);
  print("%s ", s);
  dt_toTimeStr(dt, s);
  print("%s\n", s);
  dt.mo = 2;
  dt.d = 28;
  dt.y = 2020;
  dt.h = 23;
  dt.m = 59;
  dt.s = 59;
  dt_set(dt);
  pause(1000);
  dt = dt_get();
  print("%d-%d-%d %d\n", dt.y, dt.mo, dt.d, dt.h);
  dt_end();
}
