//# header lis3dh.h
// An accelerometer on three or four wires. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/liblis3dh (lis3dh.h and its
// files of one function each).

//# constant LIS3DH_STATUS_REG_AUX
//#   fidelity: exact
#define LIS3DH_STATUS_REG_AUX 0x07

//# constant LIS3DH_OUT_ADC1_L
//#   fidelity: exact
#define LIS3DH_OUT_ADC1_L 0x08

//# constant LIS3DH_OUT_ADC1_H
//#   fidelity: exact
#define LIS3DH_OUT_ADC1_H 0x09

//# constant LIS3DH_OUT_ADC2_L
//#   fidelity: exact
#define LIS3DH_OUT_ADC2_L 0x0A

//# constant LIS3DH_OUT_ADC2_H
//#   fidelity: exact
#define LIS3DH_OUT_ADC2_H 0x0B

//# constant LIS3DH_OUT_ADC3_L
//#   fidelity: exact
#define LIS3DH_OUT_ADC3_L 0x0C

//# constant LIS3DH_OUT_ADC3_H
//#   fidelity: exact
#define LIS3DH_OUT_ADC3_H 0x0D

//# constant LIS3DH_WHO_AM_I
//#   fidelity: exact
#define LIS3DH_WHO_AM_I 0x0F

//# constant LIS3DH_WHO_AM_I_REPLY
//#   fidelity: exact
#define LIS3DH_WHO_AM_I_REPLY 0x33

//# constant LIS3DH_CTRL_REG0
//#   fidelity: exact
#define LIS3DH_CTRL_REG0 0x1E

//# constant LIS3DH_TEMP_CFG_REG
//#   fidelity: exact
#define LIS3DH_TEMP_CFG_REG 0x1F

//# constant LIS3DH_CTRL_REG1
//#   fidelity: exact
#define LIS3DH_CTRL_REG1 0x20

//# constant LIS3DH_CTRL_REG2
//#   fidelity: exact
#define LIS3DH_CTRL_REG2 0x21

//# constant LIS3DH_CTRL_REG3
//#   fidelity: exact
#define LIS3DH_CTRL_REG3 0x22

//# constant LIS3DH_CTRL_REG4
//#   fidelity: exact
#define LIS3DH_CTRL_REG4 0x23

//# constant LIS3DH_CTRL_REG5
//#   fidelity: exact
#define LIS3DH_CTRL_REG5 0x24

//# constant LIS3DH_CTRL_REG6
//#   fidelity: exact
#define LIS3DH_CTRL_REG6 0x25

//# constant LIS3DH_REFERENCE
//#   fidelity: exact
#define LIS3DH_REFERENCE 0x26

//# constant LIS3DH_STATUS_REG
//#   fidelity: exact
#define LIS3DH_STATUS_REG 0x27

//# constant LIS3DH_OUT_X_L
//#   fidelity: exact
#define LIS3DH_OUT_X_L 0x28

//# constant LIS3DH_OUT_X_H
//#   fidelity: exact
#define LIS3DH_OUT_X_H 0x29

//# constant LIS3DH_OUT_Y_L
//#   fidelity: exact
#define LIS3DH_OUT_Y_L 0x2A

//# constant LIS3DH_OUT_Y_H
//#   fidelity: exact
#define LIS3DH_OUT_Y_H 0x2B

//# constant LIS3DH_OUT_Z_L
//#   fidelity: exact
#define LIS3DH_OUT_Z_L 0x2C

//# constant LIS3DH_OUT_Z_H
//#   fidelity: exact
#define LIS3DH_OUT_Z_H 0x2D

//# constant LIS3DH_FIFO_CTRL_REG
//#   fidelity: exact
#define LIS3DH_FIFO_CTRL_REG 0x2E

//# constant LIS3DH_FIFO_SRC_REG
//#   fidelity: exact
#define LIS3DH_FIFO_SRC_REG 0x2F

