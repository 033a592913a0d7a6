//# header lsm9ds1.h
// A sensor of motion with nine axes on three wires and two selects. Read from Simple-Libraries 1cc167c10,
// Learn/Simple Libraries/Sensor/liblsm9ds1 (lsm9ds1.h and its files of one group of functions each).

//# constant ACT_THS
//#   fidelity: exact
#define ACT_THS 0x04

//# constant ACT_DUR
//#   fidelity: exact
#define ACT_DUR 0x05

//# constant INT_GEN_CFG_XL
//#   fidelity: exact
#define INT_GEN_CFG_XL 0x06

//# constant INT_GEN_THS_X_XL
//#   fidelity: exact
#define INT_GEN_THS_X_XL 0x07

//# constant INT_GEN_THS_Y_XL
//#   fidelity: exact
#define INT_GEN_THS_Y_XL 0x08

//# constant INT_GEN_THS_Z_XL
//#   fidelity: exact
#define INT_GEN_THS_Z_XL 0x09

//# constant INT_GEN_DUR_XL
//#   fidelity: exact
#define INT_GEN_DUR_XL 0x0A

//# constant REFERENCE_G
//#   fidelity: exact
#define REFERENCE_G 0x0B

//# constant INT1_CTRL
//#   fidelity: exact
#define INT1_CTRL 0x0C

//# constant INT2_CTRL
//#   fidelity: exact
#define INT2_CTRL 0x0D

//# constant WHO_AM_I_XG
//#   fidelity: exact
#define WHO_AM_I_XG 0x0F

//# constant CTRL_REG1_G
//#   fidelity: exact
#define CTRL_REG1_G 0x10

//# constant CTRL_REG2_G
//#   fidelity: exact
#define CTRL_REG2_G 0x11

//# constant CTRL_REG3_G
//#   fidelity: exact
#define CTRL_REG3_G 0x12

//# constant ORIENT_CFG_G
//#   fidelity: exact
#define ORIENT_CFG_G 0x13

//# constant INT_GEN_SRC_G
//#   fidelity: exact
#define INT_GEN_SRC_G 0x14

//# constant OUT_TEMP_L
//#   fidelity: exact
#define OUT_TEMP_L 0x15

//# constant OUT_TEMP_H
//#   fidelity: exact
#define OUT_TEMP_H 0x16

//# constant STATUS_REG_0
//#   fidelity: exact
#define STATUS_REG_0 0x17

//# constant OUT_X_L_G
//#   fidelity: exact
#define OUT_X_L_G 0x18

//# constant OUT_X_H_G
//#   fidelity: exact
#define OUT_X_H_G 0x19

//# constant OUT_Y_L_G
//#   fidelity: exact
#define OUT_Y_L_G 0x1A

//# constant OUT_Y_H_G
//#   fidelity: exact
#define OUT_Y_H_G 0x1B

//# constant OUT_Z_L_G
//#   fidelity: exact
#define OUT_Z_L_G 0x1C

//# constant OUT_Z_H_G
//#   fidelity: exact
#define OUT_Z_H_G 0x1D

//# constant CTRL_REG4
//#   fidelity: exact
#define CTRL_REG4 0x1E

//# constant CTRL_REG5_XL
//#   fidelity: exact
#define CTRL_REG5_XL 0x1F

//# constant CTRL_REG6_XL
//#   fidelity: exact
#define CTRL_REG6_XL 0x20

//# constant CTRL_REG7_XL
//#   fidelity: exact
#define CTRL_REG7_XL 0x21

//# constant CTRL_REG8
//#   fidelity: exact
#define CTRL_REG8 0x22

//# constant CTRL_REG9
//#   fidelity: exact
#define CTRL_REG9 0x23

//# constant CTRL_REG10
//#   fidelity: exact
#define CTRL_REG10 0x24

//# constant INT_GEN_SRC_XL
//#   fidelity: exact
#define INT_GEN_SRC_XL 0x26

//# constant STATUS_REG_1
//#   fidelity: exact
#define STATUS_REG_1 0x27

//# constant OUT_X_L_XL
//#   fidelity: exact
#define OUT_X_L_XL 0x28

//# constant OUT_X_H_XL
//#   fidelity: exact
#define OUT_X_H_XL 0x29

//# constant OUT_Y_L_XL
//#   fidelity: exact
#define OUT_Y_L_XL 0x2A

//# constant OUT_Y_H_XL
//#   fidelity: exact
#define OUT_Y_H_XL 0x2B

//# constant OUT_Z_L_XL
//#   fidelity: exact
#define OUT_Z_L_XL 0x2C

//# constant OUT_Z_H_XL
//#   fidelity: exact
#define OUT_Z_H_XL 0x2D

//# constant FIFO_CTRL
//#   fidelity: exact
#define FIFO_CTRL 0x2E

//# constant FIFO_SRC
//#   fidelity: exact
#define FIFO_SRC 0x2F

//# constant INT_GEN_CFG_G
//#   fidelity: exact
#define INT_GEN_CFG_G 0x30

//# constant INT_GEN_THS_XH_G
//#   fidelity: exact
#define INT_GEN_THS_XH_G 0x31

//# constant INT_GEN_THS_XL_G
//#   fidelity: exact
#define INT_GEN_THS_XL_G 0x32

