/* gps.h of the Simple Libraries: positions of a receiver on a serial line. */
#ifndef ROBOSMI_GPS_H
#define ROBOSMI_GPS_H
#include "simpletools.h"
#include "fdserial.h"
#define KNOTS 0
#define MPH 1
#define KPH 2
#define MPS 3
#define GPS_TRUE 1
#define GPS_FALSE 0
#define GPS_INBUFF_SIZE 128
typedef unsigned char gps_byte_t;
typedef struct nmea_data_s {
  int fix, fix_valid;
  float lat_dds, lon_dds;
  int sats_tracked;
  float altitude, heading, velocity, date;
  int time;
  float mag_var;
  char talker_ids[65];
} nmea_data;
int gps_open(int gpsSin, int gpsSout, int gps_baud);
int gps_changeBaud(int newBaudRate);
void gps_close();
float gps_latitude();
float gps_longitude();
int gps_fix();
int gps_fixValid();
int gps_satsTracked();
float gps_altitude();
float gps_heading();
float gps_velocity(int units_type);
int gps_rawDate();
int gps_rawTime();
float gps_magneticVariation();
void gps_txByte(int txByte);
char *gps_sources();
#endif