//# constant LIS3DH_INT1_CFG
//#   fidelity: exact
#define LIS3DH_INT1_CFG 0x30

//# constant LIS3DH_INT1_SRC
//#   fidelity: exact
#define LIS3DH_INT1_SRC 0x31

//# constant LIS3DH_INT1_THS
//#   fidelity: exact
#define LIS3DH_INT1_THS 0x32

//# constant LIS3DH_INT1_DURATION
//#   fidelity: exact
#define LIS3DH_INT1_DURATION 0x33

//# constant LIS3DH_INT2_CFG
//#   fidelity: exact
#define LIS3DH_INT2_CFG 0x34

//# constant LIS3DH_INT2_SRC
//#   fidelity: exact
#define LIS3DH_INT2_SRC 0x35

//# constant LIS3DH_INT2_THS
//#   fidelity: exact
#define LIS3DH_INT2_THS 0x36

//# constant LIS3DH_INT2_DURATION
//#   fidelity: exact
#define LIS3DH_INT2_DURATION 0x37

//# constant LIS3DH_CLICK_CFG
//#   fidelity: exact
#define LIS3DH_CLICK_CFG 0x38

//# constant LIS3DH_CLICK_SRC
//#   fidelity: exact
#define LIS3DH_CLICK_SRC 0x39

//# constant LIS3DH_CLICK_THS
//#   fidelity: exact
#define LIS3DH_CLICK_THS 0x3A

//# constant LIS3DH_TIME_LIMIT
//#   fidelity: exact
#define LIS3DH_TIME_LIMIT 0x3B

//# constant LIS3DH_TIME_LATENCY
//#   fidelity: exact
#define LIS3DH_TIME_LATENCY 0x3C

//# constant LIS3DH_TIME_WINDOW
//#   fidelity: exact
#define LIS3DH_TIME_WINDOW 0x3D

//# constant LIS3DH_ACT_THS
//#   fidelity: exact
#define LIS3DH_ACT_THS 0x3E

//# constant LIS3DH_ACT_DUR
//#   fidelity: exact
#define LIS3DH_ACT_DUR 0x3F

//# constant LIS3DH_MASK_READSINGLE
//#   fidelity: exact
#define LIS3DH_MASK_READSINGLE 0x80

//# constant LIS3DH_MASK_READREPEAT
//#   fidelity: exact
#define LIS3DH_MASK_READREPEAT 0xC0

//# constant LIS3DH_MASK_BDUMODE
//#   fidelity: exact
#define LIS3DH_MASK_BDUMODE 0x80

//# constant LIS3DH_MASK_SPIMODE
//#   fidelity: exact
#define LIS3DH_MASK_SPIMODE 0x01

//# constant LIS3DH_RANGE_16
//#   fidelity: exact
#define LIS3DH_RANGE_16 0x03

//# constant LIS3DH_RANGE_8
//#   fidelity: exact
#define LIS3DH_RANGE_8 0x02

//# constant LIS3DH_RANGE_4
//#   fidelity: exact
#define LIS3DH_RANGE_4 0x01

//# constant LIS3DH_RANGE_2
//#   fidelity: exact
#define LIS3DH_RANGE_2 0x00

//# constant LIS3DH_AXIS_X
//#   fidelity: exact
#define LIS3DH_AXIS_X 1

//# constant LIS3DH_AXIS_Y
//#   fidelity: exact
#define LIS3DH_AXIS_Y 2

//# constant LIS3DH_AXIS_Z
//#   fidelity: exact
#define LIS3DH_AXIS_Z 3

//# constant LIS3DH_ADC_1
//#   fidelity: exact
#define LIS3DH_ADC_1 1

//# constant LIS3DH_ADC_2
//#   fidelity: exact
#define LIS3DH_ADC_2 2

//# constant LIS3DH_ADC_3
//#   fidelity: exact
#define LIS3DH_ADC_3 3

//# constant LIS3DH_SPIMODE_3
//#   fidelity: exact
#define LIS3DH_SPIMODE_3 1

