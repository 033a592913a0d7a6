#include "Wheel.h"

Wheel left(5);
Wheel right = Wheel(6);

void setup() {
  left.begin();
  right.begin();
}

void loop() {
  left.go();
}
