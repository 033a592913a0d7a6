#include "simpletools.h"
int waits[] = {4000, 6000, 8000, 5000, 9000, 7000, 8000, 9000, 6000, 5000, 3000};
void never(void) { high(9); pause(3); low(9); }
int main()
{
  for (int i = 0; i < 11; i++) {
    high(5);
    pause(waits[i]);
    low(5);
    pause(500);
  }
  while (1) pause(100);
}
