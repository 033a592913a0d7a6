//# header mma7455.h
// An accelerometer of three axes on three wires. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Sensor/libmma7455 (mma7455.h
// and its files of one function each).

//# constant MMA7455_XOUTL
//#   fidelity: exact
#define MMA7455_XOUTL 0x00

//# constant MMA7455_XOUTH
//#   fidelity: exact
#define MMA7455_XOUTH 0x01

//# constant MMA7455_YOUTL
//#   fidelity: exact
#define MMA7455_YOUTL 0x02

//# constant MMA7455_YOUTH
//#   fidelity: exact
#define MMA7455_YOUTH 0x03

//# constant MMA7455_ZOUTL
//#   fidelity: exact
#define MMA7455_ZOUTL 0x04

//# constant MMA7455_ZOUTH
//#   fidelity: exact
#define MMA7455_ZOUTH 0x05

//# constant MMA7455_XOUT8
//#   fidelity: exact
#define MMA7455_XOUT8 0x06

//# constant MMA7455_YOUT8
//#   fidelity: exact
#define MMA7455_YOUT8 0x07

//# constant MMA7455_ZOUT8
//#   fidelity: exact
#define MMA7455_ZOUT8 0x08

//# constant MMA7455_STATUS
//#   fidelity: exact
#define MMA7455_STATUS 0x09

//# constant MMA7455_DETSRC
//#   fidelity: exact
#define MMA7455_DETSRC 0x0A

//# constant MMA7455_TOUT
//#   fidelity: exact
#define MMA7455_TOUT 0x0B

//# constant MMA7455_I2CAD
//#   fidelity: exact
#define MMA7455_I2CAD 0x0D

//# constant MMA7455_USRINF
//#   fidelity: exact
#define MMA7455_USRINF 0x0E

//# constant MMA7455_WHOAMI
//#   fidelity: exact
#define MMA7455_WHOAMI 0x0F

//# constant MMA7455_XOFFL
//#   fidelity: exact
#define MMA7455_XOFFL 0x10

//# constant MMA7455_XOFFH
//#   fidelity: exact
#define MMA7455_XOFFH 0x11

//# constant MMA7455_YOFFL
//#   fidelity: exact
#define MMA7455_YOFFL 0x12

//# constant MMA7455_YOFFH
//#   fidelity: exact
#define MMA7455_YOFFH 0x13

//# constant MMA7455_ZOFFL
//#   fidelity: exact
#define MMA7455_ZOFFL 0x14

//# constant MMA7455_ZOFFH
//#   fidelity: exact
#define MMA7455_ZOFFH 0x15

//# constant MMA7455_MCTL
//#   fidelity: exact
#define MMA7455_MCTL 0x16

//# constant MMA7455_INTRST
//#   fidelity: exact
#define MMA7455_INTRST 0x17

//# constant MMA7455_CTL1
//#   fidelity: exact
#define MMA7455_CTL1 0x18

//# constant MMA7455_CTL2
//#   fidelity: exact
#define MMA7455_CTL2 0x19

//# constant MMA7455_LDTH
//#   fidelity: exact
#define MMA7455_LDTH 0x1A

//# constant MMA7455_PDTH
//#   fidelity: exact
#define MMA7455_PDTH 0x1B

//# constant MMA7455_PW
//#   fidelity: exact
#define MMA7455_PW 0x1C

//# constant MMA7455_LT
//#   fidelity: exact
#define MMA7455_LT 0x1D

//# constant MMA7455_TW
//#   fidelity: exact
#define MMA7455_TW 0x1E

//# constant MMA7455_STANDBY
//#   fidelity: exact
#define MMA7455_STANDBY 0

//# constant MMA7455_MEASUREMENT
//#   fidelity: exact
#define MMA7455_MEASUREMENT 1

//# constant MMA7455_LEVEL_DETECT
//#   fidelity: exact
#define MMA7455_LEVEL_DETECT 2

//# constant MMA7455_PULSE_DETECT
//#   fidelity: exact
#define MMA7455_PULSE_DETECT 3

//# helper mma7455_pins
//#   ram: 3
static uint8_t mma7455_pins[3] = {255, 255, 255};  // data, clock, enable

//# adapter MMA7455_writeByte
//#   for: void MMA7455_writeByte(unsigned char address, unsigned char value)
//#   kind: oneToMany
//#   needs: mma7455_pins simpletools.h/low simpletools.h/high simpletools.h/shift_out
//#   fidelity: exact: a one, six bits of the address, a zero, and the value
//#   stack: 56 45
inline void MMA7455_writeByte(uint8_t address, uint8_t value) {
  low(mma7455_pins[2]);
  shift_out(mma7455_pins[0], mma7455_pins[1], MSBFIRST, 7, address | 0x40);
  shift_out(mma7455_pins[0], mma7455_pins[1], MSBFIRST, 1, 0);
  shift_out(mma7455_pins[0], mma7455_pins[1], MSBFIRST, 8, value);
  high(mma7455_pins[2]);
}

//# adapter MMA7455_readByte
//#   for: unsigned char MMA7455_readByte(unsigned char address)
//#   kind: oneToMany
//#   needs: mma7455_pins simpletools.h/low simpletools.h/high simpletools.h/shift_out simpletools.h/shift_in simpletools.h/MSBPRE
//#   fidelity: exact: a zero, six bits of the address, a zero; then the sensor sends the value on the same line
//#   stack: 78 68
inline uint8_t MMA7455_readByte(uint8_t address) {
  low(mma7455_pins[2]);
  shift_out(mma7455_pins[0], mma7455_pins[1], MSBFIRST, 7, address & 0x3F);
  shift_out(mma7455_pins[0], mma7455_pins[1], MSBFIRST, 1, 0);
  uint8_t value = shift_in(mma7455_pins[0], mma7455_pins[1], MSBPRE, 8);
  high(mma7455_pins[2]);
  return value;
}

