// Writes two bytes into an EEPROM, waits until it is ready, reads three; asks a sensor's register 3; asks nobody.
#include <Wire.h>

void ask(int address, int bytes) {
  Wire.requestFrom(address, bytes);
  while (Wire.available()) {
    Serial.print(' ');
    Serial.print(Wire.read());
  }
  Serial.println();
}

void setup() {
  Serial.begin(115200);
  Wire.begin();
  Wire.beginTransmission(0x50);
  Wire.write(0x01);
  Wire.write(0x02);
  Wire.write(77);
  Wire.write(78);
  Serial.println(Wire.endTransmission());
  int polls = 0;
  do {
    Wire.beginTransmission(0x50);
    polls++;
  } while (Wire.endTransmission());
  Serial.println(polls > 1);
  Wire.beginTransmission(0x50);
  Wire.write(0x01);
  Wire.write(0x01);
  Wire.endTransmission(false);
  ask(0x50, 3);
  Wire.beginTransmission(0x19);
  Wire.write(3);
  Wire.endTransmission(false);
  ask(0x19, 2);
  Wire.beginTransmission(0x44);
  Serial.println(Wire.endTransmission() != 0);
}

void loop() {}
