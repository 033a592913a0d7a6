/* lsm9ds1.h: registers of two halves, each with a select of its own, over one line both ways. Sources: liblsm9ds1. */
#include "simpletools.h"
#include "lsm9ds1.h"

enum { GYRO, ACCEL, MAG, SENSORS, AXES = 3, STAMP = 63280, KEPT = 7 };
static const char stamp[KEPT] = {'L', 'S', 'M', '9', 'D', 'S', '1'};
static int clock_pin, data_pin, motion, field, corrected, scale[SENSORS] = {2000, 0, 16}, bias[SENSORS][AXES];
static float per_unit[SENSORS];

void imu_SPIwriteByte(unsigned char csPin, unsigned char subAddress, unsigned char data) {
  low(csPin);
  shift_out(data_pin, clock_pin, MSBFIRST, 16, (subAddress & 0x3F) << 8 | data);
  high(csPin);
}

void imu_SPIreadBytes(unsigned char csPin, unsigned char subAddress, unsigned char *dest, unsigned char count) {
  int more = csPin == field && count > 1;
  low(csPin);
  shift_out(data_pin, clock_pin, MSBFIRST, 8, 0x80 | more << 6 | (subAddress & 0x3F));
  while (count--) *dest++ = shift_in(data_pin, clock_pin, MSBPRE, 8);
  high(csPin);
}

static int get(int select, int address) {
  unsigned char value;
  imu_SPIreadBytes(select, address, &value, 1);
  return value;
}

static void change(int select, int address, int kept, int set) { imu_SPIwriteByte(select, address, (get(select, address) & kept) | set); }

static void clear(int select, const unsigned char *addresses, int count) {
  while (count--) imu_SPIwriteByte(select, *addresses++, 0);
}

/* ---- readings */

static void words(int select, int address, int count, int *to) {
  unsigned char bytes[2 * AXES];
  imu_SPIreadBytes(select, address, bytes, 2 * count);
  for (int place = 0; place < count; place++) to[place] = (short)(bytes[2 * place] | bytes[2 * place + 1] << 8);
}

static void axes(int sensor, int *x, int *y, int *z) {
  static const unsigned char addresses[SENSORS] = {OUT_X_L_G, OUT_X_L_XL, OUT_X_L_M};
  int now[AXES];
  words(sensor == MAG ? field : motion, addresses[sensor], AXES, now);
  for (int axis = 0; axis < AXES && sensor != MAG && corrected >> sensor & 1; axis++) now[axis] -= bias[sensor][axis];
  *x = now[0], *y = now[1], *z = now[2];
}

static void in_units(int sensor, float *x, float *y, float *z) {
  int a, b, c;
  axes(sensor, &a, &b, &c);
  *x = a / per_unit[sensor], *y = b / per_unit[sensor], *z = c / per_unit[sensor];
}

void imu_readGyro(int *gx, int *gy, int *gz) { axes(GYRO, gx, gy, gz); }
void imu_readAccel(int *ax, int *ay, int *az) { axes(ACCEL, ax, ay, az); }
void imu_readMag(int *mx, int *my, int *mz) { axes(MAG, mx, my, mz); }
void imu_readGyroCalculated(float *gx, float *gy, float *gz) { in_units(GYRO, gx, gy, gz); }
void imu_readAccelCalculated(float *ax, float *ay, float *az) { in_units(ACCEL, ax, ay, az); }
void imu_readMagCalculated(float *mx, float *my, float *mz) { in_units(MAG, mx, my, mz); }
void imu_readTemp(int *temperature) { words(motion, OUT_TEMP_L, 1, temperature); }

void imu_readTempCalculated(float *temperature, char tempUnit) {
  int raw;
  imu_readTemp(&raw);
  float celsius = raw / 16.0f + 25.0f;
  *temperature = tempUnit == FAHRENHEIT ? celsius * 1.8f + 32.0f : tempUnit == KELVIN ? celsius + 273.15f : celsius;
}

