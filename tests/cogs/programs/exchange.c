/* A cog blinks as fast as a shared variable says, until main ends it. */
#include "simpletools.h"

void blink();                       // the other cog
int *cog;
volatile int dt;                    // for both

int main()
{
  dt = 100;
  cog = cog_run(blink, 128);
  pause(1000);
  dt = 50;
  pause(1000);
  cog_end(cog);
  high(27);
}

void blink()
{
  while(1)
  {
    high(26);
    pause(dt);
    low(26);
    pause(dt);
  }
}