//# constant LIS3DH_SPIMODE_4
//#   fidelity: exact
#define LIS3DH_SPIMODE_4 0

//# constant LIS3DH_BDUMODE_CONTINUOUS
//#   fidelity: exact
#define LIS3DH_BDUMODE_CONTINUOUS 1

//# constant LIS3DH_BDUMODE_CONSISTENT
//#   fidelity: exact
#define LIS3DH_BDUMODE_CONSISTENT 0

//# type lis3dh_t
//#   fidelity: the fields of the library
struct lis3dh_t {
  int32_t tempcalC, adccal_m1000, adccal_b1000, tiltavgX, tiltavgY, tiltavgZ, tiltavg_factor, sdi_pin, sdo_pin, sck_pin, cs_pin;
};

//# type lis3dh
//#   needs: lis3dh_t
//#   fidelity: exact
typedef lis3dh_t lis3dh;

//# adapter lis3dh_readByte
//#   for: unsigned char lis3dh_readByte(lis3dh_t *device, unsigned char address)
//#   kind: oneToMany
//#   needs: LIS3DH_MASK_READSINGLE lis3dh_t simpletools.h/high simpletools.h/low simpletools.h/shift_in simpletools.h/shift_out
//#   fidelity: exact
//#   stack: 42 30
inline uint8_t lis3dh_readByte(lis3dh_t *device, uint8_t address) {
  low(device->cs_pin);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, address | LIS3DH_MASK_READSINGLE);
  uint8_t value = shift_in(device->sdo_pin, device->sck_pin, 0, 8);
  high(device->cs_pin);
  return value;
}

//# adapter lis3dh_writeByte
//#   for: void lis3dh_writeByte(lis3dh_t *device, unsigned char address, unsigned char value)
//#   kind: oneToMany
//#   needs: lis3dh_t simpletools.h/high simpletools.h/low simpletools.h/shift_out
//#   fidelity: exact
//#   stack: 62 53
inline void lis3dh_writeByte(lis3dh_t *device, uint8_t address, uint8_t value) {
  low(device->cs_pin);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, address);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, value);
  high(device->cs_pin);
}

//# adapter lis3dh_getResolution
//#   for: int lis3dh_getResolution(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG1 LIS3DH_CTRL_REG4 lis3dh_t lis3dh_readByte
//#   fidelity: bits: 8, 10 or 12; 0 for settings that exclude each other
//#   stack: 47 42
inline int32_t lis3dh_getResolution(lis3dh_t *device) {
  bool low_power = lis3dh_readByte(device, LIS3DH_CTRL_REG1) & 8, fine = lis3dh_readByte(device, LIS3DH_CTRL_REG4) & 8;
  return low_power ? (fine ? 0 : 8) : fine ? 12 : 10;
}

//# adapter lis3dh_setResolution
//#   for: void lis3dh_setResolution(lis3dh_t *device, int bits)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG1 LIS3DH_CTRL_REG4 lis3dh_t lis3dh_readByte lis3dh_writeByte
//#   fidelity: 12, 10, else 8 bits
//#   stack: 86 76
inline void lis3dh_setResolution(lis3dh_t *device, int32_t bits) {
  uint8_t first = lis3dh_readByte(device, LIS3DH_CTRL_REG1) & ~8, fourth = lis3dh_readByte(device, LIS3DH_CTRL_REG4) & ~8;
  lis3dh_writeByte(device, LIS3DH_CTRL_REG1, bits == 12 || bits == 10 ? first : first | 8);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, bits == 12 ? fourth | 8 : fourth);
}

//# adapter lis3dh_getRange
//#   for: int lis3dh_getRange(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG4 lis3dh_t lis3dh_readByte
//#   fidelity: g: 2, 4, 8 or 16
//#   stack: 42 30
inline int32_t lis3dh_getRange(lis3dh_t *device) {
  return 2 << (lis3dh_readByte(device, LIS3DH_CTRL_REG4) >> 4 & 3);
}

