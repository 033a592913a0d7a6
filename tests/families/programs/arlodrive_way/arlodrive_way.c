/* A large robot whose motor controller is told where to go. */
#include "simpletools.h"
#include "arlodrive.h"

int left, right;

int main() {
  drive_speed(50, -50);
  pause(200);
  drive_speed(0, 0);
  drive_close();
}
