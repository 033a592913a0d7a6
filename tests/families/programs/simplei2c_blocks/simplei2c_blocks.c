/* An EEPROM of its own by whole blocks, and whether somebody is there. */
#include "simpletools.h"
#include "simplei2c.h"

int main() {
  unsigned char out[] = {0x01, 0x40, 7, 8, 9}, back[3];
  i2c theBus, *bus = i2c_open(&theBus, 4, 5, 1);
  i2c_start(bus);
  i2c_writeByte(bus, 0xA0);
  print("%d\n", i2c_writeData(bus, out, 5));
  i2c_stop(bus);
  int polls = 0;
  while (i2c_poll(bus, 0xA0))
    polls++;
  print("%d\n", polls > 0);
  i2c_in(bus, 0x50, 0x0140, 2, back, 3);
  print("%d %d %d\n", back[0], back[1], back[2]);
}