//# constant INT_GEN_THS_YH_G
//#   fidelity: exact
#define INT_GEN_THS_YH_G 0x33

//# constant INT_GEN_THS_YL_G
//#   fidelity: exact
#define INT_GEN_THS_YL_G 0x34

//# constant INT_GEN_THS_ZH_G
//#   fidelity: exact
#define INT_GEN_THS_ZH_G 0x35

//# constant INT_GEN_THS_ZL_G
//#   fidelity: exact
#define INT_GEN_THS_ZL_G 0x36

//# constant INT_GEN_DUR_G
//#   fidelity: exact
#define INT_GEN_DUR_G 0x37

//# constant OFFSET_X_REG_L_M
//#   fidelity: exact
#define OFFSET_X_REG_L_M 0x05

//# constant OFFSET_X_REG_H_M
//#   fidelity: exact
#define OFFSET_X_REG_H_M 0x06

//# constant OFFSET_Y_REG_L_M
//#   fidelity: exact
#define OFFSET_Y_REG_L_M 0x07

//# constant OFFSET_Y_REG_H_M
//#   fidelity: exact
#define OFFSET_Y_REG_H_M 0x08

//# constant OFFSET_Z_REG_L_M
//#   fidelity: exact
#define OFFSET_Z_REG_L_M 0x09

//# constant OFFSET_Z_REG_H_M
//#   fidelity: exact
#define OFFSET_Z_REG_H_M 0x0A

//# constant WHO_AM_I_M
//#   fidelity: exact
#define WHO_AM_I_M 0x0F

//# constant CTRL_REG1_M
//#   fidelity: exact
#define CTRL_REG1_M 0x20

//# constant CTRL_REG2_M
//#   fidelity: exact
#define CTRL_REG2_M 0x21

//# constant CTRL_REG3_M
//#   fidelity: exact
#define CTRL_REG3_M 0x22

//# constant CTRL_REG4_M
//#   fidelity: exact
#define CTRL_REG4_M 0x23

//# constant CTRL_REG5_M
//#   fidelity: exact
#define CTRL_REG5_M 0x24

//# constant STATUS_REG_M
//#   fidelity: exact
#define STATUS_REG_M 0x27

//# constant OUT_X_L_M
//#   fidelity: exact
#define OUT_X_L_M 0x28

//# constant OUT_X_H_M
//#   fidelity: exact
#define OUT_X_H_M 0x29

//# constant OUT_Y_L_M
//#   fidelity: exact
#define OUT_Y_L_M 0x2A

//# constant OUT_Y_H_M
//#   fidelity: exact
#define OUT_Y_H_M 0x2B

//# constant OUT_Z_L_M
//#   fidelity: exact
#define OUT_Z_L_M 0x2C

//# constant OUT_Z_H_M
//#   fidelity: exact
#define OUT_Z_H_M 0x2D

//# constant INT_CFG_M
//#   fidelity: exact
#define INT_CFG_M 0x30

//# constant INT_SRC_M
//#   fidelity: exact
#define INT_SRC_M 0x30

//# constant INT_THS_L_M
//#   fidelity: exact
#define INT_THS_L_M 0x32

//# constant INT_THS_H_M
//#   fidelity: exact
#define INT_THS_H_M 0x33

//# constant WHO_AM_I_AG_RSP
//#   fidelity: exact
#define WHO_AM_I_AG_RSP 0x68

//# constant WHO_AM_I_M_RSP
//#   fidelity: exact
#define WHO_AM_I_M_RSP 0x3D

//# constant FIFO_OFF
//#   fidelity: exact
#define FIFO_OFF 0

//# constant FIFO_THS
//#   fidelity: exact
#define FIFO_THS 1

//# constant FIFO_CONT_TRIGGER
//#   fidelity: exact
#define FIFO_CONT_TRIGGER 3

//# constant FIFO_OFF_TRIGGER
//#   fidelity: exact
#define FIFO_OFF_TRIGGER 4

//# constant FIFO_CONT
//#   fidelity: exact
#define FIFO_CONT 5

//# constant X_AXIS
//#   fidelity: exact
#define X_AXIS 0

//# constant Y_AXIS
//#   fidelity: exact
#define Y_AXIS 1

//# constant Z_AXIS
//#   fidelity: exact
#define Z_AXIS 2

//# constant ALL_AXIS
//#   fidelity: exact
#define ALL_AXIS 3

//# constant CELSIUS
//#   fidelity: exact
#define CELSIUS 0

//# constant FAHRENHEIT
//#   fidelity: exact
#define FAHRENHEIT 1

//# constant KELVIN
//#   fidelity: exact
#define KELVIN 2

//# helper imu_state
//#   ram: 59
struct ImuState {
  uint8_t clock, data, motion, field;  // its pins: SCL, SDIO, and the selects of the two halves
  uint8_t corrected;                   // bit 0: biases of the gyroscope are taken off, bit 1: those of the accelerometer
  uint8_t accelScale, fieldScale;
  int32_t gyroScale, bias[3][3];       // of the gyroscope, the accelerometer and the magnetometer
  float perUnit[3];
};
static ImuState imu_state = {255, 255, 255, 255, 0, 0, 16, 2000, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {0, 0, 0}};

