/* The same on three wires, at another range and resolution, axis by axis. */
#include "simpletools.h"
#include "lis3dh.h"

int main() {
  lis3dh *s = lis3dh_init(9, 8, 7);
  lis3dh_setRange(s, 4);
  lis3dh_setResolution(s, 10);
  print("%d %d\n", lis3dh_getRange(s), lis3dh_getResolution(s));
  pause(100);
  print("%d %d\n", lis3dh_getAccel_mg(s, LIS3DH_AXIS_X), lis3dh_getAccel_mg(s, LIS3DH_AXIS_Z));
  pause(600);
  print("%d\n", lis3dh_getAccel_mg(s, LIS3DH_AXIS_Y));
  lis3dh_shutdown(s);
}
