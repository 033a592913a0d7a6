/* lis3dh.h: registers of the sensor are read and written bit by bit at the pins. Sources: liblis3dh (a file for each function). */
#include "lis3dh.h"

/* ---- registers */

unsigned char lis3dh_readByte(lis3dh_t *device, unsigned char address) {
  low(device->cs_pin);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, address | LIS3DH_MASK_READSINGLE);
  unsigned char value = shift_in(device->sdo_pin, device->sck_pin, MSBPRE, 8);
  high(device->cs_pin);
  return value;
}

void lis3dh_writeByte(lis3dh_t *device, unsigned char address, unsigned char value) {
  low(device->cs_pin);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, address);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, value);
  high(device->cs_pin);
}

/* Three words of 16 bits from a register on, low byte first, cut to the resolution. */
static void read_three(lis3dh_t *device, unsigned char first, int *values[3]) {
  int unused_bits = 16 - lis3dh_getResolution(device);
  low(device->cs_pin);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, first | LIS3DH_MASK_READREPEAT);
  for (int i = 0; i < 3; i++) {
    unsigned low_byte = shift_in(device->sdo_pin, device->sck_pin, MSBPRE, 8);
    *values[i] = (short)(low_byte | shift_in(device->sdo_pin, device->sck_pin, MSBPRE, 8) << 8) >> unused_bits;
  }
  high(device->cs_pin);
}

static void change(lis3dh_t *device, unsigned char address, unsigned char clear, unsigned char set) {
  lis3dh_writeByte(device, address, (lis3dh_readByte(device, address) & ~clear) | set);
}

/* ---- settings */

int lis3dh_getWhoAmI(lis3dh_t *device) { return lis3dh_readByte(device, LIS3DH_WHO_AM_I); }

int lis3dh_getResolution(lis3dh_t *device) {
  int low_power = lis3dh_readByte(device, LIS3DH_CTRL_REG1) >> 3 & 1, high_power = lis3dh_readByte(device, LIS3DH_CTRL_REG4) >> 3 & 1;
  return low_power ? (high_power ? 0 : 8) : high_power ? 12 : 10;
}

void lis3dh_setResolution(lis3dh_t *device, int bits) {
  unsigned char first = lis3dh_readByte(device, LIS3DH_CTRL_REG1), fourth = lis3dh_readByte(device, LIS3DH_CTRL_REG4);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG1, bits == 12 || bits == 10 ? first & ~8 : first | 8);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, bits == 12 ? fourth | 8 : fourth & ~8);
}

int lis3dh_getRange(lis3dh_t *device) { return 2 << (lis3dh_readByte(device, LIS3DH_CTRL_REG4) >> 4 & 3); }

void lis3dh_setRange(lis3dh_t *device, int range) {
  int code = range == 16 ? LIS3DH_RANGE_16 : range == 8 ? LIS3DH_RANGE_8 : range == 4 ? LIS3DH_RANGE_4 : LIS3DH_RANGE_2;
  change(device, LIS3DH_CTRL_REG4, 0x30, code << 4);
}

int lis3dh_getSPImode(lis3dh_t *device) { return lis3dh_readByte(device, LIS3DH_CTRL_REG4) & LIS3DH_MASK_SPIMODE ? 3 : 4; }

void lis3dh_setSPImode(lis3dh_t *device, int mode) { change(device, LIS3DH_CTRL_REG4, LIS3DH_MASK_SPIMODE, mode == 3); }

void lis3dh_setBDUmode(lis3dh_t *device, int mode) {
  change(device, LIS3DH_CTRL_REG4, LIS3DH_MASK_BDUMODE, mode == LIS3DH_BDUMODE_CONSISTENT ? LIS3DH_MASK_BDUMODE : 0);
}

void lis3dh_setADCmode(lis3dh_t *device, int adcEnable, int tempEnable) {
  lis3dh_setBDUmode(device, LIS3DH_BDUMODE_CONSISTENT);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, (adcEnable ? 0x80 : 0) | (tempEnable ? 0x40 : 0));
}

lis3dh_t *lis3dh_init4wire(int pinSCK, int pinSDI, int pinSDO, int pinCS) {
  lis3dh_t *device = calloc(1, sizeof *device);
  if (!device) return 0;
  device->sdi_pin = pinSDI, device->sdo_pin = pinSDO, device->sck_pin = pinSCK, device->cs_pin = pinCS;
  high(pinCS);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, pinSDI == pinSDO);
  pause(5);
  lis3dh_setBDUmode(device, LIS3DH_BDUMODE_CONSISTENT);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG1, 0x77);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, 0x80);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG2, 0);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG3, 0);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG5, 0);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG6, 0);
  lis3dh_setResolution(device, 12);
  lis3dh_setRange(device, 2);
  pause(100);
  int x = 0, y = 0, z = 0;
  if (lis3dh_accel_mg(device, &x, &y, &z)) device->tiltavgX = x, device->tiltavgY = y, device->tiltavgZ = z;
  device->tiltavg_factor = 100;
  return device;
}

lis3dh_t *lis3dh_init(int pinSCK, int pinSDI, int pinCS) { return lis3dh_init4wire(pinSCK, pinSDI, pinSDI, pinCS); }

void lis3dh_shutdown(lis3dh_t *device) {
  high(device->cs_pin);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, device->sdi_pin == device->sdo_pin);
  pause(5);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG2, 0);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG3, 0);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG5, 0x80);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG6, 0);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, 0);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG1, 0);
}

/* ---- acceleration */

int lis3dh_accel(lis3dh_t *device, int *x, int *y, int *z) {
  if (!(lis3dh_readByte(device, LIS3DH_STATUS_REG) & 8)) return 0;
  read_three(device, LIS3DH_OUT_X_L, (int *[]){x, y, z});
  return 1;
}

