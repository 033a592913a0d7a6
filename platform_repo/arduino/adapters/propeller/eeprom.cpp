//# header eeprom.h
// Memories on the two-wire bus. Read from propgcc b280e7a77, lib/include/eeprom.h, lib/sys/propeller/eeprom.c.
//# task eepromBootOpen the memory that the program was loaded from is not there: use ee_putByte and its like, or eepromOpen for one on the bus

//# type EEPROM
//#   needs: i2c.h/I2C
//#   fidelity: exact
struct EEPROM {
  I2C *dev;
  int32_t address;
};

//# type EEPROM_COGDRIVER
//#   needs: EEPROM i2c.h/I2C_COGDRIVER
//#   fidelity: for use with the functions
struct EEPROM_COGDRIVER {
  EEPROM state;
  I2C_COGDRIVER dev;
};

//# type EEPROM_SIMPLE
//#   needs: EEPROM_COGDRIVER
//#   fidelity: for use with the functions
typedef EEPROM_COGDRIVER EEPROM_SIMPLE;

//# adapter eepromInit
//#   for: void eepromInit(EEPROM *eeprom, I2C *dev, int address)
//#   kind: oneToMany
//#   needs: EEPROM i2c.h/I2C
//#   fidelity: exact
//#   stack: 0
inline void eepromInit(EEPROM *eeprom, I2C *dev, int32_t address) {
  eeprom->dev = dev;
  eeprom->address = address;
}

//# adapter eepromOpen
//#   for: EEPROM *eepromOpen(EEPROM_COGDRIVER *eeprom, int scl, int sda, int freq, int address)
//#   kind: oneToMany
//#   needs: EEPROM EEPROM_COGDRIVER eepromInit i2c.h/I2C i2c.h/i2cOpen
//#   pin: scl digital both
//#   pin: sda digital both
//#   fidelity: exact: 0 beyond 400 kHz; the address has 8 bits
//#   limit avr: only at the pins SCL and SDA; connect a memory there
//#   stack: 0
inline EEPROM *eepromOpen(EEPROM_COGDRIVER *eeprom, int32_t scl, int32_t sda, int32_t freq, int32_t address) {
  I2C *dev = i2cOpen(&eeprom->dev, scl, sda, freq);
  if (!dev) return 0;
  eepromInit(&eeprom->state, dev, address);
  return &eeprom->state;
}

//# adapter simple_eepromOpen
//#   for: EEPROM *simple_eepromOpen(EEPROM_SIMPLE *eeprom, int scl, int sda, int address)
//#   kind: oneToMany
//#   needs: EEPROM EEPROM_SIMPLE EEPROM_COGDRIVER eepromInit i2c.h/simple_i2cOpen
//#   pin: scl digital both
//#   pin: sda digital both
//#   fidelity: 100 kHz; the address has 8 bits
//#   limit avr: only at the pins SCL and SDA; connect a memory there
//#   stack: 0
inline EEPROM *simple_eepromOpen(EEPROM_SIMPLE *eeprom, int32_t scl, int32_t sda, int32_t address) {
  eepromInit(&eeprom->state, simple_i2cOpen(&eeprom->dev, scl, sda), address);
  return &eeprom->state;
}

//# adapter eepromRead
//#   for: int eepromRead(EEPROM *eeprom, uint32_t address, uint8_t *buffer, int count)
//#   kind: oneToMany
//#   needs: EEPROM i2c.h/i2cWrite i2c.h/i2cRead
//#   fidelity: exact: 0, or -1 when the memory does not answer
//#   stack: 22 4
inline int32_t eepromRead(EEPROM *eeprom, uint32_t address, void *buffer, int32_t count) {
  const uint8_t place[2] = {(uint8_t)(address >> 8), (uint8_t)address};
  if (i2cWrite(eeprom->dev, eeprom->address, place, 2, 0)) return -1;
  return i2cRead(eeprom->dev, eeprom->address, buffer, count, 1);
}

//# adapter eepromWrite
//#   for: int eepromWrite(EEPROM *eeprom, uint32_t address, uint8_t *buffer, int count)
//#   kind: oneToMany
//#   needs: EEPROM i2c.h/i2cWrite i2c.h/i2cWriteMore
//#   fidelity: exact: it waits until the memory has written; 0, or -1 when it does not answer
//#   stack: 22 4
inline int32_t eepromWrite(EEPROM *eeprom, uint32_t address, const void *buffer, int32_t count) {
  const uint8_t place[2] = {(uint8_t)(address >> 8), (uint8_t)address};
  if (i2cWrite(eeprom->dev, eeprom->address, place, 2, 0)) return -1;
  if (i2cWriteMore(eeprom->dev, buffer, count, 1)) return -1;
  while (i2cWrite(eeprom->dev, eeprom->address, 0, 0, 1)) yield();
  return 0;
}

//# adapter eepromClose
//#   for: int eepromClose(EEPROM *eeprom)
//#   kind: oneToMany
//#   needs: EEPROM i2c.h/i2cClose
//#   fidelity: exact: 0, or -1 when it is closed already
//#   stack: 0
inline int32_t eepromClose(EEPROM *eeprom) {
  if (!eeprom->dev) return -1;
  i2cClose(eeprom->dev);
  eeprom->dev = 0;
  return 0;
}
