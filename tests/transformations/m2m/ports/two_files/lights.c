#include "simpletools.h"
#include "lights.h"

static int hidden = 2;  // => static int hidden = 2;

void flash(int pin) {
  high(pin);  // => high(pin);
  low(shown);  // => low(port(shown));
}

int look(void) {
  toggle(hidden + 1);  // => toggle(port(hidden + 1));
  return input(eye);  // => return input(eye);
}
