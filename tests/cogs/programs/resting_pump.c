/* A cog runs three pumps, two by registers, until main ends it; main never drives their pins. */
#include "simpletools.h"

int *cog;

void pump(void *par)
{
  high(4);
  DIRA |= 1 << 5;
  OUTA |= 1 << 5;
  DIRA = DIRA | 1 << 6;
  OUTA = OUTA | 1 << 6;
  while(1) pause(10);
}

int main()
{
  cog = cog_run(pump, 60);
  pause(300);
  cog_end(cog);
}
