/* The cog's code stands in a file of its own, with state of its own. */
#include "simpletools.h"
#include "blinker.h"

static int count = 100;

int main()
{
  blinker_start();
  while (1)
  {
    if (blinker_count() == 5) break;
    count++;
    pause(2);
  }
  blinker_stop();
  print("%d %d\n", blinker_count(), count > 105);
}
