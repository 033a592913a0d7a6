#include <Wire.h>
uint16_t check = 0xFFFF;
uint16_t last;
void feed(uint16_t &value, byte given) {
  value ^= given;
  for (byte i = 0; i < 8; i++) value = value & 1 ? (value >> 1) ^ 0xA001 : value << 1;
}
int axis() { return (int16_t)(Wire.read() << 8 | Wire.read()); }
void setup() { Wire.begin(); }
void loop() {
  feed(check, Wire.read());
  if ((uint16_t)((unsigned int)millis() - last) > 500) last = millis();
  tone(8, (uint16_t)(axis() + (int)check));
}
