/* dht22.h: the sensor is asked by 18 ms of low, and answers with 40 bits; two rising edges more than 102 us apart are a 1.
 * Source: libdht22/dht22.c, with its fault: the checksum of a temperature below 0 is never right. */
#include <propeller.h>
#include "dht22.h"

enum { EDGES = 42, LISTENING_TURNS = 16500, SENT_TICKS = 7 * HOST_TICKS_PER_MS, ONE_TICKS = HOST_HZ / 9800 };
static int last_read[32], last_celsius, last_humidity;
static unsigned hasty;

void dht22_set_timeout_ignore(int dht_pin, char ignore_timeout) {
  host_call();
  unsigned mask = 1u << (dht_pin & 31);
  hasty = ignore_timeout ? hasty | mask : hasty & ~mask;
}

/* The bits from an edge to another, first one highest. */
static int bits(const unsigned *edge, int first, int end) {
  int value = 0;
  for (int i = first; i < end; i++) value = value << 1 | (edge[i] - edge[i - 1] > ONE_TICKS);
  return value;
}

char dht22_read(int dht_pin) {
  unsigned edge[EDGES] = {0}, mask = 1u << (dht_pin & 31);
  int count = 0;
  host_call();
  if (dht_pin < 0 || dht_pin > 31) return 0;
  if (last_read[dht_pin] && CNT - last_read[dht_pin] < HOST_HZ / 2 && !(hasty & mask))
    host_wait_counter(last_read[dht_pin] + HOST_HZ / 2);
  OUTA &= ~mask;
  DIRA |= mask;
  host_sleep_until(host_now() + HOST_HZ / 55);
  DIRA &= ~mask;
  host_time end = host_now() + SENT_TICKS;
  while (host_wait_pins(mask, 0, 1, end) && host_wait_pins(mask, mask, 1, end))
    if (count < EDGES) edge[count++] = (unsigned)host_now();
  if (end > host_now()) host_spend(end - host_now());
  host_turns(LISTENING_TURNS);
  int humidity = bits(edge, 2, 18), raw = bits(edge, 18, 34), sum = bits(edge, 34, 42);
  int celsius = raw & 0x8000 ? -(raw & 0x7FFF) : raw;
  last_humidity = humidity;
  last_celsius = celsius;
  last_read[dht_pin] = CNT;
  if (count < EDGES) return 0;  /* the library calculates with what was on its stack */
  return sum == (((humidity >> 8 & 255) + (humidity & 255) + (celsius >> 8 & 255) + (celsius & 255)) & 255);
}

int dht22_getTemp(char temp_units) {
  host_call();
  if (temp_units == KELVIN) return last_celsius + 2732;
  return temp_units == FAHRENHEIT ? last_celsius * 9 / 5 + 320 : last_celsius;
}

int dht22_getHumidity() {
  host_call();
  return last_humidity;
}
