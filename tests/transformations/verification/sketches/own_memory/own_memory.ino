// D8 is high while two bytes are written to the microcontroller's own memory; one that is there already takes no time.
#include <avr/eeprom.h>

void setup() {
  pinMode(8, OUTPUT);
  Serial.begin(115200);
  digitalWrite(8, HIGH);
  eeprom_update_byte((uint8_t *)4, 0x55);
  eeprom_update_byte((uint8_t *)5, 0xAA);
  eeprom_busy_wait();
  digitalWrite(8, LOW);
  delay(10);
  digitalWrite(8, HIGH);
  eeprom_update_byte((uint8_t *)4, 0x55);
  eeprom_busy_wait();
  digitalWrite(8, LOW);
  Serial.print(eeprom_read_byte((uint8_t *)4), HEX);
  Serial.print(eeprom_read_byte((uint8_t *)5), HEX);
}

void loop() {}