//# adapter MMA7455_init
//#   for: void MMA7455_init(int pinData, int pinClock, int pinEnable)
//#   kind: oneToMany
//#   needs: mma7455_pins MMA7455_writeByte MMA7455_MCTL simpletools.h/high simpletools.h/low
//#   pin: pinData digital both
//#   pin: pinClock digital out
//#   pin: pinEnable digital out
//#   fidelity: exact: it measures up to 8 g, on three wires
//#   limit: the sensor takes 3.6 V at most: its lines need level shifters on a board of 5 V
//#   stack: 81 67
inline void MMA7455_init(int32_t pinData, int32_t pinClock, int32_t pinEnable) {
  const int32_t pins[3] = {pinData, pinClock, pinEnable};
  for (uint8_t place = 0; place < 3; place++) mma7455_pins[place] = pins[place] < 0 || pins[place] > 254 ? 255 : pins[place];
  high(pinEnable);
  low(pinClock);
  MMA7455_writeByte(MMA7455_MCTL, 0x61);
}

//# adapter MMA7455_gRange
//#   for: void MMA7455_gRange(unsigned char range)
//#   kind: oneToMany
//#   needs: MMA7455_readByte MMA7455_writeByte MMA7455_MCTL
//#   fidelity: exact: 2, 4 or 8 g; 8 is cut to the bits of 0, which mean 8 g
//#   stack: 83 68
inline void MMA7455_gRange(uint8_t range) {
  MMA7455_writeByte(MMA7455_MCTL, (MMA7455_readByte(MMA7455_MCTL) & 0xF3) | (range << 1 & 0x0C));
}

//# adapter MMA7455_setMode
//#   for: void MMA7455_setMode(unsigned char mode)
//#   kind: oneToMany
//#   needs: MMA7455_readByte MMA7455_writeByte MMA7455_MCTL
//#   fidelity: exact
//#   stack: 83 68
inline void MMA7455_setMode(uint8_t mode) {
  MMA7455_writeByte(MMA7455_MCTL, (MMA7455_readByte(MMA7455_MCTL) & 0xFC) | mode);
}

//# adapter MMA7455_getMode
//#   for: unsigned char MMA7455_getMode()
//#   kind: oneToOne
//#   needs: MMA7455_readByte MMA7455_MCTL
//#   fidelity: exact
//#   stack: 78 68
inline uint8_t MMA7455_getMode() {
  return MMA7455_readByte(MMA7455_MCTL) & 3;
}

//# adapter MMA7455_getxyz10
//#   for: void MMA7455_getxyz10(signed short *x, signed short *y, signed short *z)
//#   kind: oneToMany
//#   needs: MMA7455_readByte
//#   fidelity: exact: 64 for 1 g
//#   stack: 92 86
template <class Short> inline void MMA7455_getxyz10(Short *x, Short *y, Short *z) {
  Short *values[3] = {x, y, z};
  for (uint8_t axis = 0; axis < 3; axis++) {
    uint8_t low_byte = MMA7455_readByte(2 * axis), high_byte = MMA7455_readByte(2 * axis + 1);
    if (high_byte & 2) high_byte |= 0xFC;
    *values[axis] = (int16_t)((uint16_t)high_byte << 8 | low_byte);
  }
}

//# adapter MMA7455_getxyz8
//#   for: void MMA7455_getxyz8(signed char *x, signed char *y, signed char *z)
//#   kind: oneToMany
//#   needs: MMA7455_readByte MMA7455_XOUT8
//#   fidelity: exact: the range is 128
//#   stack: 92 76
inline void MMA7455_getxyz8(signed char *x, signed char *y, signed char *z) {
  signed char *values[3] = {x, y, z};
  for (uint8_t axis = 0; axis < 3; axis++) *values[axis] = (signed char)MMA7455_readByte(MMA7455_XOUT8 + axis);
}

//# adapter MMA7455_setOffsetX
//#   for: void MMA7455_setOffsetX(signed short offset)
//#   kind: oneToMany
//#   needs: MMA7455_writeByte MMA7455_XOFFL MMA7455_XOFFH
//#   fidelity: exact: half units, of two bytes
//#   stack: 56
inline void MMA7455_setOffsetX(int16_t offset) {
  MMA7455_writeByte(MMA7455_XOFFL, (uint8_t)offset);
  MMA7455_writeByte(MMA7455_XOFFH, (uint8_t)(offset >> 8));
}

//# adapter MMA7455_setOffsetY
//#   for: void MMA7455_setOffsetY(signed short offset)
//#   kind: oneToMany
//#   needs: MMA7455_writeByte MMA7455_YOFFL MMA7455_YOFFH
//#   fidelity: exact: half units, of two bytes
//#   stack: 56
inline void MMA7455_setOffsetY(int16_t offset) {
  MMA7455_writeByte(MMA7455_YOFFL, (uint8_t)offset);
  MMA7455_writeByte(MMA7455_YOFFH, (uint8_t)(offset >> 8));
}

//# adapter MMA7455_setOffsetZ
//#   for: void MMA7455_setOffsetZ(signed short offset)
//#   kind: oneToMany
//#   needs: MMA7455_writeByte MMA7455_ZOFFL MMA7455_ZOFFH
//#   fidelity: exact: half units, of two bytes
//#   stack: 56
inline void MMA7455_setOffsetZ(int16_t offset) {
  MMA7455_writeByte(MMA7455_ZOFFL, (uint8_t)offset);
  MMA7455_writeByte(MMA7455_ZOFFH, (uint8_t)(offset >> 8));
}
