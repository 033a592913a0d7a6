#include "simpletools.h"
#include "abdrive.h"
int main()
{
  int l, r;
  drive_goto(64, 64);
  drive_speed(32, 32);
  drive_getTicks(&l, &r);
  print("%d %d\n", l, r);
  return 0;
}
