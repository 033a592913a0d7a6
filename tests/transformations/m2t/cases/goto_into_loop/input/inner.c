#include "simpletools.h"

int main()
{
  high(1);
  while (1) {
    int tries = 0;
retry:
    tries++;
    if (tries < 3) goto retry;
    pause(tries);
  }
}
