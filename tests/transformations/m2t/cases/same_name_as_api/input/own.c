#include "simpletools.h"

int get_state(int pin) { return input(pin); }
int pause_time = 5;

void pause(int ms)
{
  waitcnt(CNT + ms * (CLKFREQ / 1000));
}

int main()
{
  while (1) {
    if (get_state(3)) pause(pause_time);
  }
}
