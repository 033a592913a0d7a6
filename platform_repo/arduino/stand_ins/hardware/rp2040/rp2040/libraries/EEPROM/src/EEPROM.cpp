// In memory: what is committed stays until the program ends. An erased cell is 255, as in flash.
#include "EEPROM.h"

EEPROMClass EEPROM;
static constexpr size_t MOST = 4096;
static uint8_t flash[MOST];
static bool erased;

void EEPROMClass::begin(size_t wanted) {
  if (!wanted || wanted > MOST) return;
  if (!erased) memset(flash, 255, MOST);
  erased = true;
  size = wanted;
  if (!data) data = (uint8_t *)malloc(MOST);
  if (data) memcpy(data, flash, MOST);
  else size = 0;
}

bool EEPROMClass::commit() {
  if (!size) return false;
  memcpy(flash, data, size);
  return true;
}

uint8_t &EEPROMClass::operator[](int address) {
  static uint8_t none;
  none = 0;
  return address >= 0 && (size_t)address < size ? data[address] : none;
}
