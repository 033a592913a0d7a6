#include <Servo.h>
Servo left, right;
void setup() {
  Serial.begin(9600);
  left.attach(0);
  right.attach(1);
}
void loop() {
  left.write(90);
  right.write(10);
}
