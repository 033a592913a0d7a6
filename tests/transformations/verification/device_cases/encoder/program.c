/* A wheel with an encoder: how far it has turned. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  int left, right;
  drive_goto(64, 64);
  drive_getTicks(&left, &right);
  print("%d %d\n", left / 8, right / 8);
  drive_speed(0, 0);
}
