/* What comes while the program does something else is kept until it is asked for. */
#include "simpletools.h"
#include "fdserial.h"

#define RX 3
#define TX 4

int main() {
  fdserial *line = fdserial_open(RX, TX, 0, 19200);
  pause(400);
  print("%d %d %d\n", fdserial_rxCount(line), fdserial_rxReady(line) != 0, fdserial_rxPeek(line));
  print("%c", fdserial_rxChar(line));
  print("%c ", fdserial_rxCheck(line));
  fdserial_rxFlush(line);
  print("%d %d\n", fdserial_rxCount(line), fdserial_rxCheck(line));
  for (int n = 0; n < 3; n++) {
    int c = fdserial_rxChar(line);
    fdserial_txChar(line, c + 1);
  }
  fdserial_txFlush(line);
  print("%d\n", fdserial_txEmpty(line) != 0);
}
