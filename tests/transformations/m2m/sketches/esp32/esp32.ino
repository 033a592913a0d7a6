#include <Servo.h>
#include <SoftwareSerial.h>
Servo arm;
void setup() {
  randomSeed(analogRead(A0));
}
void loop() {}
