//# header bme680.h
// A sensor of temperature, pressure, humidity and gas. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libbme680
// (bme680.h and its bme680_*.c). The formulas are those of the maker's data sheet, in floats as there.

//# constant CELSIUS
//#   fidelity: exact
#define CELSIUS 0

//# constant FAHRENHEIT
//#   fidelity: exact
#define FAHRENHEIT 1

//# constant KELVIN
//#   fidelity: exact
#define KELVIN 2

//# constant PASCALS
//#   fidelity: exact
#define PASCALS 0

//# constant MMHG
//#   fidelity: exact
#define MMHG 1

//# constant INHG
//#   fidelity: exact
#define INHG 2

//# constant PSI
//#   fidelity: exact
#define PSI 3

//# constant METERS
//#   fidelity: exact
#define METERS 0

//# constant FEET
//#   fidelity: exact
#define FEET 1

//# constant BME680_OS_NONE
//#   fidelity: exact
#define BME680_OS_NONE 0

//# constant BME680_OS_1X
//#   fidelity: exact
#define BME680_OS_1X 1

//# constant BME680_OS_2X
//#   fidelity: exact
#define BME680_OS_2X 2

//# constant BME680_OS_4X
//#   fidelity: exact
#define BME680_OS_4X 3

//# constant BME680_OS_8X
//#   fidelity: exact
#define BME680_OS_8X 4

//# constant BME680_OS_16X
//#   fidelity: exact
#define BME680_OS_16X 5

//# constant BME680_FILTER_SIZE_0
//#   fidelity: exact
#define BME680_FILTER_SIZE_0 0

//# constant BME680_FILTER_SIZE_1
//#   fidelity: exact
#define BME680_FILTER_SIZE_1 1

//# constant BME680_FILTER_SIZE_3
//#   fidelity: exact
#define BME680_FILTER_SIZE_3 2

//# constant BME680_FILTER_SIZE_7
//#   fidelity: exact
#define BME680_FILTER_SIZE_7 3

//# constant BME680_FILTER_SIZE_15
//#   fidelity: exact
#define BME680_FILTER_SIZE_15 4

//# constant BME680_FILTER_SIZE_31
//#   fidelity: exact
#define BME680_FILTER_SIZE_31 5

//# constant BME680_FILTER_SIZE_63
//#   fidelity: exact
#define BME680_FILTER_SIZE_63 6

//# constant BME680_FILTER_SIZE_127
//#   fidelity: exact
#define BME680_FILTER_SIZE_127 7

//# constant BME680_SETTING_AMB_TEMP
//#   fidelity: exact
#define BME680_SETTING_AMB_TEMP 0

//# constant BME680_SETTING_HEATER_TEMP
//#   fidelity: exact
#define BME680_SETTING_HEATER_TEMP 1

//# constant BME680_SETTING_HEATER_DURATION
//#   fidelity: exact
#define BME680_SETTING_HEATER_DURATION 2

//# constant BME680_SETTING_FILTER_SIZE
//#   fidelity: exact
#define BME680_SETTING_FILTER_SIZE 3

//# constant BME680_SETTING_TEMP_SAMPLES
//#   fidelity: exact
#define BME680_SETTING_TEMP_SAMPLES 4

//# constant BME680_SETTING_PRESSURE_SAMPLES
//#   fidelity: exact
#define BME680_SETTING_PRESSURE_SAMPLES 5

//# constant BME680_SETTING_HUMIDITY_SAMPLES
//#   fidelity: exact
#define BME680_SETTING_HUMIDITY_SAMPLES 6

//# type bme680_t
//#   needs: simplei2c.h/i2c
//#   fidelity: the members that programs read and set; what the sensor was calibrated with is in bytes as it came
struct bme680_t {
  uint8_t dev_id, intf;  // pin CS or address on the bus; 1 on the two-wire bus
  i2c *i2c_ptr;
  uint8_t sdi_pin, sdo_pin, clk_pin;
  uint8_t amb_temp;
  uint16_t heater_temp;
  uint8_t heater_duration, filter_size, temp_oversample, pres_oversample, hum_oversample;
  int16_t sensor_reading_period;
  uint8_t calibration[44];
  float t_fine;
  uint8_t status, gas_index, meas_index;
  float temperature, pressure, altitude, humidity, gas_resistance;

