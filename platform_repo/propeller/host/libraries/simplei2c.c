/* simplei2c.h: the two-wire bus, byte by byte. Devices are reached by their address, not by edges at the pins; a byte takes the time of
 * its nine bits. Source: libsimplei2c/simplei2c.c. */
#include "simplei2c.h"

enum { BYTE_TICKS = 180 * HOST_TICKS_PER_US };
static int addressed, expects_address, acknowledged;

i2c *i2c_open(i2c *bus, int sclPin, int sdaPin, int sclDrive) {
  host_call();
  bus->scl_mask = 1 << sclPin;
  bus->sda_mask = 1 << sdaPin;
  bus->scl_mask_inv = ~bus->scl_mask;
  bus->sda_mask_inv = ~bus->sda_mask;
  bus->drivescl = sclDrive;
  return bus;
}

void i2c_start(i2c *bus) {
  (void)bus;
  host_call();
  expects_address = 1;
}

void i2c_stop(i2c *bus) {
  (void)bus;
  host_call();
  if (addressed) host_bus_stop();
  addressed = expects_address = 0;
}

int i2c_writeByte(i2c *bus, int byte) {
  (void)bus;
  host_spend(BYTE_TICKS);
  if (expects_address) {
    if (addressed) host_bus_stop();  /* a start without a stop before it */
    acknowledged = host_bus_start(byte >> 1 & 0x7F, byte & 1);
    addressed = acknowledged;
    expects_address = 0;
    return !acknowledged;
  }
  return addressed ? !host_bus_write(byte) : 1;
}

int i2c_readByte(i2c *bus, int ackState) {
  (void)bus, (void)ackState;
  host_spend(BYTE_TICKS);
  return addressed ? host_bus_read() : 0xFF;
}

int i2c_writeData(i2c *bus, const unsigned char *data, int count) {
  int done = 0;
  while (done < count && !i2c_writeByte(bus, data[done])) done++;
  return done;
}

int i2c_readData(i2c *bus, unsigned char *data, int count) {
  int done = 0;
  for (; done < count - 1; done++) data[done] = i2c_readByte(bus, 0);
  data[done] = i2c_readByte(bus, 1);
  return done;
}

int i2c_poll(i2c *bus, int addr) {
  i2c_start(bus);
  return i2c_writeByte(bus, addr);
}
