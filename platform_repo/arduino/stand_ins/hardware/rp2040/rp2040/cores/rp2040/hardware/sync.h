#pragma once
#include <stdint.h>
static inline uint32_t save_and_disable_interrupts(void) {
  uint32_t state;
  __asm volatile("mrs %0, primask\n\tcpsid i" : "=r"(state) : : "memory");
  return state;
}
static inline void restore_interrupts(uint32_t state) { __asm volatile("msr primask, %0" : : "r"(state) : "memory"); }
static inline void __wfi(void) { __asm volatile("wfi"); }
