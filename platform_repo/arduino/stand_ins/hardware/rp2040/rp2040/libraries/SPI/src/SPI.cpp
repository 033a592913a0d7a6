#include "SPI.h"

#include <hardware/gpio.h>
#include <registers.h>

SPIClass SPI;

namespace {

constexpr uint32_t FORMAT = SPI_0, ENABLE = SPI_0 + 4, DATA = SPI_0 + 8, STATUS = SPI_0 + 12, DIVIDER = SPI_0 + 16;
constexpr uint32_t CAN_READ = 4;

uint8_t reversed(uint8_t byte) {
  uint8_t made = 0;
  for (int place = 0; place < 8; place++) made |= (byte >> place & 1) << (7 - place);
  return made;
}

}  // namespace

void SPIClass::begin(bool ownSelect) {
  for (pin_size_t pin : {rx, tx, sck}) gpio_set_function(pin, GPIO_FUNC_SPI);
  if (ownSelect) gpio_set_function(cs, GPIO_FUNC_SPI);
  beginTransaction(current);
}

void SPIClass::end() {
  reg(ENABLE) = 0;
  for (pin_size_t pin : {rx, tx, sck}) pinMode(pin, INPUT);
}

void SPIClass::beginTransaction(SPISettings settings) {
  current = settings;
  uint32_t turns = (F_CPU / 2 + settings.hertz - 1) / settings.hertz;  // with a first divider of 2
  reg(ENABLE) = 0;
  reg(DIVIDER) = 2;
  reg(FORMAT) = constrain(turns, 1u, 256u) - 1 << 8 | (settings.mode & 1) << 7 | (settings.mode >> 1) << 6 | 7;
  reg(ENABLE) = 2;
}

uint8_t SPIClass::transfer(uint8_t byte) {
  bool low = current.order == LSBFIRST;
  reg(DATA) = low ? reversed(byte) : byte;
  while (!(reg(STATUS) & CAN_READ)) {}
  uint8_t answer = reg(DATA);
  return low ? reversed(answer) : answer;
}

uint16_t SPIClass::transfer16(uint16_t value) {
  if (current.order == LSBFIRST) {
    uint8_t low = transfer(value);
    return low | transfer(value >> 8) << 8;
  }
  uint8_t high = transfer(value >> 8);
  return high << 8 | transfer(value);
}

void SPIClass::transfer(void *bytes, size_t count) {
  for (uint8_t *each = (uint8_t *)bytes; count--; each++) *each = transfer(*each);
}

void SPIClass::transfer(const void *sent, void *received, size_t count) {
  for (size_t at = 0; at < count; at++) {
    uint8_t answer = transfer(sent ? ((const uint8_t *)sent)[at] : (uint8_t)0xff);
    if (received) ((uint8_t *)received)[at] = answer;
  }
}
