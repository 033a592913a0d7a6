#include "simpletools.h"
#include "blinker.h"

static volatile int count;
static int started;
static int *cog;

static void blink(void *par)
{
  while (1)
  {
    high(26);
    pause(10);
    low(26);
    pause(10);
    count++;
  }
}

void blinker_start(void)
{
  started++;
  cog = cog_run(blink, 40);
}

int blinker_count(void) { return started * count; }

void blinker_stop(void) { if (cog) cog_end(cog); }