unsigned char imu_accelAvailable() { return get(motion, STATUS_REG_1) & 1; }
unsigned char imu_gyroAvailable() { return get(motion, STATUS_REG_1) >> 1 & 1; }
unsigned char imu_tempAvailable() { return get(motion, STATUS_REG_1) >> 2 & 1; }
unsigned char imu_magAvailable() { return get(field, STATUS_REG_M) >> 3 & 1; }

/* ---- scales */

void imu_setGyroScale(unsigned int gScl) {
  scale[GYRO] = gScl == 500 || gScl == 2000 ? gScl : 245;
  per_unit[GYRO] = 32768.0f / scale[GYRO];
  change(motion, CTRL_REG1_G, 0xE7, gScl == 500 ? 1 << 3 : gScl == 2000 ? 3 << 3 : 0);
}

void imu_setAccelScale(unsigned char aScl) {
  scale[ACCEL] = aScl == 4 || aScl == 8 || aScl == 16 ? aScl : 2;
  per_unit[ACCEL] = 32768.0f / scale[ACCEL];
  change(motion, CTRL_REG6_XL, 0xE7, aScl == 4 ? 2 << 3 : aScl == 8 ? 3 << 3 : aScl == 16 ? 1 << 3 : 0);
}

void imu_setMagScale(unsigned char mScl) {
  static const float units[] = {6896.55f, 3448.28f, 2298.85f, 1724.14f};
  int step = mScl == 8 || mScl == 12 || mScl == 16 ? mScl / 4 - 1 : 0;
  scale[MAG] = 4 * (step + 1);
  per_unit[MAG] = units[step];
  change(field, CTRL_REG2_M, 0x9F, step << 5);
}

int imu_getGyroScale() { return scale[GYRO]; }
int imu_getAccelScale() { return scale[ACCEL]; }
int imu_getMagScale() { return scale[MAG]; }

/* ---- biases, and where they are kept: a letter and three numbers, highest byte first */

static int place(int sensor) { return STAMP + KEPT * (SENSORS - sensor); }

static void keep(int sensor, int x, int y, int z) {
  int given[AXES] = {x, y, z};
  for (int at = 0; at < KEPT; at++) ee_putByte(stamp[at], STAMP + at);
  ee_putByte("gam"[sensor], place(sensor));
  for (int axis = 0; axis < AXES; axis++) {
    bias[sensor][axis] = given[axis];
    ee_putByte(given[axis] >> 8, place(sensor) + 2 * axis + 1);
    ee_putByte(given[axis], place(sensor) + 2 * axis + 2);
  }
}

static int kept(int sensor, int axis) {
  int at = place(sensor) + 2 * axis + 1;
  return (short)((unsigned char)ee_getByte(at) << 8 | (unsigned char)ee_getByte(at + 1));
}

void imu_setGyroCalibration(int gxBias, int gyBias, int gzBias) {
  keep(GYRO, gxBias, gyBias, gzBias);
  corrected = 1;
}

void imu_setAccelCalibration(int axBias, int ayBias, int azBias) {
  keep(ACCEL, axBias, ayBias, azBias);
  corrected |= 2;
}

void imu_setMagCalibration(int mxBias, int myBias, int mzBias) {
  int given[AXES] = {mxBias, myBias, mzBias};
  for (int byte = 0; byte < 2 * AXES; byte++) imu_SPIwriteByte(field, OFFSET_X_REG_L_M + byte, given[byte / 2] >> 8 * (byte % 2));
  keep(MAG, mxBias, myBias, mzBias);
}

static void biases(int sensor, int *x, int *y, int *z) { *x = bias[sensor][0], *y = bias[sensor][1], *z = bias[sensor][2]; }

