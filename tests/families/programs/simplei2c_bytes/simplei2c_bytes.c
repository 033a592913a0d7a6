/* A sensor on the two-wire bus that is read byte by byte. */
#include "simpletools.h"
#include "simplei2c.h"

i2c bus;

int main() {
  unsigned char data[3];
  i2c_open(&bus, 28, 29, 0);
  data[0] = 9;
  i2c_out(&bus, 0x68, 40, 1, data, 1);
  i2c_start(&bus);
  print("%d", i2c_writeByte(&bus, 0x68 << 1));
  print("%d", i2c_writeByte(&bus, 5));
  i2c_start(&bus);
  print("%d ", i2c_writeByte(&bus, 0x68 << 1 | 1));
  int first = i2c_readByte(&bus, 0);
  int second = i2c_readByte(&bus, 1);
  i2c_stop(&bus);
  print("%d\n", second - first);
  i2c_start(&bus);
  i2c_writeByte(&bus, 0xD0);
  i2c_writeByte(&bus, 7);
  i2c_start(&bus);
  i2c_writeByte(&bus, 0xD1);
  print("%d ", i2c_readData(&bus, data, 3));
  i2c_stop(&bus);
  print("%d %d\n", data[1] - data[0], data[2] - first);
}
