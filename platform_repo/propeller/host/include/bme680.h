/* bme680.h of the Simple Libraries: a sensor of temperature, pressure, humidity and gas. */
#ifndef BME680_H
#define BME680_H
#include "simpletools.h"
#ifndef CELSIUS
#define CELSIUS 0
#endif
#ifndef FAHRENHEIT
#define FAHRENHEIT 1
#endif
#ifndef KELVIN
#define KELVIN 2
#endif
#ifndef PASCALS
#define PASCALS 0
#endif
#ifndef MMHG
#define MMHG 1
#endif
#ifndef INHG
#define INHG 2
#endif
#ifndef PSI
#define PSI 3
#endif
#ifndef METERS
#define METERS 0
#endif
#ifndef FEET
#define FEET 1
#endif
#ifndef BME680_OS_NONE
#define BME680_OS_NONE 0
#endif
#ifndef BME680_OS_1X
#define BME680_OS_1X 1
#endif
#ifndef BME680_OS_2X
#define BME680_OS_2X 2
#endif
#ifndef BME680_OS_4X
#define BME680_OS_4X 3
#endif
#ifndef BME680_OS_8X
#define BME680_OS_8X 4
#endif
#ifndef BME680_OS_16X
#define BME680_OS_16X 5
#endif
#ifndef BME680_FILTER_SIZE_0
#define BME680_FILTER_SIZE_0 0
#endif
#ifndef BME680_FILTER_SIZE_1
#define BME680_FILTER_SIZE_1 1
#endif
#ifndef BME680_FILTER_SIZE_3
#define BME680_FILTER_SIZE_3 2
#endif
#ifndef BME680_FILTER_SIZE_7
#define BME680_FILTER_SIZE_7 3
#endif
#ifndef BME680_FILTER_SIZE_15
#define BME680_FILTER_SIZE_15 4
#endif
#ifndef BME680_FILTER_SIZE_31
#define BME680_FILTER_SIZE_31 5
#endif
#ifndef BME680_FILTER_SIZE_63
#define BME680_FILTER_SIZE_63 6
#endif
#ifndef BME680_FILTER_SIZE_127
#define BME680_FILTER_SIZE_127 7
#endif
#ifndef BME680_SETTING_AMB_TEMP
#define BME680_SETTING_AMB_TEMP 0
#endif
#ifndef BME680_SETTING_HEATER_TEMP
#define BME680_SETTING_HEATER_TEMP 1
#endif
#ifndef BME680_SETTING_HEATER_DURATION
#define BME680_SETTING_HEATER_DURATION 2
#endif
#ifndef BME680_SETTING_FILTER_SIZE
#define BME680_SETTING_FILTER_SIZE 3
#endif
#ifndef BME680_SETTING_TEMP_SAMPLES
#define BME680_SETTING_TEMP_SAMPLES 4
#endif
#ifndef BME680_SETTING_PRESSURE_SAMPLES
#define BME680_SETTING_PRESSURE_SAMPLES 5
#endif
#ifndef BME680_SETTING_HUMIDITY_SAMPLES
#define BME680_SETTING_HUMIDITY_SAMPLES 6
#endif
typedef struct bme680_st {
  unsigned char dev_id;
  char intf;
  i2c *i2c_ptr;
  char sdi_pin, sdo_pin, clk_pin, amb_temp;
  unsigned short heater_temp;
  unsigned char heater_duration, filter_size, temp_oversample, pres_oversample, hum_oversample;
  short sensor_reading_period;
  unsigned short par_h1, par_h2;
  char par_h3, par_h4, par_h5;
  unsigned char par_h6;
  char par_h7, par_gh1;
  short par_gh2;
  char par_gh3;
  unsigned short par_t1;
  short par_t2;
  char par_t3;
  unsigned short par_p1;
  short par_p2;
  char par_p3;
  short par_p4, par_p5;
  char par_p6, par_p7;
  short par_p8, par_p9;
  unsigned char par_p10;
  float t_fine;
  unsigned char res_heat_range;
  char res_heat_val, range_sw_err;
  unsigned char status, gas_index, meas_index;
  float temperature, pressure, altitude, humidity, gas_resistance;
} bme680_t;
typedef bme680_t bme680;
bme680_t *bme680_openI2C(i2c *i2c_bus, char i2c_addr);
bme680_t *bme680_openSPI(char pin_clk, char pin_sdi, char pin_sdo, char pin_cs);
void bme680_begin(bme680_t *dev);
char bme680_loadSettings(bme680_t *dev);
char bme680_readSensor(bme680_t *dev);
void bme680_write(bme680_t *dev, unsigned char reg_addr, unsigned char *reg_data, unsigned short len);
void bme680_read(bme680_t *dev, unsigned char reg_addr, unsigned char *reg_data, unsigned short len);
void bme680_configure(bme680_t *dev, char setting, int value);
void bme680_close(bme680_t *dev);
float bme680_temperature(bme680_t *dev, char unit);
float bme680_pressure(bme680_t *dev, char unit);
float bme680_altitude(bme680_t *dev, char unit);
float bme680_humidity(bme680_t *dev);
float bme680_gasResistance(bme680_t *dev);
void bme680_heaterEnable(bme680_t *dev);
void bme680_heaterDisable(bme680_t *dev);
#endif