void imu_getGyroCalibration(int *gxBias, int *gyBias, int *gzBias) { biases(GYRO, gxBias, gyBias, gzBias); }
void imu_getAccelCalibration(int *axBias, int *ayBias, int *azBias) { biases(ACCEL, axBias, ayBias, azBias); }
void imu_getMagCalibration(int *mxBias, int *myBias, int *mzBias) { biases(MAG, mxBias, myBias, mzBias); }

void imu_calibrateAG(void) {
  int sums[2][AXES] = {{0}}, now[AXES], samples = 0;
  change(motion, CTRL_REG9, 0xFF, 2);
  imu_SPIwriteByte(motion, FIFO_CTRL, FIFO_THS << 5 | 0x1F);
  while (samples < 0x1F) samples = get(motion, FIFO_SRC) & 0x3F;
  for (int sample = 0; sample < samples; sample++)
    for (int sensor = GYRO; sensor <= ACCEL; sensor++) {
      axes(sensor, now, now + 1, now + 2);
      for (int axis = 0; axis < AXES; axis++) sums[sensor][axis] += now[axis];
    }
  sums[ACCEL][2] -= samples * (int)per_unit[ACCEL];
  imu_setGyroCalibration(sums[GYRO][0] / samples, sums[GYRO][1] / samples, sums[GYRO][2] / samples);
  imu_setAccelCalibration(sums[ACCEL][0] / samples, sums[ACCEL][1] / samples, sums[ACCEL][2] / samples);
  change(motion, CTRL_REG9, 0xFD, 0);
  imu_SPIwriteByte(motion, FIFO_CTRL, FIFO_OFF << 5);
}

void imu_calibrateMag(void) {
  int least[AXES] = {0}, most[AXES] = {0}, now[AXES];
  for (int reading = 0; reading < 1200; reading++) {
    while (!imu_magAvailable()) continue;
    imu_readMag(now, now + 1, now + 2);
    for (int axis = 0; axis < AXES; axis++) {
      if (now[axis] < least[axis]) least[axis] = now[axis];
      if (now[axis] > most[axis]) most[axis] = now[axis];
    }
  }
  imu_setMagCalibration((least[0] + most[0]) / 2, (least[1] + most[1]) / 2, (least[2] + most[2]) / 2);
}

int imu_init(int pinSCL, int pinSDIO, int pinAG, int pinM) {
  static const unsigned char settings[][2] = {
    {CTRL_REG1_G, 0xC0}, {CTRL_REG2_G, 0}, {CTRL_REG3_G, 0}, {CTRL_REG4, 0x38}, {ORIENT_CFG_G, 0}, {CTRL_REG5_XL, 0x38},
    {CTRL_REG6_XL, 0xC0}, {CTRL_REG7_XL, 0}};
  clock_pin = pinSCL, data_pin = pinSDIO, motion = pinAG, field = pinM;
  high(motion);
  high(field);
  low(clock_pin);
  pause(1);
  imu_SPIwriteByte(motion, CTRL_REG8, 0x0C);
  imu_SPIwriteByte(field, CTRL_REG3_M, 0x84);
  int who = get(field, WHO_AM_I_M);
  who |= get(motion, WHO_AM_I_XG) << 8;
  if (who != (WHO_AM_I_AG_RSP << 8 | WHO_AM_I_M_RSP)) return 0;
  for (unsigned number = 0; number < sizeof settings / sizeof *settings; number++)
    imu_SPIwriteByte(motion, settings[number][0], settings[number][1]);
  imu_SPIwriteByte(field, CTRL_REG2_M, 0);
  imu_SPIwriteByte(field, CTRL_REG4_M, 0x0C);
  imu_SPIwriteByte(field, CTRL_REG5_M, 0);
  imu_setGyroScale(500);
  imu_setAccelScale(8);
  imu_setMagScale(12);
  for (int at = 0; at < KEPT; at++)
    if (ee_getByte(STAMP + at) != stamp[at]) return who;
  imu_setMagCalibration(kept(MAG, 0), kept(MAG, 1), kept(MAG, 2));
  imu_setAccelCalibration(kept(ACCEL, 0), kept(ACCEL, 1), kept(ACCEL, 2));
  imu_setGyroCalibration(kept(GYRO, 0), kept(GYRO, 1), kept(GYRO, 2));
  return who;
}