//# adapter lis3dh_setRange
//#   for: void lis3dh_setRange(lis3dh_t *device, int range)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG4 LIS3DH_RANGE_16 LIS3DH_RANGE_8 LIS3DH_RANGE_4 LIS3DH_RANGE_2 lis3dh_t lis3dh_readByte lis3dh_writeByte
//#   fidelity: 16, 8, 4, else 2 g
//#   stack: 77 64
inline void lis3dh_setRange(lis3dh_t *device, int32_t range) {
  uint8_t bits = range == 16 ? LIS3DH_RANGE_16 : range == 8 ? LIS3DH_RANGE_8 : range == 4 ? LIS3DH_RANGE_4 : LIS3DH_RANGE_2;
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, (lis3dh_readByte(device, LIS3DH_CTRL_REG4) & ~0x30) | bits << 4);
}

//# adapter lis3dh_setBDUmode
//#   for: void lis3dh_setBDUmode(lis3dh_t *device, int mode)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG4 LIS3DH_MASK_BDUMODE LIS3DH_BDUMODE_CONSISTENT lis3dh_t lis3dh_readByte lis3dh_writeByte
//#   fidelity: exact
//#   stack: 80 64
inline void lis3dh_setBDUmode(lis3dh_t *device, int32_t mode) {
  uint8_t fourth = lis3dh_readByte(device, LIS3DH_CTRL_REG4);
  bool consistent = mode == LIS3DH_BDUMODE_CONSISTENT;
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, consistent ? fourth | LIS3DH_MASK_BDUMODE : fourth & ~LIS3DH_MASK_BDUMODE);
}

//# adapter lis3dh_getSPImode
//#   for: int lis3dh_getSPImode(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG4 LIS3DH_MASK_SPIMODE lis3dh_t lis3dh_readByte
//#   fidelity: wires: 3 or 4
//#   stack: 42 30
inline int32_t lis3dh_getSPImode(lis3dh_t *device) {
  return lis3dh_readByte(device, LIS3DH_CTRL_REG4) & LIS3DH_MASK_SPIMODE ? 3 : 4;
}

//# adapter lis3dh_setSPImode
//#   for: void lis3dh_setSPImode(lis3dh_t *device, int mode)
//#   kind: oneToMany
//#   needs: LIS3DH_CTRL_REG4 LIS3DH_MASK_SPIMODE lis3dh_t lis3dh_readByte lis3dh_writeByte
//#   fidelity: exact
//#   stack: 80 64
inline void lis3dh_setSPImode(lis3dh_t *device, int32_t mode) {
  uint8_t fourth = lis3dh_readByte(device, LIS3DH_CTRL_REG4);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, mode == 3 ? fourth | LIS3DH_MASK_SPIMODE : fourth & ~LIS3DH_MASK_SPIMODE);
}

//# adapter lis3dh_getWhoAmI
//#   for: int lis3dh_getWhoAmI(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: LIS3DH_WHO_AM_I lis3dh_t lis3dh_readByte
//#   fidelity: exact: 0x33
//#   stack: 42 30
inline int32_t lis3dh_getWhoAmI(lis3dh_t *device) {
  return lis3dh_readByte(device, LIS3DH_WHO_AM_I);
}

//# adapter lis3dh_setADCmode
//#   for: void lis3dh_setADCmode(lis3dh_t *device, int adcEnable, int tempEnable)
//#   kind: oneToMany
//#   needs: LIS3DH_TEMP_CFG_REG LIS3DH_BDUMODE_CONSISTENT lis3dh_t lis3dh_writeByte lis3dh_setBDUmode
//#   fidelity: exact
//#   stack: 93 77
inline void lis3dh_setADCmode(lis3dh_t *device, int32_t adcEnable, int32_t tempEnable) {
  lis3dh_setBDUmode(device, LIS3DH_BDUMODE_CONSISTENT);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, (adcEnable ? 0x80 : 0) | (tempEnable ? 0x40 : 0));
}

