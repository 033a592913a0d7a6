/* A beacon: a light, a button, a knob, and a voice over the serial port. */
#include "simpletools.h"

enum { slow = 400, quick = 90 };

const int LAMP   = 7;   // the lamp
const int BUTTON = 6;   // the button, pressed is 1
const int KNOB   = 5;   // the knob's wiper

static int times = 0;
static const char *words[] = { "slow", "quick" };

int wait_time(int pressed) {
  return pressed ? quick : slow;
}

int main() {
  int *counter = &times;
  unsigned char steps[3] = { 1, 2, 3 };
  low(LAMP);
  while (1) {
    int pressed = input(BUTTON);
    int turn = input(KNOB);
    high(LAMP);
    pause(wait_time(pressed) + turn * steps[1]);  // on
    low(LAMP);
    pause(wait_time(pressed));                    // off
    *counter = *counter + 1;
    if (times % 10 == 0) {
      print("%s %d\n", words[pressed != 0], times);
    }
  }
}
