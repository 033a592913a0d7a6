#include "store.h"
#include <Arduino.h>
#include <EEPROM.h>

void store(int value) {
  EEPROM.write(0, value);
}
