/* Wheels that go from place to place and turn in between: the marks of their way, and the times, hardly differ for another angle. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_goto(64, 64);
  pause(200);
  drive_goto(26, -25);
  pause(200);
  drive_goto(64, 64);
}
