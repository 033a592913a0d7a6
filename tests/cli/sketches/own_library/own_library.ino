#include "src/Lamp/Lamp.h"

void setup() {
  pinMode(13, OUTPUT);
  PORTD |= _BV(4);
}

void loop() {
  lamp_on();
}
