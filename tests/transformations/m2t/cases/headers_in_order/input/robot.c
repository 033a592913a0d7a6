#include "abdrive.h"
#include "ping.h"
#include "moves.h"

int main()
{
  while (near(20) == 0) pause(50);
  away(100);
  drive_speed(0, 0);
}
