/* An accelerometer on four wires: thousandths of gravity, and a lamp when it lies on its side. */
#include "simpletools.h"
#include "lis3dh.h"

#define SCK 2
#define SDI 3
#define SDO 4
#define CS 5

int main() {
  int x, y, z;
  lis3dh *sensor = lis3dh_init4wire(SCK, SDI, SDO, CS);
  print("%d\n", lis3dh_getWhoAmI(sensor));
  while (1) {
    lis3dh_accel_mg(sensor, &x, &y, &z);
    print("%d %d %d\n", x, y, z);
    set_direction(26, 1);
    set_output(26, abs(x) > 700);
    pause(200);
  }
}