  uint16_t word(uint8_t at) const { return calibration[at] | (uint16_t)calibration[at + 1] << 8; }
  int16_t number(uint8_t at) const { return (int16_t)word(at); }
};

//# type bme680
//#   needs: bme680_t
//#   fidelity: as bme680_t
typedef bme680_t bme680;

//# adapter bme680_write
//#   for: void bme680_write(bme680_t *dev, unsigned char reg_addr, unsigned char *reg_data, unsigned short len)
//#   kind: oneToMany
//#   needs: bme680_t simpletools.h/i2c_busy simpletools.h/i2c_out simpletools.h/low simpletools.h/high simpletools.h/shift_out
//#   fidelity: exact; a bus on which nobody answers for 1 s ends it, where the library waits for ever
//#   stack: 71 53
inline void bme680_write(bme680_t *dev, uint8_t reg_addr, const void *reg_data, uint16_t len) {
  const uint8_t *bytes = (const uint8_t *)reg_data;
  if (dev->intf) {
    for (uint32_t begun = millis(); i2c_busy(dev->i2c_ptr, dev->dev_id);)
      if (millis() - begun > 1000) return;
    i2c_out(dev->i2c_ptr, dev->dev_id, reg_addr, 1, bytes, len);
    return;
  }
  low(dev->dev_id);
  shift_out(dev->sdi_pin, dev->clk_pin, MSBFIRST, 8, reg_addr);
  for (; len; len--) shift_out(dev->sdi_pin, dev->clk_pin, MSBFIRST, 8, *bytes++);
  high(dev->dev_id);
}

//# adapter bme680_read
//#   for: void bme680_read(bme680_t *dev, unsigned char reg_addr, unsigned char *reg_data, unsigned short len)
//#   kind: oneToMany
//#   needs: bme680_t simpletools.h/i2c_busy simpletools.h/i2c_in simpletools.h/low simpletools.h/high simpletools.h/shift_out simpletools.h/shift_in
//#   fidelity: exact; a bus on which nobody answers for 1 s ends it, where the library waits for ever
//#   stack: 48 30
inline void bme680_read(bme680_t *dev, uint8_t reg_addr, void *reg_data, uint16_t len) {
  uint8_t *bytes = (uint8_t *)reg_data;
  if (dev->intf) {
    for (uint32_t begun = millis(); i2c_busy(dev->i2c_ptr, dev->dev_id);)
      if (millis() - begun > 1000) return;
    i2c_in(dev->i2c_ptr, dev->dev_id, reg_addr, 1, bytes, len);
    return;
  }
  low(dev->dev_id);
  shift_out(dev->sdi_pin, dev->clk_pin, MSBFIRST, 8, reg_addr | 0x80);
  for (; len; len--) *bytes++ = (uint8_t)shift_in(dev->sdo_pin, dev->clk_pin, 0, 8);
  high(dev->dev_id);
}

