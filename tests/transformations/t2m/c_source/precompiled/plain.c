/* a program like most */
#include "board.h"   // the board
#include "motor.h"

output_t led = { LED, 1 };

int main()
{
  enum state now = BUSY;
  set_output(&led, doubled(now) + SQUARE(3));
  if (get_input(LED) < SPEED) STOP();
  counter++;
  return led.level;
}