//# helper lis3dh_words
//#   needs: LIS3DH_MASK_READREPEAT lis3dh_t lis3dh_getResolution simpletools.h/high simpletools.h/low simpletools.h/shift_in simpletools.h/shift_out
inline void lis3dh_words(lis3dh_t *device, uint8_t address, int32_t words[3]) {  // three of 16 bits from an address on, in the resolution
  int32_t unused = 16 - lis3dh_getResolution(device);
  low(device->cs_pin);
  shift_out(device->sdi_pin, device->sck_pin, MSBFIRST, 8, address | LIS3DH_MASK_READREPEAT);
  for (uint8_t word = 0; word < 3; word++) {
    uint16_t least = shift_in(device->sdo_pin, device->sck_pin, 0, 8);
    words[word] = (int32_t)(int16_t)(least | (uint16_t)shift_in(device->sdo_pin, device->sck_pin, 0, 8) << 8) >> unused;
  }
  high(device->cs_pin);
}

//# adapter lis3dh_accel
//#   for: int lis3dh_accel(lis3dh_t *device, int *x, int *y, int *z)
//#   kind: oneToMany
//#   needs: LIS3DH_STATUS_REG LIS3DH_OUT_X_L lis3dh_t lis3dh_readByte lis3dh_words
//#   fidelity: exact; 0 while there is nothing new
//#   stack: 86 74
template <class Int> inline int32_t lis3dh_accel(lis3dh_t *device, Int *x, Int *y, Int *z) {
  if (!(lis3dh_readByte(device, LIS3DH_STATUS_REG) & 8)) return 0;
  int32_t words[3];
  lis3dh_words(device, LIS3DH_OUT_X_L, words);
  *x = words[0];
  *y = words[1];
  *z = words[2];
  return 1;
}

//# adapter lis3dh_getAccel
//#   for: int lis3dh_getAccel(lis3dh_t *device, int axis)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_accel
//#   fidelity: exact
//#   stack: 96 68
inline int32_t lis3dh_getAccel(lis3dh_t *device, int32_t axis) {
  int32_t words[3];
  if (axis < 1 || axis > 3 || !lis3dh_accel(device, words, words + 1, words + 2)) return 0;
  return words[axis - 1];
}

//# adapter lis3dh_accel_mg
//#   for: int lis3dh_accel_mg(lis3dh_t *device, int *xmg, int *ymg, int *zmg)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_getResolution lis3dh_getRange lis3dh_accel
//#   fidelity: exact: thousandths of g
//#   stack: 91 79
template <class Int> inline int32_t lis3dh_accel_mg(lis3dh_t *device, Int *x, Int *y, Int *z) {
  if (!lis3dh_accel(device, x, y, z)) return 0;
  int32_t bits = lis3dh_getResolution(device), range = lis3dh_getRange(device);
  int32_t step = (range * 8 + (range == 16 ? 64 : 0)) >> (bits == 10 ? 2 : bits == 12 ? 4 : 0);
  *x *= step;
  *y *= step;
  *z *= step;
  return 1;
}

//# adapter lis3dh_getAccel_mg
//#   for: int lis3dh_getAccel_mg(lis3dh_t *device, int axis)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_accel_mg
//#   fidelity: exact
//#   stack: 95 73
inline int32_t lis3dh_getAccel_mg(lis3dh_t *device, int32_t axis) {
  int32_t words[3];
  if (axis < 1 || axis > 3 || !lis3dh_accel_mg(device, words, words + 1, words + 2)) return 0;
  return words[axis - 1];
}

//# adapter lis3dh_adc
//#   for: void lis3dh_adc(lis3dh_t *device, int *ad1, int *ad2, int *ad3)
//#   kind: oneToMany
//#   needs: LIS3DH_OUT_ADC1_L lis3dh_t lis3dh_words
//#   fidelity: exact
//#   stack: 80 74
template <class Int> inline void lis3dh_adc(lis3dh_t *device, Int *ad1, Int *ad2, Int *ad3) {
  int32_t words[3];
  lis3dh_words(device, LIS3DH_OUT_ADC1_L, words);
  *ad1 = words[0];
  *ad2 = words[1];
  *ad3 = words[2];
}