//# adapter bme680_begin
//#   for: void bme680_begin(bme680_t *dev)
//#   kind: oneToMany
//#   needs: bme680_t bme680_read bme680_write BME680_FILTER_SIZE_3 BME680_OS_8X BME680_OS_4X BME680_OS_2X
//#   fidelity: exact: reads what the sensor was calibrated with, takes the usual settings, and waits 193 ms
//#   stack: 93 89
inline void bme680_begin(bme680_t *dev) {
  uint8_t page = 0;
  if (!dev->intf) bme680_write(dev, 0x73, &page, 1);
  bme680_write(dev, dev->intf ? 0xe0 : 0x60, &page, 1);
  delay(10);
  bme680_read(dev, 0x89, dev->calibration, 25);
  bme680_read(dev, 0xe1, dev->calibration + 25, 16);
  page = 0x10;
  if (!dev->intf) bme680_write(dev, 0x73, &page, 1);
  bme680_read(dev, 0x02, dev->calibration + 41, 1);
  bme680_read(dev, 0x00, dev->calibration + 42, 1);
  bme680_read(dev, 0x04, dev->calibration + 43, 1);
  dev->amb_temp = 25;
  dev->heater_temp = 320;
  dev->heater_duration = 150;
  dev->filter_size = BME680_FILTER_SIZE_3;
  dev->temp_oversample = BME680_OS_8X;
  dev->pres_oversample = BME680_OS_4X;
  dev->hum_oversample = BME680_OS_2X;
  dev->sensor_reading_period = 183;
  delay(183);
}

//# helper bme680_rest
//#   needs: bme680_t bme680_read bme680_write
//#   fidelity: the sensor rests, with the settings of a reading as they are there (0x8c); ten tries, where the library tries for ever
inline void bme680_rest(bme680_t *dev) {
  for (uint8_t tries = 10, control; tries; tries--) {
    bme680_read(dev, 0x74, &control, 1);
    if (control == 0x8c) return;
    control = 0x8c;
    bme680_write(dev, 0x74, &control, 1);
    delay(10);
  }
}

//# adapter bme680_loadSettings
//#   for: char bme680_loadSettings(bme680_t *dev)
//#   kind: oneToMany
//#   needs: bme680_t bme680_write bme680_rest
//#   fidelity: exact, in what the library gets wrong, too: coefficients below 0 are taken without their sign, and the duration is kept as it
//#   fidelity: was packed, so that a second call heats shorter
//#   stack: 106 91
inline char bme680_loadSettings(bme680_t *dev) {
  const uint8_t *coefficients = dev->calibration;
  if (dev->heater_temp > 400) dev->heater_temp = 400;
  float slope = dev->number(35) / 32768.0 * 0.0005 + 0.00235;
  float heat = (coefficients[37] / 16.0 + 49.0) * (1.0 + slope * dev->heater_temp) + coefficients[38] / 1024.0 * dev->amb_temp;
  uint8_t range = coefficients[41] >> 4 & 3, packed = 0;
  while (dev->heater_duration > 63) {
    dev->heater_duration /= 4;
    packed += 64;
  }
  packed += dev->heater_duration;
  float resistance = 3.4 * (heat * (4 / (4 + (float)range)) * (1 / (1 + coefficients[42] * 0.002)) - 25);
  const uint8_t heater[] = {(uint8_t)(int32_t)resistance, 0x64, packed};
  bme680_write(dev, 0x5a, heater, sizeof heater);
  bme680_rest(dev);
  uint8_t samples = (dev->temp_oversample << 5 & 0xE0) | (dev->pres_oversample << 2 & 0x1C);
  const uint8_t settings[] = {
      (uint8_t)(dev->filter_size << 2 & 0x1C), 0x74, samples, 0x72, (uint8_t)(dev->hum_oversample & 7), 0x71, 0x10};
  bme680_write(dev, 0x75, settings, sizeof settings);
  return 0;
}

//# adapter bme680_openI2C
//#   for: bme680_t *bme680_openI2C(i2c *i2c_bus, char i2c_addr)
//#   kind: oneToMany
//#   needs: bme680_t bme680_begin bme680_loadSettings simplei2c.h/i2c
//#   fidelity: exact
//#   limit: the sensor takes 3.6 V at most: its lines need level shifters on a board of 5 V
//#   stack: 115 102
inline bme680_t *bme680_openI2C(i2c *i2c_bus, uint8_t i2c_addr) {
  bme680_t *dev = new bme680_t();
  dev->i2c_ptr = i2c_bus;
  dev->dev_id = i2c_addr;
  dev->intf = 1;
  bme680_begin(dev);
  bme680_loadSettings(dev);
  return dev;
}

