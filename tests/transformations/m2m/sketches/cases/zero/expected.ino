// 0 as a byte.
#include <SoftwareSerial.h>
#include <Wire.h>
#define REST 0x00
#define SPEED 3

SoftwareSerial far(2, 3);

void send(Stream &to) {
  to.write(7);
}

void setup() {
  Serial.begin(9600); while (!Serial && millis() < 3000) {}
  far.begin(9600);
}

void loop() {
  int none = 0;
  Serial.write((uint8_t)0);
  Serial.write((uint8_t)REST);
  Serial.write(SPEED);
  Serial.write(none);
  Wire.write(0);
  Serial.print(0);
  send(far);
}