int lis3dh_accel_mg(lis3dh_t *device, int *xmg, int *ymg, int *zmg) {
  int x, y, z;
  if (!lis3dh_accel(device, &x, &y, &z)) return 0;
  int bits = lis3dh_getResolution(device), range = lis3dh_getRange(device);
  unsigned char mg = range * 8 + (range == 16 ? 64 : 0);
  if (bits == 10) mg >>= 2;
  if (bits == 12) mg >>= 4;
  *xmg = x * mg, *ymg = y * mg, *zmg = z * mg;
  return 1;
}

static int chosen(int number, int first, int second, int third) { return number == 1 ? first : number == 2 ? second : number == 3 ? third : 0; }

int lis3dh_getAccel(lis3dh_t *device, int axis) {
  int x, y, z;
  return lis3dh_accel(device, &x, &y, &z) ? chosen(axis, x, y, z) : 0;
}

int lis3dh_getAccel_mg(lis3dh_t *device, int axis) {
  int x, y, z;
  return lis3dh_accel_mg(device, &x, &y, &z) ? chosen(axis, x, y, z) : 0;
}

int lis3dh_tiltConfig(lis3dh_t *device, int avg_factor) {
  if (avg_factor < 0 || avg_factor > 100) return 0;
  device->tiltavg_factor = avg_factor;
  return 1;
}

/* Hundredths as whole numbers; only positive ones are rounded. */
static int whole(int hundredths) { return hundredths / 100 + (hundredths % 100 > 49); }

static int degrees(float radians) {
  int angle = (int)(radians * 57.3);
  return angle < -90 ? -90 : angle > 90 ? 90 : angle;
}

int lis3dh_tilt(lis3dh_t *device, int *ax, int *ay, int *az, int *motion) {
  int x, y, z, part = device->tiltavg_factor;
  if (!lis3dh_accel_mg(device, &x, &y, &z)) return 0;
  if (part > 0 && part < 100) {
    device->tiltavgX = x = whole(x * part + device->tiltavgX * (100 - part));
    device->tiltavgY = y = whole(y * part + device->tiltavgY * (100 - part));
    device->tiltavgZ = z = whole(z * part + device->tiltavgZ * (100 - part));
  }
  *ay = degrees(atan((float)y / sqrt(x * x + z * z)));
  *ax = degrees(atan((float)x / sqrt(y * y + z * z)));
  *az = degrees(atan(sqrt(x * x + y * y) / z));
  *motion = (int)sqrt(x * x + y * y + z * z) - 1000;
  return 1;
}

/* ---- converter and temperature */

void lis3dh_adc(lis3dh_t *device, int *ad1, int *ad2, int *ad3) { read_three(device, LIS3DH_OUT_ADC1_L, (int *[]){ad1, ad2, ad3}); }

int lis3dh_getADC(lis3dh_t *device, int channel) {
  int a, b, c;
  lis3dh_adc(device, &a, &b, &c);
  return chosen(channel, a, b, c);
}

static int mapped(int value, int from, int to, int least, int most) { return (value - from) * (most - least) / (to - from) + least; }

void lis3dh_adc_mV(lis3dh_t *device, int *ad1, int *ad2, int *ad3) {
  int a, b, c;
  lis3dh_adc(device, &a, &b, &c);
  int bits = lis3dh_getResolution(device);
  int zero = bits == 8 ? 87 : bits == 10 ? 350 : 1400, high = bits == 8 ? 127 : bits == 10 ? 508 : 2032, low = bits == 8 ? -128 : -high;
  *ad1 = mapped(a, zero, low, 0, 7800);
  *ad2 = mapped(b, high, low, 900, 1700);
  *ad3 = mapped(c, high, low, 900, 1700);
  if (device->adccal_m1000 || device->adccal_b1000) *ad1 = (*ad1 * device->adccal_m1000 + device->adccal_b1000) / 1000;
}

int lis3dh_getADC_mV(lis3dh_t *device, int channel) {
  int a, b, c;
  lis3dh_adc_mV(device, &a, &b, &c);
  return chosen(channel, a, b, c);
}

void lis3dh_adcCal_mV(lis3dh_t *device, int mV_L, int mV_H, int value_L, int value_H) {
  device->adccal_m1000 = device->adccal_b1000 = 0;
  if (!mV_L && !mV_H && !value_L && !value_H) return;
  device->adccal_m1000 = 1000 * mV_H / (value_H - value_L);
  device->adccal_b1000 = -(device->adccal_m1000 * value_L);
}

/* Six readings are added and divided by five, as in the library. */
int lis3dh_tempRaw(lis3dh_t *device) {
  int sum = 0;
  unsigned char before = lis3dh_readByte(device, LIS3DH_TEMP_CFG_REG);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, 0xC0);
  pause(20);
  lis3dh_getADC(device, 3);
  for (int turn = 0; turn < 6; turn++) {
    pause(20);
    sum += lis3dh_getADC(device, 3) >> 2;
  }
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, before);
  return sum / 5;
}

int lis3dh_temp_C(lis3dh_t *device) { return lis3dh_tempRaw(device) + device->tempcalC; }
int lis3dh_temp_F(lis3dh_t *device) { return lis3dh_temp_C(device) * 9 / 5 + 32; }
void lis3dh_tempCal_C(lis3dh_t *device, int actualTempC) { device->tempcalC = actualTempC - lis3dh_tempRaw(device); }

void lis3dh_tempCal_F(lis3dh_t *device, int actualTempF) {
  int celsius = (actualTempF - 32) * 5 / 9;
  lis3dh_tempCal_C(device, celsius + (actualTempF * 18 % 10 > 5));
}
