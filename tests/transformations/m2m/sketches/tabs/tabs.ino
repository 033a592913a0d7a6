#include "src/helper.h"
const int LAMP = 6;
int speed = 3;

void setup() {
  begin_wheels();
}

void loop() {
  turn(speed);
  digitalWrite(LAMP, helper());
}
