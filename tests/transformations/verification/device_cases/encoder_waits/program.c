/* Wheels that go from place to place, and stand in between for as long as the program says. */
#include "simpletools.h"
#include "abdrive.h"

int main() {
  drive_goto(40, 40);
  pause(250);
  drive_goto(-20, 20);
  pause(400);
  drive_goto(30, 30);
  drive_goto(10, 10);
}
