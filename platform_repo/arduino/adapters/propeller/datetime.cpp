//# header datetime.h
// A clock and a calendar. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Time/libdatetime (datetime.h, datetime.c and its files of one function each).
// A time inside is the number of seconds since 1970. The calendar's calculations are those of the Gregorian calendar.

//# constant SECONDS
//#   fidelity: exact
#define SECONDS 1L

//# constant MINUTES
//#   fidelity: exact
#define MINUTES 60L

//# constant HOURS
//#   fidelity: exact
#define HOURS (60L * 60L)

//# constant DAYS
//#   fidelity: exact
#define DAYS (24L * 60L * 60L)

//# constant _eunix
//#   fidelity: exact: the Julian day of 1970-01-01
#define _eunix 2440588L

//# constant _edos
//#   fidelity: exact: the Julian day of 1980-01-01
#define _edos 2444240L

//# constant _eprop
//#   fidelity: exact: the Julian day of 2000-01-01
#define _eprop 2451545L

//# constant _epoch
//#   fidelity: exact
#define _epoch 2440588L

//# type datetime_st
//#   fidelity: exact; the type of a point in time
struct datetime_st {
  int32_t y, mo, d, h, m, s;
};

//# type datetime
//#   needs: datetime_st
//#   fidelity: exact
typedef datetime_st datetime;

//# helper clock_seconds
//#   ram: 9
static int32_t clock_seconds;      // at the last look
static uint32_t clock_looked;      // millis() at the whole second before that look
static bool clock_on;

inline int32_t clock_now() {
  for (; clock_on && millis() - clock_looked >= 1000; clock_looked += 1000) clock_seconds++;
  return clock_seconds;
}

//# adapter dte_toJD
//#   for: int dte_toJD(int y, int m, int d)
//#   kind: oneToOne
//#   fidelity: exact: the Julian day
//#   stack: 0
inline int32_t dte_toJD(int32_t y, int32_t m, int32_t d) {
  int32_t before = m <= 2;  // January and February count as months 11 and 12 of the year before
  int32_t year = y + 4800 - before, month = m - 2 + 12 * before;
  return 1461 * year / 4 + 367 * month / 12 - 3 * ((year + 100) / 100) / 4 + d - 32075;
}

//# adapter dte_toCal
//#   for: int dte_toCal(int jd)
//#   kind: oneToOne
//#   fidelity: exact: year, month and day of a Julian day, in bits 16 up, 8 to 15 and 0 to 7
//#   stack: 0
inline int32_t dte_toCal(int32_t jd) {
  int32_t days = jd + 68569, centuries = 4 * days / 146097;
  days -= (146097 * centuries + 3) / 4;
  int32_t year = 4000 * (days + 1) / 1461001;
  days += 31 - 1461 * year / 4;
  int32_t month = 80 * days / 2447, day = days - 2447 * month / 80, late = month / 11;
  return (100 * (centuries - 49) + year + late) << 16 | (month + 2 - 12 * late) << 8 | day;
}

//# adapter dte_toSPD
//#   for: int dte_toSPD(int h, int m, int s)
//#   kind: oneToOne
//#   fidelity: exact: seconds of the day
//#   stack: 0
inline int32_t dte_toSPD(int32_t h, int32_t m, int32_t s) {
  return (h * 60 + m) * 60 + s;
}

//# adapter dte_dateETV
//#   for: int dte_dateETV(int etv)
//#   kind: oneToOne
//#   needs: _epoch dte_toCal
//#   fidelity: exact: as dte_toCal
//#   stack: 0
inline int32_t dte_dateETV(int32_t etv) {
  return dte_toCal(etv / 86400 + _epoch);
}

//# adapter dte_timeETV
//#   for: int dte_timeETV(int etv)
//#   kind: oneToOne
//#   fidelity: exact: hours, minutes and seconds in bits 16 up, 8 to 15 and 0 to 7
//#   stack: 0
inline int32_t dte_timeETV(int32_t etv) {
  int32_t seconds = etv % 86400;
  return seconds / 3600 << 16 | seconds / 60 % 60 << 8 | seconds % 60;
}

//# adapter dt_toEt
//#   for: int dt_toEt(datetime dt)
//#   kind: oneToOne
//#   needs: _epoch datetime datetime_st dte_toJD dte_toSPD
//#   fidelity: exact: seconds since 1970
//#   stack: 0
inline int32_t dt_toEt(datetime dt) {
  return (dte_toJD(dt.y, dt.mo, dt.d) - _epoch) * 86400 + dte_toSPD(dt.h, dt.m, dt.s);
}

