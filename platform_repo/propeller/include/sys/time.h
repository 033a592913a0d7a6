/* Minimal sys/time.h for reading programs (C99/POSIX names and types only). */
#ifndef ROBOSMI_SYS_TIME_H
#define ROBOSMI_SYS_TIME_H
#include <time.h>
struct timeval { time_t tv_sec; long tv_usec; };
struct timezone { int tz_minuteswest, tz_dsttime; };
int gettimeofday(struct timeval *to, void *zone);
int settimeofday(const struct timeval *from, const void *zone);
#endif
