#include "simpletools.h"
/* The loop ends by itself, by a pin, or by what it does. */
static volatile int ready;
static int other;
void measure(void *par) { ready = 1; }

int main(void)
{
  cognew(measure, 0);
  while (!ready) { if (input(3)) break; }
  while (!ready) ready = input(3);
  while (!input(4));
  while (other < 5) other++;
}
