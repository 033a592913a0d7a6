/* A memory of its own on a two-wire bus, written with the highest byte of an address first, and waited for. */
#include "simpletools.h"

i2c *bus;

int main() {
  unsigned char out[] = {11, 22, 33, 44};
  unsigned char in[4] = {0, 0, 0, 0};
  bus = i2c_newbus(2, 3, 0);
  int n = i2c_out(bus, 0x50, 0x0120, 2, out, 4);
  while (i2c_busy(bus, 0x50))
    ;
  int m = i2c_in(bus, 0x50, 0x0121, 2, in, 3);
  print("%d %d %d %d %d\n", n, m, in[0], in[1], in[2]);
  i2c_in(bus, 0x50, 0x2001, -2, in, -2);
  print("%d %d\n", in[0], in[1]);
  print("%d\n", i2c_out(bus, 0x33, 1, 1, out, 1));
}
