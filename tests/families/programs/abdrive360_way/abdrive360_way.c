/* A robot with servos that tell their angle drives a way and back. */
#include "simpletools.h"
#include "abdrive360.h"

int left, right;

int main() {
  drive_goto(64, 48);
  drive_getTicks(&left, &right);
  print("%d %d\n", left, right);
  drive_goto(-32, -32);
  drive_getTicks(&left, &right);
  print("%d %d\n", left, right);
}
