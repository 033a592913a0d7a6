#include "badgetools.h"
void go(int which)
{
  int i;
  for (i = 0; i < LED_COUNT; i++) high(i);
  while (ping_cm(9) > TOO_CLOSE) pause(10);
  switch (which) { case ENTER: led(1, ON); break; default: led(2, OFF); }
}
/* expect: high ping_cm pause led led */
