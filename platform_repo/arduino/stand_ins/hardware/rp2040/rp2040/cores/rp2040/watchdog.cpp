#include <hardware/watchdog.h>

#include "registers.h"

namespace {

constexpr uint32_t CONTROL = WATCHDOG, LOAD = WATCHDOG + 4, REASON = WATCHDOG + 8;
constexpr uint32_t MOST = 0xffffff, RUNS = 1u << 30, TRIGGER = 1u << 31;
uint32_t load;

}  // namespace

extern "C" {

void watchdog_enable(uint32_t delay_ms, bool) {
  clearBits(CONTROL, RUNS);
  uint64_t turns = 2000ULL * delay_ms;  // it counts two a microsecond (erratum RP2040-E1)
  load = turns < MOST ? turns : MOST;
  watchdog_update();
  setBits(CONTROL, RUNS);
}
void watchdog_update() { reg(LOAD) = load; }
void watchdog_reboot(uint32_t, uint32_t, uint32_t delay_ms) {
  if (delay_ms) watchdog_enable(delay_ms, false);
  else setBits(CONTROL, TRIGGER);
}
bool watchdog_caused_reboot() { return reg(REASON) != 0; }

}
