#include "Wire.h"

#include "../../chip/board.h"
#include "pins.h"

TwoWire Wire;

namespace {
#if defined(API_SCL) && defined(API_SDA)
int32_t scl() { return apiPin(API_SCL); }
int32_t sda() { return apiPin(API_SDA); }
#else
int32_t scl() { board_lacks("Wire on this board"); }
int32_t sda() { return scl(); }
#endif
}  // namespace

void TwoWire::passByte() { board_spend(9 * 1000000 / hertz); }

void TwoWire::beginTransmission(int address) {
  target = address;
  have = at = 0;
  tooLong = false;
}

size_t TwoWire::write(uint8_t byte) {
  tooLong = tooLong || have == ROOM;
  if (!tooLong) buffer[have++] = byte;
  return !tooLong;
}

uint8_t TwoWire::endTransmission(bool stop) {
  int count = have;
  have = at = 0;
  if (tooLong) return 1;
  if (!runs) return 4;
  passByte();
  uint8_t result = board_bus_start(scl(), sda(), target, 0) ? 0 : 2;
  for (int next = 0; next < count && !result; next++) {
    passByte();
    if (!board_bus_write(scl(), sda(), buffer[next])) result = 3;
  }
  if (stop || result) board_bus_stop(scl(), sda());
  return result;
}

size_t TwoWire::requestFrom(int address, int count, int stop) {
  have = at = 0;
  if (!runs || count <= 0) return 0;
  passByte();
  if (board_bus_start(scl(), sda(), address, 1))
    while (have < constrain(count, 0, ROOM)) {
      passByte();
      buffer[have++] = board_bus_read(scl(), sda());
    }
  if (stop || !have) board_bus_stop(scl(), sda());
  return have;
}
