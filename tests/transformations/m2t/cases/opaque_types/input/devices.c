#include "simpletools.h"
#include "fdserial.h"

serial *gps;
i2c *bus;

int main()
{
  fdserial *term = fdserial_open(31, 30, 0, 115200);
  unsigned char buffer[8];
  gps = serial_open(8, 9, 0, 9600);
  bus = i2c_newbus(28, 29, 0);
  while (1) {
    int c = fdserial_rxChar(term);
    fdserial_txChar(term, c);
    i2c_in(bus, 0x68, 0, 1, buffer, 8);
  }
}