//# adapter imu_SPIwriteByte
//#   for: void imu_SPIwriteByte(unsigned char csPin, unsigned char subAddress, unsigned char data)
//#   kind: oneToMany
//#   needs: imu_state simpletools.h/low simpletools.h/high simpletools.h/shift_out
//#   pin: csPin digital out
//#   fidelity: exact
//#   stack: 64 41
inline void imu_SPIwriteByte(int32_t csPin, uint8_t subAddress, uint8_t data) {
  low(csPin);
  shift_out(imu_state.data, imu_state.clock, MSBFIRST, 8, subAddress & 0x3F);
  shift_out(imu_state.data, imu_state.clock, MSBFIRST, 8, data);
  high(csPin);
}

//# adapter imu_SPIreadBytes
//#   for: void imu_SPIreadBytes(unsigned char csPin, unsigned char subAddress, unsigned char *dest, unsigned char count)
//#   kind: oneToMany
//#   needs: imu_state simpletools.h/low simpletools.h/high simpletools.h/shift_out simpletools.h/shift_in simpletools.h/MSBPRE
//#   pin: csPin digital out
//#   fidelity: exact: the magnetometer is told when several bytes are read
//#   stack: 46 30
inline void imu_SPIreadBytes(int32_t csPin, uint8_t subAddress, void *dest, uint8_t count) {
  uint8_t address = 0x80 | (subAddress & 0x3F);
  if (csPin == imu_state.field && count > 1) address |= 0x40;
  low(csPin);
  shift_out(imu_state.data, imu_state.clock, MSBFIRST, 8, address);
  for (uint8_t place = 0; place < count; place++) ((uint8_t *)dest)[place] = shift_in(imu_state.data, imu_state.clock, MSBPRE, 8);
  high(csPin);
}

//# helper imu_readAxes
//#   needs: imu_SPIreadBytes hal/SourceInt
inline void imu_readAxes(int32_t csPin, uint8_t subAddress, SourceInt *x, SourceInt *y, SourceInt *z) {  // 16 bits with a sign each
  SourceInt *to[3] = {x, y, z};
  uint8_t bytes[6];
  imu_SPIreadBytes(csPin, subAddress, bytes, 6);
  for (uint8_t axis = 0; axis < 3; axis++) *to[axis] = (int16_t)(bytes[2 * axis + 1] << 8 | bytes[2 * axis]);
}

//# helper imu_lessBias
//#   needs: imu_state hal/SourceInt
inline void imu_lessBias(uint8_t sensor, SourceInt *x, SourceInt *y, SourceInt *z) {
  if (!(imu_state.corrected >> sensor & 1)) return;
  *x -= imu_state.bias[sensor][0];
  *y -= imu_state.bias[sensor][1];
  *z -= imu_state.bias[sensor][2];
}

//# helper imu_byte
//#   needs: imu_SPIreadBytes
inline uint8_t imu_byte(uint8_t select, uint8_t address) {
  uint8_t value = 0;
  imu_SPIreadBytes(select, address, &value, 1);
  return value;
}

//# helper imu_change
//#   needs: imu_byte imu_SPIwriteByte
inline void imu_change(uint8_t select, uint8_t address, uint8_t kept, uint8_t set) {
  imu_SPIwriteByte(select, address, (imu_byte(select, address) & kept) | set);
}

//# adapter imu_readGyro
//#   for: void imu_readGyro(int *gx, int *gy, int *gz)
//#   kind: oneToMany
//#   needs: imu_state imu_readAxes imu_lessBias OUT_X_L_G hal/SourceInt
//#   fidelity: exact: 16 bits with a sign, less the bias once there is a calibration
//#   stack: 55 42
inline void imu_readGyro(SourceInt *gx, SourceInt *gy, SourceInt *gz) {
  imu_readAxes(imu_state.motion, OUT_X_L_G, gx, gy, gz);
  imu_lessBias(0, gx, gy, gz);
}

//# adapter imu_readGyroCalculated
//#   for: void imu_readGyroCalculated(float *gx, float *gy, float *gz)
//#   kind: oneToMany
//#   needs: imu_state imu_readGyro hal/SourceInt
//#   fidelity: exact: degrees per second
//#   stack: 73 61
inline void imu_readGyroCalculated(float *gx, float *gy, float *gz) {
  SourceInt x, y, z;
  imu_readGyro(&x, &y, &z);
  *gx = x / imu_state.perUnit[0];
  *gy = y / imu_state.perUnit[0];
  *gz = z / imu_state.perUnit[0];
}

//# adapter imu_readAccel
//#   for: void imu_readAccel(int *ax, int *ay, int *az)
//#   kind: oneToMany
//#   needs: imu_state imu_readAxes imu_lessBias OUT_X_L_XL hal/SourceInt
//#   fidelity: exact: 16 bits with a sign, less the bias once there is a calibration
//#   stack: 55 42
inline void imu_readAccel(SourceInt *ax, SourceInt *ay, SourceInt *az) {
  imu_readAxes(imu_state.motion, OUT_X_L_XL, ax, ay, az);
  imu_lessBias(1, ax, ay, az);
}

//# adapter imu_readAccelCalculated
//#   for: void imu_readAccelCalculated(float *ax, float *ay, float *az)
//#   kind: oneToMany
//#   needs: imu_state imu_readAccel hal/SourceInt
//#   fidelity: exact: g
//#   stack: 73 61
inline void imu_readAccelCalculated(float *ax, float *ay, float *az) {
  SourceInt x, y, z;
  imu_readAccel(&x, &y, &z);
  *ax = x / imu_state.perUnit[1];
  *ay = y / imu_state.perUnit[1];
  *az = z / imu_state.perUnit[1];
}

