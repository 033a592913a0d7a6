#include <stdio.h>
#include <time.h>
#include <propeller.h>

typedef struct { char ids[8]; int valid; } Sentence;

volatile Sentence last;

static _NATIVE
doubled(int value)
{
  return 2 * value;
}

char *ids()
{
  return(last.ids);
}

void start(volatile void *parameter)
{
  extern unsigned int binary_blink_dat_start[];
  cognew(binary_blink_dat_start, parameter);
}

int main()
{
  int levels[4];
  int at = (int)&levels[1];
  start(&last);
  while (1) {
    if (at < &levels[3]) printf("%s %d\n", ids(), doubled(levels[0]));
    waitcnt(CNT + _clkfreq);
  }
}
