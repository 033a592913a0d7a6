/* The drive is first started in a cog, while main waits. */
#include "simpletools.h"
#include "abdrive.h"

void Direction() { while (1) { drive_speed(64, 64); pause(500); } }

int main()
{
  cog_run(Direction, 128);
  while (1) pause(1);
}
