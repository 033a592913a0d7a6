/* bme680.h: registers over two or four wires, and the formulas of the sensor's data sheet in single precision; single bytes have no sign,
 * as plain char has none there. Sources: libbme680 (a file for each function). */
#include "bme680.h"

enum { FIRST_CALIBRATION = 0x89, SECOND_CALIBRATION = 0xE1, SETTINGS = 0x74, HEATER = 0x70, MEASURED = 0x1D, PAGE = 0x73, IDLE = 0x8C };

/* ---- registers */

void bme680_read(bme680_t *dev, unsigned char reg_addr, unsigned char *reg_data, unsigned short len) {
  if (dev->intf) {
    while (i2c_busy(dev->i2c_ptr, dev->dev_id)) host_call();
    i2c_in(dev->i2c_ptr, dev->dev_id, reg_addr, 1, reg_data, len);
    i2c_stop(dev->i2c_ptr);
    return;
  }
  low(dev->dev_id);
  shift_out(dev->sdi_pin, dev->clk_pin, MSBFIRST, 8, reg_addr | 0x80);
  for (int i = 0; i < len; i++) reg_data[i] = shift_in(dev->sdo_pin, dev->clk_pin, MSBPRE, 8);
  high(dev->dev_id);
}

void bme680_write(bme680_t *dev, unsigned char reg_addr, unsigned char *reg_data, unsigned short len) {
  if (dev->intf) {
    while (i2c_busy(dev->i2c_ptr, dev->dev_id)) host_call();
    i2c_out(dev->i2c_ptr, dev->dev_id, reg_addr, 1, reg_data, len);
    i2c_stop(dev->i2c_ptr);
    return;
  }
  low(dev->dev_id);
  shift_out(dev->sdi_pin, dev->clk_pin, MSBFIRST, 8, reg_addr);
  for (int i = 0; i < len; i++) shift_out(dev->sdi_pin, dev->clk_pin, MSBFIRST, 8, reg_data[i]);
  high(dev->dev_id);
}

static void put(bme680_t *dev, unsigned char address, unsigned char value) { bme680_write(dev, address, &value, 1); }

static unsigned char get(bme680_t *dev, unsigned char address) {
  unsigned char value = 0;
  bme680_read(dev, address, &value, 1);
  return value;
}

/* What is written counts as read, as in the library. */
static void make_idle(bme680_t *dev) {
  if (get(dev, SETTINGS) == IDLE) return;
  put(dev, SETTINGS, IDLE);
  pause(10);
}

/* ---- opening and settings */

static unsigned word(const unsigned char *bytes) { return bytes[0] | bytes[1] << 8; }

void bme680_begin(bme680_t *dev) {
  unsigned char cal[44];
  if (!dev->intf) put(dev, PAGE, 0);
  put(dev, dev->intf ? 0xE0 : 0x60, 0);
  pause(10);
  bme680_read(dev, FIRST_CALIBRATION, cal, 25);
  bme680_read(dev, SECOND_CALIBRATION, cal + 25, 16);
  if (!dev->intf) put(dev, PAGE, 0x10);
  bme680_read(dev, 0x02, cal + 41, 1);
  bme680_read(dev, 0x00, cal + 42, 1);
  bme680_read(dev, 0x04, cal + 43, 1);
  dev->par_t1 = word(cal + 33), dev->par_t2 = word(cal + 1), dev->par_t3 = cal[3];
  dev->par_p1 = word(cal + 5), dev->par_p2 = word(cal + 7), dev->par_p3 = cal[9], dev->par_p4 = word(cal + 11);
  dev->par_p5 = word(cal + 13), dev->par_p6 = cal[16], dev->par_p7 = cal[15], dev->par_p8 = word(cal + 19);
  dev->par_p9 = word(cal + 21), dev->par_p10 = cal[23];
  dev->par_h1 = cal[27] << 4 | (cal[26] & 0x0F), dev->par_h2 = cal[25] << 4 | cal[26] >> 4;
  dev->par_h3 = cal[28], dev->par_h4 = cal[29], dev->par_h5 = cal[30], dev->par_h6 = cal[31], dev->par_h7 = cal[32];
  dev->par_gh1 = cal[37], dev->par_gh2 = word(cal + 35), dev->par_gh3 = cal[38];
  dev->res_heat_range = cal[41] >> 4 & 3, dev->res_heat_val = cal[42], dev->range_sw_err = cal[43] >> 4;
  dev->amb_temp = 25, dev->heater_temp = 320, dev->heater_duration = 150, dev->filter_size = BME680_FILTER_SIZE_3;
  dev->temp_oversample = BME680_OS_8X, dev->pres_oversample = BME680_OS_4X, dev->hum_oversample = BME680_OS_2X;
  dev->sensor_reading_period = 183;
  pause(dev->sensor_reading_period);
}

