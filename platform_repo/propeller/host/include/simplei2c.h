/* simplei2c.h of the Simple Libraries: the two-wire bus. */
#ifndef ROBOSMI_SIMPLEI2C_H
#define ROBOSMI_SIMPLEI2C_H
#include <propeller.h>
typedef struct i2c_st {
  volatile int scl_mask, scl_mask_inv;
  int sda_mask, sda_mask_inv, drivescl;
} i2c;
i2c *i2c_open(i2c *bus, int sclPin, int sdaPin, int sclDrive);
void i2c_start(i2c *bus);
void i2c_stop(i2c *bus);
int i2c_writeByte(i2c *bus, int byte);
int i2c_readByte(i2c *bus, int ackState);
int i2c_writeData(i2c *bus, const unsigned char *data, int count);
int i2c_readData(i2c *bus, unsigned char *data, int count);
int i2c_poll(i2c *bus, int addr);
#endif