//# adapter imu_readMag
//#   for: void imu_readMag(int *mx, int *my, int *mz)
//#   kind: oneToMany
//#   needs: imu_state imu_readAxes OUT_X_L_M hal/SourceInt
//#   fidelity: exact: 16 bits with a sign
//#   stack: 59 42
inline void imu_readMag(SourceInt *mx, SourceInt *my, SourceInt *mz) {
  imu_readAxes(imu_state.field, OUT_X_L_M, mx, my, mz);
}

//# adapter imu_readMagCalculated
//#   for: void imu_readMagCalculated(float *mx, float *my, float *mz)
//#   kind: oneToMany
//#   needs: imu_state imu_readMag hal/SourceInt
//#   fidelity: exact: gauss
//#   stack: 73 61
inline void imu_readMagCalculated(float *mx, float *my, float *mz) {
  SourceInt x, y, z;
  imu_readMag(&x, &y, &z);
  *mx = x / imu_state.perUnit[2];
  *my = y / imu_state.perUnit[2];
  *mz = z / imu_state.perUnit[2];
}

//# adapter imu_readTemp
//#   for: void imu_readTemp(int *temperature)
//#   kind: oneToMany
//#   needs: imu_state imu_SPIreadBytes OUT_TEMP_L hal/SourceInt
//#   fidelity: exact: sixteenths of a degree from 25 degrees Celsius on
//#   stack: 45 32
inline void imu_readTemp(SourceInt *temperature) {
  uint8_t bytes[2];
  imu_SPIreadBytes(imu_state.motion, OUT_TEMP_L, bytes, 2);
  *temperature = (int16_t)(bytes[1] << 8 | bytes[0]);
}

//# adapter imu_readTempCalculated
//#   for: void imu_readTempCalculated(float *temperature, char tempUnit)
//#   kind: oneToMany
//#   needs: imu_readTemp FAHRENHEIT KELVIN hal/SourceInt
//#   fidelity: exact
//#   stack: 46 32
inline void imu_readTempCalculated(float *temperature, uint8_t tempUnit) {
  SourceInt raw;
  imu_readTemp(&raw);
  *temperature = raw / 16.0f + 25.0f;
  if (tempUnit == FAHRENHEIT) *temperature = *temperature * 1.8f + 32.0f;
  if (tempUnit == KELVIN) *temperature += 273.15f;
}

//# adapter imu_accelAvailable
//#   for: unsigned char imu_accelAvailable()
//#   kind: oneToOne
//#   needs: imu_state imu_byte STATUS_REG_1
//#   fidelity: exact: whether there is a new reading, 1 or 0
//#   stack: 37 30
inline uint8_t imu_accelAvailable() {
  return imu_byte(imu_state.motion, STATUS_REG_1) >> 0 & 1;
}

//# adapter imu_gyroAvailable
//#   for: unsigned char imu_gyroAvailable()
//#   kind: oneToOne
//#   needs: imu_state imu_byte STATUS_REG_1
//#   fidelity: exact: whether there is a new reading, 1 or 0
//#   stack: 37 30
inline uint8_t imu_gyroAvailable() {
  return imu_byte(imu_state.motion, STATUS_REG_1) >> 1 & 1;
}

//# adapter imu_tempAvailable
//#   for: unsigned char imu_tempAvailable()
//#   kind: oneToOne
//#   needs: imu_state imu_byte STATUS_REG_1
//#   fidelity: exact: whether there is a new reading, 1 or 0
//#   stack: 37 30
inline uint8_t imu_tempAvailable() {
  return imu_byte(imu_state.motion, STATUS_REG_1) >> 2 & 1;
}

//# adapter imu_magAvailable
//#   for: unsigned char imu_magAvailable()
//#   kind: oneToOne
//#   needs: imu_state imu_byte STATUS_REG_M
//#   fidelity: exact: whether there is a new reading, 1 or 0
//#   stack: 37 30
inline uint8_t imu_magAvailable() {
  return imu_byte(imu_state.field, STATUS_REG_M) >> 3 & 1;
}

//# adapter imu_setGyroScale
//#   for: void imu_setGyroScale(unsigned int gScl)
//#   kind: oneToMany
//#   needs: imu_state imu_change CTRL_REG1_G
//#   fidelity: exact: 245, 500 or 2000 degrees per second, 245 for others
//#   stack: 84 68
inline void imu_setGyroScale(uint32_t gScl) {
  if (gScl != 500 && gScl != 2000) gScl = 245;
  imu_state.gyroScale = gScl;
  imu_state.perUnit[0] = 32768.0f / gScl;
  imu_change(imu_state.motion, CTRL_REG1_G, 0xE7, gScl == 500 ? 0x08 : gScl == 2000 ? 0x18 : 0);
}

