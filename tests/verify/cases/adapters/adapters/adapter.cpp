#include "adapter.h"

#include <Arduino.h>

void blink(int pin, int times) {
  while (times-- > 0) {
    digitalWrite(pin, HIGH);
    delay(100);
    digitalWrite(pin, LOW);
    delay(100);
  }
}
