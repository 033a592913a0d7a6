//# header i2c.h
// The two-wire bus of propgcc. Read from propgcc b280e7a77, lib/include/i2c.h, lib/sys/propeller/i2c_interface.c, i2c_simple.c.
//# task i2cGetCogBuffer it gives memory of the driver's machine code, of which there is none: use an array of the program
//# task i2cBootBuffer it gives memory of the driver's machine code, of which there is none: use an array of the program
//# task i2cBootOpen the bus that the program was loaded over is not there: open the one at SCL and SDA with i2cOpen

//# type I2C
//#   needs: simplei2c.h/i2c
//#   fidelity: for use with the functions; there are no operations in it
struct I2C {
  i2c bus;
};

//# type I2C_COGDRIVER
//#   needs: I2C
//#   fidelity: for use with the functions; there are no cog and mailbox
struct I2C_COGDRIVER {
  I2C i2c;
};

//# type I2C_SIMPLE
//#   needs: I2C_COGDRIVER
//#   fidelity: for use with the functions
typedef I2C_COGDRIVER I2C_SIMPLE;

//# adapter i2cOpen
//#   for: I2C *i2cOpen(I2C_COGDRIVER *dev, int scl, int sda, int freq)
//#   kind: semantic
//#   needs: I2C I2C_COGDRIVER hal/TwoWireBus
//#   pin: scl digital both
//#   pin: sda digital both
//#   fidelity: up to 400 kHz, 0 beyond, as there; a frequency below 31 kHz is made 31 kHz
//#   limit: only at the pins SCL and SDA; a bus at others has no devices
//#   stack: 0
inline I2C *i2cOpen(I2C_COGDRIVER *dev, int32_t scl, int32_t sda, int32_t freq) {
  if (freq > 400000) return 0;
  dev->i2c.bus.open(scl, sda, freq > 31000 ? freq : 31000);
  return &dev->i2c;
}

//# adapter simple_i2cOpen
//#   for: I2C *simple_i2cOpen(I2C_SIMPLE *dev, int scl, int sda)
//#   kind: semantic
//#   needs: I2C I2C_SIMPLE I2C_COGDRIVER simplei2c.h/i2c_open
//#   pin: scl digital both
//#   pin: sda digital both
//#   fidelity: 100 kHz
//#   limit: only at the pins SCL and SDA; a bus at others has no devices
//#   stack: 0
inline I2C *simple_i2cOpen(I2C_SIMPLE *dev, int32_t scl, int32_t sda) {
  i2c_open(&dev->i2c.bus, scl, sda, 0);
  return &dev->i2c;
}

//# adapter i2cClose
//#   for: int i2cClose(I2C *dev)
//#   kind: semantic
//#   needs: I2C hal/TwoWireBus
//#   fidelity: exact: 0, and there are no devices any more
//#   stack: 0
inline int32_t i2cClose(I2C *dev) {
  dev->bus.close();
  return 0;
}

//# adapter i2cWriteMore
//#   for: int i2cWriteMore(I2C *dev, uint8_t *buffer, int count, int stop)
//#   kind: oneToMany
//#   needs: I2C simplei2c.h/i2c_writeByte simplei2c.h/i2c_stop
//#   fidelity: exact: 0, or -1 for a byte that was not acknowledged, with which the transfer ends here
//#   stack: 14 2
inline int32_t i2cWriteMore(I2C *dev, const void *buffer, int32_t count, int32_t stop) {
  for (int32_t number = 0; number < count; number++) {
    if (!i2c_writeByte(&dev->bus, ((const uint8_t *)buffer)[number])) continue;
    i2c_stop(&dev->bus);
    return -1;
  }
  if (stop) i2c_stop(&dev->bus);
  return 0;
}

//# adapter i2cWrite
//#   for: int i2cWrite(I2C *dev, int address, uint8_t *buffer, int count, int stop)
//#   kind: oneToMany
//#   needs: I2C i2cWriteMore simplei2c.h/i2c_start simplei2c.h/i2c_stop simplei2c.h/i2c_writeByte
//#   fidelity: exact: 0, or -1 for a byte that was not acknowledged, with which the transfer ends here. The address has 8 bits
//#   stack: 29 4
inline int32_t i2cWrite(I2C *dev, int32_t address, const void *buffer, int32_t count, int32_t stop) {
  i2c_start(&dev->bus);
  if (!i2c_writeByte(&dev->bus, address)) return i2cWriteMore(dev, buffer, count, stop);
  i2c_stop(&dev->bus);
  return -1;
}

//# adapter i2cReadMore
//#   for: int i2cReadMore(I2C *dev, uint8_t *buffer, int count, int stop)
//#   kind: oneToMany
//#   needs: I2C simplei2c.h/i2c_readByte simplei2c.h/i2c_stop
//#   fidelity: exact: all bytes but the last are acknowledged
//#   stack: 16 0
inline int32_t i2cReadMore(I2C *dev, void *buffer, int32_t count, int32_t stop) {
  for (int32_t number = 0; number < count; number++) ((uint8_t *)buffer)[number] = i2c_readByte(&dev->bus, number == count - 1);
  if (stop) i2c_stop(&dev->bus);
  return 0;
}

//# adapter i2cRead
//#   for: int i2cRead(I2C *dev, int address, uint8_t *buffer, int count, int stop)
//#   kind: oneToMany
//#   needs: I2C i2cReadMore simplei2c.h/i2c_start simplei2c.h/i2c_stop simplei2c.h/i2c_writeByte
//#   fidelity: exact: 0, or -1 when the device does not answer. The address has 8 bits
//#   stack: 30 10
inline int32_t i2cRead(I2C *dev, int32_t address, void *buffer, int32_t count, int32_t stop) {
  i2c_start(&dev->bus);
  if (!i2c_writeByte(&dev->bus, address | 1)) return i2cReadMore(dev, buffer, count, stop);
  i2c_stop(&dev->bus);
  return -1;
}