//# adapter imu_setAccelScale
//#   for: void imu_setAccelScale(unsigned char aScl)
//#   kind: oneToMany
//#   needs: imu_state imu_change CTRL_REG6_XL
//#   fidelity: exact: 2, 4, 8 or 16 g, 2 for others
//#   stack: 84 68
inline void imu_setAccelScale(uint8_t aScl) {
  if (aScl != 4 && aScl != 8 && aScl != 16) aScl = 2;
  imu_state.accelScale = aScl;
  imu_state.perUnit[1] = 32768.0f / aScl;
  imu_change(imu_state.motion, CTRL_REG6_XL, 0xE7, aScl == 4 ? 0x10 : aScl == 8 ? 0x18 : aScl == 16 ? 0x08 : 0);
}

//# adapter imu_setMagScale
//#   for: void imu_setMagScale(unsigned char mScl)
//#   kind: oneToMany
//#   needs: imu_state imu_change CTRL_REG2_M
//#   fidelity: exact: 4, 8, 12 or 16 gauss, 4 for others
//#   stack: 84 68
inline void imu_setMagScale(uint8_t mScl) {
  if (mScl != 8 && mScl != 12 && mScl != 16) mScl = 4;
  imu_state.fieldScale = mScl;
  imu_state.perUnit[2] = mScl == 8 ? 3448.28f : mScl == 12 ? 2298.85f : mScl == 16 ? 1724.14f : 6896.55f;
  imu_change(imu_state.field, CTRL_REG2_M, 0x9F, (mScl / 4 - 1) << 5);
}

//# adapter imu_getGyroScale
//#   for: int imu_getGyroScale()
//#   kind: oneToOne
//#   needs: imu_state
//#   fidelity: exact
//#   stack: 0
inline int32_t imu_getGyroScale() {
  return imu_state.gyroScale;
}

//# adapter imu_getAccelScale
//#   for: int imu_getAccelScale()
//#   kind: oneToOne
//#   needs: imu_state
//#   fidelity: exact
//#   stack: 0
inline int32_t imu_getAccelScale() {
  return imu_state.accelScale;
}

//# adapter imu_getMagScale
//#   for: int imu_getMagScale()
//#   kind: oneToOne
//#   needs: imu_state
//#   fidelity: exact
//#   stack: 0
inline int32_t imu_getMagScale() {
  return imu_state.fieldScale;
}

//# helper imu_keep
//#   needs: imu_state simpletools.h/ee_putStr simpletools.h/ee_putByte
//#   fidelity: biases are kept where the library keeps them, at 63,280 and behind it
inline void imu_keep(uint8_t sensor, int32_t x, int32_t y, int32_t z) {
  const int32_t given[3] = {x, y, z};
  int32_t at = 63301 - 7L * sensor;
  ee_putStr("LSM9DS1", 7, 63280);
  ee_putByte("gam"[sensor], at++);
  for (uint8_t axis = 0; axis < 3; axis++) {
    imu_state.bias[sensor][axis] = given[axis];
    ee_putByte((uint8_t)(given[axis] >> 8), at++);
    ee_putByte((uint8_t)given[axis], at++);
  }
}

//# adapter imu_setGyroCalibration
//#   for: void imu_setGyroCalibration(int gxBias, int gyBias, int gzBias)
//#   kind: oneToMany
//#   needs: imu_state imu_keep
//#   limit avr: it is kept in the memory of the microcontroller, at the address that is left of the library's within 1 KB
//#   limit other: it is kept in the memory of the board, at the address that is left of the library's within 4 KB
//#   fidelity: exact: readings are less by it from now on; those of the accelerometer are not any more, as there
//#   stack: 28 16
inline void imu_setGyroCalibration(int32_t gxBias, int32_t gyBias, int32_t gzBias) {
  imu_keep(0, gxBias, gyBias, gzBias);
  imu_state.corrected = 1;
}

//# adapter imu_setAccelCalibration
//#   for: void imu_setAccelCalibration(int axBias, int ayBias, int azBias)
//#   kind: oneToMany
//#   needs: imu_state imu_keep
//#   limit avr: it is kept in the memory of the microcontroller, at the address that is left of the library's within 1 KB
//#   limit other: it is kept in the memory of the board, at the address that is left of the library's within 4 KB
//#   fidelity: exact: readings are less by it from now on
//#   stack: 30 16
inline void imu_setAccelCalibration(int32_t axBias, int32_t ayBias, int32_t azBias) {
  imu_keep(1, axBias, ayBias, azBias);
  imu_state.corrected |= 2;
}

//# adapter imu_setMagCalibration
//#   for: void imu_setMagCalibration(int mxBias, int myBias, int mzBias)
//#   kind: oneToMany
//#   needs: imu_state imu_keep imu_SPIwriteByte OFFSET_X_REG_L_M OFFSET_X_REG_H_M
//#   limit avr: it is kept in the memory of the microcontroller, at the address that is left of the library's within 1 KB
//#   limit other: it is kept in the memory of the board, at the address that is left of the library's within 4 KB
//#   fidelity: exact: the sensor takes it off
//#   stack: 124 106
inline void imu_setMagCalibration(int32_t mxBias, int32_t myBias, int32_t mzBias) {
  const int32_t given[3] = {mxBias, myBias, mzBias};
  for (uint8_t axis = 0; axis < 3; axis++) {
    imu_SPIwriteByte(imu_state.field, OFFSET_X_REG_L_M + 2 * axis, (uint8_t)given[axis]);
    imu_SPIwriteByte(imu_state.field, OFFSET_X_REG_H_M + 2 * axis, (uint8_t)(given[axis] >> 8));
  }
  imu_keep(2, mxBias, myBias, mzBias);
}