//# adapter bme680_openSPI
//#   for: bme680_t *bme680_openSPI(char pin_clk, char pin_sdi, char pin_sdo, char pin_cs)
//#   kind: oneToMany
//#   needs: bme680_t bme680_begin bme680_loadSettings
//#   pin: pin_clk digital out
//#   pin: pin_sdi digital out
//#   pin: pin_sdo digital in
//#   pin: pin_cs digital out
//#   fidelity: exact
//#   limit: the sensor takes 3.6 V at most: its lines need level shifters on a board of 5 V
//#   stack: 113 102
inline bme680_t *bme680_openSPI(int32_t pin_clk, int32_t pin_sdi, int32_t pin_sdo, int32_t pin_cs) {
  bme680_t *dev = new bme680_t();
  dev->clk_pin = pin_clk;
  dev->sdi_pin = pin_sdi;
  dev->sdo_pin = pin_sdo;
  dev->dev_id = pin_cs;
  bme680_begin(dev);
  bme680_loadSettings(dev);
  return dev;
}

//# adapter bme680_close
//#   for: void bme680_close(bme680_t *dev)
//#   kind: oneToOne
//#   needs: bme680_t
//#   fidelity: exact: its memory is free
//#   stack: 4
inline void bme680_close(bme680_t *dev) {
  delete dev;
}

//# adapter bme680_configure
//#   for: void bme680_configure(bme680_t *dev, char setting, int value)
//#   kind: oneToMany
//#   needs: bme680_t bme680_loadSettings BME680_SETTING_AMB_TEMP BME680_SETTING_HEATER_TEMP BME680_SETTING_HEATER_DURATION BME680_SETTING_FILTER_SIZE BME680_SETTING_TEMP_SAMPLES BME680_SETTING_PRESSURE_SAMPLES BME680_SETTING_HUMIDITY_SAMPLES
//#   fidelity: exact, with what the library gets wrong: with BME680_OS_NONE the Propeller shifts by 31 bits, and a reading waits for 30,769 ms
//#   fidelity: where the sensor needs 185 ms; BME680_OS_1X avoids that on both
//#   stack: 112 95
inline void bme680_configure(bme680_t *dev, uint8_t setting, int32_t value) {
  if (setting == BME680_SETTING_AMB_TEMP) dev->amb_temp = value;
  if (setting == BME680_SETTING_HEATER_TEMP) dev->heater_temp = value;
  if (setting == BME680_SETTING_HEATER_DURATION) dev->heater_duration = value;
  if (setting == BME680_SETTING_FILTER_SIZE) dev->filter_size = value;
  if (setting == BME680_SETTING_TEMP_SAMPLES) dev->temp_oversample = value;
  if (setting == BME680_SETTING_PRESSURE_SAMPLES) dev->pres_oversample = value;
  if (setting == BME680_SETTING_HUMIDITY_SAMPLES) dev->hum_oversample = value;
  const uint8_t samples[] = {dev->temp_oversample, dev->pres_oversample, dev->hum_oversample};
  int32_t time = 0;
  for (uint8_t each : samples) time += 1UL << ((each - 1) & 31);
  dev->sensor_reading_period = (int16_t)(183 + time / 15);
  bme680_loadSettings(dev);
}

//# helper bme680_pressure_of
//#   needs: bme680_t
//#   fidelity: pascals
inline float bme680_pressure_of(const bme680_t *dev, float measured) {
  float near = dev->t_fine / 2.0 - 64000.0;
  float offset = near * near * (dev->calibration[16] / 131072.0) + near * dev->number(13) * 2.0;
  offset = offset / 4.0 + dev->number(11) * 65536.0;
  float scale = (dev->calibration[9] * near * near / 16384.0 + dev->number(7) * near) / 524288.0;
  scale = (1.0 + scale / 32768.0) * dev->word(5);
  if ((int32_t)scale == 0) return 0;
  float pressure = (1048576.0 - measured - offset / 4096.0) * 6250.0 / scale;
  float square = dev->number(21) * pressure * pressure / 2147483648.0, line = pressure * (dev->number(19) / 32768.0);
  float cube = pressure / 256.0 * (pressure / 256.0) * (pressure / 256.0) * (dev->calibration[23] / 131072.0);
  return pressure + (square + line + cube + dev->calibration[15] * 128.0) / 16.0;
}

