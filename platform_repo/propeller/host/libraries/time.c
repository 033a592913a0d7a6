/* time.h, sys/time.h and the waits of unistd.h. There is no clock that runs without power: time begins at 0. */
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
#include "host.h"

static time_t offset;

static host_time clock_now(void) { return host_now() + host_clock_ahead(); }

clock_t clock(void) {
  host_call();
  return (clock_t)host_now();
}

time_t time(time_t *to) {
  host_call();
  time_t now = offset + (time_t)(clock_now() / HOST_HZ);
  return to ? *to = now : now;
}

double difftime(time_t end, time_t start) { return end - start; }

int gettimeofday(struct timeval *to, void *zone) {
  (void)zone;
  host_call();
  to->tv_sec = offset + (time_t)(clock_now() / HOST_HZ);
  to->tv_usec = (long)(clock_now() % HOST_HZ / HOST_TICKS_PER_US);
  return 0;
}

int settimeofday(const struct timeval *from, const void *zone) {
  (void)zone;
  host_call();
  offset = from->tv_sec - (time_t)(clock_now() / HOST_HZ);
  return 0;
}

unsigned int sleep(unsigned int seconds) {
  host_sleep_until(host_now() + (host_time)seconds * HOST_HZ);
  return 0;
}

int usleep(useconds_t microseconds) {
  host_sleep_until(host_now() + (host_time)microseconds * HOST_TICKS_PER_US);
  return 0;
}

/* The calendar: no time zone, since a program has no environment there; mktime puts nothing right, and counts a day too few from 2100 on. */
static const int days_before[] = { 0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334, 365 };
static struct tm the_time;

static int leap(int year) { return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0); }

struct tm *gmtime_r(const time_t *when, struct tm *to) {
  unsigned int days = (unsigned int)*when / 86400, rest = (unsigned int)*when % 86400;
  int year = 1970, month = 11;
  host_call();
  to->tm_wday = (int)((days + 4) % 7);
  for (; days >= 365u + (unsigned int)leap(year); year++) days -= 365u + (unsigned int)leap(year);
  while (days_before[month] + (month > 1 && leap(year)) > (int)days) month--;
  to->tm_year = year - 1900;
  to->tm_yday = (int)days;
  to->tm_mon = month;
  to->tm_mday = (int)days - days_before[month] - (month > 1 && leap(year)) + 1;
  to->tm_hour = (int)(rest / 3600);
  to->tm_min = (int)(rest / 60 % 60);
  to->tm_sec = (int)(rest % 60);
  to->tm_isdst = 0;
  return to;
}

struct tm *localtime_r(const time_t *when, struct tm *to) {
  gmtime_r(when, to)->tm_isdst = -1;
  return to;
}

struct tm *gmtime(const time_t *when) { return gmtime_r(when, &the_time); }

struct tm *localtime(const time_t *when) { return localtime_r(when, &the_time); }

time_t mktime(struct tm *when) {
  int year = when->tm_year + 1900, leaps = (year - 1969) / 4 - (year > 2000 ? (year - 2000) / 100 : 0);
  host_call();
  if (when->tm_year < 70) return (time_t)-1;
  int days = when->tm_mday - 1 + days_before[when->tm_mon] + (leap(year) && when->tm_mon > 1) + (year - 1970) * 365 + leaps;
  return (time_t)((unsigned int)days * 86400u + (unsigned int)(when->tm_hour * 3600 + when->tm_min * 60 + when->tm_sec));
}

static int week_of_date(const struct tm *when, int *year) {
  int thursday = when->tm_yday + 4 - (when->tm_wday ? when->tm_wday : 7);
  *year = when->tm_year + 1900;
  if (thursday < 0) {
    --*year;
    thursday += 365 + leap(*year);
  } else if (thursday >= 365 + leap(*year)) {
    thursday -= 365 + leap(*year);
    ++*year;
  }
  return 1 + thursday / 7;
}

static void name_of(char *to, const char *names, int which, int all) {  /* each name with a point behind it */
  int letters = 0;
  for (; *names; names++) {
    if (*names == '.') which--;
    else if (!which && (all || letters < 3)) to[letters++] = *names;
  }
  if (!letters) to[letters++] = '?';
  to[letters] = 0;
}

