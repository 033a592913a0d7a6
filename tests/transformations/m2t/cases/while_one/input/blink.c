/* A title
   of two lines. */
#include "simpletools.h"

int count = 0;  // how often

// Blinks once.
void blink(int pin)
{
  high(pin);
  pause(100);
  low(pin);
}

// Comment on main.
int main()                       // behind main
{
  // First the direction.
  set_direction(26, 1);

  blink(26);  // say hello
  while (1)   // for ever
  {
    // In the loop.
    blink(26);
    count++;

    if (count > 10) {
      count = 0;
    }
  }  // behind the loop
}
// The end.
