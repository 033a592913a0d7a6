#include "simpletools.h"
#include "servo.h"
#include "ping.h"

int main()
{
  servo_angle(14, 900);
  while (1)
  {
    print("%d\n", ping_cm(15));
    pause(200);
  }
}
