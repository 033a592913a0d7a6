/* i2c.h of propgcc: the two-wire bus. */
#ifndef ROBOSMI_I2C_H
#define ROBOSMI_I2C_H
#include <stdint.h>
typedef struct I2C { int open, bus; } I2C;
typedef struct { I2C i2c; } I2C_COGDRIVER;
typedef struct { I2C i2c; } I2C_SIMPLE;
I2C *i2cOpen(I2C_COGDRIVER *dev, int scl, int sda, int freq);
I2C *simple_i2cOpen(I2C_SIMPLE *dev, int scl, int sda);
int i2cClose(I2C *dev);
int i2cWrite(I2C *dev, int address, uint8_t *buffer, int count, int stop);
int i2cWriteMore(I2C *dev, uint8_t *buffer, int count, int stop);
int i2cRead(I2C *dev, int address, uint8_t *buffer, int count, int stop);
int i2cReadMore(I2C *dev, uint8_t *buffer, int count, int stop);
#endif
