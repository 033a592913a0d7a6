/* simplei2c.h: the two-wire bus, byte by byte. Devices are reached by their address, not by edges at the pins; a byte takes the time of
 * its nine bits. Source: libsimplei2c/simplei2c.c. */
#include "simplei2c.h"

enum { BYTE_TICKS = 180 * HOST_TICKS_PER_US };

/* How far a transfer is, of each pair of pins: programs may describe one bus twice. */
static struct bus { int number, addressed, expects_address; } buses[32];

static struct bus *bus_of(const i2c *pins) {
  int number = host_bus(__builtin_ctz(pins->scl_mask | 1u << 31), __builtin_ctz(pins->sda_mask | 1u << 31)) + 1, k = 0;
  while (buses[k].number && buses[k].number != number && k < 31) k++;
  buses[k].number = number;
  return &buses[k];
}

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
  host_call();
  bus_of(bus)->expects_address = 1;
}

void i2c_stop(i2c *bus) {
  struct bus *on = bus_of(bus);
  host_call();
  if (on->addressed) host_bus_stop(on->number - 1);
  on->addressed = on->expects_address = 0;
}

int i2c_writeByte(i2c *bus, int byte) {
  struct bus *on = bus_of(bus);
  host_spend(BYTE_TICKS);
  if (on->expects_address) {
    if (on->addressed) host_bus_stop(on->number - 1);  /* a start without a stop before it */
    on->expects_address = 0;
    return !(on->addressed = host_bus_start(on->number - 1, byte >> 1, byte & 1));
  }
  return on->addressed ? !host_bus_write(on->number - 1, byte) : 1;
}

int i2c_readByte(i2c *bus, int ackState) {
  struct bus *on = bus_of(bus);
  (void)ackState;
  host_spend(BYTE_TICKS);
  return on->addressed ? host_bus_read(on->number - 1) : 0xFF;
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