static void digits_of(char *to, int value, int width, char filler) {
  char digits[12];
  int count = 0;
  do {
    digits[count++] = (char)('0' + value % 10);
    value /= 10;
  } while (value);
  for (; width > count; width--) *to++ = filler;
  while (count) *to++ = digits[--count];
  *to = 0;
}

static int time_text(char *to, size_t room, const char *format, const struct tm *when) {
  static const char days[] = "Sunday.Monday.Tuesday.Wednesday.Thursday.Friday.Saturday.";
  static const char months[] = "January.February.March.April.May.June.July.August.September.October.November.December.";
  size_t length = 0;
  int year;
  for (;; format++) {
    char part[24] = { 0 };
    const char *whole = 0;
    if (length >= room) return -1;
    if (!*format) break;
    if (*format != '%') {
      to[length++] = *format;
      continue;
    }
    if (!*++format) break;
    switch (*format) {
      case 'a': case 'A': name_of(part, days, when->tm_wday, *format == 'A'); break;
      case 'b': case 'B': case 'h': name_of(part, months, when->tm_mon, *format == 'B'); break;
      case 'c': whole = "%a %b %d %X %Y"; break;
      case 'D': case 'x': whole = "%m/%d/%y"; break;
      case 'F': whole = "%Y-%m-%d"; break;
      case 'r': whole = "%I:%M:%S %p"; break;
      case 'R': whole = "%H:%M"; break;
      case 'T': case 'X': whole = "%H:%M:%S"; break;
      case 'd': digits_of(part, when->tm_mday, 2, '0'); break;
      case 'e': digits_of(part, when->tm_mday, 2, ' '); break;
      case 'g': week_of_date(when, &year); digits_of(part, year % 100, 2, '0'); break;
      case 'G': week_of_date(when, &year); digits_of(part, year, 2, '0'); break;
      case 'H': digits_of(part, when->tm_hour, 2, '0'); break;
      case 'I': digits_of(part, when->tm_hour == 0 ? 12 : when->tm_hour > 12 ? when->tm_hour - 12 : when->tm_hour, 2, '0'); break;
      case 'j': digits_of(part, when->tm_yday + 1, 3, '0'); break;
      case 'm': digits_of(part, when->tm_mon + 1, 2, '0'); break;
      case 'M': digits_of(part, when->tm_min, 2, '0'); break;
      case 'S': digits_of(part, when->tm_sec, 2, '0'); break;
      case 'u': digits_of(part, when->tm_wday ? when->tm_wday : 7, 1, '0'); break;
      case 'U': digits_of(part, (when->tm_yday - when->tm_wday + 7) / 7, 2, '0'); break;
      case 'V': digits_of(part, week_of_date(when, &year), 2, '0'); break;
      case 'w': digits_of(part, when->tm_wday, 1, '0'); break;
      case 'W': digits_of(part, (when->tm_yday - when->tm_wday + (when->tm_wday ? 8 : 1)) / 7, 2, '0'); break;
      case 'y': digits_of(part, when->tm_year % 100, 2, '0'); break;
      case 'Y': digits_of(part, when->tm_year + 1900, 1, '0'); break;
      case 'z': case 'Z': break;
      case 'n': part[0] = '\n'; break;
      case 't': part[0] = '\t'; break;
      case 'p': strcpy(part, when->tm_hour < 12 ? "AM" : "PM"); break;
      default: part[0] = *format;
    }
    if (whole) {
      int taken = time_text(to + length, room - length, whole, when);
      if (taken < 0) return -1;
      length += (size_t)taken;
      continue;
    }
    if (length + strlen(part) >= room) return -1;
    strcpy(to + length, part);
    length += strlen(part);
  }
  to[length] = 0;
  return (int)length;
}

size_t strftime(char *s, size_t n, const char *format, const struct tm *when) {
  int length = time_text(s, n, format, when);
  host_call();
  return length < 0 ? 0 : (size_t)length;
}

char *asctime(const struct tm *when) {
  static char text[26];
  strftime(text, sizeof text, "%a %b %d %H:%M:%S %Y\n", when);
  return text;
}

char *ctime(const time_t *when) { return asctime(localtime(when)); }
