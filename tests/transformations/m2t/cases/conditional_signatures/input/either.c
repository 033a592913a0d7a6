#include "simpletools.h"
#define NEW_BOARD

#ifdef NEW_BOARD
void lamp(int on)
{
  if (on) high(26); else low(26);
}
#else
void lamp(int on)
{
  OUTA |= on << 26;
}
#endif

int main()
{
  while (1) {
#ifdef NEW_BOARD
    lamp(1);
#else
    lamp(0);
#endif
    pause(10);
  }
}