//# helper bme680_humidity_of
//#   needs: bme680_t
//#   fidelity: per cent
inline float bme680_humidity_of(const bme680_t *dev, float measured) {
  const uint8_t *coefficients = dev->calibration;
  float celsius = dev->t_fine / 5120.0;
  uint16_t first = (uint16_t)coefficients[27] << 4 | (coefficients[26] & 0x0F), second = (uint16_t)coefficients[25] << 4 | coefficients[26] >> 4;
  float beyond = measured - (first * 16.0 + coefficients[28] / 2.0 * celsius);
  beyond *= second / 262144.0 * (1.0 + coefficients[29] / 16384.0 * celsius + coefficients[30] / 1048576.0 * celsius * celsius);
  float humidity = beyond + (coefficients[31] / 16384.0 + coefficients[32] / 2097152.0 * celsius) * beyond * beyond;
  return humidity > 100 ? 100 : humidity < 0 ? 0 : humidity;
}

//# helper bme680_resistance_of
//#   needs: bme680_t
//#   fidelity: ohms
inline float bme680_resistance_of(const bme680_t *dev, float measured, uint8_t range) {
  static const int8_t first[16] PROGMEM = {0, 0, 0, 0, 0, -10, 0, -8, 0, 0, -2, -5, 0, -10, 0, 0};  // tenths of a per cent
  static const int8_t second[16] PROGMEM = {0, 0, 0, 0, 1, 7, 0, -8, -1, 0, 0, 0, 0, 0, 0, 0};
  float span = (1340.0 + 5.0 * (dev->calibration[43] >> 4)) * (1.0 + (int8_t)pgm_read_byte(first + range) / 1000.0);
  float unit = (1.0 + (int8_t)pgm_read_byte(second + range) / 1000.0) * 0.000000125 * (float)(1UL << range);
  return 1.0 / (unit * ((measured - 512.0) / span + 1.0));
}

//# adapter bme680_readSensor
//#   for: char bme680_readSensor(bme680_t *dev)
//#   kind: oneToMany
//#   needs: bme680_t bme680_read bme680_write bme680_rest bme680_pressure_of bme680_humidity_of bme680_resistance_of
//#   fidelity: 0, or 255 (-1 in a char without a sign) and all values 0 when the sensor has nothing new in ten tries; coefficients below 0 are
//#   fidelity: taken without their sign, as there
//#   stack: 131 115
inline uint8_t bme680_readSensor(bme680_t *dev) {
  uint8_t buffer[15] = {0x8d};
  bme680_write(dev, 0x74, buffer, 1);
  if (dev->sensor_reading_period > 0) delay(dev->sensor_reading_period);
  uint8_t tries = 10;
  for (; tries; tries--) {
    bme680_read(dev, 0x1d, buffer, sizeof buffer);
    dev->status = (buffer[0] & 0x80) | (buffer[14] & 0x30);
    if (dev->status & 0x80) break;
    delay(10);
  }
  if (tries) {
    dev->gas_index = buffer[0] & 0x0F;
    dev->meas_index = buffer[1];
    float measured = (uint32_t)buffer[5] << 12 | (uint16_t)buffer[6] << 4 | buffer[7] >> 4;
    float base = dev->word(33), beyond = measured / 131072.0 - base / 8192.0;
    dev->t_fine = (measured / 16384.0 - base / 1024.0) * dev->number(1) + beyond * beyond * (dev->calibration[3] * 16.0);
    dev->temperature = dev->t_fine / 5120.0;
    dev->pressure = bme680_pressure_of(dev, (uint32_t)buffer[2] << 12 | (uint16_t)buffer[3] << 4 | buffer[4] >> 4);
    dev->humidity = bme680_humidity_of(dev, (uint16_t)buffer[8] << 8 | buffer[9]);
    dev->gas_resistance = bme680_resistance_of(dev, (uint16_t)buffer[13] << 2 | buffer[14] >> 6, buffer[14] & 0x0F);
  }
  bme680_rest(dev);
  if (tries) return 0;
  dev->temperature = dev->pressure = dev->altitude = dev->humidity = dev->gas_resistance = 0;
  return 255;
}

