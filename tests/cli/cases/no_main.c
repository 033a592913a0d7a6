#include "simpletools.h"

int brightness(int pin) {
  return input(pin);
}
