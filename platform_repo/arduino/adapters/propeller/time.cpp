//# header time.h
// Clock ticks, seconds, and times of the calendar. Read from propgcc b280e7a77, lib/include/time.h, lib/sys/propeller/clock.c and rtc.c,
// lib/time/time.c, difftime.c, localtim.c, asctime.c and strftime.c. avr-libc declares clock without a body, and has no clock behind its
// time; it counts seconds from the year 2000, and the members of its tm have another order.

//# type clock_t
//#   include: <time.h>
//#   fidelity: exact: 32 bits without a sign
static_assert(sizeof(clock_t) == 4 && (clock_t)-1 > 0, "clock_t is that in time.h");

//# type time_t
//#   include: <time.h>
//#   fidelity: a number of seconds, of 64 bits in the C library of this target
static_assert(sizeof(time_t) >= 4, "time_t is a number of seconds");

//# type time_t
//#   architecture: avr
//#   include: <time.h>
//#   fidelity: exact: 32 bits without a sign
static_assert(sizeof(time_t) == 4 && (time_t)-1 > 0, "time_t is that in time.h");

//# constant CLOCKS_PER_SEC
//#   include: <time.h>
//#   fidelity: exact: ticks of the virtual counter in a second
#undef CLOCKS_PER_SEC
#define CLOCKS_PER_SEC ((clock_t)80000000UL)

//# constant CLK_TCK
//#   include: <time.h>
//#   fidelity: exact: ticks of the virtual counter in a second
#undef CLK_TCK
#define CLK_TCK ((clock_t)80000000UL)

//# adapter clock
//#   for: clock_t clock(void)
//#   for: unsigned int clock(void)
//#   kind: oneToOne
//#   name: c_clock
//#   needs: propeller.h/CNT
//#   include: <time.h>
//#   fidelity: the virtual counter, in steps of 4 us; it comes round after 53.7 s, as there
//#   stack: 2 0
inline clock_t c_clock() {
  return CNT;
}

//# helper clock_base
//#   include: <time.h>
//#   fidelity: what the clock was set to, and when
//#   ram: 12
static time_t clock_base;  // seconds
static uint64_t clock_set_at;  // microseconds since the program began

//# helper clock_us
//#   fidelity: microseconds since the program began, for 49 days; there they are lost when nobody asks for 53 s
inline uint64_t clock_us() {
  uint64_t us = (uint64_t)millis() * 1000;
  return us + (int32_t)(micros() - (uint32_t)us);
}

//# adapter time
//#   for: time_t time(time_t *tp)
//#   kind: semantic
//#   name: c_time
//#   needs: clock_base clock_us
//#   include: <time.h>
//#   fidelity: seconds since the clock was set, from what it was set to; since the program began, from 0, where nobody set it
//#   stack: 34 14
inline time_t c_time(time_t *tp) {
  time_t now = clock_base + (time_t)((clock_us() - clock_set_at) / 1000000);
  if (tp) *tp = now;
  return now;
}

//# adapter difftime
//#   for: double difftime(time_t time2, time_t time1)
//#   kind: oneToOne
//#   name: c_difftime
//#   include: <time.h>
//#   fidelity: exact
//#   stack: 0
inline double c_difftime(time_t time2, time_t time1) {
  return time1 <= time2 ? (double)(time2 - time1) : -(double)(time1 - time2);
}

// ---------------------------------------------------------------- the calendar

//# helper has_leap_day
inline bool has_leap_day(int32_t year) {
  return year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
}

//# helper days_before
//#   needs: has_leap_day
//#   fidelity: days of a year before one of its months, the first of which is 0
inline int16_t days_before(int32_t month, int32_t year) {
  int16_t days = 0;
  for (uint8_t each = 0; each < month && each < 12; each++) {
    uint8_t number = each + 1 + (each > 6);  // months with an odd one have 31 days
    days += each == 1 ? 28 + has_leap_day(year) : 30 + number % 2;
  }
  return days;
}

//# helper the_time
//#   fidelity: what gmtime and localtime give, both the same one, as there
//#   include: <time.h>
//#   ram: 12
static struct tm the_time;

//# adapter gmtime_r
//#   for: struct tm *gmtime_r(const time_t *t, struct tm *stm)
//#   kind: oneToOne
//#   name: c_gmtime_r
//#   needs: has_leap_day days_before
//#   include: <time.h>
//#   fidelity: exact: seconds since 1970
//#   stack: 40 21
inline struct tm *c_gmtime_r(const time_t *t, struct tm *stm) {
  uint32_t days = *t / 86400, rest = *t % 86400;
  int16_t year = 1970;
  stm->tm_wday = (days + 4) % 7;
  for (; days >= 365U + has_leap_day(year); year++) days -= 365 + has_leap_day(year);
  stm->tm_year = year - 1900;
  stm->tm_yday = days;
  uint8_t month = 11;
  while (days_before(month, year) > (int16_t)days) month--;
  stm->tm_mon = month;
  stm->tm_mday = days - days_before(month, year) + 1;
  stm->tm_hour = rest / 3600;
  stm->tm_min = rest / 60 % 60;
  stm->tm_sec = rest % 60;
  stm->tm_isdst = 0;
  return stm;
}