char bme680_loadSettings(bme680_t *dev) {
  unsigned char heat[3], rest[7];
  if (dev->heater_temp > 400) dev->heater_temp = 400;
  float slope = dev->par_gh2 / 32768.0 * 0.0005 + 0.00235;
  float warm = (dev->par_gh1 / 16.0 + 49.0) * (1.0 + slope * dev->heater_temp) + dev->par_gh3 / 1024.0 * dev->amb_temp;
  heat[0] = (unsigned char)(3.4 * (warm * (4 / (4 + (float)dev->res_heat_range)) * (1 / (1 + dev->res_heat_val * 0.002)) - 25));
  heat[1] = 0x64;
  for (heat[2] = 0; dev->heater_duration > 63; heat[2] += 64) dev->heater_duration /= 4;
  heat[2] += dev->heater_duration;
  bme680_write(dev, 0x5A, heat, 3);
  make_idle(dev);
  rest[0] = dev->filter_size << 2 & 0x1C;
  rest[1] = SETTINGS;
  rest[2] = (dev->temp_oversample << 5 & 0xE0) | (dev->pres_oversample << 2 & 0x1C);
  rest[3] = 0x72;
  rest[4] = dev->hum_oversample & 7;
  rest[5] = 0x71;
  rest[6] = 0x10;
  bme680_write(dev, 0x75, rest, 7);
  return 0;
}

static bme680_t *opened(bme680_t wanted) {
  bme680_t *dev = malloc(sizeof *dev);
  if (!dev) return 0;
  *dev = wanted;
  bme680_begin(dev);
  bme680_loadSettings(dev);
  return dev;
}

bme680_t *bme680_openI2C(i2c *i2c_bus, char i2c_addr) { return opened((bme680_t){.i2c_ptr = i2c_bus, .dev_id = i2c_addr, .intf = 1}); }

bme680_t *bme680_openSPI(char pin_clk, char pin_sdi, char pin_sdo, char pin_cs) {
  return opened((bme680_t){.clk_pin = pin_clk, .sdi_pin = pin_sdi, .sdo_pin = pin_sdo, .dev_id = pin_cs});
}

void bme680_close(bme680_t *dev) { free(dev); }

void bme680_configure(bme680_t *dev, char setting, int value) {
  if (setting == BME680_SETTING_AMB_TEMP) dev->amb_temp = value;
  if (setting == BME680_SETTING_HEATER_TEMP) dev->heater_temp = value;
  if (setting == BME680_SETTING_HEATER_DURATION) dev->heater_duration = value;
  if (setting == BME680_SETTING_FILTER_SIZE) dev->filter_size = value;
  if (setting == BME680_SETTING_TEMP_SAMPLES) dev->temp_oversample = value;
  if (setting == BME680_SETTING_PRESSURE_SAMPLES) dev->pres_oversample = value;
  if (setting == BME680_SETTING_HUMIDITY_SAMPLES) dev->hum_oversample = value;
  int samples = 0;
  const unsigned char counts[3] = {dev->temp_oversample, dev->pres_oversample, dev->hum_oversample};
  for (int i = 0; i < 3; i++) samples += 1u << ((counts[i] - 1) & 31);  /* without samples the chip shifts by 31 */
  dev->sensor_reading_period = 183 + samples / 15;
  bme680_loadSettings(dev);
}

static void heat(bme680_t *dev, unsigned char off) {
  put(dev, HEATER, (get(dev, HEATER) & 0xF7) | off);
  pause(250);
}

void bme680_heaterEnable(bme680_t *dev) { heat(dev, 0); }
void bme680_heaterDisable(bme680_t *dev) { heat(dev, 8); }

/* ---- measuring */

static unsigned twenty_bits(const unsigned char *bytes) { return bytes[0] << 12 | bytes[1] << 4 | bytes[2] >> 4; }