//# adapter lis3dh_getADC
//#   for: int lis3dh_getADC(lis3dh_t *device, int channel)
//#   kind: oneToMany
//#   needs: LIS3DH_OUT_ADC1_L lis3dh_t lis3dh_words
//#   fidelity: exact
//#   stack: 80 68
inline int32_t lis3dh_getADC(lis3dh_t *device, int32_t channel) {
  int32_t words[3];
  lis3dh_words(device, LIS3DH_OUT_ADC1_L, words);
  return channel < 1 || channel > 3 ? 0 : words[channel - 1];
}

//# adapter lis3dh_adc_mV
//#   for: void lis3dh_adc_mV(lis3dh_t *device, int *ad1, int *ad2, int *ad3)
//#   kind: oneToMany
//#   needs: LIS3DH_OUT_ADC1_L lis3dh_t lis3dh_getResolution lis3dh_words
//#   fidelity: exact: millivolts
//#   stack: 96 79
template <class Int> inline void lis3dh_adc_mV(lis3dh_t *device, Int *ad1, Int *ad2, Int *ad3) {
  int32_t words[3], bits = lis3dh_getResolution(device);
  lis3dh_words(device, LIS3DH_OUT_ADC1_L, words);
  int32_t zero = bits == 8 ? 87 : bits == 10 ? 350 : 1400, most = bits == 8 ? 127 : bits == 10 ? 508 : 2032;
  int32_t least = bits == 8 ? -128 : -most;
  int32_t first = (words[0] - zero) * 7800 / (least - zero);
  if (device->adccal_m1000 || device->adccal_b1000) first = (first * device->adccal_m1000 + device->adccal_b1000) / 1000;
  *ad1 = first;
  *ad2 = (words[1] - most) * 800 / (least - most) + 900;
  *ad3 = (words[2] - most) * 800 / (least - most) + 900;
}

//# adapter lis3dh_getADC_mV
//#   for: int lis3dh_getADC_mV(lis3dh_t *device, int channel)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_adc_mV
//#   fidelity: exact: millivolts
//#   stack: 110 73
inline int32_t lis3dh_getADC_mV(lis3dh_t *device, int32_t channel) {
  int32_t words[3];
  lis3dh_adc_mV(device, words, words + 1, words + 2);
  return channel < 1 || channel > 3 ? 0 : words[channel - 1];
}

//# adapter lis3dh_adcCal_mV
//#   for: void lis3dh_adcCal_mV(lis3dh_t *device, int mV_L, int mV_H, int value_L, int value_H)
//#   kind: oneToMany
//#   needs: lis3dh_t
//#   fidelity: exact; the lower voltage is taken for 0, as there
//#   stack: 8
inline void lis3dh_adcCal_mV(lis3dh_t *device, int32_t mV_L, int32_t mV_H, int32_t value_L, int32_t value_H) {
  device->adccal_m1000 = device->adccal_b1000 = 0;
  if (!mV_L && !mV_H && !value_L && !value_H) return;
  device->adccal_m1000 = 1000 * mV_H / (value_H - value_L);
  device->adccal_b1000 = -device->adccal_m1000 * value_L;
}

//# adapter lis3dh_tempRaw
//#   for: int lis3dh_tempRaw(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: LIS3DH_TEMP_CFG_REG lis3dh_t lis3dh_readByte lis3dh_writeByte lis3dh_getADC
//#   fidelity: six samples divided by five, as there
//#   stack: 89 71
inline int32_t lis3dh_tempRaw(lis3dh_t *device) {
  uint8_t before = lis3dh_readByte(device, LIS3DH_TEMP_CFG_REG);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, 0xC0);
  delay(20);
  int32_t sum = 0;
  for (uint8_t sample = 0; sample < 6; sample++) {
    delay(20);
    sum += lis3dh_getADC(device, 3) >> 2;
  }
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, before);
  return sum / 5;
}