//# adapter gmtime
//#   for: struct tm *gmtime(const time_t *t)
//#   kind: oneToOne
//#   name: c_gmtime
//#   needs: the_time gmtime_r
//#   include: <time.h>
//#   fidelity: exact: seconds since 1970
//#   stack: 37 19
inline struct tm *c_gmtime(const time_t *t) {
  return c_gmtime_r(t, &the_time);
}

//# adapter localtime_r
//#   for: struct tm *localtime_r(const time_t *t, struct tm *stm)
//#   kind: oneToOne
//#   name: c_localtime_r
//#   needs: gmtime_r
//#   include: <time.h>
//#   fidelity: exact without a time zone: that of Greenwich, and daylight saving is unknown, -1
//#   limit: there is no environment: a time zone that the program puts into TZ changes nothing
//#   stack: 40 21
inline struct tm *c_localtime_r(const time_t *t, struct tm *stm) {
  c_gmtime_r(t, stm)->tm_isdst = -1;
  return stm;
}

//# adapter localtime
//#   for: struct tm *localtime(const time_t *t)
//#   kind: oneToOne
//#   name: c_localtime
//#   needs: the_time localtime_r
//#   include: <time.h>
//#   fidelity: exact without a time zone: that of Greenwich, and daylight saving is unknown, -1
//#   limit: there is no environment: a time zone that the program puts into TZ changes nothing
//#   stack: 37 19
inline struct tm *c_localtime(const time_t *t) {
  return c_localtime_r(t, &the_time);
}

//# adapter mktime
//#   for: time_t mktime(struct tm *t)
//#   kind: oneToOne
//#   name: c_mktime
//#   needs: days_before
//#   include: <time.h>
//#   fidelity: exact without a time zone: seconds since 1970, -1 for years before; members out of their range are not put right, as there
//#   limit: the members of a tm have another order here: a list of values for all of them is to be written by their names
//#   stack: 0
inline time_t c_mktime(struct tm *t) {
  if (t->tm_year < 70) return (time_t)-1;
  int32_t year = 1900 + t->tm_year, leaps = (year - 1969) / 4 - (year > 2000 ? (year - 2000) / 100 : 0);
  int32_t days = t->tm_mday - 1 + days_before(t->tm_mon, year) + (year - 1970) * 365 + leaps;
  return (uint32_t)days * 86400UL + t->tm_hour * 3600L + t->tm_min * 60L + t->tm_sec;
}

//# helper time_names
//#   fidelity: days and months, three letters or all of them
inline void time_name(char *to, const char *names, int32_t which, bool all) {  // names: in program memory, each one with a point behind it
  uint8_t letters = 0;
  for (char letter; (letter = pgm_read_byte(names)); names++) {
    if (letter == '.') which--;
    else if (!which && (all || letters < 3)) to[letters++] = letter;
  }
  if (!letters) to[letters++] = '?';
  to[letters] = 0;
}
static const char day_names[] PROGMEM = "Sunday.Monday.Tuesday.Wednesday.Thursday.Friday.Saturday.";
static const char month_names[] PROGMEM =
    "January.February.March.April.May.June.July.August.September.October.November.December.";

//# helper week_of_date
//#   include: <time.h>
//#   needs: has_leap_day
//#   fidelity: by ISO 8601, with its year
inline int32_t week_of_date(const struct tm *ts, int32_t *year) {
  int32_t weekday = ts->tm_wday ? ts->tm_wday : 7, thursday = ts->tm_yday + 4 - weekday;
  *year = ts->tm_year + 1900;
  if (thursday < 0) {
    --*year;
    thursday += 365 + has_leap_day(*year);
  } else if (thursday >= 365 + has_leap_day(*year)) {
    thursday -= 365 + has_leap_day(*year);
    ++*year;
  }
  return 1 + thursday / 7;
}

