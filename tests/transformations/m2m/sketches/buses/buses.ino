#include <SPI.h>
#include <Wire.h>
void setup() {
  Serial.begin(9600);
  Wire.begin();
  SPI.begin();
}
void loop() {
  if (Serial.available()) Wire.write(Serial.read());
}
