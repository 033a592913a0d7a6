// expect D9=1 D8=2 D7=3
#include "simpletools.h"
typedef struct { unsigned mask; int times; } Lamp;
static Lamp lamps[3];
static int stacks[3][64];
static void on(int n) { unsigned bits = 1 << n; DIRA |= bits; OUTA |= bits; }
static void off(int n) { OUTA &= ~(1u << n); }
static void twice(void *arg) {
  int pin = (int) arg;
  for (int i = 0; i < 2; i++) { on(pin); pause(5); off(pin); pause(5); }
  while (1) pause(100);
}
int main(void) {
  int pins[] = {0, 1, 2};
  cogstart(twice, (void *) pins[1], stacks[1], sizeof stacks[1]);
  for (int i = 0; i < 3; i += 2) { lamps[i].mask = 1 << pins[i]; lamps[i].times = i + 1; }
  for (Lamp *lamp = lamps; lamp < lamps + 3; lamp += 2) {
    DIRA |= lamp->mask;
    for (int i = 0; i < lamp->times; i++) { OUTA |= lamp->mask; pause(3); OUTA &= ~lamp->mask; pause(3); }
  }
  while (1) pause(100);
}