//# adapter imu_getGyroCalibration
//#   for: void imu_getGyroCalibration(int *gxBias, int *gyBias, int *gzBias)
//#   kind: oneToOne
//#   needs: imu_state hal/SourceInt
//#   fidelity: exact
//#   stack: 0
inline void imu_getGyroCalibration(SourceInt *gxBias, SourceInt *gyBias, SourceInt *gzBias) {
  *gxBias = imu_state.bias[0][0];
  *gyBias = imu_state.bias[0][1];
  *gzBias = imu_state.bias[0][2];
}

//# adapter imu_getAccelCalibration
//#   for: void imu_getAccelCalibration(int *axBias, int *ayBias, int *azBias)
//#   kind: oneToOne
//#   needs: imu_state hal/SourceInt
//#   fidelity: exact
//#   stack: 0
inline void imu_getAccelCalibration(SourceInt *axBias, SourceInt *ayBias, SourceInt *azBias) {
  *axBias = imu_state.bias[1][0];
  *ayBias = imu_state.bias[1][1];
  *azBias = imu_state.bias[1][2];
}

//# adapter imu_getMagCalibration
//#   for: void imu_getMagCalibration(int *mxBias, int *myBias, int *mzBias)
//#   kind: oneToOne
//#   needs: imu_state hal/SourceInt
//#   fidelity: exact
//#   stack: 0
inline void imu_getMagCalibration(SourceInt *mxBias, SourceInt *myBias, SourceInt *mzBias) {
  *mxBias = imu_state.bias[2][0];
  *myBias = imu_state.bias[2][1];
  *mzBias = imu_state.bias[2][2];
}

//# helper imu_kept
//#   needs: simpletools.h/ee_getByte
//#   fidelity: a bias as it was kept, with its sign
inline int32_t imu_kept(uint8_t sensor, uint8_t axis) {
  int32_t at = 63302 - 7L * sensor + 2 * axis;
  return (int16_t)(ee_getByte(at) << 8 | ee_getByte(at + 1));
}

//# adapter imu_init
//#   for: int imu_init(int pinSCL, int pinSDIO, int pinAG, int pinM)
//#   kind: oneToMany
//#   needs: imu_state imu_SPIwriteByte imu_byte imu_setGyroScale imu_setAccelScale imu_setMagScale imu_kept imu_setMagCalibration imu_setAccelCalibration
//#   needs: imu_setGyroCalibration CTRL_REG8 CTRL_REG3_M WHO_AM_I_M WHO_AM_I_XG WHO_AM_I_AG_RSP WHO_AM_I_M_RSP CTRL_REG1_G CTRL_REG2_G CTRL_REG3_G CTRL_REG4
//#   needs: ORIENT_CFG_G CTRL_REG5_XL CTRL_REG6_XL CTRL_REG7_XL CTRL_REG2_M CTRL_REG4_M CTRL_REG5_M simpletools.h/high simpletools.h/low simpletools.h/ee_getByte
//#   pin: pinSCL digital out
//#   pin: pinSDIO digital both
//#   pin: pinAG digital out
//#   pin: pinM digital out
//#   limit: the sensor takes 3.6 V at most: its lines need level shifters on a board of 5 V
//#   limit: the library compares a text without its end, so that it depends on what lies behind whether it uses what was kept
//#   fidelity: exact: 0x683D, or 0 where another sensor or none answers; 500 degrees per second, 8 g, 12 gauss. What was kept is used, with its sign
//#   stack: 158 142
inline int32_t imu_init(int32_t pinSCL, int32_t pinSDIO, int32_t pinAG, int32_t pinM) {
  const int32_t pins[4] = {pinSCL, pinSDIO, pinAG, pinM};
  uint8_t *const kept[4] = {&imu_state.clock, &imu_state.data, &imu_state.motion, &imu_state.field};
  for (uint8_t place = 0; place < 4; place++) *kept[place] = pins[place] < 0 || pins[place] > 254 ? 255 : pins[place];
  const uint8_t motion = imu_state.motion, field = imu_state.field;
  high(pinAG);
  high(pinM);
  low(pinSCL);
  delay(1);
  imu_SPIwriteByte(motion, CTRL_REG8, 0x0C);
  imu_SPIwriteByte(field, CTRL_REG3_M, 0x84);
  uint8_t of_field = imu_byte(field, WHO_AM_I_M), of_motion = imu_byte(motion, WHO_AM_I_XG);
  if (of_motion != WHO_AM_I_AG_RSP || of_field != WHO_AM_I_M_RSP) return 0;
  const uint8_t settings[][2] = {
    {CTRL_REG1_G, 0xC0}, {CTRL_REG2_G, 0}, {CTRL_REG3_G, 0}, {CTRL_REG4, 0x38}, {ORIENT_CFG_G, 0},
    {CTRL_REG5_XL, 0x38}, {CTRL_REG6_XL, 0xC0}, {CTRL_REG7_XL, 0}};
  for (const uint8_t *setting : settings) imu_SPIwriteByte(motion, setting[0], setting[1]);
  imu_SPIwriteByte(field, CTRL_REG2_M, 0);
  imu_SPIwriteByte(field, CTRL_REG4_M, 0x0C);
  imu_SPIwriteByte(field, CTRL_REG5_M, 0);
  imu_setGyroScale(500);
  imu_setAccelScale(8);
  imu_setMagScale(12);
  for (uint8_t place = 0; place < 7; place++)
    if (ee_getByte(63280L + place) != (uint8_t)"LSM9DS1"[place]) return (int32_t)of_motion << 8 | of_field;
  imu_setMagCalibration(imu_kept(2, 0), imu_kept(2, 1), imu_kept(2, 2));
  imu_setAccelCalibration(imu_kept(1, 0), imu_kept(1, 1), imu_kept(1, 2));
  imu_setGyroCalibration(imu_kept(0, 0), imu_kept(0, 1), imu_kept(0, 2));
  return (int32_t)of_motion << 8 | of_field;
}

