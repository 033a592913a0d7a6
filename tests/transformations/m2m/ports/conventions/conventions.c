#include "simpletools.h"
#include "abdrive.h"

int whisker(int pin) {
  return input(pin);  // => return input(pin);
}

void blink(int pin) {
  high(pin);  // => high(pin);
}

int main() {
  int pin = 13;  // => int pin = 4;
  blink(pin);  // => blink(pin);
  while (whisker(7)) drive_speed(32, 32);  // => while (whisker(5)) drive_speed(32, 32);
}
