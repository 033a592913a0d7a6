// Time and repeating timers under the names of the Pico SDK.
#pragma once
#include <stdbool.h>
#include <stdint.h>

#include "../hardware/sync.h"
#include "../hardware/timer.h"

#ifdef __cplusplus
extern "C" {
#endif
typedef struct repeating_timer repeating_timer_t;
typedef bool (*repeating_timer_callback_t)(repeating_timer_t *timer);
struct repeating_timer {
  int64_t delay_us;  // below 0: from begin to begin
  repeating_timer_callback_t callback;
  void *user_data;
  uint32_t due;
  struct repeating_timer *next;
};
bool add_repeating_timer_us(int64_t delay_us, repeating_timer_callback_t callback, void *user_data, repeating_timer_t *timer);
bool add_repeating_timer_ms(int32_t delay_ms, repeating_timer_callback_t callback, void *user_data, repeating_timer_t *timer);
bool cancel_repeating_timer(repeating_timer_t *timer);
void sleep_us(uint64_t us);
void sleep_ms(uint32_t ms);
#ifdef __cplusplus
}
#endif
