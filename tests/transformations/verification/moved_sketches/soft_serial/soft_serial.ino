// Sends a count to a display at two other pins.
#include <SoftwareSerial.h>

SoftwareSerial display(10, 11);
byte n = 'A';

void setup() {
  display.begin(9600);
}

void loop() {
  display.write(n);
  n = n == 'Z' ? 'A' : n + 1;
  delay(20);
}
