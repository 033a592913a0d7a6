/* Commands of one's own to the motor controller. */
#include "simpletools.h"
#include "arlodrive.h"

int main() {
  char *s;
  drive_open();
  s = dhb10_com("gospd 10 -10\r");
  print("%d\n", s != 0);
  pause(100);
  drive_clearTicks();
  drive_close();
}
