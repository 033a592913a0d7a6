/* Wheels that tell their angles: they go ahead for a time, brake, and turn so far. Where they brake they turn back at once. */
#include "simpletools.h"
#include "abdrive360.h"

int main() {
  drive_speed(64, 64);
  pause(300);
  drive_speed(0, 0);
  pause(150);
  drive_goto(26, -26);
}
