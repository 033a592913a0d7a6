/* Dates and times calculated and read from texts. */
#include "simpletools.h"
#include "datetime.h"

int main() {
  datetime dt = {2000, 1, 1, 0, 0, 0};
  int et = dt_toEt(dt);
  dt = dt_fromEt(et + 86400 * 60 + 3661);
  print("%d/%d/%d %d:%d:%d\n", dt.mo, dt.d, dt.y, dt.h, dt.m, dt.s);
  dt = dt_fromDateStr(dt, "08/03/13");
  dt = dt_fromTimeStr(dt, "17:05:09");
  print("%d/%d/%d %d:%d:%d\n", dt.mo, dt.d, dt.y, dt.h, dt.m, dt.s);
  dt = dt_fromDateStr(dt, "12/31/99");
  print("%d %d\n", dt.y, dte_toJD(2000, 1, 1) - dte_toJD(dt.y, dt.mo, dt.d));
  print("%d %d\n", dte_toSPD(1, 1, 1), et);
}
