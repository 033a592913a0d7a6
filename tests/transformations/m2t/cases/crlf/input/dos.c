#include "simpletools.h"

#define LED 26

// A comment.
int main()
{
  int n = 0;
  set_direction(LED, 1);
  while (1)
  {
    n++;  // count

    pause(n);
  }
}
