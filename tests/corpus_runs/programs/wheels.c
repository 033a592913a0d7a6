#include "simpletools.h"
#include "abdrive.h"
#include "speeds.h"

int main()
{
  drive_speed(FORWARD, FORWARD);
  pause(1000);
  drive_speed(0, 0);
}
