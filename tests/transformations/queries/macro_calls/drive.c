#include "simpletools.h"
#include "abdrive.h"
#include "ping.h"
#include "go.h"
#define GO(l, r) drive_speed(l, r)
#define CM ping_cm(8)
int main()
{
  GO(32, 32);
  int d = CM;
  LAMP(5);
  while (CM > 10) { pause(20); }
  GO(0, 0);
  return 0;
}
