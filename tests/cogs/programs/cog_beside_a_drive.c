/* A cog blinks while the drive that main started works on, in interrupts that come on the stack of the cog as well. */
#include "simpletools.h"
#include "abdrive.h"

void blink() { while (1) { high(26); pause(5); low(26); pause(5); } }

int main()
{
  cog_run(blink, 128);
  drive_speed(64, 64);
  while (1) pause(1);
}
