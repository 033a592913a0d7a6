// ports 16 17 18
#include "propeller.h"
static int stacks[3][64];
void high(int n) { unsigned int bits = 1 << n; DIRA |= bits; OUTA |= bits; }
void low(int n) { unsigned int mask = 1 << n; OUTA &= ~mask; }
void blink(void *arg) {
  int pin = (int) arg;
  while (1) { high(pin); waitcnt(CNT + CLKFREQ / 2); low(pin); waitcnt(CNT + CLKFREQ / 2); }
}
int main(void) {
  int pin[] = {16, 17, 18};
  for (int n = 1; n < 3; n++) cogstart(blink, (void *) pin[n], stacks[n], sizeof stacks[n]);
  blink((void *) pin[0]);
}
