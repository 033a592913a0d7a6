/* A cog moves a servo by a shared angle and stops when main ends it; main measures with a Ping sensor meanwhile. */
#include "simpletools.h"
#include "servo.h"
#include "ping.h"

volatile int angle = 600, moved;
int *cog;

void sweep(void *par)
{
  while (1)
  {
    servo_angle(25, angle);
    moved++;
    pause(20);
  }
}

int main()
{
  cog = cog_run(sweep, 64);
  int near = ping_cm(5);
  pause(60);
  angle = 1200;
  pause(60);
  int far = ping_cm(5);
  cog_end(cog);
  int last = moved;
  pause(50);
  print("%d cm, %d cm, %d after the end\n", near, far, moved - last);
  high(27);
}
