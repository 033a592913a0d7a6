//# header simplei2c.h
// The two-wire bus, byte by byte. Read from Simple-Libraries 1cc167c10, Learn/Simple Libraries/Protocol/libsimplei2c.
// There any two pins are a bus; here the hardware drives the one at SCL and SDA. At any other pins there is no device.

//# type i2c
//#   needs: hal/TwoWireBus
//#   fidelity: for use with the functions; its members are others than there
struct i2c : TwoWireBus {};

//# adapter i2c_open
//#   for: i2c *i2c_open(i2c *bus, int sclPin, int sdaPin, int sclDrive)
//#   kind: semantic
//#   needs: i2c hal/TwoWireBus
//#   pin: sclPin digital both
//#   pin: sdaPin digital both
//#   fidelity: 100 kHz; weak pull-ups are switched on
//#   limit: only at the pins SCL and SDA; the clock is never driven high
//#   stack: 0
inline i2c *i2c_open(i2c *bus, int32_t sclPin, int32_t sdaPin, int32_t sclDrive) {
  (void)sclDrive;
  bus->open(sclPin, sdaPin, 100000L);
  return bus;
}

//# adapter i2c_start
//#   for: void i2c_start(i2c *bus)
//#   kind: semantic
//#   needs: i2c hal/TwoWireBus
//#   fidelity: exact
//#   stack: 2 0
inline void i2c_start(i2c *bus) {
  bus->start();
}

//# adapter i2c_stop
//#   for: void i2c_stop(i2c *bus)
//#   kind: semantic
//#   needs: i2c hal/TwoWireBus
//#   fidelity: exact
//#   stack: 2 0
inline void i2c_stop(i2c *bus) {
  bus->stop();
}

//# adapter i2c_writeByte
//#   for: int i2c_writeByte(i2c *bus, int byte)
//#   kind: semantic
//#   needs: i2c hal/TwoWireBus
//#   fidelity: exact: 0 when the byte is acknowledged, else 1
//#   stack: 2 0
inline int32_t i2c_writeByte(i2c *bus, int32_t byte) {
  return !bus->write((uint8_t)byte);
}

//# adapter i2c_readByte
//#   for: int i2c_readByte(i2c *bus, int ackState)
//#   kind: semantic
//#   needs: i2c hal/TwoWireBus
//#   fidelity: exact: it acknowledges the byte when ackState is 0
//#   stack: 2 0
inline int32_t i2c_readByte(i2c *bus, int32_t ackState) {
  return bus->read(!ackState);
}

//# adapter i2c_writeData
//#   for: int i2c_writeData(i2c *bus, const unsigned char *data, int count)
//#   kind: oneToMany
//#   needs: i2c i2c_writeByte
//#   fidelity: exact: the number of bytes that were acknowledged
//#   stack: 8 0
inline int32_t i2c_writeData(i2c *bus, const void *data, int32_t count) {
  int32_t number = 0;
  while (number < count && !i2c_writeByte(bus, ((const uint8_t *)data)[number])) number++;
  return number;
}

//# adapter i2c_readData
//#   for: int i2c_readData(i2c *bus, unsigned char *data, int count)
//#   kind: oneToMany
//#   needs: i2c i2c_readByte
//#   fidelity: exact: it acknowledges all bytes but the last, and returns their number without it
//#   stack: 13 0
inline int32_t i2c_readData(i2c *bus, void *data, int32_t count) {
  int32_t number = 0;
  do ((uint8_t *)data)[number] = (uint8_t)i2c_readByte(bus, number + 1 >= count);
  while (++number < count);
  return number - 1;
}

//# adapter i2c_poll
//#   for: int i2c_poll(i2c *bus, int addr)
//#   kind: oneToMany
//#   needs: i2c i2c_start i2c_writeByte
//#   fidelity: exact: 0 when the device acknowledges; the address has 8 bits here
//#   stack: 4 2
inline int32_t i2c_poll(i2c *bus, int32_t addr) {
  i2c_start(bus);
  return i2c_writeByte(bus, addr);
}
