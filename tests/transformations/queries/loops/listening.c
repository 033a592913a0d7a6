// 10 to 40
#include "simpletools.h"
#include "fdserial.h"
fdserial *link;
int main() {
  link = fdserial_open(9, 8, 0, 9600);
  while (1) {
    toggle(26);
    pause(10);
    fdserial_rxTime(link, 30);
  }
}
