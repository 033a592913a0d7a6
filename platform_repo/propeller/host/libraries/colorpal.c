/* colorpal.h: 4,800 baud in both directions on one wire of open drain. Source: libcolorpal/colorpal.c. */
#include "simpletools.h"
#include "colorpal.h"

enum { BAUD = 4800, RESET_MS = 80, AFTER_MS = 10, START_MS = 100 };

static void reset(colorPal *device) {
  int pin = ((colorPal_t *)device->devst)->tx_pin;
  input(pin);
  while (!input(pin)) {}
  low(pin);
  pause(RESET_MS);
  input(pin);
  pause(AFTER_MS);
}

static void init(colorPal *device) {
  reset(device);
  writeStr(device, "=(00 $ m)!");
}

colorPal *colorPal_open(int sioPin) {
  colorPal *device = host_serial_line(sioPin, sioPin, FDSERIAL_MODE_OPENDRAIN_TX | FDSERIAL_MODE_IGNORE_TX_ECHO, BAUD, START_MS);
  if (device) init(device);
  return device;
}

void colorPal_close(colorPal *device) { fdserial_close(device); }

void colorPal_getRGB(colorPal *device, int *r, int *g, int *b) {
  int *colours[3] = {r, g, b};
  fdserial_rxFlush(device);
  while (readChar(device) != '$') {}
  for (int k = 0; k < 3; k++) {
    char digits[4] = {0};
    for (int i = 0; i < 3; i++) digits[i] = readChar(device);
    *colours[k] = strtol(digits, 0, 16);
  }
}

static unsigned clipped(int value) { return value < 0 ? 0 : value > 255 ? 255 : value; }

unsigned int colorPalRRGGBB(int r, int g, int b) {
  unsigned red = clipped(21 * r / 11 - 65 - r * r / 415), green = clipped(48 * g / 17 - 70 - g * g / 170);
  return red << 16 | green << 8 | clipped(8 * b / 9 - 30 - b * b / 1680);
}
