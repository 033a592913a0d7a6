/* Wheels that tell their angles: they go ahead, and turn. */
#include "simpletools.h"
#include "abdrive360.h"

int main() {
  drive_goto(40, 40);
  pause(300);
  drive_goto(26, -25);
}
