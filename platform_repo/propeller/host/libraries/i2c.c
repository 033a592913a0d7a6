/* i2c.h: devices are reached by their address, of 8 bits here. Sources: propgcc lib/sys/propeller (i2c_interface.c, i2c_simple.c). */
#include <i2c.h>
#include <propeller.h>

enum { FASTEST = 400000, BYTE_TICKS = 90 * HOST_TICKS_PER_US };

I2C *i2cOpen(I2C_COGDRIVER *dev, int scl, int sda, int freq) {
  host_call();
  if (freq > FASTEST) return 0;
  dev->i2c = (I2C){1, host_bus(scl, sda)};
  return &dev->i2c;
}

I2C *simple_i2cOpen(I2C_SIMPLE *dev, int scl, int sda) {
  host_call();
  dev->i2c = (I2C){1, host_bus(scl, sda)};
  return &dev->i2c;
}

int i2cClose(I2C *dev) {
  host_call();
  dev->open = 0;
  return 0;
}

int i2cWriteMore(I2C *dev, uint8_t *buffer, int count, int stop) {
  if (!dev->open) return -1;
  for (int k = 0; k < count; k++) {
    host_spend(BYTE_TICKS);
    if (!host_bus_write(dev->bus, buffer[k])) return -1;
  }
  if (stop) host_bus_stop(dev->bus);
  return 0;
}

int i2cWrite(I2C *dev, int address, uint8_t *buffer, int count, int stop) {
  host_spend(BYTE_TICKS);
  if (!dev->open || !host_bus_start(dev->bus, address >> 1, 0)) return -1;
  return i2cWriteMore(dev, buffer, count, stop);
}

int i2cReadMore(I2C *dev, uint8_t *buffer, int count, int stop) {
  if (!dev->open) return -1;
  for (int k = 0; k < count; k++) {
    host_spend(BYTE_TICKS);
    buffer[k] = host_bus_read(dev->bus);
  }
  if (stop) host_bus_stop(dev->bus);
  return 0;
}

int i2cRead(I2C *dev, int address, uint8_t *buffer, int count, int stop) {
  host_spend(BYTE_TICKS);
  if (!dev->open || !host_bus_start(dev->bus, address >> 1, 1)) return -1;
  return i2cReadMore(dev, buffer, count, stop);
}
