/* simpletools.h: pins and time. Sources: libsimpletools/source (high.c, setOutputs.c, pause.c, wait.c and their neighbours). */
#include "simpletools.h"

int ms = HOST_TICKS_PER_MS, us = HOST_TICKS_PER_US, st_msTicks = HOST_TICKS_PER_MS, st_usTicks = HOST_TICKS_PER_US;
int st_iodt = HOST_TICKS_PER_US, st_timeout = 250 * HOST_TICKS_PER_MS, st_pauseTicks = HOST_TICKS_PER_MS, st_mark;

static unsigned one(int pin) { return 1u << (pin & 31); }

static void put(volatile unsigned *bits, unsigned mask, int value) { *bits = value & 1 ? *bits | mask : *bits & ~mask; }

void high(int pin) {
  host_call();
  OUTA |= one(pin);
  DIRA |= one(pin);
}

void low(int pin) {
  host_call();
  OUTA &= ~one(pin);
  DIRA |= one(pin);
}

int input(int pin) {
  host_call();
  DIRA &= ~one(pin);
  return INA >> (pin & 31) & 1;
}

unsigned int toggle(int pin) {
  host_call();
  OUTA ^= one(pin);
  DIRA |= one(pin);
  return OUTA >> (pin & 31) & 1;
}

unsigned int reverse(int pin) {
  host_call();
  DIRA ^= one(pin);
  return DIRA >> (pin & 31) & 1;
}

unsigned int get_state(int pin) {
  host_call();
  return INA >> (pin & 31) & 1;
}

unsigned int get_direction(int pin) {
  host_call();
  return DIRA >> (pin & 31) & 1;
}

unsigned int get_output(int pin) {
  host_call();
  return OUTA >> (pin & 31) & 1;
}

void set_direction(int pin, int direction) {
  host_call();
  put(&DIRA, one(pin), direction);
}

void set_output(int pin, int state) {
  host_call();
  put(&OUTA, one(pin), state);
}

/* Pins from one end to the other, in either order. */
static unsigned range(int end, int start, int *lowest) {
  int first = end < start ? end : start, last = end < start ? start : end;
  *lowest = first & 31;
  return (0xFFFFFFFFu >> (31 - ((last - first) & 31))) << (first & 31);
}

static unsigned field(unsigned bits, int end, int start) {
  int lowest;
  unsigned mask = range(end, start, &lowest);
  return (bits & mask) >> lowest;
}

/* The library does not cut the pattern to the range: bits beyond it reach pins above, where they are 1. */
static void put_field(volatile unsigned *bits, int end, int start, unsigned pattern) {
  int lowest;
  unsigned mask = range(end, start, &lowest);
  *bits = (*bits & ~mask) | pattern << lowest;
}

unsigned int get_states(int endPin, int startPin) {
  host_call();
  return field(INA, endPin, startPin);
}

unsigned int get_directions(int endPin, int startPin) {
  host_call();
  return field(DIRA, endPin, startPin);
}

unsigned int get_outputs(int endPin, int startPin) {
  host_call();
  return field(OUTA, endPin, startPin);
}

void set_directions(int endPin, int startPin, unsigned int pattern) {
  host_call();
  put_field(&DIRA, endPin, startPin, pattern);
}

void set_outputs(int endPin, int startPin, unsigned int pattern) {
  host_call();
  put_field(&OUTA, endPin, startPin, pattern);
}

void pause(int time) { host_sleep_until(host_now() + (host_time)(unsigned)time * (unsigned)st_pauseTicks); }

void set_pause_dt(int clockticks) { st_pauseTicks = clockticks; }

void mark(void) { st_mark = CNT; }

int timeout(int time) { return CNT - st_mark >= (unsigned)(time * st_iodt); }

void wait(int time) { host_wait_counter(st_mark += time * st_iodt); }

void set_io_timeout(long clockTicks) { st_timeout = clockTicks; }

void set_io_dt(long clockticks) { st_iodt = clockticks; }
