/* A cog runs two pumps, one by registers, until main ends it; main never drives their pins. */
#include "simpletools.h"

int *cog;

void pump(void *par)
{
  high(4);
  DIRA |= 1 << 5;
  OUTA |= 1 << 5;
  while(1) pause(10);
}

int main()
{
  cog = cog_run(pump, 60);
  pause(300);
  cog_end(cog);
}
