/* ws2812.h: a cog sends 24 bits for each LED, highest first, then a pause; a new picture waits until the last one is sent.
 * Sources: libws2812 (its driver is in machine code). */
#include <stdlib.h>
#include <propeller.h>
#include "ws2812.h"

/* What a driver's cog knows; one for each cog. */
static struct strip {
  ws2812_t *driver;
  unsigned high[2], low[2], reset, swaps;
  int pin, count;
  uint32_t *colors;
} strips[8];

static void send(struct strip *strip, uint32_t color) {
  unsigned mask = 1u << strip->pin;
  if (strip->swaps) color = (color & 0xFF) | (color >> 8 & 0xFF) << 16 | (color >> 16 & 0xFF) << 8;
  for (int bit = 23; bit >= 0; bit--) {
    int one = color >> bit & 1;
    OUTA |= mask;
    host_spend(strip->high[one]);
    OUTA &= ~mask;
    host_spend(strip->low[one]);
  }
}

static void serve(void *parameter) {
  struct strip *strip = parameter;
  for (;;) {
    while (!strip->driver->command) host_spend(HOST_TICKS_PER_US);
    OUTA &= ~(1u << strip->pin);
    DIRA |= 1u << strip->pin;
    for (int i = 0; i < strip->count; i++) send(strip, strip->colors[i]);
    host_spend(strip->reset);
    strip->driver->command = 0;
  }
}

int ws_start(ws2812_t *driver, int usreset, int ns0h, int ns0l, int ns1h, int ns1l, int type) {
  int place = 0;
  host_call();
  while (place < 8 && strips[place].driver && strips[place].driver != driver) place++;
  if (place == 8) return -1;
  const unsigned tick = HOST_TICKS_PER_US;
  strips[place] = (struct strip){driver, {tick * ns0h / 1000, tick * ns1h / 1000}, {tick * ns0l / 1000, tick * ns1l / 1000},
                                 tick * usreset, type == TYPE_GRB, 0, 0, 0};
  driver->command = 0;
  driver->cog = host_start(serve, &strips[place], -1);
  return driver->cog;
}

int ws2812_start(ws2812_t *driver) { return ws_start(driver, 50, 350, 800, 700, 600, TYPE_GRB); }
int ws2812b_start(ws2812_t *driver) { return ws_start(driver, 300, 200, 600, 600, 200, TYPE_GRB); }

static ws2812_t *opened(int (*start)(ws2812_t *driver)) {
  ws2812_t *driver = malloc(sizeof *driver);
  if (!driver) return 0;
  if (start(driver) >= 0) return driver;
  free(driver);
  return 0;
}

ws2812_t *ws2812_open(void) { return opened(ws2812_start); }
ws2812_t *ws2812b_open(void) { return opened(ws2812b_start); }

void ws2812_stop(ws2812_t *driver) {
  host_call();
  if (driver->cog >= 0) host_stop(driver->cog);
  driver->cog = -1;
  for (int i = 0; i < 8; i++)
    if (strips[i].driver == driver) strips[i].driver = 0;
}

void ws2812_close(ws2812_t *driver) {
  while (driver->command) host_call();
  ws2812_stop(driver);
  free(driver);
}

void ws2812_set(ws2812_t *driver, int pin, uint32_t *colors, int count) {
  host_call();
  while (driver->command) host_call();
  for (int i = 0; i < 8; i++)
    if (strips[i].driver == driver) strips[i].pin = pin & 31, strips[i].colors = colors, strips[i].count = count;
  driver->command = 1;
}

uint32_t ws2812_wheel_dim(int pos, int brightness) {
  int third = pos < 85 ? 0 : pos < 170 ? 1 : 2, rise = (pos - 85 * third) * 3, fall = 255 - rise;
  int red = third == 0 ? fall : third == 1 ? 0 : rise, green = third == 0 ? rise : third == 1 ? fall : 0;
  return COLORX(red, green, third == 0 ? 0 : third == 1 ? rise : fall, brightness);
}

uint32_t ws2812_wheel(int pos) { return ws2812_wheel_dim(pos, 255); }
