/* A radio module at 9600 baud: letters move a lamp, numbers are sent back. */
#include "simpletools.h"
#include "fdserial.h"

fdserial *radio;
int got;

int main() {
  radio = fdserial_open(9, 8, 0, 9600);
  low(26);
  writeStr(radio, "ready\r");
  dprint(radio, "%d,%x\r", 1000, 255);
  while (1) {
    int c = fdserial_rxTime(radio, 150);
    if (c == -1) {
      fdserial_txChar(radio, '.');
      continue;
    }
    if (c == 'h') high(26);
    if (c == 'l') low(26);
    if (c == 'n') {
      got = readDec(radio);
      writeDec(radio, got * 2);
      fdserial_txChar(radio, '\r');
    }
    if (c == 'q') break;
  }
  fdserial_close(radio);
  print("done %d\n", got);
}
