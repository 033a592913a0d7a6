#include "Wire.h"

#include <hardware/gpio.h>
#include <registers.h>

TwoWire Wire(I2C_0, PIN_WIRE0_SDA, PIN_WIRE0_SCL), Wire1(I2C_1, PIN_WIRE1_SDA, PIN_WIRE1_SCL);

namespace {

constexpr uint32_t CONTROL = 0, TARGET = 4, COMMAND = 0x10, HIGH_COUNT = 0x1c, LOW_COUNT = 0x20, RAISED = 0x34, CLEAR = 0x40, ENABLE = 0x6c,
                   STATUS = 0x70, ABORT_SOURCE = 0x80;
constexpr uint32_t MASTER = 0x65, READ = 0x100, STOP = 0x200, RESTART = 0x400;
constexpr uint32_t ABORTED = 0x40, STOPPED = 0x200, CAN_WRITE = 2, ALL_WRITTEN = 4, CAN_READ = 8;
constexpr uint32_t NO_ADDRESS = 1, NO_DATA = 8;

}  // namespace

void TwoWire::begin() {
  for (pin_size_t pin : {sda, scl}) {
    pinMode(pin, INPUT_PULLUP);
    gpio_set_function(pin, GPIO_FUNC_I2C);
  }
  reg(base + ENABLE) = 0;
  reg(base + CONTROL) = MASTER;
  setClock(hertz);
  running = true;
}

void TwoWire::end() {
  reg(base + ENABLE) = 0;
  running = false;
}

void TwoWire::setClock(uint32_t frequency) {
  hertz = frequency;
  reg(base + ENABLE) = 0;
  uint32_t period = F_CPU / hertz;
  reg(base + HIGH_COUNT) = period * 2 / 5;
  reg(base + LOW_COUNT) = period - period * 2 / 5;
}

void TwoWire::aim(uint8_t address) {
  if (held) return;  // the transfer goes on with a restart
  reg(base + ENABLE) = 0;
  reg(base + TARGET) = address;
  reg(base + ENABLE) = 1;
  uint32_t forgotten = reg(base + CLEAR);
  (void)forgotten;
}

bool TwoWire::wait(uint32_t flags) {
  for (unsigned long begun = millis(); !(reg(base + RAISED) & (flags | ABORTED));)
    if (millis() - begun > timeout) return false;
  return true;
}

uint8_t TwoWire::aborted() {
  uint32_t raised = reg(base + RAISED), source = reg(base + ABORT_SOURCE), forgotten = reg(base + CLEAR);
  (void)forgotten;
  if (!(raised & ABORTED)) return 0;
  return source & NO_ADDRESS ? 2 : source & NO_DATA ? 3 : 4;
}

void TwoWire::beginTransmission(uint8_t address) {
  target = address;
  have = at = 0;
  tooLong = false;
}

size_t TwoWire::write(uint8_t byte) {
  if (have == WIRE_BUFFER_SIZE) {
    tooLong = true;
    return 0;
  }
  buffer[have++] = byte;
  return 1;
}

uint8_t TwoWire::endTransmission(bool stop) {
  size_t count = have;
  have = at = 0;
  if (tooLong) return 1;
  if (!running) return 4;
  bool again = held;
  aim(target);
  held = false;
  if (!count) reg(base + COMMAND) = READ | STOP;  // the block sends no address alone
  for (size_t next = 0; next < count; next++) {
    while (!(reg(base + STATUS) & CAN_WRITE) && !(reg(base + RAISED) & ABORTED)) {}
    reg(base + COMMAND) = buffer[next] | (stop && next + 1 == count ? STOP : 0) | (again && !next ? RESTART : 0);
  }
  if (!count || stop) {
    if (!wait(STOPPED)) return 4;
    return aborted();
  }
  for (unsigned long begun = millis(); !(reg(base + STATUS) & ALL_WRITTEN) && !(reg(base + RAISED) & ABORTED);)
    if (millis() - begun > timeout) return 4;
  if (uint8_t why = aborted()) return why;
  held = true;
  return 0;
}

size_t TwoWire::requestFrom(uint8_t address, size_t count, bool) {
  have = at = 0;
  if (!running || !count) return 0;
  if (count > WIRE_BUFFER_SIZE) count = WIRE_BUFFER_SIZE;
  bool again = held;
  if (address != target) held = false;
  aim(target = address);
  held = false;
  for (size_t asked = 0; have < count;) {
    if (reg(base + RAISED) & ABORTED) break;
    if (asked < count && asked - have < 8) {
      reg(base + COMMAND) = READ | (asked + 1 == count ? STOP : 0) | (again && !asked ? RESTART : 0);
      asked++;
    }
    if (reg(base + STATUS) & CAN_READ) buffer[have++] = reg(base + COMMAND);
  }
  wait(STOPPED);
  if (aborted()) have = 0;
  return have;
}
