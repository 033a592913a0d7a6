#include <Wire.h>
unsigned int check = 0xFFFF;
unsigned int last;
void feed(unsigned int &value, byte given) {
  value ^= given;
  for (byte i = 0; i < 8; i++) value = value & 1 ? (value >> 1) ^ 0xA001 : value << 1;
}
int axis() { return Wire.read() << 8 | Wire.read(); }
void setup() { Wire.begin(); }
void loop() {
  feed(check, Wire.read());
  if ((unsigned int)millis() - last > 500) last = millis();
  tone(8, axis() + (int)check);
}
