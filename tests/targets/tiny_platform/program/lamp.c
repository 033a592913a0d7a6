#include "octo.h"

#define BUTTON 2
const int lamps[2] = {5, 7};

int main(void)
{
  int turn = 0;
  for (;;)
  {
    if (is_on(BUTTON))
    {
      turn_on(lamps[turn]);
      wait_ms(100);
      turn_off(lamps[turn]);
      turn = !turn;
    }
    wait_ms(10);
  }
}
