// devices: devices.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

serial *gps;
i2c *bus;

fdserial *term;
unsigned char buffer[8];

void setup() {
  term = fdserial_open(31, 30, 0, 115200);
  gps = serial_open(8, 9, 0, 9600);
  bus = i2c_newbus(28, 29, 0);
}

void loop() {
  int32_t c = fdserial_rxChar(term);
  fdserial_txChar(term, c);
  i2c_in(bus, 0x68, 0, 1, buffer, 8);
}
