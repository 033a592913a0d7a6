#include <Arduino.h>

#include "adapter.h"

void turn(int pin) {
  digitalWrite(pin, HIHG);
}
