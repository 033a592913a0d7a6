// The console.
#include <Arduino.h>

#include "registers.h"

void SerialUSB::begin(unsigned long) { reg(UART_0 + 0x24) = F_CPU / 16 / 115200, reg(UART_0 + 0x2c) = 0x70, reg(UART_0 + 0x30) = 0x301; }
SerialUSB::operator bool() { return true; }
int SerialUSB::available() { return !(reg(UART_0 + 0x18) & 0x10); }
int SerialUSB::read() { return available() ? (int)(reg(UART_0) & 255) : -1; }
int SerialUSB::peek() { return -1; }
size_t SerialUSB::write(uint8_t byte) {
  while (reg(UART_0 + 0x18) & 0x20) {}
  reg(UART_0) = byte;
  return 1;
}
size_t SerialUSB::write(const uint8_t *bytes, size_t count) { return Print::write(bytes, count); }
int SerialUSB::availableForWrite() { return 64; }
