#include "simpletools.h"
#define LED 5

int main()
{
  int n = 0;
#ifdef LED
  high(LED);
#else
  low(1);
#endif
  while (1) {
#if defined(LED) && LED > 3
    toggle(LED);
#endif
    n++;
    pause(n);
  }
}
