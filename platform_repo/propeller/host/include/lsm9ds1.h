/* lsm9ds1.h of the Simple Libraries: a sensor of motion with nine axes on three wires and two selects. */
#ifndef ROBOSMI_LSM9DS1_H
#define ROBOSMI_LSM9DS1_H
#define ACT_THS 0x04
#define ACT_DUR 0x05
#define INT_GEN_CFG_XL 0x06
#define INT_GEN_THS_X_XL 0x07
#define INT_GEN_THS_Y_XL 0x08
#define INT_GEN_THS_Z_XL 0x09
#define INT_GEN_DUR_XL 0x0A
#define REFERENCE_G 0x0B
#define INT1_CTRL 0x0C
#define INT2_CTRL 0x0D
#define WHO_AM_I_XG 0x0F
#define CTRL_REG1_G 0x10
#define CTRL_REG2_G 0x11
#define CTRL_REG3_G 0x12
#define ORIENT_CFG_G 0x13
#define INT_GEN_SRC_G 0x14
#define OUT_TEMP_L 0x15
#define OUT_TEMP_H 0x16
#define STATUS_REG_0 0x17
#define OUT_X_L_G 0x18
#define OUT_X_H_G 0x19
#define OUT_Y_L_G 0x1A
#define OUT_Y_H_G 0x1B
#define OUT_Z_L_G 0x1C
#define OUT_Z_H_G 0x1D
#define CTRL_REG4 0x1E
#define CTRL_REG5_XL 0x1F
#define CTRL_REG6_XL 0x20
#define CTRL_REG7_XL 0x21
#define CTRL_REG8 0x22
#define CTRL_REG9 0x23
#define CTRL_REG10 0x24
#define INT_GEN_SRC_XL 0x26
#define STATUS_REG_1 0x27
#define OUT_X_L_XL 0x28
#define OUT_X_H_XL 0x29
#define OUT_Y_L_XL 0x2A
#define OUT_Y_H_XL 0x2B
#define OUT_Z_L_XL 0x2C
#define OUT_Z_H_XL 0x2D
#define FIFO_CTRL 0x2E
#define FIFO_SRC 0x2F
#define INT_GEN_CFG_G 0x30
#define INT_GEN_THS_XH_G 0x31
#define INT_GEN_THS_XL_G 0x32
#define INT_GEN_THS_YH_G 0x33
#define INT_GEN_THS_YL_G 0x34
#define INT_GEN_THS_ZH_G 0x35
#define INT_GEN_THS_ZL_G 0x36
#define INT_GEN_DUR_G 0x37
#define OFFSET_X_REG_L_M 0x05
#define OFFSET_X_REG_H_M 0x06
#define OFFSET_Y_REG_L_M 0x07
#define OFFSET_Y_REG_H_M 0x08
#define OFFSET_Z_REG_L_M 0x09
#define OFFSET_Z_REG_H_M 0x0A
#define WHO_AM_I_M 0x0F
#define CTRL_REG1_M 0x20
#define CTRL_REG2_M 0x21
#define CTRL_REG3_M 0x22
#define CTRL_REG4_M 0x23
#define CTRL_REG5_M 0x24
#define STATUS_REG_M 0x27
#define OUT_X_L_M 0x28
#define OUT_X_H_M 0x29
#define OUT_Y_L_M 0x2A
#define OUT_Y_H_M 0x2B
#define OUT_Z_L_M 0x2C
#define OUT_Z_H_M 0x2D
#define INT_CFG_M 0x30
#define INT_SRC_M 0x30
#define INT_THS_L_M 0x32
#define INT_THS_H_M 0x33
#define WHO_AM_I_AG_RSP 0x68
#define WHO_AM_I_M_RSP 0x3D
#define FIFO_OFF 0
#define FIFO_THS 1
#define FIFO_CONT_TRIGGER 3
#define FIFO_OFF_TRIGGER 4
#define FIFO_CONT 5
#define X_AXIS 0
#define Y_AXIS 1
#define Z_AXIS 2
#define ALL_AXIS 3
#define CELSIUS 0
#define FAHRENHEIT 1
#define KELVIN 2
void imu_SPIwriteByte(unsigned char csPin, unsigned char subAddress, unsigned char data);
void imu_SPIreadBytes(unsigned char csPin, unsigned char subAddress, unsigned char *dest, unsigned char count);
void imu_readGyro(int *gx, int *gy, int *gz);
void imu_readGyroCalculated(float *gx, float *gy, float *gz);
void imu_readAccel(int *ax, int *ay, int *az);
void imu_readAccelCalculated(float *ax, float *ay, float *az);
void imu_readMag(int *mx, int *my, int *mz);
void imu_readMagCalculated(float *mx, float *my, float *mz);
void imu_readTemp(int *temperature);
void imu_readTempCalculated(float *temperature, char tempUnit);
unsigned char imu_accelAvailable();
unsigned char imu_gyroAvailable();
unsigned char imu_tempAvailable();
unsigned char imu_magAvailable();
void imu_setGyroScale(unsigned int gScl);
void imu_setAccelScale(unsigned char aScl);
void imu_setMagScale(unsigned char mScl);
int imu_getGyroScale();
int imu_getAccelScale();
int imu_getMagScale();
void imu_setGyroCalibration(int gxBias, int gyBias, int gzBias);
void imu_setAccelCalibration(int axBias, int ayBias, int azBias);
void imu_setMagCalibration(int mxBias, int myBias, int mzBias);
void imu_getGyroCalibration(int *gxBias, int *gyBias, int *gzBias);
void imu_getAccelCalibration(int *axBias, int *ayBias, int *azBias);
void imu_getMagCalibration(int *mxBias, int *myBias, int *mzBias);
int imu_init(int pinSCL, int pinSDIO, int pinAG, int pinM);
void imu_calibrateAG(void);
void imu_calibrateMag(void);
void imu_clearAccelInterrupt();
void imu_clearGyroInterrupt();
void imu_clearMagInterrupt();
void imu_setAccelInterrupt(char axis, float threshold, char duration, char overUnder, char andOr);
void imu_setGyroInterrupt(char axis, float threshold, char duration, char overUnder, char andOr);
void imu_setMagInterrupt(char axis, float threshold, char lowHigh);
#endif
