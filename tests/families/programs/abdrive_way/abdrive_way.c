/* A robot that drives a way by its encoders, turns, and tells how far its wheels came. */
#include "simpletools.h"
#include "abdrive.h"

int left, right;

int main() {
  drive_goto(64, 64);
  drive_getTicks(&left, &right);
  print("%d %d\n", left, right);
  drive_goto(26, -25);
  drive_getTicks(&left, &right);
  print("%d %d\n", left, right);
  high(26);
}
