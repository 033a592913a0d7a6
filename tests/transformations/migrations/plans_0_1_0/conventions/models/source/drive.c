#include "simpletools.h"
#include "abdrive.h"

#define LED 26

int main()
{
  drive_speed(24, 24);
  while (1) {
    high(LED);
    pause(1000);
    low(LED);
  }
}
