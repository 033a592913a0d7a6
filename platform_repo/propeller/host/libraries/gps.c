/* gps.h: a cog reads sentences of NMEA 0183 (RMC and GGA). Sources: libgps (gps_run.c, gps_open.c, gps_close.c, gps_changeBaud.c,
 * gps_velocity.c). */
#include "simpletools.h"
#include "gps.h"

enum { RMC_FIELDS = 12, GGA_FIELDS = 16, TALKERS = 64, CHANGE_MS = 50 };

static volatile nmea_data now;
static volatile int cog = -1, stopping, rx_pin, tx_pin, baud;
static fdserial *line;

/* The fields of a sentence, an empty one between two commas as "0". */
static int fields(char *text, char **found, int most) {
  int count = 0;
  while (text && count < most) {
    char *end = strchr(text, ',');
    if (end) *end = 0;
    found[count++] = end && end == text ? "0" : text;
    text = end ? end + 1 : 0;
  }
  return count;
}

static float degrees(const char *place, const char *side, const char *positive) {
  float value = strtof(place, 0);
  int whole = (int)value / 100;
  return (strcmp(side, positive) ? -1 : 1) * ((value - whole * 100) / 60 + whole);
}

static void position(char *text) {
  char *f[RMC_FIELDS];
  int count = fields(text, f, RMC_FIELDS);
  if (count > 1) now.time = strtof(f[1], 0);
  if (count > 2) now.fix_valid = !strcmp(f[2], "A");
  if (count > 4) now.lat_dds = degrees(f[3], f[4], "N");
  if (count > 6) now.lon_dds = degrees(f[5], f[6], "E");
  if (count > 7) now.velocity = strtof(f[7], 0);
  if (count > 8) now.heading = strtof(f[8], 0);
  if (count > 9) now.date = atoi(f[9]);
  if (count > 10) now.mag_var = strtof(f[10], 0);
}

static void height(char *text) {
  char *f[GGA_FIELDS];
  int count = fields(text, f, GGA_FIELDS);
  if (count > 6) now.fix = atoi(f[6]);
  if (count > 7) now.sats_tracked = atoi(f[7]);
  if (count > 9) now.altitude = strtof(f[9], 0);
}

static void heard_from(char source) {
  char *ids = (char *)now.talker_ids;
  memmove(ids + 1, ids, TALKERS - 1);
  ids[0] = source;
}

static void reads(void *unused) {
  (void)unused;
  char text[GPS_INBUFF_SIZE];
  memset((char *)now.talker_ids, ' ', TALKERS);
  line = fdserial_open(rx_pin, tx_pin, 0, baud);
  for (;;) {
    int byte = -1;
    while (!stopping && (byte = fdserial_rxCheck(line)) < 0) {}
    if (stopping) {
      fdserial_close(line);
      stopping = 0;
      host_sleep_for_ever();
    }
    if (byte != '$') continue;
    int length = 0;
    while ((byte = fdserial_rxChar(line)) != '\r' && length < GPS_INBUFF_SIZE - 1) text[length++] = byte;
    text[length] = 0;
    if (!strchr("GBQ", text[0]) || !text[0] || length < 5) continue;
    char source = text[0] == 'B' && text[1] == 'D' ? 'B' : text[1];
    if (!strncmp(text + 2, "RMC", 3)) heard_from(source), position(text);
    else if (!strncmp(text + 2, "GGA", 3)) heard_from(source), height(text);
  }
}

int gps_open(int gpsSin, int gpsSout, int gps_baud) {
  host_call();
  rx_pin = gpsSin, tx_pin = gpsSout, baud = gps_baud, stopping = 0;
  cog = host_start(reads, 0, -1);
  return cog < 0 ? GPS_FALSE : GPS_TRUE;
}

void gps_close() {
  host_call();
  if (cog < 0) return;
  memset((void *)&now, 0, sizeof now);
  stopping = 1;
  while (stopping) host_call();
  host_stop(cog);
  cog = -1;
}

int gps_changeBaud(int newBaudRate) {
  gps_close();
  pause(CHANGE_MS);
  return gps_open(rx_pin, tx_pin, newBaudRate);
}

float gps_latitude() { return now.lat_dds; }
float gps_longitude() { return now.lon_dds; }
int gps_fix() { return now.fix; }
int gps_fixValid() { return now.fix_valid; }
int gps_satsTracked() { return now.sats_tracked; }
float gps_altitude() { return now.altitude; }
float gps_heading() { return now.heading; }
int gps_rawDate() { return (int)now.date; }
int gps_rawTime() { return now.time; }
float gps_magneticVariation() { return now.mag_var; }
void gps_txByte(int txByte) { fdserial_txChar(line, txByte & 0xFF); }
char *gps_sources() { return (char *)now.talker_ids; }

float gps_velocity(int units_type) {
  static const float in_units[] = {1, 1.15078, 1.852, 0.514444444444444};
  return units_type >= KNOTS && units_type <= MPS ? now.velocity * in_units[units_type] : -1;
}
