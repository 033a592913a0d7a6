#include <Arduino.h>
#include "Lamp.h"

void lamp_on(void) {
  DDRB |= _BV(3);
  PORTB |= _BV(3);
}
