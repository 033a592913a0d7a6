#include "src/wheel/Wheel.h"

Wheel wheel(5, 200);

void setup() {
  Serial.begin(9600);
  report(name().length());
}

void loop() {
  wheel.turn();
  Serial.print(wheel.turns(), HEX);
  blink(7);
}
