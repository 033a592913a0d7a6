// An arm that moves between its ends.
#include <Servo.h>

Servo arm;

void setup() {
  arm.attach(9);
}

void loop() {
  arm.write(0);
  delay(100);
  arm.write(180);
  delay(100);
}
