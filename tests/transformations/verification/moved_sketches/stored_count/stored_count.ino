// Counts its starts and steps in the EEPROM.
#include <EEPROM.h>

int address = 10;

void setup() {
  Serial.begin(9600);
  pinMode(6, OUTPUT);
  EEPROM.write(0, 41);
  EEPROM.put(address, 1000);
  EEPROM.put(address + sizeof(int), -7);
}

void loop() {
  int big, small;
  EEPROM.get(address, big);
  EEPROM.get(address + 2, small);
  Serial.print(EEPROM.read(0));
  Serial.print(' ');
  Serial.print(big);
  Serial.print(' ');
  Serial.println(small);
  digitalWrite(6, small < 0);
  delay(100);
}
