#include "simpletools.h"
/* What waits is done once. */
int main(void)
{
  pause(1000);
  while (!input(4));
  while (1) {
    int steps = 0;
    toggle(26);
    while (steps < 10 && input(3)) steps++;
    for (steps = 0; steps < 5; steps++);
  }
}
