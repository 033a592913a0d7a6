/* lis3dh.h of the Simple Libraries: an accelerometer on three or four wires. */
#ifndef LIS3DH_H
#define LIS3DH_H
#include "simpletools.h"
#define LIS3DH_STATUS_REG_AUX 0x07
#define LIS3DH_OUT_ADC1_L 0x08
#define LIS3DH_OUT_ADC1_H 0x09
#define LIS3DH_OUT_ADC2_L 0x0A
#define LIS3DH_OUT_ADC2_H 0x0B
#define LIS3DH_OUT_ADC3_L 0x0C
#define LIS3DH_OUT_ADC3_H 0x0D
#define LIS3DH_WHO_AM_I 0x0F
#define LIS3DH_WHO_AM_I_REPLY 0x33
#define LIS3DH_CTRL_REG0 0x1E
#define LIS3DH_TEMP_CFG_REG 0x1F
#define LIS3DH_CTRL_REG1 0x20
#define LIS3DH_CTRL_REG2 0x21
#define LIS3DH_CTRL_REG3 0x22
#define LIS3DH_CTRL_REG4 0x23
#define LIS3DH_CTRL_REG5 0x24
#define LIS3DH_CTRL_REG6 0x25
#define LIS3DH_REFERENCE 0x26
#define LIS3DH_STATUS_REG 0x27
#define LIS3DH_OUT_X_L 0x28
#define LIS3DH_OUT_X_H 0x29
#define LIS3DH_OUT_Y_L 0x2A
#define LIS3DH_OUT_Y_H 0x2B
#define LIS3DH_OUT_Z_L 0x2C
#define LIS3DH_OUT_Z_H 0x2D
#define LIS3DH_FIFO_CTRL_REG 0x2E
#define LIS3DH_FIFO_SRC_REG 0x2F
#define LIS3DH_INT1_CFG 0x30
#define LIS3DH_INT1_SRC 0x31
#define LIS3DH_INT1_THS 0x32
#define LIS3DH_INT1_DURATION 0x33
#define LIS3DH_INT2_CFG 0x34
#define LIS3DH_INT2_SRC 0x35
#define LIS3DH_INT2_THS 0x36
#define LIS3DH_INT2_DURATION 0x37
#define LIS3DH_CLICK_CFG 0x38
#define LIS3DH_CLICK_SRC 0x39
#define LIS3DH_CLICK_THS 0x3A
#define LIS3DH_TIME_LIMIT 0x3B
#define LIS3DH_TIME_LATENCY 0x3C
#define LIS3DH_TIME_WINDOW 0x3D
#define LIS3DH_ACT_THS 0x3E
#define LIS3DH_ACT_DUR 0x3F
#define LIS3DH_MASK_READSINGLE 0x80
#define LIS3DH_MASK_READREPEAT 0xC0
#define LIS3DH_MASK_BDUMODE 0x80
#define LIS3DH_MASK_SPIMODE 0x01
#define LIS3DH_RANGE_16 0x03
#define LIS3DH_RANGE_8 0x02
#define LIS3DH_RANGE_4 0x01
#define LIS3DH_RANGE_2 0x00
#define LIS3DH_AXIS_X 0b01
#define LIS3DH_AXIS_Y 0b10
#define LIS3DH_AXIS_Z 0b11
#define LIS3DH_ADC_1 0b01
#define LIS3DH_ADC_2 0b10
#define LIS3DH_ADC_3 0b11
#define LIS3DH_SPIMODE_3 0b01
#define LIS3DH_SPIMODE_4 0b00
#define LIS3DH_BDUMODE_CONTINUOUS 0b01
#define LIS3DH_BDUMODE_CONSISTENT 0b00
typedef struct lis3dh_st {
  volatile int tempcalC, adccal_m1000, adccal_b1000, tiltavgX, tiltavgY, tiltavgZ, tiltavg_factor;
  int sdi_pin, sdo_pin, sck_pin, cs_pin;
} lis3dh_t;
typedef lis3dh_t lis3dh;
lis3dh_t *lis3dh_init(int pinSCK, int pinSDI, int pinCS);
lis3dh_t *lis3dh_init4wire(int pinSCK, int pinSDI, int pinSDO, int pinCS);
void lis3dh_shutdown(lis3dh_t *device);
int lis3dh_getWhoAmI(lis3dh_t *device);
void lis3dh_setResolution(lis3dh_t *device, int bits);
int lis3dh_getResolution(lis3dh_t *device);
void lis3dh_setRange(lis3dh_t *device, int range);
int lis3dh_getRange(lis3dh_t *device);
void lis3dh_setSPImode(lis3dh_t *device, int mode);
int lis3dh_getSPImode(lis3dh_t *device);
void lis3dh_setBDUmode(lis3dh_t *device, int mode);
void lis3dh_setADCmode(lis3dh_t *device, int adcEnable, int tempEnable);
void lis3dh_adc(lis3dh_t *device, int *ad1, int *ad2, int *ad3);
int lis3dh_getADC(lis3dh_t *device, int channel);
void lis3dh_adc_mV(lis3dh_t *device, int *ad1, int *ad2, int *ad3);
int lis3dh_getADC_mV(lis3dh_t *device, int channel);
void lis3dh_adcCal_mV(lis3dh_t *device, int mV_L, int mV_H, int value_L, int value_H);
void lis3dh_tempCal_C(lis3dh_t *device, int actualTempC);
void lis3dh_tempCal_F(lis3dh_t *device, int actualTempF);
int lis3dh_tempRaw(lis3dh_t *device);
int lis3dh_temp_C(lis3dh_t *device);
int lis3dh_temp_F(lis3dh_t *device);
int lis3dh_accel(lis3dh_t *device, int *x, int *y, int *z);
int lis3dh_getAccel(lis3dh_t *device, int axis);
int lis3dh_accel_mg(lis3dh_t *device, int *x, int *y, int *z);
int lis3dh_getAccel_mg(lis3dh_t *device, int axis);
int lis3dh_tilt(lis3dh_t *device, int *ax, int *ay, int *az, int *motion);
int lis3dh_tiltConfig(lis3dh_t *device, int avg_factor);
void lis3dh_writeByte(lis3dh_t *device, unsigned char address, unsigned char value);
unsigned char lis3dh_readByte(lis3dh_t *device, unsigned char address);
#endif
