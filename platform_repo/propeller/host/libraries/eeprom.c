/* eeprom.h: two bytes of address, then bytes. Source: propgcc lib/sys/propeller/eeprom.c. */
#include <eeprom.h>

void eepromInit(EEPROM *eeprom, I2C *dev, int address) { *eeprom = (EEPROM){dev, address}; }

EEPROM *eepromOpen(EEPROM_COGDRIVER *eeprom, int scl, int sda, int freq, int address) {
  I2C *dev = i2cOpen(&eeprom->dev, scl, sda, freq);
  if (!dev) return 0;
  eepromInit(&eeprom->state, dev, address);
  return &eeprom->state;
}

EEPROM *simple_eepromOpen(EEPROM_SIMPLE *eeprom, int scl, int sda, int address) {
  eepromInit(&eeprom->state, simple_i2cOpen(&eeprom->dev, scl, sda), address);
  return &eeprom->state;
}

static int at(EEPROM *eeprom, uint32_t address) {
  uint8_t place[2] = {address >> 8, address};
  return i2cWrite(eeprom->dev, eeprom->address, place, 2, 0);
}

int eepromRead(EEPROM *eeprom, uint32_t address, uint8_t *buffer, int count) {
  return at(eeprom, address) ? -1 : i2cRead(eeprom->dev, eeprom->address, buffer, count, 1);
}

int eepromWrite(EEPROM *eeprom, uint32_t address, uint8_t *buffer, int count) {
  if (at(eeprom, address) || i2cWriteMore(eeprom->dev, buffer, count, 1)) return -1;
  while (i2cWrite(eeprom->dev, eeprom->address, 0, 0, 1)) {}
  return 0;
}

int eepromClose(EEPROM *eeprom) {
  if (!eeprom->dev) return -1;
  i2cClose(eeprom->dev);
  eeprom->dev = 0;
  return 0;
}