//# adapter dt_fromEt
//#   for: datetime dt_fromEt(int et)
//#   kind: oneToOne
//#   needs: datetime dte_dateETV dte_timeETV
//#   fidelity: exact
//#   stack: 68 0
inline datetime dt_fromEt(int32_t et) {
  int32_t date = dte_dateETV(et), time = dte_timeETV(et);
  return datetime{date >> 16, date >> 8 & 0xFF, date & 0xFF, time >> 16, time >> 8 & 0xFF, time & 0xFF};
}

//# adapter dt_run
//#   for: void dt_run(datetime dt)
//#   kind: semantic
//#   needs: datetime clock_seconds dt_toEt
//#   fidelity avr: the clock goes from that time on; the resonator of an Uno is up to 0.5 % off, 7 minutes a day
//#   fidelity other: the clock goes from that time on, as exactly as that of the board does
//#   stack: 102 0
inline void dt_run(datetime dt) {
  clock_seconds = dt_toEt(dt);
  clock_looked = millis();
  clock_on = true;
}

//# adapter dt_set
//#   for: void dt_set(datetime dt)
//#   kind: oneToOne
//#   needs: datetime clock_seconds dt_toEt
//#   fidelity: exact; the second under way goes on
//#   stack: 122 62
inline void dt_set(datetime dt) {
  clock_now();
  clock_seconds = dt_toEt(dt);
}

//# adapter dt_get
//#   for: datetime dt_get()
//#   kind: oneToOne
//#   needs: datetime clock_seconds dt_fromEt
//#   fidelity: exact
//#   stack: 68 0
inline datetime dt_get() {
  return dt_fromEt(clock_now());
}

//# adapter dt_end
//#   for: void dt_end()
//#   kind: oneToOne
//#   needs: clock_seconds
//#   fidelity: the clock stands
//#   stack: 2 0
inline void dt_end() {
  clock_now();
  clock_on = false;
}

//# adapter dt_getms
//#   for: int dt_getms()
//#   kind: oneToOne
//#   needs: clock_seconds
//#   fidelity: milliseconds of the second under way
//#   stack: 4 0
inline int32_t dt_getms() {
  clock_now();
  return millis() - clock_looked;
}

//# helper clock_digits
//#   include mbed_nano renesas_uno: <api/itoa.h>
inline char *clock_digits(char *to, int32_t first, int32_t second, int32_t third, char between) {
  int32_t parts[3] = {first, second, third};
  for (uint8_t part = 0; part < 3; part++) {
    if (part) *to++ = between;
    if (parts[part] < 10) *to++ = '0';
    ltoa(parts[part], to, 10);
    to += strlen(to);
  }
  return to;
}

//# adapter dt_toDateStr
//#   for: void dt_toDateStr(datetime dt, char *s)
//#   kind: oneToOne
//#   needs: datetime datetime_st clock_digits
//#   fidelity: exact: 11/22/26
//#   stack: 26 18
inline void dt_toDateStr(datetime dt, char *s) {
  clock_digits(s, dt.mo, dt.d, dt.y % 2000 % 1900, '/');
}

//# adapter dt_toTimeStr
//#   for: void dt_toTimeStr(datetime dt, char *s)
//#   kind: oneToOne
//#   needs: datetime datetime_st clock_digits
//#   fidelity: exact: 09:05:00
//#   stack: 26 16
inline void dt_toTimeStr(datetime dt, char *s) {
  clock_digits(s, dt.h, dt.m, dt.s, ':');
}

//# helper clock_numbers
inline void clock_numbers(const char *from, int32_t *first, int32_t *second, int32_t *third) {
  int32_t *parts[3] = {first, second, third};
  for (int32_t *part : parts) {
    while (*from && !isDigit(*from)) from++;
    if (!*from) return;
    char *end;
    *part = strtol(from, &end, 10);
    from = end;
  }
}

//# adapter dt_fromDateStr
//#   for: datetime dt_fromDateStr(datetime dt, char *s)
//#   kind: oneToOne
//#   needs: datetime datetime_st clock_numbers
//#   fidelity: month, day and year of two digits: 39 to 99 are of the century of 1900, as there
//#   stack: 143 85
inline datetime dt_fromDateStr(datetime dt, const char *s) {
  clock_numbers(s, &dt.mo, &dt.d, &dt.y);
  dt.y += dt.y > 38 ? 1900 : 2000;
  return dt;
}

//# adapter dt_fromTimeStr
//#   for: datetime dt_fromTimeStr(datetime dt, char *s)
//#   kind: oneToOne
//#   needs: datetime datetime_st clock_numbers
//#   fidelity: hours, minutes and seconds
//#   stack: 143 85
inline datetime dt_fromTimeStr(datetime dt, const char *s) {
  clock_numbers(s, &dt.h, &dt.m, &dt.s);
  return dt;
}