//# adapter imu_calibrateAG
//#   for: void imu_calibrateAG(void)
//#   kind: oneToMany
//#   needs: imu_state imu_change imu_byte imu_SPIwriteByte imu_readGyro imu_readAccel imu_setGyroCalibration imu_setAccelCalibration CTRL_REG9 FIFO_CTRL FIFO_SRC FIFO_THS FIFO_OFF hal/SourceInt
//#   fidelity: exact: the mean of the 31 readings or more that the sensor has stored, the third axis upwards; it waits for them, and for ever without a sensor
//#   stack: 155 139
inline void imu_calibrateAG() {
  int32_t sums[2][3] = {{0, 0, 0}, {0, 0, 0}};
  SourceInt x, y, z;
  imu_change(imu_state.motion, CTRL_REG9, 0xFF, 2);
  imu_SPIwriteByte(imu_state.motion, FIFO_CTRL, FIFO_THS << 5 | 0x1F);
  uint8_t samples = 0;
  while (samples < 0x1F) samples = imu_byte(imu_state.motion, FIFO_SRC) & 0x3F;
  for (uint8_t sample = 0; sample < samples; sample++) {
    imu_readGyro(&x, &y, &z);
    sums[0][0] += x, sums[0][1] += y, sums[0][2] += z;
    imu_readAccel(&x, &y, &z);
    sums[1][0] += x, sums[1][1] += y, sums[1][2] += z - (int32_t)imu_state.perUnit[1];
  }
  imu_setGyroCalibration(sums[0][0] / samples, sums[0][1] / samples, sums[0][2] / samples);
  imu_setAccelCalibration(sums[1][0] / samples, sums[1][1] / samples, sums[1][2] / samples);
  imu_change(imu_state.motion, CTRL_REG9, 0xFD, 0);
  imu_SPIwriteByte(imu_state.motion, FIFO_CTRL, FIFO_OFF << 5);
}

//# adapter imu_calibrateMag
//#   for: void imu_calibrateMag(void)
//#   kind: oneToMany
//#   needs: imu_magAvailable imu_readMag imu_setMagCalibration hal/SourceInt
//#   fidelity: exact: the middle of what 1,200 readings had, which are to be new ones: some 30 s; it waits for them, and for ever without a sensor
//#   stack: 167 157
inline void imu_calibrateMag() {
  int32_t least[3] = {0, 0, 0}, most[3] = {0, 0, 0};
  SourceInt now[3];
  for (uint16_t reading = 0; reading < 1200; reading++) {
    while (!imu_magAvailable()) continue;
    imu_readMag(now, now + 1, now + 2);
    for (uint8_t axis = 0; axis < 3; axis++) {
      least[axis] = min(least[axis], now[axis]);
      most[axis] = max(most[axis], now[axis]);
    }
  }
  imu_setMagCalibration((least[0] + most[0]) / 2, (least[1] + most[1]) / 2, (least[2] + most[2]) / 2);
}

//# adapter imu_clearAccelInterrupt
//#   for: void imu_clearAccelInterrupt()
//#   kind: oneToMany
//#   needs: imu_state imu_SPIwriteByte imu_change INT_GEN_THS_X_XL INT_GEN_THS_Y_XL INT_GEN_THS_Z_XL INT_GEN_CFG_XL INT_GEN_DUR_XL INT1_CTRL
//#   fidelity: exact
//#   stack: 88 80
inline void imu_clearAccelInterrupt() {
  const uint8_t cleared[] = {INT_GEN_THS_X_XL, INT_GEN_THS_Y_XL, INT_GEN_THS_Z_XL, INT_GEN_CFG_XL, INT_GEN_DUR_XL};
  for (uint8_t address : cleared) imu_SPIwriteByte(imu_state.motion, address, 0);
  imu_change(imu_state.motion, INT1_CTRL, 0xBF, 0);
}

//# adapter imu_clearGyroInterrupt
//#   for: void imu_clearGyroInterrupt()
//#   kind: oneToMany
//#   needs: imu_state imu_SPIwriteByte imu_change INT_GEN_THS_XH_G INT_GEN_THS_XL_G INT_GEN_THS_YH_G INT_GEN_THS_YL_G INT_GEN_THS_ZH_G INT_GEN_THS_ZL_G
//#   needs: INT_GEN_CFG_G INT_GEN_DUR_G INT1_CTRL
//#   fidelity: exact
//#   stack: 91 83
inline void imu_clearGyroInterrupt() {
  const uint8_t cleared[] = {
    INT_GEN_THS_XH_G, INT_GEN_THS_XL_G, INT_GEN_THS_YH_G, INT_GEN_THS_YL_G, INT_GEN_THS_ZH_G, INT_GEN_THS_ZL_G, INT_GEN_CFG_G, INT_GEN_DUR_G};
  for (uint8_t address : cleared) imu_SPIwriteByte(imu_state.motion, address, 0);
  imu_change(imu_state.motion, INT1_CTRL, 0x7F, 0);
}

