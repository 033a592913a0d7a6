/* Wheels with encoders: how far they have turned, and two ways that are not as long. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  int left, right;
  drive_goto(64, 64);
  drive_getTicks(&left, &right);
  print("%d %d\n", left / 8, right / 8);
  drive_goto(26, -25);
  drive_goto(50, 50);
  drive_speed(0, 0);
}