//# adapter lis3dh_temp_C
//#   for: int lis3dh_temp_C(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_tempRaw
//#   fidelity: exact
//#   stack: 89 71
inline int32_t lis3dh_temp_C(lis3dh_t *device) {
  return lis3dh_tempRaw(device) + device->tempcalC;
}

//# adapter lis3dh_temp_F
//#   for: int lis3dh_temp_F(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_temp_C
//#   fidelity: exact
//#   stack: 89 71
inline int32_t lis3dh_temp_F(lis3dh_t *device) {
  return lis3dh_temp_C(device) * 9 / 5 + 32;
}

//# adapter lis3dh_tempCal_C
//#   for: void lis3dh_tempCal_C(lis3dh_t *device, int actualTempC)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_tempRaw
//#   fidelity: exact
//#   stack: 89 75
inline void lis3dh_tempCal_C(lis3dh_t *device, int32_t actualTempC) {
  device->tempcalC = actualTempC - lis3dh_tempRaw(device);
}

//# adapter lis3dh_tempCal_F
//#   for: void lis3dh_tempCal_F(lis3dh_t *device, int actualTempF)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_tempCal_C
//#   fidelity: exact
//#   stack: 93 75
inline void lis3dh_tempCal_F(lis3dh_t *device, int32_t actualTempF) {
  lis3dh_tempCal_C(device, (actualTempF - 32) * 5 / 9 + (actualTempF * 18 % 10 > 5));
}

//# adapter lis3dh_tiltConfig
//#   for: int lis3dh_tiltConfig(lis3dh_t *device, int avg_factor)
//#   kind: oneToMany
//#   needs: lis3dh_t
//#   fidelity: exact
//#   stack: 0
inline int32_t lis3dh_tiltConfig(lis3dh_t *device, int32_t avg_factor) {
  if (avg_factor < 0 || avg_factor > 100) return 0;
  device->tiltavg_factor = avg_factor;
  return 1;
}

//# adapter lis3dh_tilt
//#   for: int lis3dh_tilt(lis3dh_t *device, int *ax, int *ay, int *az, int *motion)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_accel_mg
//#   fidelity: whole degrees, and thousandths of g beyond 1 g
//#   stack: 119 99
template <class Int> inline int32_t lis3dh_tilt(lis3dh_t *device, Int *ax, Int *ay, Int *az, Int *motion) {
  int32_t now[3], *average[3] = {&device->tiltavgX, &device->tiltavgY, &device->tiltavgZ};
  if (!lis3dh_accel_mg(device, now, now + 1, now + 2)) return 0;
  int32_t weight = device->tiltavg_factor;
  for (uint8_t axis = 0; weight > 0 && weight < 100 && axis < 3; axis++) {
    int32_t sum = now[axis] * weight + *average[axis] * (100 - weight);
    now[axis] = *average[axis] = sum / 100 + (sum % 100 > 49);
  }
  float x = now[0], y = now[1], z = now[2];
  *ax = (int32_t)(atan(x / sqrt(y * y + z * z)) * 57.3f);
  *ay = (int32_t)(atan(y / sqrt(x * x + z * z)) * 57.3f);
  *az = (int32_t)(atan(sqrt(x * x + y * y) / z) * 57.3f);
  *motion = (int32_t)sqrt(x * x + y * y + z * z) - 1000;
  return 1;
}

