/* eeprom.h of propgcc: memories on the two-wire bus. */
#ifndef ROBOSMI_EEPROM_H
#define ROBOSMI_EEPROM_H
#include <stdint.h>
#include <i2c.h>
typedef struct {
  I2C *dev;
  int address;
} EEPROM;
typedef struct {
  EEPROM state;
  I2C_COGDRIVER dev;
} EEPROM_COGDRIVER;
typedef struct {
  EEPROM state;
  I2C_SIMPLE dev;
} EEPROM_SIMPLE;
void eepromInit(EEPROM *eeprom, I2C *dev, int address);
EEPROM *eepromOpen(EEPROM_COGDRIVER *eeprom, int scl, int sda, int freq, int address);
EEPROM *simple_eepromOpen(EEPROM_SIMPLE *eeprom, int scl, int sda, int address);
int eepromRead(EEPROM *eeprom, uint32_t address, uint8_t *buffer, int count);
int eepromWrite(EEPROM *eeprom, uint32_t address, uint8_t *buffer, int count);
int eepromClose(EEPROM *eeprom);
#endif
