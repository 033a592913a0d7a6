#include <EEPROM.h>
#include <Servo.h>
Servo arm;
int index = 0;

struct Row {
  int index;
};
Row row;

void setup() {
  Serial.begin(9600);
  arm.attach(9);
  for (int i = 0; i < 4; i++) {
    EEPROM.write(i, 0);
  }
  EEPROM.update(7, index);
}

void loop() {
  row.index = index;
  SPCR = 0x50;
  tone(8, 440);
}
