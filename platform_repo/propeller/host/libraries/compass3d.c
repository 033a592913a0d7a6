/* compass3d.h: registers of an HMC5883L. Source: libcompass3d/compass3d.c. */
#include "compass3d.h"

enum { ADDRESS = 0x1E, MODE = 2, DATA = 3 };

void compass_init(i2c *bus) {
  unsigned char continuous = 0;
  i2c_out(bus, ADDRESS, MODE, 1, &continuous, 1);
}

void compass_read(i2c *bus, int *px, int *py, int *pz) {
  unsigned char data[6] = {0};
  int *axes[3] = {px, pz, py};
  i2c_in(bus, ADDRESS, DATA, 1, data, sizeof data);
  for (int k = 0; k < 3; k++) *axes[k] = (short)(data[2 * k] << 8 | data[2 * k + 1]);
}
