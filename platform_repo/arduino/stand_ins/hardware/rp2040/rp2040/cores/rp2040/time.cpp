// The timer of 1 us: time, waits, repeating timers. A wait sleeps until its alarm, so a simulator may skip the time.
#include <Arduino.h>
#include <pico/time.h>

#include "registers.h"

namespace {

constexpr int SLEEP_ALARM = 0, REPEAT_ALARM = 3;
constexpr int32_t LEAST_SLEEP = 2;  // us: an alarm that near may be missed
repeating_timer_t *repeating;

void sleepUntil(uint32_t when) {
  while ((int32_t)(when - micros()) > LEAST_SLEEP) {
    reg(TIMER_ALARM + 4 * SLEEP_ALARM) = when;
    uint32_t state = save_and_disable_interrupts();
    if ((int32_t)(when - micros()) > LEAST_SLEEP) asm volatile("wfi");
    restore_interrupts(state);
  }
  while ((int32_t)(when - micros()) > 0) {}
}

void awake() {}

void armNext() {
  const repeating_timer_t *next = nullptr;
  for (repeating_timer_t *each = repeating; each; each = each->next)
    if (!next || (int32_t)(each->due - next->due) < 0) next = each;
  if (!next) return;
  uint32_t soonest = micros() + LEAST_SLEEP;
  reg(TIMER_ALARM + 4 * REPEAT_ALARM) = (int32_t)(next->due - soonest) < 0 ? soonest : next->due;
}

void runDue() {
  for (repeating_timer_t *each = repeating, *next; each; each = next) {
    next = each->next;
    if ((int32_t)(micros() - each->due) < 0) continue;
    bool again = each->callback(each);
    each->due = each->delay_us < 0 ? each->due - (int32_t)each->delay_us : micros() + (uint32_t)each->delay_us;
    if (!again) cancel_repeating_timer(each);
  }
  armNext();
}

}  // namespace

extern "C" {

void __start_time() {
  handleAlarm(SLEEP_ALARM, awake);
  handleAlarm(REPEAT_ALARM, runDue);
}

uint32_t time_us_32() { return reg(TIMER_LOW); }
uint64_t time_us_64() {
  for (;;) {
    uint32_t high = reg(TIMER_HIGH), low = reg(TIMER_LOW);
    if (high == reg(TIMER_HIGH)) return (uint64_t)high << 32 | low;
  }
}
unsigned long micros() { return reg(TIMER_LOW); }
unsigned long millis() { return time_us_64() / 1000; }

void sleep_us(uint64_t us) {
  constexpr uint32_t most = 1000000000;
  for (; us > most; us -= most) sleepUntil(micros() + most);
  sleepUntil(micros() + (uint32_t)us);
}
void sleep_ms(uint32_t ms) { sleep_us(1000ULL * ms); }
void busy_wait_us(uint64_t us) {
  for (uint64_t begun = time_us_64(); time_us_64() - begun < us;) {}
}
void busy_wait_us_32(uint32_t us) {
  for (uint32_t begun = time_us_32(); time_us_32() - begun < us;) {}
}

// As in the core: a program may have its own, and this one does not call yield()
__attribute__((weak)) void delay(unsigned long ms) { sleep_us(1000ULL * ms); }
void delayMicroseconds(unsigned int us) {
  if (us > 20) {
    sleepUntil(micros() + us);
    return;
  }
  uint32_t turns = (us * clockCyclesPerMicrosecond() + 1) / 3;  // of 3 cycles
  if (turns) asm volatile(".syntax unified\n1: subs %0, #1\n\tbne 1b" : "+l"(turns) : : "cc");
}

bool add_repeating_timer_us(int64_t delay_us, repeating_timer_callback_t callback, void *user_data, repeating_timer_t *timer) {
  cancel_repeating_timer(timer);
  uint32_t state = save_and_disable_interrupts();
  timer->delay_us = delay_us;
  timer->callback = callback;
  timer->user_data = user_data;
  timer->due = micros() + (uint32_t)(delay_us < 0 ? -delay_us : delay_us);
  timer->next = repeating;
  repeating = timer;
  armNext();
  restore_interrupts(state);
  return true;
}
bool add_repeating_timer_ms(int32_t delay_ms, repeating_timer_callback_t callback, void *user_data, repeating_timer_t *timer) {
  return add_repeating_timer_us(1000LL * delay_ms, callback, user_data, timer);
}
bool cancel_repeating_timer(repeating_timer_t *timer) {
  uint32_t state = save_and_disable_interrupts();
  bool found = false;
  for (repeating_timer_t **link = &repeating; *link; link = &(*link)->next) {
    if (*link != timer) continue;
    *link = timer->next;
    found = true;
    break;
  }
  restore_interrupts(state);
  return found;
}
}