//# adapter bme680_temperature
//#   for: float bme680_temperature(bme680_t *dev, char unit)
//#   kind: oneToOne
//#   needs: bme680_t FAHRENHEIT KELVIN
//#   fidelity: exact
//#   stack: 0
inline float bme680_temperature(const bme680_t *dev, uint8_t unit) {
  if (unit == FAHRENHEIT) return dev->temperature * 1.8 + 32.0;
  return unit == KELVIN ? dev->temperature + 273.15 : dev->temperature;
}

//# adapter bme680_pressure
//#   for: float bme680_pressure(bme680_t *dev, char unit)
//#   kind: oneToOne
//#   needs: bme680_t INHG MMHG PSI
//#   fidelity: exact
//#   stack: 0
inline float bme680_pressure(const bme680_t *dev, uint8_t unit) {
  return dev->pressure * (unit == INHG ? 0.00029529983071445 : unit == MMHG ? 0.0075006156130264 : unit == PSI ? 0.000145037738 : 1.0);
}

//# adapter bme680_altitude
//#   for: float bme680_altitude(bme680_t *dev, char unit)
//#   kind: oneToOne
//#   needs: bme680_t FEET
//#   include: <math.h>
//#   fidelity: exact: above the height at which the pressure is 101,325 Pa
//#   stack: 0
inline float bme680_altitude(const bme680_t *dev, uint8_t unit) {
  return 44330.0 * (1.0 - pow(dev->pressure / 101325.0, 0.1903)) * (unit == FEET ? 3.28084 : 1.0);
}

//# adapter bme680_humidity
//#   for: float bme680_humidity(bme680_t *dev)
//#   kind: oneToOne
//#   needs: bme680_t
//#   fidelity: exact: per cent
//#   stack: 0
inline float bme680_humidity(const bme680_t *dev) {
  return dev->humidity;
}

//# adapter bme680_gasResistance
//#   for: float bme680_gasResistance(bme680_t *dev)
//#   kind: oneToOne
//#   needs: bme680_t
//#   fidelity: exact: ohms, 0 when the sensor says that they do not count
//#   stack: 0
inline float bme680_gasResistance(const bme680_t *dev) {
  return dev->status & 0x20 ? dev->gas_resistance : 0;
}

//# adapter bme680_heaterEnable
//#   for: void bme680_heaterEnable(bme680_t *dev)
//#   kind: oneToMany
//#   needs: bme680_t bme680_read bme680_write
//#   fidelity: exact; it waits 250 ms
//#   stack: 81 64
inline void bme680_heaterEnable(bme680_t *dev) {
  uint8_t control;
  bme680_read(dev, 0x70, &control, 1);
  control &= ~0x08;
  bme680_write(dev, 0x70, &control, 1);
  delay(250);
}

//# adapter bme680_heaterDisable
//#   for: void bme680_heaterDisable(bme680_t *dev)
//#   kind: oneToMany
//#   needs: bme680_t bme680_read bme680_write
//#   fidelity: exact; it waits 250 ms
//#   stack: 81 64
inline void bme680_heaterDisable(bme680_t *dev) {
  uint8_t control;
  bme680_read(dev, 0x70, &control, 1);
  control |= 0x08;
  bme680_write(dev, 0x70, &control, 1);
  delay(250);
}