//# adapter imu_clearMagInterrupt
//#   for: void imu_clearMagInterrupt()
//#   kind: oneToMany
//#   needs: imu_state imu_SPIwriteByte INT_THS_L_M INT_THS_H_M INT_SRC_M INT_CFG_M
//#   fidelity: exact: the third write goes to the register of the fourth, as there
//#   stack: 57 47
inline void imu_clearMagInterrupt() {
  const uint8_t cleared[] = {INT_THS_L_M, INT_THS_H_M, INT_SRC_M, INT_CFG_M};
  for (uint8_t address : cleared) imu_SPIwriteByte(imu_state.field, address, 0);
}

//# adapter imu_setAccelInterrupt
//#   for: void imu_setAccelInterrupt(char axis, float threshold, char duration, char overUnder, char andOr)
//#   kind: oneToMany
//#   needs: imu_state imu_byte imu_change imu_SPIwriteByte CTRL_REG4 INT_GEN_CFG_XL INT_GEN_THS_X_XL INT_GEN_DUR_XL INT1_CTRL
//#   fidelity: exact: of one axis, or of all for any other number
//#   stack: 112 84
inline void imu_setAccelInterrupt(uint8_t axis, float threshold, uint8_t duration, uint8_t overUnder, uint8_t andOr) {
  const uint8_t select = imu_state.motion;
  imu_change(select, CTRL_REG4, 0xFD, 0);
  uint8_t config = (imu_byte(select, INT_GEN_CFG_XL) & 0x7F) | (andOr & 1 ? 0x80 : 0);
  uint8_t value = (uint8_t)((int32_t)(imu_state.perUnit[1] * fabs(threshold)) >> 7);
  for (uint8_t each = 0; each < 3; each++)
    if (axis > 2 || axis == each) {
      config |= 1 << (2 * each + (overUnder & 1));
      imu_SPIwriteByte(select, INT_GEN_THS_X_XL + each, value);
    }
  imu_SPIwriteByte(select, INT_GEN_CFG_XL, config);
  imu_SPIwriteByte(select, INT_GEN_DUR_XL, duration ? 0x80 | (duration & 0x7F) : 0);
  imu_change(select, INT1_CTRL, 0xFF, 0x40);
}

//# adapter imu_setGyroInterrupt
//#   for: void imu_setGyroInterrupt(char axis, float threshold, char duration, char overUnder, char andOr)
//#   kind: oneToMany
//#   needs: imu_state imu_byte imu_change imu_SPIwriteByte CTRL_REG4 INT_GEN_CFG_G INT_GEN_THS_XH_G INT_GEN_THS_XL_G INT_GEN_DUR_G INT1_CTRL
//#   fidelity: exact: of one axis, or of all for any other number
//#   stack: 113 86
inline void imu_setGyroInterrupt(uint8_t axis, float threshold, uint8_t duration, uint8_t overUnder, uint8_t andOr) {
  const uint8_t select = imu_state.motion;
  imu_change(select, CTRL_REG4, 0xFD, 0);
  uint8_t config = (imu_byte(select, INT_GEN_CFG_G) & 0x7F) | (andOr ? 0x80 : 0);
  int32_t value = (int16_t)(int32_t)(imu_state.perUnit[0] * threshold);
  value = constrain(value, -16384L, 16383L);
  for (uint8_t each = 0; each < 3; each++)
    if (axis > 2 || axis == each) {
      config |= 1 << (2 * each + (overUnder & 1));
      imu_SPIwriteByte(select, INT_GEN_THS_XH_G + 2 * each, (uint8_t)(value >> 8 & 0x7F));
      imu_SPIwriteByte(select, INT_GEN_THS_XL_G + 2 * each, (uint8_t)value);
    }
  imu_SPIwriteByte(select, INT_GEN_CFG_G, config);
  imu_SPIwriteByte(select, INT_GEN_DUR_G, duration ? 0x80 | (duration & 0x7F) : 0);
  imu_change(select, INT1_CTRL, 0xFF, 0x80);
}

//# adapter imu_setMagInterrupt
//#   for: void imu_setMagInterrupt(char axis, float threshold, char lowHigh)
//#   kind: oneToMany
//#   needs: imu_state imu_SPIwriteByte INT_THS_L_M INT_THS_H_M INT_CFG_M
//#   fidelity: exact: of one axis, or of all for any other number
//#   stack: 74 64
inline void imu_setMagInterrupt(uint8_t axis, float threshold, uint8_t lowHigh) {
  int32_t value = labs((int32_t)(imu_state.perUnit[2] * threshold));
  if (value > 32767) value = 32767;
  imu_SPIwriteByte(imu_state.field, INT_THS_L_M, (uint8_t)value);
  imu_SPIwriteByte(imu_state.field, INT_THS_H_M, (uint8_t)(value >> 8));
  imu_SPIwriteByte(imu_state.field, INT_CFG_M, (axis > 2 ? 0xE0 : 0x80 >> axis) | (lowHigh & 1) << 2 | 3);
}
