// devices: devices.c moved from propeller to Arduino Uno.
// Made by RoboSMi. What is left to do is listed in MIGRATION.md.

#include <Arduino.h>

#include "adapters.h"

serial *gps;
i2c *bus;

fdserial *term;
unsigned char buffer[8];

void setup() {
  term = fdserial_open(0, 1, 0, 115200);
  gps = serial_open(255 /* P8 is not wired yet */, 255 /* P9 is not wired yet */, 0, 9600);
  bus = i2c_newbus(A5, A4, 0);
}

void loop() {
  int32_t c = fdserial_rxChar(term);
  fdserial_txChar(term, c);
  i2c_in(bus, 0x68, 0, 1, buffer, 8);
}
