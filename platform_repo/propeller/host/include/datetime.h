/* datetime.h of the Simple Libraries: date and time, and a clock of seconds in a cog of its own. */
#ifndef DATETIME_H
#define DATETIME_H
#ifndef SECONDS
#define SECONDS 1
#endif
#ifndef MINUTES
#define MINUTES 60
#endif
#ifndef HOURS
#define HOURS 60 * MINUTES
#endif
#ifndef DAYS
#define DAYS 24 * HOURS
#endif
#define _eunix 2440588
#define _edos 2444240
#define _eprop 2451545
#define _epoch _eunix
typedef struct datetime_st { volatile int y, mo, d, h, m, s; } datetime;
void dt_run(datetime dt);
void dt_end();
void dt_set(datetime dt);
datetime dt_get();
int dt_getms();
int dt_toEt(datetime dt);
datetime dt_fromEt(int et);
void dt_toDateStr(datetime dt, char *s);
void dt_toTimeStr(datetime dt, char *s);
datetime dt_fromDateStr(datetime dt, char *s);
datetime dt_fromTimeStr(datetime dt, char *s);
void secondctr(void *par);
int dte_toJD(int y, int m, int d);
int dte_toSPD(int h, int m, int s);
int dte_toCal(int jd);
int dte_dateETV(int etv);
int dte_timeETV(int etv);
#endif