//# helper time_text
//#   include: <time.h>
//#   needs: time_names week_of_date
//#   fidelity: the text's length, or -1 where it has no room
//#   include mbed_nano renesas_uno: <api/itoa.h>
inline int32_t time_text(char *to, uint32_t room, const char *format, const struct tm *ts) {
  uint32_t length = 0;
  int32_t year;
  for (;; format++) {
    if (length >= room) return -1;
    if (!*format) break;
    if (*format != '%') {
      to[length++] = *format;
      continue;
    }
    char part[16] = {0}, filler = '0';
    const char *whole = 0;  // a format of which this one stands for
    int32_t value = 0;
    uint8_t width = 2;
    switch (*++format) {
      case 0: to[length] = 0; return length;
      case 'a': case 'A': time_name(part, day_names, ts->tm_wday, *format == 'A'); width = 0; break;
      case 'b': case 'B': case 'h': time_name(part, month_names, ts->tm_mon, *format == 'B'); width = 0; break;
      case 'c': whole = "%a %b %d %X %Y"; break;
      case 'D': case 'x': whole = "%m/%d/%y"; break;
      case 'F': whole = "%Y-%m-%d"; break;
      case 'r': whole = "%I:%M:%S %p"; break;
      case 'R': whole = "%H:%M"; break;
      case 'T': case 'X': whole = "%H:%M:%S"; break;
      case 'd': value = ts->tm_mday; break;
      case 'e': value = ts->tm_mday; filler = ' '; break;
      case 'g': week_of_date(ts, &year); value = year % 100; break;
      case 'G': week_of_date(ts, &value); break;
      case 'H': value = ts->tm_hour; break;
      case 'I': value = ts->tm_hour == 0 ? 12 : ts->tm_hour > 12 ? ts->tm_hour - 12 : ts->tm_hour; break;
      case 'j': value = ts->tm_yday + 1; width = 3; break;
      case 'm': value = ts->tm_mon + 1; break;
      case 'M': value = ts->tm_min; break;
      case 'S': value = ts->tm_sec; break;
      case 'u': value = ts->tm_wday ? ts->tm_wday : 7; width = 1; break;
      case 'U': value = (ts->tm_yday - ts->tm_wday + 7) / 7; break;
      case 'V': value = week_of_date(ts, &year); break;
      case 'w': value = ts->tm_wday; width = 1; break;
      case 'W': value = (ts->tm_yday - ts->tm_wday + (ts->tm_wday ? 8 : 1)) / 7; break;
      case 'y': value = ts->tm_year % 100; break;
      case 'Y': value = ts->tm_year + 1900; width = 1; break;
      case 'z': case 'Z': width = 0; break;
      case 'n': part[0] = '\n'; width = 0; break;
      case 't': part[0] = '\t'; width = 0; break;
      case 'p': strcpy(part, ts->tm_hour < 12 ? "AM" : "PM"); width = 0; break;
      default: part[0] = *format; width = 0;
    }
    if (whole) {
      int32_t taken = time_text(to + length, room - length, whole, ts);
      if (taken < 0) return -1;
      length += taken;
      continue;
    }
    if (width) {
      char digits[12];
      ltoa(value, digits, 10);
      uint8_t most = strlen(digits), at = 0;
      for (; at + most < width; at++) part[at] = filler;
      strcpy(part + at, digits);
    }
    if (length + strlen(part) >= room) return -1;
    strcpy(to + length, part);
    length += strlen(part);
  }
  to[length] = 0;
  return length;
}

//# adapter strftime
//#   for: size_t strftime(char *s, size_t max, const char *format, const struct tm *tm)
//#   kind: oneToOne
//#   name: c_strftime
//#   needs: time_text
//#   include: <time.h>
//#   fidelity: exact: the same letters as there, names in English; 0 where the text has no room
//#   limit: there is no environment: a time zone that the program puts into TZ changes nothing
//#   limit: the members of a tm have another order here: a list of values for all of them is to be written by their names
//#   stack: 76
inline uint32_t c_strftime(char *s, uint32_t max, const char *format, const struct tm *when) {
  int32_t length = time_text(s, max, format, when);
  return length < 0 ? 0 : length;
}

//# adapter asctime
//#   for: char *asctime(const struct tm *time)
//#   kind: oneToOne
//#   name: c_asctime
//#   needs: strftime
//#   include: <time.h>
//#   fidelity: exact
//#   ram: 26
//#   limit: the members of a tm have another order here: a list of values for all of them is to be written by their names
//#   stack: 76
inline char *c_asctime(const struct tm *time) {
  static char text[26];
  c_strftime(text, sizeof text, "%a %b %d %H:%M:%S %Y\n", time);
  return text;
}

//# adapter ctime
//#   for: char *ctime(const time_t *rawtime)
//#   kind: oneToOne
//#   name: c_ctime
//#   needs: asctime localtime
//#   include: <time.h>
//#   fidelity: exact without a time zone: that of Greenwich
//#   stack: 82
inline char *c_ctime(const time_t *rawtime) {
  return c_asctime(c_localtime(rawtime));
}