static void take_temperature(bme680_t *dev, float raw) {
  float deviation = raw / 131072.0 - dev->par_t1 / 8192.0;
  dev->t_fine = (raw / 16384.0 - dev->par_t1 / 1024.0) * dev->par_t2 + deviation * deviation * (dev->par_t3 * 16.0);
  dev->temperature = dev->t_fine / 5120.0;
}

static void take_pressure(bme680_t *dev, float raw) {
  float a = dev->t_fine / 2.0 - 64000.0, b = a * a * (dev->par_p6 / 131072.0) + a * dev->par_p5 * 2.0;
  b = b / 4.0 + dev->par_p4 * 65536.0;
  a = (dev->par_p3 * a * a / 16384.0 + dev->par_p2 * a) / 524288.0;
  a = (1.0 + a / 32768.0) * dev->par_p1;
  dev->pressure = 0;
  if (!(int)a) return;
  float p = (1048576.0 - raw - b / 4096.0) * 6250.0 / a, part = p / 256.0;
  float correction = dev->par_p9 * p * p / 2147483648.0 + p * (dev->par_p8 / 32768.0) + part * part * part * (dev->par_p10 / 131072.0);
  dev->pressure = p + (correction + dev->par_p7 * 128.0) / 16.0;
}

static void take_humidity(bme680_t *dev, float raw) {
  float t = dev->temperature, a = raw - (dev->par_h1 * 16.0 + dev->par_h3 / 2.0 * t);
  a *= dev->par_h2 / 262144.0 * (1.0 + dev->par_h4 / 16384.0 * t + dev->par_h5 / 1048576.0 * t * t);
  a += (dev->par_h6 / 16384.0 + dev->par_h7 / 2097152.0 * t) * a * a;
  dev->humidity = a > 100 ? 100 : a < 0 ? 0 : a;
}

static void take_gas(bme680_t *dev, float raw, int range) {
  static const float first[16] = {[5] = -1.0, [7] = -0.8, [10] = -0.2, [11] = -0.5, [13] = -1.0};
  static const float second[16] = {[4] = 0.1, [5] = 0.7, [7] = -0.8, [8] = -0.1};
  float span = (1340.0 + 5.0 * dev->range_sw_err) * (1.0 + first[range] / 100.0);
  dev->gas_resistance = 1.0 / ((1.0 + second[range] / 100.0) * 0.000000125 * (1 << range) * ((raw - 512.0) / span + 1.0));
}

char bme680_readSensor(bme680_t *dev) {
  unsigned char field[15];
  int tries = 10;
  put(dev, SETTINGS, 0x8D);
  pause(dev->sensor_reading_period);
  for (; tries; tries--) {
    bme680_read(dev, MEASURED, field, 15);
    dev->status = (field[0] & 0x80) | (field[14] & 0x30);
    if (dev->status & 0x80) break;
    pause(10);
  }
  if (tries) {
    dev->gas_index = field[0] & 0x0F;
    dev->meas_index = field[1];
    take_temperature(dev, twenty_bits(field + 5));
    take_pressure(dev, twenty_bits(field + 2));
    take_humidity(dev, field[8] << 8 | field[9]);
    take_gas(dev, field[13] << 2 | field[14] >> 6, field[14] & 0x0F);
  }
  make_idle(dev);
  if (tries) return 0;
  dev->temperature = dev->pressure = dev->altitude = dev->humidity = dev->gas_resistance = 0;
  return -1;
}

float bme680_temperature(bme680_t *dev, char unit) {
  return unit == FAHRENHEIT ? dev->temperature * (9.0 / 5.0) + 32.0 : unit == KELVIN ? dev->temperature + 273.15 : dev->temperature;
}

float bme680_pressure(bme680_t *dev, char unit) {
  float scale = unit == INHG ? 0.00029529983071445 : unit == MMHG ? 0.0075006156130264 : unit == PSI ? 0.000145037738 : 1;
  return dev->pressure * scale;
}

float bme680_altitude(bme680_t *dev, char unit) {
  return 44330.0 * (1.0 - pow(dev->pressure / 101325.0, 0.1903)) * (unit == FEET ? 3.28084 : 1);
}

float bme680_humidity(bme680_t *dev) { return dev->humidity; }
float bme680_gasResistance(bme680_t *dev) { return dev->gas_resistance; }
