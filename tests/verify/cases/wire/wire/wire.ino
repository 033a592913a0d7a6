#include <Wire.h>

void setup() { Wire.begin(); }

void loop() {
  Wire.beginTransmission(8);
  Wire.write(1);
  Wire.endTransmission();
}
