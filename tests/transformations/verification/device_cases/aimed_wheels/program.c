/* Wheels that are driven for a time, and so far from where that ends. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_speed(64, 64);
  pause(400);
  drive_speed(0, 0);
  pause(200);
  drive_goto(26, -25);
}
