/* simpletools.h: timed inputs and outputs. Sources: libsimpletools/source (pulseIn.c, pulseOut.c, rcTime.c, count.c, freqout.c,
 * shiftIn.c, shiftOut.c). They use the cog's counters, so edges are exact to a tick. */
#include "simpletools.h"

static unsigned one(int pin) { return 1u << (pin & 31); }

/* Until the pin has, or no longer has, a level. */
static int wait_level(int pin, int level, int equal, host_time limit) {
  return host_wait_pins(one(pin), level ? one(pin) : 0, equal, limit);
}

/* A counter that is free: 0, 1, or -1. */
static int free_counter(void) { return !CTRA ? 0 : !CTRB ? 1 : -1; }

long pulse_in(int pin, int state) {
  host_call();
  DIRA &= ~one(pin);
  host_time limit = host_now() + (unsigned)st_timeout;
  wait_level(pin, state, 0, limit);  /* a pulse that has begun does not count */
  if (free_counter() < 0) return -1;
  if (!wait_level(pin, state, 1, limit)) return 0;
  host_time begun = host_now();
  wait_level(pin, state, 0, limit);
  return (long)(host_now() - begun) / st_iodt;
}

long rc_time(int pin, int state) {
  host_call();
  if (free_counter() < 0) return -1;
  host_time begun = host_now();
  DIRA &= ~one(pin);
  wait_level(pin, state, 0, begun + (unsigned)st_timeout);
  return (long)(host_now() - begun) / st_iodt;
}

void pulse_out(int pin, int time) {
  host_call();
  unsigned idle = OUTA & one(pin);
  if (free_counter() < 0 || time <= 0) return;
  OUTA ^= one(pin);
  DIRA |= one(pin);
  host_spend((host_time)time * (unsigned)st_iodt);
  OUTA = (OUTA & ~one(pin)) | idle;
}

long count(int pin, long duration) {
  host_time length = (host_time)(unsigned)duration * (unsigned)st_pauseTicks;
  int counter = free_counter();
  host_call();
  DIRA &= ~one(pin);
  wait_level(pin, 1, 0, host_now() + length);
  if (counter < 0) return -1;
  volatile unsigned *control = host_register(HOST_CTRA + counter);
  *host_register(HOST_FRQA + counter) = 1;
  *host_register(HOST_PHSA + counter) = 0;
  *control = (10u << 26) | (pin & 31);
  host_sleep_until(host_now() + length);
  long edges = *host_register(HOST_PHSA + counter);
  *control = 0;
  return edges;
}

/* The settings of a counter for a square wave: below 500 kHz by its phase, above by its phase-locked loop. */
static unsigned wave_control(int pin, int hz) { return (hz < 500000 ? 4u << 26 : 2u << 26 | 7u << 23) | (pin & 31); }

static unsigned wave_step(int hz) {
  unsigned long long step = ((unsigned long long)(unsigned)hz << 32) / HOST_HZ;
  return (unsigned)(hz < 500000 ? step : step / 16);
}

void square_wave_setup(int pin, int freq, int *control, int *step) {
  *control = wave_control(pin, freq);
  *step = wave_step(freq);
}

void freqout(int pin, int msTime, int frequency) {
  host_call();
  int counter = CTRA ? 1 : 0;
  *host_register(HOST_FRQA + counter) = wave_step(frequency);
  *host_register(HOST_CTRA + counter) = wave_control(pin, frequency);
  OUTA &= ~one(pin);
  DIRA |= one(pin);
  pause(msTime);
  *host_register(HOST_CTRA + counter) = 0;
  *host_register(HOST_FRQA + counter) = 0;
  DIRA &= ~one(pin);
  host_call();
}

int shift_in(int pinDat, int pinClk, int mode, int bits) {
  int first_bit = mode == MSBPRE || mode == MSBPOST ? bits - 1 : 0, step = mode == MSBPRE || mode == MSBPOST ? -1 : 1;
  int before = mode == MSBPRE || mode == LSBPRE, value = 0;
  if (mode == LSBPRE) value |= input(pinDat);
  low(pinClk);
  for (int turn = 0, bit = first_bit; turn < bits; turn++, bit += step) {
    if (before) value |= input(pinDat) << bit;
    toggle(pinClk);
    toggle(pinClk);
    if (!before) value |= input(pinDat) << bit;
  }
  return value;
}

void shift_out(int pinDat, int pinClk, int mode, int bits, int value) {
  set_direction(pinDat, 1);
  low(pinClk);
  for (int turn = 0; turn < bits; turn++) {
    set_output(pinDat, value >> (mode == LSBFIRST ? turn : bits - 1 - turn) & 1);
    toggle(pinClk);
    toggle(pinClk);
  }
}
