/* A turn at a speed that is held, by wheels with feedback. */
#include "simpletools.h"
#include "abdrive360.h"

int main() {
  int l0, r0, l1, r1;
  drive_speed(40, -40);
  pause(1000);
  drive_getTicks(&l0, &r0);
  pause(1000);
  drive_getTicks(&l1, &r1);
  drive_speed(0, 0);
  print("%d %d\n", l1 - l0, r1 - r0);
  pause(600);
  drive_getTicks(&l0, &r0);
  pause(300);
  drive_getTicks(&l1, &r1);
  print("%d %d\n", l1 - l0, r1 - r0);
}
