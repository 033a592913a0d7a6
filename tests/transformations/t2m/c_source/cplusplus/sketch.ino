// A sketch: no main, no prototypes, objects that nothing here declares.
#include <Servo.h>

Servo arm;
const int LED = 13;

void setup() {
  Serial.begin(9600);
  arm.attach(9);
  blink(2);
}

void loop() {
  arm.write(map(analogRead(A0), 0, 1023, 0, 180));
  delay(20);
}

void blink(int times) {
  for (int i = 0; i < times; i++) {
    digitalWrite(LED, HIGH);
  }
}
