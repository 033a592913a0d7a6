/* A cog runs a pump until main ends it; main never drives its pin. */
#include "simpletools.h"

int *cog;

void pump(void *par)
{
  high(4);
  while(1) pause(10);
}

int main()
{
  cog = cog_run(pump, 60);
  pause(300);
  cog_end(cog);
}
