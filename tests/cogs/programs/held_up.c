/* A cog blinks while main makes pulses, which no other cog can wait beside. */
#include "simpletools.h"

int stack[60];

void blink(void *par)
{
  while (1)
  {
    high(26);
    pause(50);
    low(26);
    pause(50);
  }
}

int main()
{
  cogstart(blink, NULL, stack, sizeof stack);
  while (1)
  {
    pulse_out(5, 6000);
    pause(20);
  }
}