/* ---- interrupts */

static const unsigned char of_accel[] = {INT_GEN_THS_X_XL, INT_GEN_THS_Y_XL, INT_GEN_THS_Z_XL, INT_GEN_CFG_XL, INT_GEN_DUR_XL};
static const unsigned char of_gyro[] = {INT_GEN_THS_XH_G, INT_GEN_THS_XL_G, INT_GEN_THS_YH_G, INT_GEN_THS_YL_G,
                                        INT_GEN_THS_ZH_G, INT_GEN_THS_ZL_G, INT_GEN_CFG_G, INT_GEN_DUR_G};
static const unsigned char of_field[] = {INT_THS_L_M, INT_THS_H_M, INT_SRC_M, INT_CFG_M};

void imu_clearAccelInterrupt() {
  clear(motion, of_accel, sizeof of_accel);
  change(motion, INT1_CTRL, 0xBF, 0);
}

void imu_clearGyroInterrupt() {
  clear(motion, of_gyro, sizeof of_gyro);
  change(motion, INT1_CTRL, 0x7F, 0);
}

void imu_clearMagInterrupt() { clear(field, of_field, sizeof of_field); }

static int config(int address, int axis, int over, int both) {
  change(motion, CTRL_REG4, 0xFD, 0);
  int value = (get(motion, address) & 0x7F) | (both ? 0x80 : 0);
  return value | (axis > Z_AXIS ? 0x15 : 1 << 2 * axis) << (over & 1);
}

static void finish(int address, int value, int at_duration, int duration, int line) {
  imu_SPIwriteByte(motion, address, value);
  imu_SPIwriteByte(motion, at_duration, duration ? 0x80 | (duration & 0x7F) : 0);
  change(motion, INT1_CTRL, 0xFF, line);
}

void imu_setAccelInterrupt(char axis, float threshold, char duration, char overUnder, char andOr) {
  int value = config(INT_GEN_CFG_XL, axis, overUnder, andOr & 1);
  int limit = (int)(per_unit[ACCEL] * (threshold < 0 ? -threshold : threshold)) >> 7;
  for (int each = 0; each < AXES; each++)
    if (axis > Z_AXIS || axis == each) imu_SPIwriteByte(motion, INT_GEN_THS_X_XL + each, limit);
  finish(INT_GEN_CFG_XL, value, INT_GEN_DUR_XL, duration, 0x40);
}

void imu_setGyroInterrupt(char axis, float threshold, char duration, char overUnder, char andOr) {
  int value = config(INT_GEN_CFG_G, axis, overUnder, andOr);
  int limit = (short)(int)(per_unit[GYRO] * threshold);
  limit = limit > 16383 ? 16383 : limit < -16384 ? -16384 : limit;
  for (int each = 0; each < AXES; each++)
    if (axis > Z_AXIS || axis == each) {
      imu_SPIwriteByte(motion, INT_GEN_THS_XH_G + 2 * each, limit >> 8 & 0x7F);
      imu_SPIwriteByte(motion, INT_GEN_THS_XL_G + 2 * each, limit);
    }
  finish(INT_GEN_CFG_G, value, INT_GEN_DUR_G, duration, 0x80);
}

void imu_setMagInterrupt(char axis, float threshold, char lowHigh) {
  int limit = abs((int)(per_unit[MAG] * threshold));
  if (limit > 32767) limit = 32767;
  imu_SPIwriteByte(field, INT_THS_L_M, limit);
  imu_SPIwriteByte(field, INT_THS_H_M, limit >> 8);
  imu_SPIwriteByte(field, INT_CFG_M, (axis > Z_AXIS ? 0xE0 : 0x80 >> axis) | (lowHigh & 1) << 2 | 3);
}
