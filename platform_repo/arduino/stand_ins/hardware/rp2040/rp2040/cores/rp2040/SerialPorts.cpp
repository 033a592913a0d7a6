#include <Arduino.h>
#include <hardware/irq.h>
#include <hardware/sync.h>

#include "registers.h"

SerialUART Serial1(0, PIN_SERIAL1_TX, PIN_SERIAL1_RX), Serial2(1, PIN_SERIAL2_TX, PIN_SERIAL2_RX);

namespace {

constexpr uint32_t DATA = 0, FLAGS = 0x18, WHOLE = 0x24, FRACTION = 0x28, FORMAT = 0x2c, CONTROL = 0x30, MASK = 0x38, CLEAR = 0x44;
constexpr uint32_t EMPTY = 0x10, FULL = 0x20, BUSY = 8;
constexpr uint32_t RECEIVED = 0x50;  // some bytes, or one and then a rest
uint32_t base(int line) { return line ? UART_1 : UART_0; }

}  // namespace

void SerialUART::begin(unsigned long baud, uint16_t config) {
  uint32_t divider = (uint32_t)(((uint64_t)F_CPU * 4 + baud / 2) / baud), uart = base(line);  // of 16 clocks a bit, 6 bits of fraction
  reg(uart + CONTROL) = 0;
  reg(uart + WHOLE) = divider >> 6;
  reg(uart + FRACTION) = divider & 63;
  uint32_t bits = (config >> 8 & 7) + 4, parity = config & 3, stops = config >> 4 & 3;
  reg(uart + FORMAT) = (bits - 5) << 5 | 0x10 | (stops == 3 ? 8 : 0) | (parity == 1 ? 6 : parity == 2 ? 2 : 0);
  reg(uart + CONTROL) = 0x301;
  selectFunction(tx, FUNCTION_UART);
  selectFunction(rx, FUNCTION_UART);
  running = true;
  reg(uart + MASK) = RECEIVED;
  irq_set_exclusive_handler(UART0_IRQ + line, line ? []() { Serial2.take(); } : []() { Serial1.take(); });
  irq_set_enabled(UART0_IRQ + line, true);
}

void SerialUART::end() {
  irq_set_enabled(UART0_IRQ + line, false);
  reg(base(line) + CONTROL) = 0;
  running = false;
}

void SerialUART::take() {
  uint32_t uart = base(line);
  reg(uart + CLEAR) = RECEIVED;
  while (!(reg(uart + FLAGS) & EMPTY)) {
    uint8_t byte = reg(uart + DATA);
    if ((uint8_t)(last + 1) == first) continue;  // full: the rest is lost
    buffer[last] = byte;
    last = last + 1;
  }
}

int SerialUART::available() {
  uint32_t state = save_and_disable_interrupts();
  if (running) take();
  restore_interrupts(state);
  return (uint8_t)(last - first);
}
int SerialUART::peek() { return available() ? buffer[first] : -1; }
int SerialUART::read() {
  int byte = peek();
  if (byte >= 0) first = first + 1;
  return byte;
}
size_t SerialUART::write(uint8_t byte) {
  if (!running) return 0;
  while (reg(base(line) + FLAGS) & FULL) {}
  reg(base(line) + DATA) = byte;
  return 1;
}
int SerialUART::availableForWrite() { return running && !(reg(base(line) + FLAGS) & FULL); }
void SerialUART::flush() {
  while (running && reg(base(line) + FLAGS) & BUSY) {}
}

void serialEvent1() __attribute__((weak));
void serialEvent2() __attribute__((weak));

void serialEvent1Run() {
  if (serialEvent1 && Serial1.available()) serialEvent1();
  if (serialEvent2 && Serial2.available()) serialEvent2();
}
