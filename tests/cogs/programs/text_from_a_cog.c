/* A cog prints while main blinks. */
#include "simpletools.h"

volatile int number;

void teller(void *par)
{
  while (1)
  {
    if (number > 0)
    {
      print("told %d %s %.2f\n", number, "times", number * 0.5);
      number = -number;
    }
  }
}

int main()
{
  int n = 0;
  cog_run(teller, 128);
  while (1)
  {
    high(26);
    pause(25);
    low(26);
    pause(25);
    n++;
    number = n;
  }
}
