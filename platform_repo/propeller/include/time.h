/* Minimal time.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_TIME_H
#define ROBOSMI_TIME_H
#include <stddef.h>
typedef long time_t;
typedef unsigned long clock_t;
struct tm { int tm_sec, tm_min, tm_hour, tm_mday, tm_mon, tm_year, tm_wday, tm_yday, tm_isdst; };
struct timespec { time_t tv_sec; long tv_nsec; };
extern unsigned int _clkfreq;
#define CLOCKS_PER_SEC _clkfreq
clock_t clock(void);
time_t time(time_t *to);
double difftime(time_t end, time_t start);
time_t mktime(struct tm *when);
struct tm *gmtime(const time_t *when);
struct tm *gmtime_r(const time_t *when, struct tm *to);
struct tm *localtime(const time_t *when);
struct tm *localtime_r(const time_t *when, struct tm *to);
char *asctime(const struct tm *when);
char *ctime(const time_t *when);
size_t strftime(char *s, size_t n, const char *format, const struct tm *when);
int nanosleep(const struct timespec *wanted, struct timespec *left);
#endif
