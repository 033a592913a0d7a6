#include "simpletools.h"
#include "abdrive.h"

int main(void) {
  drive_speed(32, 32);
  pause(2000);
  drive_speed(0, 0);
}
