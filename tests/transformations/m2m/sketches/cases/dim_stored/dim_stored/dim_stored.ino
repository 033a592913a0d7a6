#include <EEPROM.h>
#include <MsTimer2.h>
const float STEPS = 1024.0;
void setup() {
  analogReference(DEFAULT);
  EEPROM.write(0, 1);
}
void loop() {
  analogWrite(6, 100);
  float volts = analogRead(A0) * 5.0 / STEPS;
  long millivolts = (long)analogRead(A1) * 5000 / 1023;
  int share = analogRead(A2) / 1023.0 * 100;
  tone(8, volts + millivolts + share);
}
