#include "simpletools.h"

#define LED 3
const int horn = 4;
enum { lamp = 5, fan = 6 };
int rows[] = {7, 8};
int spare;
struct leg { int pin, speed; };
struct leg legs[] = {{9, 100}, {10, 50}};

static void blink(int pin, int ms) {
  high(pin);
  pause(ms);
  low(pin);
}

static int chosen(int first) { return first ? 11 : 12; }

static void toggled(int p) {
  toggle(p);
}

static void each(void) {
  for (int i = 0; i < 2; i++) {
    high(rows[i]);
  }
}

int main(void) {
  int button = 13;
  spare = 14;
  high(LED);
  low(horn);
  high(lamp);
  blink(fan, 100);
  each();
  for (int i = 0; i < 2; i++) high(legs[i].pin);
  low(chosen(1));
  toggled(15);
  for (int i = 16; i < 18; i++) low(i);
  high(-1);
  while (1) {
    if (input(button)) high(spare);
    set_outputs(4, 3, 0b11);
    pause(20);
  }
}