//# adapter lis3dh_init4wire
//#   for: lis3dh_t *lis3dh_init4wire(int pinSCK, int pinSDI, int pinSDO, int pinCS)
//#   kind: oneToMany
//#   needs: LIS3DH_TEMP_CFG_REG LIS3DH_CTRL_REG1 LIS3DH_CTRL_REG2 LIS3DH_CTRL_REG3 LIS3DH_CTRL_REG4 LIS3DH_CTRL_REG5 LIS3DH_CTRL_REG6 LIS3DH_BDUMODE_CONSISTENT lis3dh_t lis3dh_writeByte lis3dh_setResolution lis3dh_setRange lis3dh_setBDUmode lis3dh_accel_mg simpletools.h/high
//#   pin: pinSCK digital out accelerometer
//#   pin: pinSDI digital both accelerometer
//#   pin: pinSDO digital in accelerometer
//#   pin: pinCS digital out accelerometer
//#   fidelity: 12 bits, 2 g, 400 samples a second
//#   limit: the sensor takes 3.6 V at most: its lines need level shifters on a board of 5 V
//#   stack: 99 81
inline lis3dh_t *lis3dh_init4wire(int32_t pinSCK, int32_t pinSDI, int32_t pinSDO, int32_t pinCS) {
  lis3dh_t *device = new lis3dh_t();
  device->sck_pin = pinSCK;
  device->sdi_pin = pinSDI;
  device->sdo_pin = pinSDO;
  device->cs_pin = pinCS;
  high(pinCS);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, pinSDI == pinSDO);  // the data line serves both ways
  delay(5);
  lis3dh_setBDUmode(device, LIS3DH_BDUMODE_CONSISTENT);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG1, 0x77);
  lis3dh_writeByte(device, LIS3DH_TEMP_CFG_REG, 0x80);
  const uint8_t cleared[] = {LIS3DH_CTRL_REG2, LIS3DH_CTRL_REG3, LIS3DH_CTRL_REG5, LIS3DH_CTRL_REG6};
  for (uint8_t address : cleared) lis3dh_writeByte(device, address, 0);
  lis3dh_setResolution(device, 12);
  lis3dh_setRange(device, 2);
  delay(100);
  lis3dh_accel_mg(device, &device->tiltavgX, &device->tiltavgY, &device->tiltavgZ);
  device->tiltavg_factor = 100;
  return device;
}

//# adapter lis3dh_init
//#   for: lis3dh_t *lis3dh_init(int pinSCK, int pinSDI, int pinCS)
//#   kind: oneToMany
//#   needs: lis3dh_t lis3dh_init4wire
//#   pin: pinSCK digital out accelerometer
//#   pin: pinSDI digital both accelerometer
//#   pin: pinCS digital out accelerometer
//#   fidelity: as lis3dh_init4wire, with one line for data
//#   limit: the sensor takes 3.6 V at most: its lines need level shifters on a board of 5 V
//#   stack: 99 83
inline lis3dh_t *lis3dh_init(int32_t pinSCK, int32_t pinSDI, int32_t pinCS) {
  return lis3dh_init4wire(pinSCK, pinSDI, pinSDI, pinCS);
}

//# adapter lis3dh_shutdown
//#   for: void lis3dh_shutdown(lis3dh_t *device)
//#   kind: oneToMany
//#   needs: LIS3DH_TEMP_CFG_REG LIS3DH_CTRL_REG1 LIS3DH_CTRL_REG2 LIS3DH_CTRL_REG3 LIS3DH_CTRL_REG4 LIS3DH_CTRL_REG5 LIS3DH_CTRL_REG6 lis3dh_t lis3dh_writeByte simpletools.h/high
//#   fidelity: exact
//#   stack: 71 57
inline void lis3dh_shutdown(lis3dh_t *device) {
  high(device->cs_pin);
  lis3dh_writeByte(device, LIS3DH_CTRL_REG4, device->sdi_pin == device->sdo_pin);
  delay(5);
  const uint8_t cleared[] = {LIS3DH_CTRL_REG2, LIS3DH_CTRL_REG3, LIS3DH_CTRL_REG6, LIS3DH_TEMP_CFG_REG, LIS3DH_CTRL_REG1};
  lis3dh_writeByte(device, LIS3DH_CTRL_REG5, 0x80);
  for (uint8_t address : cleared) lis3dh_writeByte(device, address, 0);
}
