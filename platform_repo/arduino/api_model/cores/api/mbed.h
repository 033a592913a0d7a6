// Threads of Mbed OS, as far as programs start one and let it sleep.
#pragma once
#ifndef ARDUINO_ARCH_MBED_NANO
#error only cores on Mbed OS have mbed.h
#endif
#include <stdint.h>

#include "../../chip/board.h"

namespace std {
namespace chrono {
struct milliseconds {
  uint32_t count;
  explicit milliseconds(uint32_t count) : count(count) {}
};
}  // namespace chrono
}  // namespace std

enum osPriority_t { osPriorityNormal, osPriorityAboveNormal };

namespace rtos {
class Thread {
 public:
  explicit Thread(osPriority_t = osPriorityNormal) {}
  void start(void (*task)()) {
    board_task([](void *function) { ((void (*)())function)(); }, (void *)task);
  }
};
namespace ThisThread {
inline void sleep_for(std::chrono::milliseconds time) { board_sleep_until(board_now() + 1000ull * time.count); }
}  // namespace ThisThread
}  // namespace rtos
