#include "simpletools.h"
#include "abdrive.h"

int main()
{
  drive_speed(64, 64);      // from 0.14 s on
  pause(600);
  drive_speed(-64, -64);
  pause(600);
  drive_speed(64, -64);
  pause(600);
  drive_speed(0, 0);
}
