#include "simpletools.h"
#include "speech.h"
#include "servodiffdrive.h"

voice *mouth;

int main()
{
  int n = 0;
  drive_pins(12, 13);
  while (n < 3) {
    high(5);
    pause(200);
    low(5);
    beacon(n, 3);
    say(mouth, "hello");
    pause(SAY_PAUSE);
    n = n + 1;
  }
}
