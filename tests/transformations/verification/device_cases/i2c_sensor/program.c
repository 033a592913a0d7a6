/* A sensor on the two-wire bus: a setting is written, two registers are read. */
#include "simpletools.h"

int main() {
  i2c *bus = i2c_newbus(5, 4, 0);
  unsigned char setting = 0x5A, read[2];
  i2c_out(bus, 0x68, 0x6B, 1, &setting, 1);
  while (1) {
    i2c_in(bus, 0x68, 0x3B, 1, read, 2);
    print("%d\n", read[0] * 256 + read[1]);
    pause(250);
  }
}
