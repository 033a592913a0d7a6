#include <Servo.h>

Servo left, right;

void setup() {
  left.write(45);
  left.attach(10);
  right.attach(11, 1300, 1700);
}

void loop() {
  right.writeMicroseconds(1600);
  if (left.attached() && left.read() > 90 && right.readMicroseconds() > 1500) left.detach();
  delay(20);
}
