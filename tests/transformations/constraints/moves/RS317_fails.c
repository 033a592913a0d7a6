#include "simpletools.h"
#include "fdserial.h"

int main(void)
{
  fdserial *port = fdserial_open(9, 8, 0, 9600);
  char c = fdserial_rxCheck(port);
  if (c != -1) putChar(c);  // RS317: c != -1
  if (c >= 0) putChar(c);  // RS317: c >= 0
  if (c > 200) putChar(c);  // RS317: c > 200
}
